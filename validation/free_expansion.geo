// A block, 40 mm long and 10 mm high.
DefineConstant[ h = 5 ];
Point(1) = {0, 0, 0, h};  Point(2) = {40, 0, 0, h};  Point(3) = {40, 10, 0, h};  Point(4) = {0, 10, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("force:free") = {1 : 4};
Physical Surface("block") = {1};
