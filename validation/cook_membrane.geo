// Cook's tapered panel, clamped at x = 0.
DefineConstant[ h = 12 ];
Point(1) = {0, 0, 0, h};  Point(2) = {48, 44, 0, h};  Point(3) = {48, 60, 0, h};  Point(4) = {0, 44, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("force:lower") = {1};
Physical Curve("force:end") = {2};
Physical Curve("force:upper") = {3};
Physical Curve("displacement:clamp") = {4};
Physical Surface("panel") = {1};
