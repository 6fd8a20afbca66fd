// A wedge of 45°, 20 mm long, held at its round end.
DefineConstant[ h = 5 ];
R = 20;  s = R*Sin(Pi/4);
Point(1) = {0, 0, 0, h/8};  Point(2) = {s, -s, 0, h};  Point(3) = {R, 0, 0, h};
Line(1) = {1, 2};  Circle(2) = {2, 1, 3};  Line(3) = {3, 1};
Curve Loop(1) = {1 : 3};  Plane Surface(1) = {1};
Physical Curve("displacement:end") = {2};
Physical Curve("force:load") = {3};
Physical Curve("force:free") = {1};
Physical Surface("wedge") = {1};
