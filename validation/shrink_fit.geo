// A quarter of a shaft, radius 10 mm, and a rim, 20 mm.
DefineConstant[ h = 4 ];
Point(1) = {0, 0, 0, h};  Point(2) = {10, 0, 0, h};  Point(3) = {0, 10, 0, h};
Line(1) = {1, 2};  Circle(2) = {2, 1, 3};  Line(3) = {3, 1};
Curve Loop(1) = {1 : 3};  Plane Surface(1) = {1};
Point(12) = {10, 0, 0, h};  Point(13) = {20, 0, 0, h};  Point(14) = {0, 20, 0, h};  Point(15) = {0, 10, 0, h};
Line(11) = {12, 13};  Circle(12) = {13, 1, 14};  Line(13) = {14, 15};  Circle(14) = {15, 1, 12};
Curve Loop(2) = {11 : 14};  Plane Surface(2) = {2};
Physical Curve("displacement:below") = {1, 11};
Physical Curve("displacement:left") = {3, 13};
Physical Curve("contact:shaft") = {2};
Physical Curve("contact:rim") = {14};
Physical Curve("force:free") = {12};
Physical Surface("shaft") = {1};
Physical Surface("rim") = {2};
