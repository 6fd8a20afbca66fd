// A bracket with a fillet: its leg stands against a wall and on a ledge, its arm carries a load at the end.
DefineConstant[ h = 3 ];
H = 50;  L = 60;  t = 8;  r = 6;        // height of the leg, length of the arm, thickness, radius of the fillet
Point(1) = {0, 0, 0, h};  Point(2) = {t, 0, 0, h};  Point(3) = {t, H - t - r, 0, h/2};  Point(4) = {t + r, H - t - r, 0, h};
Point(5) = {t + r, H - t, 0, h/2};  Point(6) = {L, H - t, 0, h};  Point(7) = {L, H, 0, h};
Point(8) = {L - 15, H, 0, h};  Point(9) = {0, H, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Circle(3) = {3, 4, 5};  Line(4) = {5, 6};  Line(5) = {6, 7};
Line(6) = {7, 8};  Line(7) = {8, 9};  Line(8) = {9, 1};
Curve Loop(1) = {1 : 8};  Plane Surface(1) = {1};
Physical Curve("displacement:ledge") = {1};
Physical Curve("displacement:wall") = {8};
Physical Curve("force:load") = {6};
Physical Curve("force") = {2 : 5, 7};
Physical Surface("bracket") = {1};
