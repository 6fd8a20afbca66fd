// Two surfaces that share a line in space, but no curve.
Point(1) = {0, 0, 0, 2};  Point(2) = {10, 0, 0, 2};  Point(3) = {8, 5, 0, 2};  Point(4) = {2, 5, 0, 2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Point(5) = {0, 0, 0, 2};  Point(6) = {10, 0, 0, 2};  Point(7) = {5, -5, 0, 2};
Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 5};
Curve Loop(2) = {5 : 7};  Plane Surface(2) = {2};
