% everything that is no G-code
N10 G1 X100 Y; F100
N20 XY5
N30 G1.5 X--3 (open
N40 X$g_rWidth
N50 X$$ N$g_rWidth$ Y1.2.3
N60 PZ1 X / Y2
N70 Ä5
N80 X1e-05 Y2
N90 Z-$g_rWidth$ X+$g_rWidth$
