// A quarter of a ring, radii 1 and 2 mm; its end carries a moment.
DefineConstant[ h = 0.4 ];
Point(1) = {0, 0, 0, h};  Point(2) = {1, 0, 0, h};  Point(3) = {2, 0, 0, h};  Point(4) = {0, 2, 0, h};  Point(5) = {0, 1, 0, h};
Line(1) = {2, 3};  Circle(2) = {3, 1, 4};  Line(3) = {4, 5};  Circle(4) = {5, 1, 2};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("displacement:below") = {1};
Physical Curve("force:end") = {3};
Physical Curve("force:free") = {2, 4};
Physical Surface("bar") = {1};
