// Quarters of two cylinders of 10 and 13 mm, held at their flat sides; symmetry: x = 0.
DefineConstant[ h = 1.5 ];
R = 10;  S = 13;  w = Pi/12;
Point(1) = {0, 0, 0, h/4};  Point(2) = {R*Sin(w), R*(1 - Cos(w)), 0, h/2};  Point(3) = {R, R, 0, h};  Point(4) = {0, R, 0, h};
Circle(1) = {1, 4, 2};  Circle(2) = {2, 4, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Point(11) = {0, 0, 0, h/4};  Point(12) = {S*Sin(w), S*(Cos(w) - 1), 0, h/2};  Point(13) = {S, -S, 0, h};  Point(14) = {0, -S, 0, h};
Circle(11) = {12, 14, 11};  Circle(12) = {13, 14, 12};  Line(13) = {14, 13};  Line(14) = {11, 14};
Curve Loop(2) = {11, 14, 13, 12};  Plane Surface(2) = {2};
Physical Curve("contact:upper") = {1};
Physical Curve("contact:lower") = {11};
Physical Curve("force") = {2, 12};
Physical Curve("displacement:upper") = {3};
Physical Curve("displacement:lower") = {13};
Physical Curve("displacement:axis") = {4, 14};
Physical Surface("upper") = {1};
Physical Surface("lower") = {2};
