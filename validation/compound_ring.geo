// A quarter of two rings, radii 1, 1.5 and 2 mm.
DefineConstant[ h = 0.4 ];
Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};  Point(3) = {1.5, 0, 0, h};  Point(4) = {0, 1.5, 0, h};  Point(5) = {0, 1, 0, h};
Line(1) = {2, 3};  Circle(2) = {3, 1, 4};  Line(3) = {4, 5};  Circle(4) = {5, 1, 2};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Point(12) = {1.5, 0, 0, h};  Point(13) = {2, 0, 0, h};  Point(14) = {0, 2, 0, h};  Point(15) = {0, 1.5, 0, h};
Line(11) = {12, 13};  Circle(12) = {13, 1, 14};  Line(13) = {14, 15};  Circle(14) = {15, 1, 12};
Curve Loop(2) = {11 : 14};  Plane Surface(2) = {2};
Physical Curve("displacement:below") = {1, 11};
Physical Curve("displacement:left") = {3, 13};
Physical Curve("force:hole") = {4};
Physical Curve("force:rim") = {12};
Physical Curve("contact:inner") = {2};
Physical Curve("contact:outer") = {14};
Physical Surface("aluminium") = {1};
Physical Surface("steel") = {2};
