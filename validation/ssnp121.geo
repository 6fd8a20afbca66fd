// Two plates, 1 m high each, meshed by different sizes.
DefineConstant[ h = 400 ];
Point(1) = {0, 0, 0, h};  Point(2) = {1000, 0, 0, h};  Point(3) = {1000, 1000, 0, h};  Point(4) = {0, 1000, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Point(11) = {0, 1000, 0, 0.7*h};  Point(12) = {1000, 1000, 0, 0.7*h};  Point(13) = {1000, 2000, 0, h};  Point(14) = {0, 2000, 0, h};
Line(11) = {11, 12};  Line(12) = {12, 13};  Line(13) = {13, 14};  Line(14) = {14, 11};
Curve Loop(2) = {11 : 14};  Plane Surface(2) = {2};
Physical Curve("displacement:bottom") = {1};
Physical Curve("displacement:top") = {13};
Physical Curve("displacement:left") = {4, 14};
Physical Curve("contact:lower") = {3};
Physical Curve("contact:upper") = {11};
Physical Curve("force") = {2, 12};
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
