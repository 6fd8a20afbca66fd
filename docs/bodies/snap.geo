// A snap fit in plane strain: the hook of a plastic beam, held at its left end, slides up the ramp of a catch.
DefineConstant[ h = 1.2 ];
L = 20;  b = 2;                         // the beam; its hook reaches down by 2 mm, with ramps of 30 degrees
r = 2 / Tan(30 * Pi / 180);
Point(1) = {0, 0, 0, h/2};  Point(2) = {L - 2, 0, 0, h/3};  Point(3) = {L - 2, -2, 0, h/4};  Point(4) = {L - 1, -2, 0, h/6};
Point(5) = {L - 1 + r, 0, 0, h/6};  Point(6) = {L - 1 + r, b, 0, h};  Point(7) = {0, b, 0, h/2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 1};
Curve Loop(1) = {1 : 7};  Plane Surface(1) = {1};
// The catch: its ramp lies on the hook's, a part of it.
x = L - 1 + 0.3 * r;  y = -2 + 0.3 * 2;
Point(11) = {x, y, 0, h/5};  Point(12) = {x + 0.5 * r, y + 0.5 * 2, 0, h/5};  Point(13) = {x + 0.5 * r + 3, y + 1, 0, h};
Point(14) = {x + 0.5 * r + 3, y - 5, 0, h};  Point(15) = {x, y - 5, 0, h};
Line(11) = {11, 15};  Line(12) = {15, 14};  Line(13) = {14, 13};  Line(14) = {13, 12};  Line(15) = {12, 11};
Curve Loop(2) = {11 : 15};  Plane Surface(2) = {2};
Physical Curve("displacement:beam") = {7};
Physical Curve("displacement:catch") = {12};
Physical Curve("contact:hook") = {4};
Physical Curve("contact:catch") = {15};
Physical Curve("force") = {1, 2, 3, 5, 6, 11, 13, 14};
Physical Surface("beam") = {1};
Physical Surface("catch") = {2};
