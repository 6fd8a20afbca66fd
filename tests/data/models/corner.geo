// A reentrant corner at which triangles are ten thousand times smaller than elsewhere.
Point(1) = {0, 0, 0, 1e-4};  Point(2) = {10, 0, 0, 1};  Point(3) = {10, -10, 0, 1};
Point(4) = {-10, -10, 0, 1};  Point(5) = {-10, 10, 0, 1};  Point(6) = {0, 10, 0, 1};
Line(1) = {1, 6};  Line(2) = {6, 5};  Line(3) = {5, 4};  Line(4) = {4, 3};  Line(5) = {3, 2};  Line(6) = {2, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
