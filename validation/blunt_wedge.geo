// Half of a block of 8000 by 4000 mm, large beside its contact face |x| < w; symmetry: x = 0.
DefineConstant[ w = 1.4, b = 0.7 ];       // mm
L = 4000;
Point(1) = {0, 0, 0, w/5};  Point(2) = {b, 0, 0, w/5};  Point(3) = {w, 0, 0, w/5};
Point(4) = {L, 0, 0, L/3};  Point(5) = {L, L, 0, L/3};  Point(6) = {0, L, 0, L/3};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Physical Curve("contact:face") = {1, 2};
Physical Curve("force:top") = {5};
Physical Curve("force") = {3, 4};
Physical Curve("displacement:axis") = {6};
Physical Surface("block") = {1};
