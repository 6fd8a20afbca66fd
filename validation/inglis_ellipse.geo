// A quarter of a square plate with an elliptical hole, half axes 1 mm along and 2 mm across its tension.
DefineConstant[ h = 30 ];
a = 1;  b = 2;  L = 150;  W = 150;
Point(1) = {0, 0, 0, h};  Point(2) = {a, 0, 0, 0.3};  Point(3) = {L, 0, 0, h};
Point(4) = {L, W, 0, h};  Point(5) = {0, W, 0, h};  Point(6) = {0, b, 0, 0.3};
Line(1) = {2, 3};  Line(2) = {3, 4};  Line(3) = {4, 5};  Line(4) = {5, 6};
Ellipse(5) = {6, 1, 6, 2};
Curve Loop(1) = {1 : 5};  Plane Surface(1) = {1};
Physical Curve("displacement:below") = {1};
Physical Curve("displacement:left") = {4};
Physical Curve("force:end") = {2};
Physical Curve("force:free") = {3, 5};
Physical Surface("plate") = {1};
