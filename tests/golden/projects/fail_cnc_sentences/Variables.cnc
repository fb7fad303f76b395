F100
N10 G1 X$g_rWidth$ Y$g_rUnknown$
N20 G1 X$g_sName$ Z$Main.n$
N30 M4 O$g_Params$
N40 M4 O$g_rWidth$ K$g_Params$
