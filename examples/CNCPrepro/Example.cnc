% a plate whose size the program knows, with smooth corners
N10 G51 D8
N20 G1 X$g_x$ F100 E400 E-400
N30 G1 Y$g_y$
N40 G1 X20
N50 G1 X0 Y0
N60 G50
