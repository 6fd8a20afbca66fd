// Half of a bar of 80 by 40 mm on a rigid floor; symmetry: x = 40.
DefineConstant[ h = 8 ];
Point(1) = {0, 0, 0, h/2};  Point(2) = {40, 0, 0, h/2};  Point(3) = {40, 40, 0, h};  Point(4) = {0, 40, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:floor") = {1};
Physical Curve("displacement:axis") = {2};
Physical Curve("force:top") = {3};
Physical Curve("force:left") = {4};
Physical Surface("bar") = {1};
