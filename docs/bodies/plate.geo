// A plate with a hole, pressed against a wall by a pin in the hole.
DefineConstant[ h = 2 ];
Point(1) = {-12, -8, 0, h};  Point(2) = {12, -8, 0, h/2};  Point(3) = {12, 8, 0, h/2};
Point(4) = {-12, 8, 0, h};
Point(5) = {0, 0, 0, h};  Point(6) = {4, 0, 0, h/4};  Point(7) = {0, 4, 0, h/3};
Point(8) = {-4, 0, 0, h/3};  Point(9) = {0, -4, 0, h/3};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Circle(5) = {6, 5, 7};  Circle(6) = {7, 5, 8};  Circle(7) = {8, 5, 9};  Circle(8) = {9, 5, 6};
Curve Loop(1) = {1 : 4};  Curve Loop(2) = {5 : 8};  Plane Surface(1) = {1, 2};
Physical Curve("displacement:back") = {4};
Physical Curve("force") = {1, 3, 6, 7};
Physical Curve("force:pin") = {5, 8};
Physical Curve("contact") = {2};
Physical Surface("plate") = {1};
