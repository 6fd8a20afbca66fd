// A dovetail: pulled up, it bears on the two flanks of its slot.
DefineConstant[ h = 1.5 ];
Point(1) = {-8, 0, 0, h/2};  Point(2) = {8, 0, 0, h/2};  Point(3) = {4, 7, 0, h/4};
Point(4) = {4, 16, 0, h};  Point(5) = {-4, 16, 0, h};  Point(6) = {-4, 7, 0, h/4};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Physical Curve("displacement") = {4};
Physical Curve("force") = {1, 3, 5};
Physical Curve("contact:right") = {2};
Physical Curve("contact:left") = {6};
Physical Surface("blade") = {1};
