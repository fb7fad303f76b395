N10 G1 X$g_rComputed$ F10
N20 Y$g_stSize.rOther$ Z$g_aPos[4]$
N30 G1 X$g_rQuotient$ Y$g_stSize$ B$Main.fb.nCount$
