// A quarter of a cylinder of radius 3 on a rigid plane; symmetry: x = 0.
DefineConstant[ h = 0.5 ];
R = 3;  w = Pi/18;
Point(1) = {0, 0, 0, h/6};  Point(2) = {R*Sin(w), R*(1 - Cos(w)), 0, h/3};  Point(3) = {R, R, 0, h};  Point(4) = {0, R, 0, h};
Circle(1) = {1, 4, 2};  Circle(2) = {2, 4, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:foot") = {1};
Physical Curve("force") = {2};
Physical Curve("force:top") = {3};
Physical Curve("displacement:axis") = {4};
Physical Surface("cylinder") = {1};
