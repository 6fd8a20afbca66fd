// A closed crack of length 2 b, 2 m, at 20° to a compression of 100 MPa: two halves, bonded beside it.
DefineConstant[ h = 10000 ];
b = 1000;  W = 40000;  f = h/150;
Point(1) = {-W, 0, 0, h};  Point(2) = {-b, 0, 0, f};  Point(3) = {b, 0, 0, f};  Point(4) = {W, 0, 0, h};
Point(5) = {W, W, 0, h};   Point(6) = {-W, W, 0, h};
Point(11) = {-W, 0, 0, h};  Point(12) = {-b, 0, 0, f};  Point(13) = {b, 0, 0, f};  Point(14) = {W, 0, 0, h};
Point(15) = {W, -W, 0, h};   Point(16) = {-W, -W, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 1};
Line(11) = {11, 12};  Line(12) = {12, 13};  Line(13) = {13, 14};  Line(14) = {14, 15};  Line(15) = {15, 16};  Line(16) = {16, 11};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Curve Loop(2) = {-16, -15, -14, -13, -12, -11};  Plane Surface(2) = {2};
Physical Curve("contact:bonded above") = {1, 3};
Physical Curve("contact:bonded below") = {11, 13};
Physical Curve("contact:above") = {2};
Physical Curve("contact:below") = {12};
Physical Curve("force:right") = {4, 14}; Physical Curve("force:left") = {6, 16}; Physical Curve("force:top") = {5}; Physical Curve("force:bottom") = {15};
Physical Surface("upper") = {1};
Physical Surface("lower") = {2};
