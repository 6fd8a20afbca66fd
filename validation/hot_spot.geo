// A quarter of a disc, radius 10 mm, with a hot spot, radius 1 mm.
DefineConstant[ h = 3, fine = 0.04 ];
Point(1) = {0, 0, 0, h/10};  Point(2) = {1, 0, 0, fine};  Point(3) = {0, 1, 0, fine};  Point(4) = {10, 0, 0, h};  Point(5) = {0, 10, 0, h};
Line(1) = {1, 2};  Circle(2) = {2, 1, 3};  Line(3) = {3, 1};  Line(4) = {2, 4};  Circle(5) = {4, 1, 5};  Line(6) = {5, 3};
Curve Loop(1) = {1 : 3};  Plane Surface(1) = {1};
Curve Loop(2) = {4, 5, 6, -2};  Plane Surface(2) = {2};
Physical Curve("displacement:below") = {1, 4};
Physical Curve("displacement:left") = {3, 6};
Physical Curve("force:rim") = {5};
Physical Surface("spot") = {1};
Physical Surface("membrane") = {2};
