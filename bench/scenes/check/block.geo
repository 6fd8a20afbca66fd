// A block on a floor and a ramp: held at its top, loaded at its sides.
DefineConstant[ h = 2.2 ];
Point(1) = {0, 0, 0, h};  Point(2) = {8, 0, 0, h};  Point(3) = {12, 3, 0, h};
Point(4) = {12, 9, 0, 2*h};  Point(5) = {0, 9, 0, 2*h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 1};
Curve Loop(1) = {1 : 5};  Plane Surface(1) = {1};
Physical Curve("contact:floor") = {1};
Physical Curve("contact:ramp") = {2};
Physical Curve("force:flank") = {3};
Physical Curve("displacement") = {4};
Physical Curve("force:side") = {5};
Physical Surface("steel") = {1};
