// A block, 40 mm by 20 mm, on a wall inclined by 30°.
DefineConstant[ h = 10 ];
a = 30*Pi/180;  c = Cos(a);  s = Sin(a);
Point(1) = {0, 0, 0, h};  Point(2) = {40*c, 40*s, 0, h};  Point(3) = {40*c - 20*s, 40*s + 20*c, 0, h};  Point(4) = {-20*s, 20*c, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:sole") = {1};
Physical Curve("force:right") = {2};
Physical Curve("displacement:top") = {3};
Physical Curve("force:left") = {4};
Physical Surface("block") = {1};
