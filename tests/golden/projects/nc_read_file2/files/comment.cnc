N1 G1 X1 (open
N2
