LET #turn : LREAL := 90
N10 G54 X10 Y20 A#turn B0 C0
N20 G1 X5 Y2 F10 (8 25)
N30 G2 X7 Y4 I2
N40 G1 A30 B0 C0 (120 degrees for the machine)
