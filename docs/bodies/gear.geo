// Two gears in mesh, with two pairs of flanks: module 4, 30 and 40 teeth, pressure angle 25 degrees.
// Near its contact point an involute is a circle around T, where the line of action touches the base
// circle; the origin is the pitch point.
DefineConstant[ h = 2 ];
m = 4;  a = 25 * Pi / 180;  pb = Pi * m * Cos(a);  f = 0.9;      // base pitch, length of a fillet

Macro Tooth
  // From the right to the left; its right flank has the radius rho.
  For i In {0 : 3}
    b = Asin((r[i]^2 - rb^2 - rho^2) / (2 * rb * rho));
    x = -(rb + rho * Sin(b)) * Sin(a) + rho * Cos(b) * Cos(a);
    y = (rb + rho * Sin(b)) * Cos(a) + rho * Cos(b) * Sin(a);
    angle[i] = Atan2(y, x);
  EndFor
  middle = angle[0] + Pi / (2 * z);
  q[] = {r[1], r[1], r[2], r[3], rb};  size[] = {h / 2, h / 2, h / 3, h / 3, h};
  t[] = {angle[1] - f / r[1], angle[1], angle[2], angle[3], Pi / 2 + a};
  p = newp;
  For i In {0 : 4}
    Point(p + i) = {side * q[i] * Cos(t[i]), side * (q[i] * Sin(t[i]) - R), 0, size[i]};
    t[i] = 2 * middle - t[i];
    Point(p + 5 + i) = {side * q[i] * Cos(t[i]), side * (q[i] * Sin(t[i]) - R), 0, h / 2};
  EndFor
  c = newl;
  Circle(c) = {last, O, p};              Bezier(c + 1) = {p, p + 1, p + 2};
  Circle(c + 2) = {p + 2, p + 4, p + 3}; Circle(c + 3) = {p + 3, O, p + 8};
  Circle(c + 4) = {p + 8, p + 9, p + 7}; Bezier(c + 5) = {p + 7, p + 6, p + 5};
  outline[] += {c : c + 5};  flank[] += {c + 2};  last = p + 5;
Return

Macro Gear
  // With side -1 above the pitch point.
  rb = R * Cos(a);  r[] = {R, R - 1.25 * m, R - 1.25 * m + f, R + m};
  low = R - 4 * m;  from = Pi / 2 - 5 * Pi / (2 * z);  to = from + 6 * Pi / z;
  q[] = {0, low / Sin(to), low / Sin(from), r[1], r[1]};  t[] = {0, to, from, from, to};
  O = newp;
  For i In {0 : 4}
    Point(O + i) = {side * q[i] * Cos(t[i]), side * (q[i] * Sin(t[i]) - R), 0, h};
  EndFor
  held = newl;  last = O + 3;
  Line(held) = {O + 1, O + 2};  Line(held + 1) = {O + 2, last};
  outline[] = {held, held + 1};  flank[] = {};
  rho = R * Sin(a) + pb / 2;
  Call Tooth;
  rho = R * Sin(a) - pb / 2;
  Call Tooth;
  c = newl;
  Circle(c) = {last, O, O + 4};  Line(c + 1) = {O + 4, O + 1};
  outline[] += {c, c + 1};
  surface = news;
  Curve Loop(surface) = {outline[]};  Plane Surface(surface) = {surface};
Return

side = 1;  z = 30;  R = m * z / 2;
Call Gear;
Physical Surface("driver") = {surface};
Physical Curve("displacement:driver") = {held};
Physical Curve("contact:driver_1") = {flank[0]};  Physical Curve("contact:driver_2") = {flank[1]};
free[] = {outline[]};  free[] -= {held, flank[]};
side = -1;  z = 40;  R = m * z / 2;
Call Gear;
Physical Surface("driven") = {surface};
Physical Curve("displacement:driven") = {held};
Physical Curve("contact:driven_1") = {flank[1]};  Physical Curve("contact:driven_2") = {flank[0]};
free[] += {outline[]};  free[] -= {held, flank[]};
Physical Curve("force") = {free[]};
