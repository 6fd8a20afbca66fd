// A pin in the hole of a lug: held at its middle, it pulls the lug to the right against its foot.
DefineConstant[ h = 4 ];
R = 6;  c = 0.02;                       // radius of the hole, clearance
Point(1) = {0, 0, 0, h};
Point(2) = {R, 0, 0, h/5};  Point(3) = {0, R, 0, h/5};  Point(4) = {-R, 0, 0, h/5};  Point(5) = {0, -R, 0, h/5};
Circle(1) = {2, 1, 3};  Circle(2) = {3, 1, 4};  Circle(3) = {4, 1, 5};  Circle(4) = {5, 1, 2};
Point(6) = {0, 12, 0, h};  Point(7) = {12, 0, 0, h};  Point(8) = {0, -12, 0, h};
Point(9) = {-30, 12, 0, h};  Point(10) = {-30, -12, 0, h};
Circle(5) = {8, 1, 7};  Circle(6) = {7, 1, 6};  Line(7) = {6, 9};  Line(8) = {9, 10};  Line(9) = {10, 8};
Curve Loop(1) = {1 : 4};  Curve Loop(2) = {5 : 9};  Plane Surface(1) = {2, 1};
r = R - c;  q = 2;
Point(12) = {r, 0, 0, h/6};  Point(13) = {0, r, 0, h/6};  Point(14) = {-r, 0, 0, h/6};  Point(15) = {0, -r, 0, h/6};
Circle(11) = {12, 1, 13};  Circle(12) = {13, 1, 14};  Circle(13) = {14, 1, 15};  Circle(14) = {15, 1, 12};
Point(22) = {q, 0, 0, h/3};  Point(23) = {0, q, 0, h/3};  Point(24) = {-q, 0, 0, h/3};  Point(25) = {0, -q, 0, h/3};
Circle(21) = {22, 1, 23};  Circle(22) = {23, 1, 24};  Circle(23) = {24, 1, 25};  Circle(24) = {25, 1, 22};
Curve Loop(3) = {11 : 14};  Curve Loop(4) = {21 : 24};  Plane Surface(2) = {3, 4};
Physical Curve("displacement:foot") = {8};
Physical Curve("displacement:axle") = {21 : 24};
Physical Curve("contact:hole") = {1 : 4};
Physical Curve("contact:pin") = {11 : 14};
Physical Curve("force") = {5, 6, 7, 9};
Physical Surface("lug") = {1};
Physical Surface("pin") = {2};
