// Half a wave of 2 mm: y = Δ (1 − cos(πx)), Δ = 0.5 µm, of 16 cubics; symmetry: x = 0, x = 1.
DefineConstant[ h = 0.6 ];
n = 16;  D = 0.0005;
For i In {0 : n - 1}
  a = i/n;  b = (i + 1)/n;
  Point(3*i) = {a, D*(1 - Cos(Pi*a)), 0, h/6};
  Point(3*i + 1) = {a + 1/(3*n), D*(1 - Cos(Pi*a) + Pi*Sin(Pi*a)/(3*n)), 0, h/6};
  Point(3*i + 2) = {b - 1/(3*n), D*(1 - Cos(Pi*b) - Pi*Sin(Pi*b)/(3*n)), 0, h/6};
EndFor
Point(3*n) = {1, 2*D, 0, h/6};  Point(3*n + 1) = {1, 4, 0, h};  Point(3*n + 2) = {0, 4, 0, h};
For i In {0 : n - 1}
  Bezier(i + 1) = {3*i, 3*i + 1, 3*i + 2, 3*i + 3};
EndFor
Line(n + 1) = {3*n, 3*n + 1};  Line(n + 2) = {3*n + 1, 3*n + 2};  Line(n + 3) = {3*n + 2, 0};
Curve Loop(1) = {1 : n + 3};  Plane Surface(1) = {1};
Physical Curve("contact:wave") = {1 : n};
Physical Curve("displacement:side") = {n + 1};
Physical Curve("force:top") = {n + 2};
Physical Curve("displacement:axis") = {n + 3};
Physical Surface("body") = {1};
