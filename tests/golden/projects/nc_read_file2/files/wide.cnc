(* a comment
over lines *) N1 G1 X(1 + 2) * {3 - 1) // end
N2 (* *) Y5
