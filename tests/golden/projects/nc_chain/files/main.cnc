% rectangles
LET #i : LREAL := 1
LET #side : LREAL := $SIZE$ / 2
N10 F40 E200 E-200
N20 RECT{#side * #i, #i = 2}
N30 G37 O#i D1
N40 G20 L20 K #i <= 3 AND NOT $STOP$
N50 G1 X0 Y0 Z-1
