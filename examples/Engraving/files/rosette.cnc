(A rosette of 100 turns: a short line after the other, as CAM systems write curves)
LET #n : LREAL
LET #a : LREAL
LET #r : LREAL
N10 G0 X14 Y0 F100 E2000 E-2000
N20 G51
N30 G36 O#n D#n + 1
N40 G36 O#a D#n * 2 * pi / 1000
N50 G36 O#r D10 + 4 * cos{#a * 5.01}
N60 G1 X#r * cos{#a} Y#r * sin{#a}
N70 G20 L30 K#n < $LINES$
N80 G50
