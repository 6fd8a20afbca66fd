// Two blocks 40 mm wide: steel, 10 mm high, on it polymer, 20 mm.
DefineConstant[ h = 8 ];
Point(1) = {0, 0, 0, h};  Point(2) = {40, 0, 0, h};  Point(3) = {40, 10, 0, h};  Point(4) = {0, 10, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Point(11) = {0, 10, 0, h};  Point(12) = {40, 10, 0, h};  Point(13) = {40, 30, 0, h};  Point(14) = {0, 30, 0, h};
Line(11) = {11, 12};  Line(12) = {12, 13};  Line(13) = {13, 14};  Line(14) = {14, 11};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Curve Loop(2) = {11 : 14};  Plane Surface(2) = {2};
Physical Curve("displacement:below") = {1};
Physical Curve("displacement:above") = {13};
Physical Curve("displacement:left") = {4, 14};
Physical Curve("contact:steel") = {3};
Physical Curve("contact:polymer") = {11};
Physical Curve("force:free") = {2, 12};
Physical Surface("steel") = {1};
Physical Surface("polymer") = {2};
