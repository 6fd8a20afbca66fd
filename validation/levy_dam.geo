// A triangular dam, 10 m high and 8 m wide at its base; water on x = 0.
DefineConstant[ h = 3000 ];
Point(1) = {0, 0, 0, h};  Point(2) = {0, -10000, 0, h};  Point(3) = {8000, -10000, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 1};
Curve Loop(1) = {1 : 3};  Plane Surface(1) = {1};
Physical Curve("force:water") = {1};
Physical Curve("force:base") = {2};
Physical Curve("force:face") = {3};
Physical Surface("dam") = {1};
