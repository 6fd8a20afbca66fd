// Two blocks of 8000 by 4000 mm, large beside their contact faces |x| < 1.4 mm.
DefineConstant[ h = 0.35 ];
w = 1.4;  L = 4000;
Point(1) = {-w, 0, 0, h};  Point(2) = {w, 0, 0, h};  Point(3) = {L, 0, 0, L/2};  Point(4) = {L, L, 0, L/2};
Point(5) = {0, L, 0, L/2};  Point(6) = {-L, L, 0, L/2};  Point(7) = {-L, 0, 0, L/2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 1};
Curve Loop(1) = {1 : 7};  Plane Surface(1) = {1};
Point(11) = {-w, 0, 0, h};  Point(12) = {w, 0, 0, h};  Point(13) = {L, 0, 0, L/2};
Point(14) = {L, -L, 0, L/2};  Point(15) = {-L, -L, 0, L/2};  Point(16) = {-L, 0, 0, L/2};
Line(11) = {12, 11};  Line(12) = {13, 12};  Line(13) = {14, 13};  Line(14) = {15, 14};  Line(15) = {16, 15};  Line(16) = {11, 16};
Curve Loop(2) = {11, 16, 15, 14, 13, 12};  Plane Surface(2) = {2};
Physical Curve("contact:upper") = {1};
Physical Curve("contact:lower") = {11};
Physical Curve("force:right") = {4};
Physical Curve("force:left") = {5};
Physical Curve("force") = {2, 3, 6, 7, 12, 13, 15, 16};
Physical Curve("displacement:bottom") = {14};
Physical Surface("upper") = {1};
Physical Surface("lower") = {2};
