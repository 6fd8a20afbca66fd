// 400 x 200 mm under a flat punch |x| < 1 mm: 40 edges, shorter towards its corners.
Point(1) = {-1, 0, 0, 0.02};  Point(2) = {1, 0, 0, 0.02};
Point(3) = {200, 0, 0, 50};  Point(4) = {200, 200, 0, 66};  Point(5) = {-200, 200, 0, 66};
Point(6) = {-200, 0, 0, 50};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};
Line(6) = {6, 1};
Transfinite Curve {1} = 41 Using Bump 0.1;
Curve Loop(1) = {1:6};  Plane Surface(1) = {1};
Physical Curve("contact") = {1};
Physical Curve("force") = {2, 3, 5, 6};
Physical Curve("displacement") = {4};
Physical Surface("body") = {1};
Mesh.Algorithm = 1;
