// 4000 x 2000 mm, large beside its contact face |x| < 1.2 mm: 48 edges.
Point(1) = {-1.2, 0, 0, 0.05};  Point(2) = {1.2, 0, 0, 0.05};
Point(3) = {2000, 0, 0, 500};  Point(4) = {2000, 2000, 0, 650};  Point(5) = {-2000, 2000, 0, 650};
Point(6) = {-2000, 0, 0, 500};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};
Line(6) = {6, 1};
Transfinite Curve {1} = 49;
Curve Loop(1) = {1:6};  Plane Surface(1) = {1};
Physical Curve("contact") = {1};
Physical Curve("force") = {2, 3, 5, 6};
Physical Curve("displacement") = {4};
Physical Surface("body") = {1};
Mesh.Algorithm = 1;
