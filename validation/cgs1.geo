// Half of a cylinder of 100 mm on half of a block of 200 by 200 mm; symmetry: x = 0.
DefineConstant[ h = 12 ];
R = 50;  w = Pi/12;  t = Pi/18;        // angles of the contact face, of the loaded top
Point(1) = {0, 0, 0, h/4};  Point(2) = {R*Sin(w), R*(1 - Cos(w)), 0, h/2};  Point(3) = {R, R, 0, h};
Point(4) = {R*Sin(t), R*(1 + Cos(t)), 0, h};  Point(5) = {0, 2*R, 0, h};  Point(6) = {0, R, 0, h};
Circle(1) = {1, 6, 2};  Circle(2) = {2, 6, 3};  Circle(3) = {3, 6, 4};  Circle(4) = {4, 6, 5};
Line(5) = {5, 6};  Line(6) = {6, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Point(11) = {0, -200, 0, 3*h};  Point(12) = {100, -200, 0, 3*h};  Point(13) = {100, 0, 0, 3*h};
Point(14) = {15, 0, 0, h/2};  Point(15) = {0, 0, 0, h/4};
Line(11) = {11, 12};  Line(12) = {12, 13};  Line(13) = {13, 14};  Line(14) = {14, 15};  Line(15) = {15, 11};
Curve Loop(2) = {11 : 15};  Plane Surface(2) = {2};
Physical Curve("contact:cylinder") = {1};
Physical Curve("contact:block") = {14};
Physical Curve("force:top") = {4};
Physical Curve("force") = {2, 3, 12, 13};
Physical Curve("displacement:bottom") = {11};
Physical Curve("displacement:axis") = {5, 6, 15};
Physical Surface("cylinder") = {1};
Physical Surface("block") = {2};
