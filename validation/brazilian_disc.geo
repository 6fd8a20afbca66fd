// A quarter of a disc, radius 25 mm, pressed over 5° on either side of its diameter.
DefineConstant[ h = 6 ];
R = 25;  a = 5*Pi/180;
Point(1) = {0, 0, 0, h};  Point(2) = {R, 0, 0, h};  Point(3) = {R*Sin(a), R*Cos(a), 0, h/6};  Point(4) = {0, R, 0, h/6};
Line(1) = {1, 2};  Circle(2) = {2, 1, 3};  Circle(3) = {3, 1, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("displacement:below") = {1};
Physical Curve("displacement:left") = {4};
Physical Curve("force:load") = {3};
Physical Curve("force:rim") = {2};
Physical Surface("disc") = {1};
