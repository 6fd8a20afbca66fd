// A roller of steel, R 25, on a plate 100 x 30, pressed at its axle.
h=8; fine=0.15; w=2.5; R=25; y=R-Sqrt(R*R-w*w);
Point(1)={0,R,0,h}; Point(2)={-w,y,0,4*fine}; Point(3)={w,y,0,4*fine}; Point(4)={R,R,0,h}; Point(5)={0,2*R,0,h}; Point(6)={-R,R,0,h}; Point(7)={0,0,0,fine};
Circle(1)={2,1,7}; Circle(2)={7,1,3}; Circle(3)={3,1,4}; Circle(4)={4,1,5}; Circle(5)={5,1,6}; Circle(6)={6,1,2};
Curve Loop(1)={1:6};
q=8;
Point(11)={q,R,0,h/2}; Point(12)={0,R+q,0,h/2}; Point(13)={-q,R,0,h/2}; Point(14)={0,R-q,0,h/2};
Circle(11)={11,1,12}; Circle(12)={12,1,13}; Circle(13)={13,1,14}; Circle(14)={14,1,11};
Curve Loop(2)={11:14}; Plane Surface(1)={1,2};
Point(21)={-50,-30,0,h}; Point(22)={50,-30,0,h}; Point(23)={50,0,0,h}; Point(24)={w,0,0,4*fine}; Point(25)={0,0,0,fine}; Point(26)={-w,0,0,4*fine}; Point(27)={-50,0,0,h};
Line(21)={21,22}; Line(22)={22,23}; Line(23)={23,24}; Line(24)={24,25}; Line(25)={25,26}; Line(26)={26,27}; Line(27)={27,21};
Curve Loop(3)={21:27}; Plane Surface(2)={3};
Physical Curve("displacement:bed")={21};
Physical Curve("contact:roller")={1,2};
Physical Curve("contact:plate")={24,25};
Physical Curve("force:axle")={11:14};
Physical Curve("force:free")={3:6,22,23,26,27};
Physical Surface("roller")={1};
Physical Surface("plate")={2};
