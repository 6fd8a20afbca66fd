// A half of a half disc, radius 10 m, under a pressure on 1 mm.
DefineConstant[ h = 2500 ];
R = 10000;
Point(1) = {0, 0, 0, 0.3};  Point(2) = {1, 0, 0, 0.15};  Point(3) = {R, 0, 0, h};  Point(4) = {0, -R, 0, h};  Point(5) = {4, 0, 0, 2};  Point(6) = {0, -4, 0, 2};
Line(1) = {1, 6};  Line(2) = {6, 4};  Circle(3) = {4, 1, 3};  Line(4) = {3, 5};  Line(5) = {5, 2};  Line(6) = {2, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Physical Curve("displacement:axis") = {1, 2};
Physical Curve("displacement:far") = {3};
Physical Curve("force:free") = {4, 5};
Physical Curve("force:load") = {6};
Physical Surface("ground") = {1};
