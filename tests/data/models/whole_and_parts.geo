// Two surfaces that share a curve; a group of both, and one of each.
Point(1) = {0, 0, 0, 2};  Point(2) = {10, 0, 0, 2};  Point(3) = {8, 5, 0, 2};  Point(4) = {2, 5, 0, 2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Point(7) = {5, -5, 0, 2};
Line(6) = {2, 7};  Line(7) = {7, 1};
Curve Loop(2) = {1, 6, 7};  Plane Surface(2) = {2};
Physical Surface("whole") = {1, 2};  Physical Surface("upper") = {1};  Physical Surface("lower") = {2};
