// A punch with rounded edges on a block that stands for a half plane.
DefineConstant[ h = 1.5 ];
w = 3; r = 1;                           // half width, radius of the edges
Point(1) = {-w, 6, 0, h};  Point(2) = {-w, r, 0, h/3};      Point(3) = {-w + r, r, 0, h};
Point(4) = {-w + r, 0, 0, h/8};  Point(5) = {w - r, 0, 0, h/8};  Point(6) = {w - r, r, 0, h};
Point(7) = {w, r, 0, h/3};  Point(8) = {w, 6, 0, h};
Line(1) = {1, 2};  Circle(2) = {2, 3, 4};  Line(3) = {4, 5};  Circle(4) = {5, 6, 7};
Line(5) = {7, 8};  Line(6) = {8, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Point(11) = {-20, -20, 0, 2*h};  Point(12) = {20, -20, 0, 2*h};  Point(13) = {20, 0, 0, 2*h};
Point(14) = {w, 0, 0, h/5};  Point(15) = {-w, 0, 0, h/5};  Point(16) = {-20, 0, 0, 2*h};
Line(11) = {11, 12};  Line(12) = {12, 13};  Line(13) = {13, 14};  Line(14) = {14, 15};  Line(15) = {15, 16};
Line(16) = {16, 11};
Curve Loop(2) = {11 : 16};  Plane Surface(2) = {2};
Physical Curve("displacement:head") = {6};
Physical Curve("displacement:ground") = {11, 12, 16};
Physical Curve("contact:left")  = {2};   // arcs have groups of their own, for their `face`
Physical Curve("contact:sole")  = {3};
Physical Curve("contact:right") = {4};
Physical Curve("contact:ground") = {14};
Physical Curve("force") = {1, 5, 13, 15};
Physical Surface("punch") = {1};
Physical Surface("ground") = {2};
