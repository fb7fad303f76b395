% made by the command
N10 G1 X10.5 E900
N20 X20 Y0.1
/N30 X300
N40 M3
