// In the plane x = -3.
Point(1) = {-3, 0, 0, 2};  Point(2) = {-3, 10, 0, 2};  Point(3) = {-3, 8, 5, 2};  Point(4) = {-3, 2, 5, 2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:sole") = {1};  Physical Curve("displacement:head") = {3};
Physical Surface("steel") = {1};
