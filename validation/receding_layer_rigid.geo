// Half of a layer of 1 mm, 16 mm long, pressed over 0.2 mm on a rigid plane; symmetry: x = 0.
DefineConstant[ h = 0.1 ];
Point(1) = {0, 0, 0, h};  Point(2) = {2, 0, 0, h};  Point(3) = {8, 0, 0, 4*h};  Point(4) = {8, 1, 0, 4*h};
Point(5) = {0.1, 1, 0, h/2};  Point(6) = {0, 1, 0, h/2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Physical Curve("contact:layer") = {1};
Physical Curve("force:top") = {5};
Physical Curve("force") = {2, 3, 4};
Physical Curve("displacement:axis") = {6};
Physical Surface("layer") = {1};
