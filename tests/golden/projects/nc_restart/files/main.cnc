% the program
LET #n : LREAL := 2 (the first)
LET #wide : BOOL := $WIDE$
N10 G1 X$WIDTH$*#n Y-{#n + 1} F100 E500 E-500
N20 DRILL{#n, expt{2, 3}, NOT #wide}
N30 G36 O#n D#n + 1
N40 G20 L10 K#n < 4
/N50 G1 X77
N60 DYNCALL{$SUB$, 1, 1, FALSE}
N70 G36 O$COUNT$ D$COUNT$ + 1
N80 G1 X0 Y0
