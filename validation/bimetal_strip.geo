// A strip 20 mm long: invar 1 mm thick, on it brass 0.5 mm thick.
DefineConstant[ h = 1 ];
Point(1) = {-10, 0, 0, h};  Point(2) = {10, 0, 0, h};  Point(3) = {10, 1, 0, h};  Point(4) = {10, 1.5, 0, h};  Point(5) = {-10, 1.5, 0, h};  Point(6) = {-10, 1, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 1};  Line(7) = {3, 6};
Curve Loop(1) = {1, 2, 7, 6};  Plane Surface(1) = {1};
Curve Loop(2) = {3, 4, 5, -7};  Plane Surface(2) = {2};
Physical Curve("force:free") = {1 : 6};
Physical Surface("invar") = {1};
Physical Surface("brass") = {2};
