% as a text
N10 G1 X30 F50
N20 Y20
