% plate
N10 G1 X$g_stSize.rWidth$ F100 E400 E-300
N20 Y$g_aHeights[2]$ A$Main.aTurns[1, -1]$
/N30 X7
N35 G36 O$g_iRounds$ D2
N40 G91
N50 X-10.1 H3 L2
N60 G37 O$g_iRounds$ D-1
N70 G20 L50 K$g_iRounds$
N80 M7 K1.5
N90 M8 O$g_Params$
N100 G4 T0.25
