// A quarter of a shaft of radius 500 mm in a ring of 1000 mm, both drawn with the nominal radius.
DefineConstant[ h = 200 ];
r = 500;  R = 1000;
Point(1) = {0, 0, 0, h};  Point(2) = {r, 0, 0, h};  Point(3) = {0, r, 0, h};
Line(1) = {1, 2};  Circle(2) = {2, 1, 3};  Line(3) = {3, 1};
Curve Loop(1) = {1 : 3};  Plane Surface(1) = {1};
Point(12) = {r, 0, 0, 0.8*h};  Point(13) = {R, 0, 0, h};  Point(14) = {0, R, 0, h};  Point(15) = {0, r, 0, 0.8*h};
Line(11) = {12, 13};  Circle(12) = {13, 1, 14};  Line(13) = {14, 15};  Circle(14) = {15, 1, 12};
Curve Loop(2) = {11 : 14};  Plane Surface(2) = {2};
Physical Curve("displacement:left") = {3, 13};
Physical Curve("displacement:below") = {1, 11};
Physical Curve("contact:shaft") = {2};
Physical Curve("contact:ring") = {14};
Physical Curve("force") = {12};
Physical Surface("shaft") = {1};
Physical Surface("ring") = {2};
