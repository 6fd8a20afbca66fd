// Half of a layer of 1 mm, 16 mm long, pressed over 0.2 mm on half of a block of 400 by 200 mm; symmetry: x = 0.
DefineConstant[ h = 0.2 ];
L = 200;
Point(1) = {0, 0, 0, h};  Point(2) = {2, 0, 0, h};  Point(3) = {8, 0, 0, 4*h};  Point(4) = {8, 1, 0, 4*h};
Point(5) = {0.1, 1, 0, h/2};  Point(6) = {0, 1, 0, h/2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Point(11) = {0, 0, 0, h};  Point(12) = {2, 0, 0, h};  Point(13) = {L, 0, 0, L/3};  Point(14) = {L, -L, 0, L/3};  Point(15) = {0, -L, 0, L/3};
Line(11) = {12, 11};  Line(12) = {13, 12};  Line(13) = {14, 13};  Line(14) = {15, 14};  Line(15) = {11, 15};
Curve Loop(2) = {11, 15, 14, 13, 12};  Plane Surface(2) = {2};
Physical Curve("contact:layer") = {1};
Physical Curve("contact:ground") = {11};
Physical Curve("force:top") = {5};
Physical Curve("force") = {2, 3, 4, 12, 13};
Physical Curve("displacement:bottom") = {14};
Physical Curve("displacement:axis") = {6, 15};
Physical Surface("layer") = {1};
Physical Surface("ground") = {2};
