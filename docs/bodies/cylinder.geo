// The lower half of a cylinder, pressed on a flat wall.
DefineConstant[ h = 1.6, fine = 0.025 ];
R = 8;  s = R*Sin(Pi/30);  c = R*(1 - Cos(Pi/30));
Point(1) = {0, R, 0, h};  Point(2) = {-R, R, 0, h};  Point(3) = {-s, c, 0, 2*fine};
Point(4) = {0, 0, 0, fine};  Point(5) = {s, c, 0, 2*fine};  Point(6) = {R, R, 0, h};
Circle(1) = {2, 1, 3};  Circle(2) = {3, 1, 4};  Circle(3) = {4, 1, 5};  Circle(4) = {5, 1, 6};
Line(5) = {6, 2};
Curve Loop(1) = {1 : 5};  Plane Surface(1) = {1};
Physical Curve("displacement") = {5};
Physical Curve("force") = {1, 4};
Physical Curve("contact") = {2, 3};
Physical Surface("body") = {1};
