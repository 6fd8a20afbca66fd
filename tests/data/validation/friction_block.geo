// Half of a bar on a rigid floor (test SSNV128): 40 x 40 mm, floor points every 1.25 mm. Its axis of
// symmetry is x = 40; the last edge of the floor, where it sticks, holds the body.
h = 1.25;
Point(1) = { 0,  0, 0, h};      Point(2) = {40 - h, 0, 0, h};  Point(3) = {40, 0, 0, h};
Point(4) = {40, 40, 0, 5 * h};  Point(5) = { 0, 40, 0, 4 * h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};  Line(5) = {5, 1};
Transfinite Curve {1} = 32;  Transfinite Curve {2} = 2;
Curve Loop(1) = {1:5};  Plane Surface(1) = {1};
Physical Curve("contact") = {1};
Physical Curve("displacement:foot") = {2};
Physical Curve("displacement:axis") = {3};
Physical Curve("force:top") = {4};
Physical Curve("force:left") = {5};
Physical Surface("body") = {1};
