SUBPROGRAM Drill{#depth : LREAL, #radius : LREAL, #round : BOOL}
LET #x : LREAL := #depth * 2
N10 G91
N20 G20 L?1 K#round
N30 G1 X#x Z-#depth
N40 TurnBack{}
N50 RETURN
N60 L!1 G2 X#radius Y0 R#radius
N70 TURNBACK{}
END_SUBPROGRAM
