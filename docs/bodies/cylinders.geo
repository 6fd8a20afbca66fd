// Two cylinders, an upper half and a lower half, held at their flat sides and pressed together.
DefineConstant[ h = 1.2, fine = 0.04 ];
R = 8;  S = 12;  w = 1;                 // radii; half width of the contact faces
yR = R - Sqrt(R*R - w*w);  yS = Sqrt(S*S - w*w) - S;
Point(1) = {-R, R, 0, h};  Point(2) = {-w, yR, 0, fine*2};  Point(3) = {0, 0, 0, fine};
Point(4) = {w, yR, 0, fine*2};  Point(5) = {R, R, 0, h};  Point(6) = {0, R, 0, h};
Circle(1) = {1, 6, 2};  Circle(2) = {2, 6, 3};  Circle(3) = {3, 6, 4};  Circle(4) = {4, 6, 5};
Line(5) = {5, 6};  Line(6) = {6, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Point(11) = {S, -S, 0, 1.3*h};  Point(12) = {w, yS, 0, fine*2.6};  Point(13) = {0, 0, 0, fine*1.3};
Point(14) = {-w, yS, 0, fine*2.6};  Point(15) = {-S, -S, 0, 1.3*h};  Point(16) = {0, -S, 0, 1.3*h};
Circle(11) = {11, 16, 12};  Circle(12) = {12, 16, 13};  Circle(13) = {13, 16, 14};  Circle(14) = {14, 16, 15};
Line(15) = {15, 16};  Line(16) = {16, 11};
Curve Loop(2) = {11 : 16};  Plane Surface(2) = {2};
Physical Curve("displacement:upper") = {5, 6};
Physical Curve("displacement:lower") = {15, 16};
Physical Curve("contact:upper") = {2, 3};
Physical Curve("contact:lower") = {12, 13};
Physical Curve("force") = {1, 4, 11, 14};
Physical Surface("upper") = {1};
Physical Surface("lower") = {2};
