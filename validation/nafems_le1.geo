// A quarter of an elliptic membrane; in the test 1 mm is 1 m.
DefineConstant[ h = 0.8 ];
Point(1) = {0, 0, 0, h};
Point(2) = {2, 0, 0, h/4};  Point(3) = {3.25, 0, 0, h};  Point(4) = {0, 2.75, 0, h};  Point(5) = {0, 1, 0, h};
Line(1) = {2, 3};  Ellipse(2) = {3, 1, 3, 4};  Line(3) = {4, 5};  Ellipse(4) = {5, 1, 2, 2};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("displacement:below") = {1};
Physical Curve("displacement:left") = {3};
Physical Curve("force:rim") = {2};
Physical Curve("force:hole") = {4};
Physical Surface("membrane") = {1};
