// In the plane y = 7.
Point(1) = {0, 7, 0, 2};  Point(2) = {10, 7, 0, 2};  Point(3) = {8, 7, 5, 2};  Point(4) = {2, 7, 5, 2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:sole") = {1};  Physical Curve("displacement:head") = {3};
Physical Surface("steel") = {1};
