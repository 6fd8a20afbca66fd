// A wedge of 60 mm on a slope of tan α = 0.1.
DefineConstant[ h = 8 ];
Point(1) = {0, 0, 0, h/2};  Point(2) = {60, 6, 0, h/2};  Point(3) = {60, 26, 0, h};  Point(4) = {0, 26, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:sole") = {1};
Physical Curve("force:right") = {2};
Physical Curve("force:top") = {3};
Physical Curve("displacement:left") = {4};
Physical Surface("wedge") = {1};
