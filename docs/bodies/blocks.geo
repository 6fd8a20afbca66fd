// Two blocks whose meshes do not match: the upper one is pressed down and pushed to the right.
DefineConstant[ h = 2 ];
Point(1) = {0, 0, 0, h};   Point(2) = {24, 0, 0, h};   Point(3) = {24, 8, 0, h / 1.6};  Point(4) = {0, 8, 0, h / 1.6};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Point(5) = {5, 8, 0, h / 2.5};  Point(6) = {17, 8, 0, h / 2.5};  Point(7) = {17, 14, 0, h};  Point(8) = {5, 14, 0, h};
Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 8};  Line(8) = {8, 5};
Curve Loop(2) = {5 : 8};  Plane Surface(2) = {2};
Physical Curve("displacement:floor") = {1};
Physical Curve("displacement:top") = {7};
Physical Curve("contact:lower") = {3};
Physical Curve("contact:upper") = {5};
Physical Curve("force") = {2, 4, 6, 8};
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
