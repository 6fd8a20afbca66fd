// In metres, which Gmsh writes as mm.
Point(1) = {0, 0, 0, 0.002};  Point(2) = {0.010, 0, 0, 0.002};  Point(3) = {0.008, 0.005, 0, 0.002};  Point(4) = {0.002, 0.005, 0, 0.002};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};  Plane Surface(1) = {1};
Physical Curve("contact:sole") = {1};  Physical Curve("displacement:head") = {3};
Physical Surface("steel") = {1};
Mesh.ScalingFactor = 1000;
