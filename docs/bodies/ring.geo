// A segment of a ring in its socket, pressed outwards from inside.
DefineConstant[ h = 1 ];
R = 30;  r = 24;  c = Cos(Pi/6);  s = Sin(Pi/6);
Point(1) = {0, 0, 0, h};
Point(2) = {-R*c, -R*s, 0, h/3};  Point(3) = {0, -R, 0, h/2};  Point(4) = {R*c, -R*s, 0, h/3};
Point(5) = {r*c, -r*s, 0, h};     Point(6) = {0, -r, 0, h};    Point(7) = {-r*c, -r*s, 0, h};
Circle(1) = {2, 1, 3};  Circle(2) = {3, 1, 4};  Line(3) = {4, 5};
Circle(4) = {5, 1, 6};  Circle(5) = {6, 1, 7};  Line(6) = {7, 2};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Physical Curve("contact") = {1, 2};
Physical Curve("displacement:right") = {3};
Physical Curve("displacement:left") = {6};
Physical Curve("force:bore") = {4, 5};
Physical Surface("ring") = {1};
