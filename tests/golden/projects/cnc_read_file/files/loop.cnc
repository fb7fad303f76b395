% a loop
N10 G36 O$g_iCount$ D3
N20 G$g_byCommand$ X$g_rTestX$ Y1
N30 G1 X0 Y0
N40 M4 O$params$
N50 G1 X$own$ (a value of the list)
N60 G37 O$g_iCount$ D-1
N70 G20 L20 K$g_iCount$
N80 G0 X1
