// A quarter of a bar 4 mm wide, which a fillet of 0.5 mm narrows to 2 mm.
DefineConstant[ h = 1 ];
r = 0.5;
Point(1) = {-6, 0, 0, h};  Point(2) = {6, 0, 0, h};  Point(3) = {6, 1, 0, h};  Point(4) = {r, 1, 0, h/8};
Point(5) = {0, 1 + r, 0, h/4};  Point(6) = {0, 2, 0, h};  Point(7) = {-6, 2, 0, h};  Point(8) = {r, 1 + r, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Circle(4) = {4, 8, 5};  Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 1};
Curve Loop(1) = {1 : 7};  Plane Surface(1) = {1};
Physical Curve("displacement:below") = {1};
Physical Curve("displacement:left") = {7};
Physical Curve("force:end") = {2};
Physical Curve("force:free") = {3 : 6};
Physical Surface("bar") = {1};
