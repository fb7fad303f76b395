% a line
N10 G1 X5 Y$g_rHeight$ F10
