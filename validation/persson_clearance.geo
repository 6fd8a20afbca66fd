// Half of a pin of 9.98 mm in a hole of 10 mm in a plate of 400 mm; symmetry: x = 0.
DefineConstant[ h = 2.5, dr = 0.02 ];      // dr: by which the pin's radius is smaller
R = 10;  r = R - dr;  L = 400;  k = 0.2;
Point(1) = {0, -dr, 0, h/10};  Point(2) = {0, -R, 0, h/4};  Point(3) = {r, -dr, 0, h/2};  Point(4) = {0, r - dr, 0, h};
Point(5) = {0, -dr - k, 0, k/2};  Point(6) = {k, -dr, 0, k/2};  Point(7) = {0, k - dr, 0, k/2};
Circle(1) = {2, 1, 3};  Circle(2) = {3, 1, 4};  Line(3) = {4, 7};  Circle(4) = {7, 1, 6};  Circle(5) = {6, 1, 5};  Line(6) = {5, 2};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Point(10) = {0, 0, 0, h};  Point(12) = {0, -R, 0, h/4};  Point(13) = {R, 0, 0, h/2};  Point(14) = {0, R, 0, h};
Point(15) = {0, L, 0, L/3};  Point(16) = {L, 0, 0, L/3};  Point(17) = {0, -L, 0, L/3};
Circle(11) = {14, 10, 13};  Circle(12) = {13, 10, 12};  Line(13) = {12, 17};  Circle(14) = {17, 10, 16};  Circle(15) = {16, 10, 15};  Line(16) = {15, 14};
Curve Loop(2) = {11 : 16};  Plane Surface(2) = {2};
Physical Curve("contact:pin") = {1, 2};
Physical Curve("contact:hole") = {11, 12};
Physical Curve("force:core") = {4, 5};
Physical Curve("displacement:axis") = {3, 6, 13, 16};
Physical Curve("displacement:far") = {14, 15};
Physical Surface("pin") = {1};
Physical Surface("plate") = {2};
