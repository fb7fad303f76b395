% the "bracket" of O'Hara, 5$
N10 G36 O$g_iCount$ D3
n020 g$Main.byCommand$ x$g_rWidth$ (the width) // goes on
N30 G02 X200 R75
N40 M7 O$g_Params$
N50 G37 O$G_ICOUNT$ D-1
N60 G20 L20 K$g_iCount$
N70 G0 X-0.125
