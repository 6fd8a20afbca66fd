// A snap fit in plane strain: the hook of a plastic beam, held at its left end, slides on a catch.
DefineConstant[ h = 1.2 ];
L = 20;  b = 2;                         // the beam; its hook reaches down by 2 mm, with ramps of 30 degrees
r = 2 / Tan(30 * Pi / 180);
Point(1) = {0, 0, 0, h/2};  Point(2) = {L - 2, 0, 0, h/3};  Point(3) = {L - 2, -2, 0, h/4};  Point(4) = {L - 1, -2, 0, h/6};
Point(5) = {L - 1 + r, 0, 0, h/6};  Point(6) = {L - 1 + r, b, 0, h};  Point(7) = {0, b, 0, h/2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 1};
Curve Loop(1) = {1 : 7};  Plane Surface(1) = {1};
// The catch: its rounded corner, of 1 mm, touches the middle of the ramp.
x = L - 1 + r/2 + Sin(30 * Pi / 180);  y = -1 - Cos(30 * Pi / 180);
Point(10) = {x, y, 0, h};  Point(11) = {x - 1, y, 0, h/4};  Point(12) = {x, y + 1, 0, h/4};
Point(13) = {x + 4, y + 1, 0, h};  Point(14) = {x + 4, y - 5, 0, h};  Point(15) = {x - 1, y - 5, 0, h};
Point(16) = {x - Sin(30 * Pi / 180), y + Cos(30 * Pi / 180), 0, h/40};
Line(11) = {11, 15};  Line(12) = {15, 14};  Line(13) = {14, 13};  Line(14) = {13, 12};  Circle(15) = {12, 10, 16};  Circle(16) = {16, 10, 11};
Curve Loop(2) = {11 : 16};  Plane Surface(2) = {2};
Physical Curve("displacement:beam") = {7};
Physical Curve("displacement:catch") = {12};
Physical Curve("contact:hook") = {4};
Physical Curve("contact:catch") = {15, 16};
Physical Curve("force") = {1, 2, 3, 5, 6, 11, 13, 14};
Physical Surface("beam") = {1};
Physical Surface("catch") = {2};
