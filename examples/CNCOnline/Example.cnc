% a plate whose size the program knows
N10 G1 X$g_x$ F100 E400 E-400
N20 G1 Y$g_y$
N30 G1 X20
N40 G1 X0 Y0
