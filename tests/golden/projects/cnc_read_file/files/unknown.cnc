N1 G1 X1
N2 G1 X$g_rNobody$
