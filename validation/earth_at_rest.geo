// A column of earth, 10 m high, between walls 4 m apart.
DefineConstant[ h = 3000 ];
Point(1) = {0, 0, 0, h};  Point(2) = {4000, 0, 0, h};  Point(3) = {4000, 10000, 0, h};  Point(4) = {0, 10000, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("displacement:below") = {1};
Physical Curve("displacement:sides") = {2, 4};
Physical Curve("force:top") = {3};
Physical Surface("earth") = {1};
