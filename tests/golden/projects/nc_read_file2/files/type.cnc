LET #b : BOOL
N1 G1 X#b
