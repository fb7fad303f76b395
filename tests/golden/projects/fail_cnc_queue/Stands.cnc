% the second motion stands
N10 G1 X1 F10
N20 X2 F0
