% the tool's radius and the plane
N10 G1 X10 F10
N20 G41 D-0.5
N30 X20
N40 G1 Y20
N50 G40
