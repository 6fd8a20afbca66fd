// A block of 8000 by 4000 mm, large beside the face of a punch, |x| < 1 mm.
DefineConstant[ h = 0.2 ];
L = 4000;
Point(1) = {-1, 0, 0, h};  Point(2) = {1, 0, 0, h};  Point(3) = {L, 0, 0, L/3};
Point(4) = {L, L, 0, L/3};  Point(5) = {-L, L, 0, L/3};  Point(6) = {-L, 0, 0, L/3};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Physical Curve("contact:face") = {1};
Physical Curve("displacement:right") = {3};
Physical Curve("displacement:left") = {5};
Physical Curve("force:top") = {4};
Physical Curve("force") = {2, 6};
Physical Surface("block") = {1};
