// A punch with rounded edges, held at its head and pressed on a flat wall.
DefineConstant[ h = 1.2 ];              // mm, size of triangles
w = 6; r = 1.5;                         // half width, radius of the edges
Point(1) = {-w, 14, 0, h};  Point(2) = {-w, r, 0, h/3};      Point(3) = {-w + r, r, 0, h};
Point(4) = {-w + r, 0, 0, h/6};  Point(5) = {w - r, 0, 0, h/6};  Point(6) = {w - r, r, 0, h};
Point(7) = {w, r, 0, h/3};  Point(8) = {w, 14, 0, h};
Line(1) = {1, 2};  Circle(2) = {2, 3, 4};  Line(3) = {4, 5};  Circle(4) = {5, 6, 7};
Line(5) = {7, 8};  Line(6) = {8, 1};
Curve Loop(1) = {1 : 6};  Plane Surface(1) = {1};
Physical Curve("displacement:head") = {6};
Physical Curve("force")   = {1, 5};
Physical Curve("contact:left")  = {2};   // arcs have groups of their own, for their `face` in punch.json
Physical Curve("contact:sole")  = {3};
Physical Curve("contact:right") = {4};
Physical Surface("steel") = {1};
