% a label with a hole and a notch, for a knife that points along its path
(M1: turn the knife to K degrees and lower it; M2: lift it)
N10 G17
N20 G0 X58 Y60 F200 E1500 E-1500
N30 M1 K90 (the hole)
N40 G3 I-8
N50 M2
N60 G0 X30 Y20
N70 M1 K0 (the outline)
N80 G52 D10
N90 G1 X125
N100 G1 X150 Y40
N110 G1 Y80
N120 G50
N130 G3 X130 Y100 I-20
N140 G1 X105
N150 M1 K-135 (the notch: sharp corners)
N160 G1 X90 Y85
N170 M1 K135
N180 G1 X75 Y100
N190 M1 K180
N200 G1 X30
N210 G3 X10 Y80 J-20
N220 G1 Y40
N230 G3 X30 Y20 I20
N240 M2
N250 G0 X0 Y0
