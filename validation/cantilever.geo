// A beam 12 mm long and 2 mm high, its force at x = 0.
DefineConstant[ h = 1 ];
Point(1) = {0, -1, 0, h};  Point(2) = {12, -1, 0, h};  Point(3) = {12, 1, 0, h};  Point(4) = {0, 1, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("force:tip") = {4};
Physical Curve("force:root") = {2};
Physical Curve("force:free") = {1, 3};
Physical Surface("beam") = {1};
