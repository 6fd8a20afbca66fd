// A block on a slope, held by friction alone.
DefineConstant[ h = 4, slope = 15 ];    // mm, degrees
a = slope*Pi/180;  w = 40;  b = 20;     // width and height of the block
c = Cos(a);  s = Sin(a);
Point(1) = {0, 0, 0, h/2};  Point(2) = {w*c, w*s, 0, h/2};  Point(3) = {w*c - b*s, w*s + b*c, 0, h};  Point(4) = {-b*s, b*c, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:sole") = {1};
Physical Curve("force") = {2 : 4};
Physical Surface("block") = {1};
