% initial values that are expressions
N10 G1 X$g_rWhole$ Y$g_rReal$ Z$g_rTurn$ F100
N20 X$g_iRest$ Y$g_rRoot$ Z$g_rMany$
N30 X$g_rNegative$ Y$g_rOfConstant$ Z$g_rMost$
