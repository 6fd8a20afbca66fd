// An angle of two materials: screwed down at its foot, its arm rests on a round pin.
DefineConstant[ h = 1.5 ];
Point(1) = {0, 0, 0, h};  Point(2) = {5, 0, 0, h};  Point(3) = {5, 15, 0, h/4};
Point(4) = {14, 15, 0, h/3};  Point(5) = {18, 15, 0, h/4};  Point(6) = {20, 15, 0, h/2};
Point(7) = {20, 20, 0, h};  Point(8) = {5, 20, 0, h};  Point(9) = {0, 20, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 6};
Line(6) = {6, 7};  Line(7) = {7, 8};  Line(8) = {8, 9};  Line(9) = {9, 1};  Line(10) = {3, 8};
Curve Loop(1) = {1, 2, 10, 8, 9};  Plane Surface(1) = {1};
Curve Loop(2) = {3, 4, 5, 6, 7, -10};  Plane Surface(2) = {2};
Physical Curve("displacement") = {1};
Physical Curve("force") = {2, 3, 5, 6, 8, 9};
Physical Curve("force:top") = {7};
Physical Curve("contact") = {4};
Physical Surface("steel") = {1};
Physical Surface("bronze") = {2};
