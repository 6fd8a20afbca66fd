// As packing.geo, by the surface.
Point(1) = {0, 0, 0, 2};  Point(2) = {10, 0, 0, 2};  Point(3) = {8, 5, 0, 2};  Point(4) = {2, 5, 0, 2};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:sole") = {1};  Physical Curve("displacement:head") = {3};
Physical Surface("steel") = {1};
MeshAlgorithm Surface {1} = 8;
