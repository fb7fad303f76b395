#!/usr/bin/env python3
"""Draws the pictures of docs/kinematics.md: of each kinematics its axes and the measures that its block takes.

usage: figures.py STRIDE [OUT]

Each machine is drawn for some positions of its axes by this script's own geometry. The blocks must say the same place of the
tool, or the script fails. Without OUT it says which of the pictures beside it are no longer what it would draw.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
from math import cos, radians, sin, sqrt

from picture import Picture, in_space, plus, polar


def gantry3(p):
    x, y, z = 210, 120, 90
    for side in (0, 240):
        p.link((0, side, 150), (330, side, 150))
    p.link((x, 0, 150), (x, 240, 150))
    p.rod((x, y, 190), (x, y, z))
    p.slide((x, y, 150), (26, 18))
    p.tool((x, y, z))
    p.frame((0, 0, 0), {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}, 60)
    for start, end, name in (((0, 0, 0), (x, 0, 0), "a0"), ((x, 0, 0), (x, y, 0), "a1"), ((x, y, 0), (x, y, z), "a2")):
        p.ghost(start, end)
        p.text(plus(in_space(tuple((a + b) / 2 for a, b in zip(start, end))), (8, -10)), name, "#d55e00", bold=True)
    return (x, y, z)


def belts(p, left, signs, title):
    """A carriage of a belt portal at a place that is drawn from the left end."""
    a0, a1 = 60, 20
    x = 0.5 * (signs[0] * a0 + signs[2] * a1)
    y = 0.5 * (signs[1] * a0 + signs[3] * a1)
    p.text((left + 130, 205), title, bold=True)
    p.link((left, 0), (left, 180))
    p.link((left + 260, 0), (left + 260, 180))
    beam = 100 + y
    p.link((left, beam), (left + 260, beam))
    p.slide((left + 130 + x, beam), (34, 26))
    p.tool((left + 130 + x, beam))
    for at, name in (((left, 0), "a0"), ((left + 260, 0), "a1")):
        p.joint(at, 13)
        p.text(plus(at, (0, -28)), name, "#d55e00", bold=True)
    p.frame((left + 130, 100), {"X": (1, 0), "Y": (0, 1)}, 52)
    return (x, y, 0)


def h_gantry(p):
    return belts(p, 0, (1, -1, -1, -1), "Kin_HGantry2")


def t_gantry(p):
    return belts(p, 0, (1, -1, 1, 1), "Kin_TGantry2")


def polar_z(p):
    tip = polar(210, 35)
    p.frame((0, 0), {"X": (1, 0), "Y": (0, 1), "Z": (0, 0)}, 90)
    p.link((0, 0), polar(280, 35))
    p.joint((0, 0), 12)
    p.slide(tip, (30, 26))
    p.tool(tip)
    p.measure((0, 0), tip, "a1", 24)
    p.turn((0, 0), 62, 0, 35, "a0")
    return (*tip, 0)


def scara(p, lengths, angles):
    at, heading, place = (0.0, 0.0), 0.0, []
    for number, (length, angle) in enumerate(zip(lengths, angles)):
        p.ghost(at, plus(at, polar(88 if number == 0 else 80, heading)))
        p.turn(at, 46, heading, heading + angle, f"a{number}", 16)
        heading += angle
        end = plus(at, polar(length, heading))
        p.link(at, end)
        p.measure(at, end, f"dArmLength{number + 1}", 30 if number % 2 == 0 else -30)
        place.append(at)
        at = end
    for joint in place:
        p.joint(joint, 12)
    p.tool(at)
    p.frame((0, 0), {"X": (1, 0), "Y": (0, 1), "Z": (0, 0)}, 84)
    return (*at, 0)


def scara2(p):
    return scara(p, (220, 180), (30, 55))


def scara3(p):
    return scara(p, (200, 160, 90), (20, 60, -50))


def tripod_linear(p):
    """From the side, the rail of a0 to the right; from above, the other two."""
    outer, inner, rod, lean, a = 150, 45, 260, radians(12), 40
    slide = (outer - a * sin(lean), -a * cos(lean))
    down = sqrt(rod * rod - (outer - a * sin(lean) - inner) ** 2)
    tool = (0, -a * cos(lean) - down)
    p.ghost((-60, 0), (outer + 40, 0))
    p.ghost((0, 70), (0, tool[1]))
    p.ghost((outer, 0), (outer, -110))
    p.link((outer + 40 * sin(lean), 40 * cos(lean)), (outer - 200 * sin(lean), -200 * cos(lean)))
    p.slide(slide, (26, 26))
    p.rod(slide, (inner, tool[1]))
    p.link((0, tool[1]), (inner, tool[1]))
    p.joint((inner, tool[1]), 6)
    p.tool(tool)
    p.frame((0, 0), {"X": (1, 0), "Z": (0, 1)}, 56)
    p.measure((0, 44), (outer, 44), "dOuterRadius", 20)
    p.measure((0, tool[1]), (inner, tool[1]), "dInnerRadius", -24)
    p.measure(slide, (inner, tool[1]), "dRodLength", -34)
    p.arrow((outer + 56, 0), plus((outer + 56, 0), (-84 * sin(lean), -84 * cos(lean))), "a0", "#d55e00")
    p.text((outer + 6, -118), "dRailAngle", anchor="start")
    above = (-190, -130)
    for i in range(3):
        p.rod(above, plus(above, polar(80, 120 * i)))
        p.slide(plus(above, polar(80, 120 * i)), (20, 20))
        p.text(plus(above, polar(106, 120 * i)), f"a{i}", "#d55e00", bold=True)
    p.frame(above, {"X": (1, 0), "Y": (0, 1)}, 40)
    p.text(plus(above, (0, -120)), "from above")
    return (0, 0, tool[1])


def tripod_rotary(p):
    """From the side: the arm of a0 to the left, level."""
    arm, rod, motor, stewart, pair = 130, 270, 80, 45, 50
    plate = sqrt(stewart ** 2 - pair ** 2 / 4)
    height = sqrt(rod ** 2 - (motor + arm - plate) ** 2)
    elbow = (-motor - arm, height)
    p.ghost((0, height), (-motor - arm - 20, height))
    p.ghost((0, height + 40), (0, 0))
    p.base((-motor - 30, height + 16), (motor + 30, height + 16))
    p.link((-motor, height), elbow)
    p.rod(elbow, (-plate, 0))
    p.link((-plate, 0), (plate, 0))
    p.joint((-motor, height), 12)
    p.joint(elbow, 6)
    p.joint((-plate, 0), 6)
    p.tool((0, 0))
    p.frame((0, 0), {"X": (1, 0), "Z": (0, 1)}, 70)
    p.measure((-motor, height), (0, height), "dArm1Radius", 40)
    p.measure(elbow, (-motor, height), "dArmLength1", 40)
    p.measure(elbow, (-plate, 0), "dArmLength2", -22)
    p.turn((-motor, height), 74, 180, 222, "a0", 16)
    above = (220, height - 40)
    for i in range(3):
        out = 180 + 120 * i
        p.link(plus(above, polar(48, out)), plus(above, polar(110, out)))
        for side in (-1, 1):
            aside = polar(side * 13, out + 90)
            p.rod(plus(plus(above, polar(110, out)), aside), plus(plus(above, polar(24, out)), aside))
        p.joint(plus(above, polar(48, out)), 8)
        p.text(plus(above, polar(134, out)), f"a{i}", "#d55e00", bold=True)
    p.frame(above, {"X": (1, 0), "Y": (0, 1)}, 44)
    p.measure(plus(above, (-110, -13)), plus(above, (-110, 13)), "dDistance", 44)
    p.text(plus(above, (0, -140)), "from above")
    p.text((0, -40), "dStewartRadius: circle through the six joints of the plate")
    return (0, 0, 0)


def bipod(p):
    motors, arm, rod, plate, a0, a1 = 100, 150, 280, 60, 25, 40
    ends = [(side * (motors / 2 + arm * cos(radians(a))), -arm * sin(radians(a))) for side, a in ((-1, a0), (1, a1))]
    # The rods' ends moved together by half the plate: the tool is as far from both.
    (x0, y0), (x1, y1) = ((ends[0][0] + plate / 2, ends[0][1]), (ends[1][0] - plate / 2, ends[1][1]))
    half = sqrt((x1 - x0) ** 2 + (y1 - y0) ** 2) / 2
    down = sqrt(rod ** 2 - half ** 2) / (2 * half)
    tool = ((x0 + x1) / 2 + (y1 - y0) * down, (y0 + y1) / 2 - (x1 - x0) * down)
    for side, end, a, name in ((-1, ends[0], a0, "a0"), (1, ends[1], a1, "a1")):
        motor = (side * motors / 2, 0)
        p.ghost(motor, plus(motor, (side * 110, 0)))
        p.link(motor, end)
        p.rod(end, plus(tool, (side * plate / 2, 0)))
        p.joint(motor, 12)
        p.joint(end, 6)
        p.turn(motor, 76, 90 - side * 90, 90 - side * (90 + a), name, 16)
    p.link(plus(tool, (-plate / 2, 0)), plus(tool, (plate / 2, 0)))
    p.tool(tool)
    p.frame((0, 0), {"X": (1, 0), "Y": (0, 1)}, 40)
    p.measure((-motors / 2, 0), (motors / 2, 0), "dMotorDistance", 62)
    p.measure((-motors / 2, 0), ends[0], "dArmLength1", -70)
    p.measure(ends[0], plus(tool, (-plate / 2, 0)), "dArmLength2", -26)
    p.measure(plus(tool, (-plate / 2, 0)), plus(tool, (plate / 2, 0)), "dPlateDistance", -24)
    return (*tool, 0)


def robot(p):
    """Zero, from the side; d3 from above."""
    d1, a1, a2, d3, a3, d4, d6 = 150, 60, 170, 40, 40, 180, 70
    shoulder, elbow = (a1, d1), (a1, d1 + a2)
    wrist, tool = (a1 + d4, d1 + a2 + a3), (a1 + d4 + d6, d1 + a2 + a3)
    p.base((-60, 0), (60, 0))
    p.ghost((0, 0), (0, d1 + a2 + a3 + 30))
    p.ghost(elbow, plus(elbow, (d4 + 20, 0)))
    p.link((0, 0), (0, d1), shoulder)
    p.link(shoulder, elbow)
    p.link(elbow, (a1, d1 + a2 + a3), wrist, tool)
    for at in (shoulder, elbow, wrist):
        p.joint(at, 12)
    p.tool(tool)
    p.frame((0, 0), {"X": (1, 0), "Z": (0, 1)}, 92)
    p.frame(tool, {"Z tool": (1, 0), "X tool": (0, 1)}, 46)
    p.measure((0, 0), (0, d1), "d1", 46)
    p.measure((0, d1), shoulder, "a1", 24)
    p.measure(shoulder, elbow, "a2", -34)
    p.measure(elbow, (a1, d1 + a2 + a3), "a3", 30)
    p.measure((a1, d1 + a2 + a3), wrist, "d4", 40)
    p.measure(wrist, tool, "d6", -56)
    p.turn(shoulder, 40, 20, 90, "+", 8)
    for at, name, off in ((shoulder, "axis 1", (44, -16)), (elbow, "axis 2", (40, -22)), (wrist, "axis 4", (0, -26))):
        p.text(plus(at, off), name, "#d55e00", bold=True)
    p.text((36, 60), "axis 0", "#d55e00", bold=True)
    p.text((a1 + 80, d1 + a2 + a3 - 16), "axis 3", "#d55e00", bold=True)
    p.text(plus(tool, (-4, -18)), "axis 5", "#d55e00", bold=True)
    above = (0, -110)
    p.link(above, plus(above, (a1, 0)))
    p.link(plus(above, (a1, -d3)), plus(above, (a1 + d4 + d6, -d3)))
    p.rod(plus(above, (a1, 0)), plus(above, (a1, -d3)))
    p.joint(above, 12)
    p.tool(plus(above, (a1 + d4 + d6, -d3)))
    p.frame(above, {"X": (1, 0), "Y": (0, 1)}, 40)
    p.measure(plus(above, (a1 + 60, -d3)), plus(above, (a1 + 60, 0)), "d3", -20)
    p.text(plus(above, (-40, -52)), "from above")
    return (a1 + d4 + d6, -d3, d1 + a2 + a3)


def palletizer(p):
    height, front, arm1, arm2, hand, down, a1, a2 = 130, 50, 200, 190, 50, 60, 25, 20
    shoulder = (front, height)
    elbow = plus(shoulder, polar(arm1, 90 - a1))
    end = plus(elbow, polar(arm2, a2))
    tool = plus(end, (hand, -down))
    p.base((-60, 0), (60, 0))
    p.ghost(shoulder, plus(shoulder, (0, 120)))
    p.ghost(elbow, plus(elbow, (130, 0)))
    p.link((0, 0), (0, height), shoulder)
    p.link(shoulder, elbow, end)
    p.rod(end, plus(end, (hand, 0)), tool)
    for at in (shoulder, elbow, end):
        p.joint(at, 12)
    p.tool(tool)
    p.frame((0, 0), {"X": (1, 0), "Z": (0, 1)}, 80)
    p.measure((0, 0), (0, height), "dShoulderHeight", 30)
    p.measure((0, height), shoulder, "dShoulderFront", 40)
    p.measure(shoulder, elbow, "dArmLength1", -60)
    p.measure(elbow, end, "dArmLength2", 40)
    p.measure(end, plus(end, (hand, 0)), "dHandFront", 40)
    p.measure(plus(end, (hand, 0)), tool, "dHandDown", 26)
    p.turn(shoulder, 90, 90, 90 - a1, "a1", 14)
    p.turn(elbow, 100, 0, a2, "a2", 16)
    p.text((26, 60), "a0", "#d55e00", bold=True)
    p.text(plus(tool, (-22, 12)), "a3", "#d55e00", bold=True)
    return (tool[0], 0, tool[1])


def chain(rows, joints):
    """Frames of a chain after Denavit and Hartenberg, rows of (d, a, twist)."""
    turn, place, frames = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], (0.0, 0.0, 0.0), []
    for (d, a, twist), joint in zip(rows, joints):
        frames.append((turn, place))
        c, s, ct, st = cos(radians(joint)), sin(radians(joint)), cos(radians(twist)), sin(radians(twist))
        step = [[c, -s * ct, s * st], [s, c * ct, -c * st], [0, st, ct]]
        way = (a * c, a * s, d)
        place = tuple(place[i] + sum(turn[i][k] * way[k] for k in range(3)) for i in range(3))
        turn = [[sum(turn[i][k] * step[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    frames.append((turn, place))
    return frames


def offset_wrist(p):
    d1, a2, a3, d4, d5, d6 = 130, -190, -170, 80, 70, 60
    joints = (20, -50, 60, -20, -90, 0)
    frames = chain(((d1, 0, 90), (0, a2, 0), (0, a3, 0), (d4, 0, 90), (d5, 0, -90), (d6, 0, 0)), joints)
    places = [place for _, place in frames]
    p.frame((0, 0, 0), {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}, 70)
    p.link(*places)
    for number, (turn, place) in enumerate(frames[:-1]):
        axis = tuple(row[2] for row in turn)
        p.turn_about(plus(place, ((60 if number == 0 else 30) * part for part in axis)), axis, 22, f"axis {number}")
        p.ghost(plus(place, (-30 * part for part in axis)), plus(place, (52 * part for part in axis)))
        p.joint(place, 8)
    p.tool(places[-1])
    for name, start, end, off in (("d1", 0, 1, 26), ("a2", 1, 2, 30), ("a3", 2, 3, 30), ("d4", 3, 4, -26), ("d5", 4, 5, -30), ("d6", 5, 6, -30)):
        p.measure(places[start], places[end], name, off)
    return places[-1]


def head(p):
    tilt, length = 25, 130
    p.link((-130, 0), (36, 0))
    p.rod((0, 0), (0, -40))
    p.joint((0, -40), 14)
    tool = plus((0, -40), (length * sin(radians(tilt)), length * cos(radians(tilt))))
    p.link((0, -40), tool)
    p.tool(tool)
    p.ghost((0, -40), (0, 110))
    p.turn((0, -40), 84, 90, 90 - tilt, "a4", 16)
    p.measure((0, -40), tool, "dToolLength", -34)
    p.frame((-110, -90), {"X": (1, 0), "Z": (0, 1)}, 50)
    p.text((-24, 26), "a3", "#d55e00", bold=True)
    return (length * sin(radians(tilt)), 0, length * cos(radians(tilt)))


def table(p):
    """The table swivelled, the tool on the workpiece's origin and then above it."""
    cx, cy, cz, height, swivel, turn = 150, 90, 60, 50, -30, 25
    x, y, z = 180, 60, 190
    p.frame((0, 0, 0), {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}, 70)
    p.ghost((cx - 140, cy, cz), (cx + 140, cy, cz))
    normal = (0, -sin(radians(swivel)), cos(radians(swivel)))
    across = (0, cos(radians(swivel)), sin(radians(swivel)))
    origin = tuple(c + height * n for c, n in zip((cx, cy, cz), normal))
    corners = [tuple(o + u * e + v * f for o, e, f in zip(origin, (1, 0, 0), across)) for u, v in ((-80, -60), (80, -60), (80, 60), (-80, 60), (-80, -60))]
    p.path(corners, "#5b7083", 3)
    p.rod((cx, cy, cz), origin)
    p.joint((cx, cy, cz), 8)
    p.turn_about((cx + 110, cy, cz), (1, 0, 0), 24, "a3")
    p.turn_about(tuple(c + 24 * n for c, n in zip((cx, cy, cz), normal)), normal, 30, "a4")
    p.measure((cx, cy, cz), origin, "dTableHeight", 60)
    p.ghost((0, 0, 0), (cx, 0, 0), (cx, cy, 0), (cx, cy, cz))
    p.text(plus(in_space((cx, cy, cz)), (90, -64)), "dCentreX, dCentreY, dCentreZ")
    p.link((x, y, z + 90), (x, y, z))
    p.tool((x, y, z))
    p.text(plus(in_space((x, y, z + 90)), (0, 14)), "a0, a1, a2", "#d55e00", bold=True)
    # The tool from the workpiece: back by the swivel about x, then by the turn about z.
    dx, dy, dz = x - cx, y - cy, z - cz
    s, c = sin(radians(swivel)), cos(radians(swivel))
    dy, dz = c * dy + s * dz, -s * dy + c * dz
    s, c = sin(radians(turn)), cos(radians(turn))
    return (c * dx + s * dy, -s * dx + c * dy, dz - height)


def c_axis_tool(p):
    a, x, y = 35, 110, 40
    tool = plus(polar(x, a), polar(y, a + 90))
    p.frame((0, 0), {"X flange": (1, 0), "Y flange": (0, 1), "Z": (0, 0)}, 118)
    p.ghost((0, 0), polar(150, a))
    p.link((0, 0), polar(x, a), tool)
    p.joint((0, 0), 14)
    p.tool(tool)
    p.turn((0, 0), 62, 0, a, "a0", 14)
    p.measure((0, 0), polar(x, a), "dToolX", 20)
    p.measure(polar(x, a), tool, "dToolY", -26)
    return (*tool, 0)


def wrist2(p):
    roll_x, roll_z, length, a1 = 40, 50, 130, 35
    roll = (roll_x, roll_z)
    tool = plus(roll, (length * sin(radians(a1)), length * cos(radians(a1))))
    p.base((-60, 0), (60, 0))
    p.frame((0, 0), {"X flange": (1, 0), "Z flange": (0, 1)}, 100)
    p.rod((0, 0), (0, roll_z), roll)
    p.link(roll, tool)
    p.ghost(roll, plus(roll, (0, 110)))
    p.joint(roll, 12)
    p.tool(tool)
    p.turn(roll, 80, 90, 90 - a1, "a1", 14)
    p.text((-22, 26), "a0", "#d55e00", bold=True)
    p.measure((0, roll_z), roll, "dRollAxisOffsetX", -76)
    p.measure((roll_x, 0), roll, "dRollAxisOffsetZ", -44)
    p.measure(roll, tool, "dToolLength", -30)
    return (tool[0], 0, tool[1])


def wrist3(p):
    length, a1 = 120, -40  # about the negative y axis: negative leads to +x
    tool = (length * sin(radians(-a1)), length * cos(radians(-a1)))
    p.base((-40, -60), (40, -60))
    p.frame((-170, -60), {"X flange": (1, 0), "Z flange": (0, 1)}, 44)
    p.rod((0, -60), (0, 0))
    p.link((0, 0), tool)
    p.ghost((0, 0), (0, 130))
    p.joint((0, 0), 14)
    p.tool(tool)
    p.turn((0, 0), 90, 90 + a1, 90, "a1", 14)
    p.text((-24, -30), "a0", "#d55e00", bold=True)
    p.text(plus(tool, (24, 0)), "a2", "#d55e00", bold=True)
    p.measure((0, 0), tool, "dToolOffsetZ", -34)
    return (tool[0], 0, tool[1])


# Each picture: who draws it, the block with its inputs, the positions of the axes that are drawn.
PICTURES = (
    (gantry3, "Kin_Gantry3", "", (210, 120, 90)),
    (h_gantry, "Kin_HGantry2", "", (60, 20)),
    (t_gantry, "Kin_TGantry2", "", (60, 20)),
    (polar_z, "Kin_Polar_Z", "", (35, 210, 0)),
    (scara2, "Kin_Scara2_Z", "dArmLength1 := 220, dArmLength2 := 180", (30, 55, 0)),
    (scara3, "Kin_Scara3_Z", "dArmLength1 := 200, dArmLength2 := 160, dArmLength3 := 90", (20, 60, -50, 0)),
    (tripod_linear, "Kin_Tripod_Linear", "dOuterRadius := 150, dInnerRadius := 45, dRodLength := 260, dRailAngle := 12", (40, 40, 40)),
    (tripod_rotary, "Kin_Tripod_Rotary", "dArmLength1 := 130, dArmLength2 := 270, dArm1Radius := 80, dStewartRadius := 45, dDistance := 50", (0, 0, 0)),
    (bipod, "Kin_Bipod_Rotary", "dMotorDistance := 100, dArmLength1 := 150, dArmLength2 := 280, dPlateDistance := 60", (25, 40)),
    (robot, "Kin_ArticulatedRobot_6DOF", "d1 := 150, a1 := 60, a2 := 170, d3 := 40, a3 := 40, d4 := 180, d6 := 70", (0, 0, 0, 0, 0, 0)),
    (palletizer, "Kin_4AxisPalletizer",
     "dShoulderHeight := 130, dShoulderFront := 50, dArmLength1 := 200, dArmLength2 := 190, dHandFront := 50, dHandDown := 60", (0, 25, 20, 0)),
    (offset_wrist, "Kin_OffsetWrist_6DOF", "d1 := 130, a2 := -190, a3 := -170, d4 := 80, d5 := 70, d6 := 60", (20, -50, 60, -20, -90, 0)),
    (head, "Kin_5Axes", "dToolLength := 130", (0, 0, 0, 0, 25)),
    (table, "Kin_5AxesTable", "dCentreX := 150, dCentreY := 90, dCentreZ := 60, dTableHeight := 50", (180, 60, 190, -30, 25)),
    (c_axis_tool, "Kin_CAxis_Tool", "dToolX := 110, dToolY := 40", (35,)),
    (wrist2, "Kin_Wrist2", "dToolLength := 130, dRollAxisOffsetX := 40, dRollAxisOffsetZ := 50", (0, 35)),
    (wrist3, "Kin_Wrist3", "dToolOffsetZ := 120", (0, -40, 0)),
)


def places_of_blocks(stride, folder):
    """Where each block says that the tool is."""
    declared, calls = [], []
    for number, (_, block, inputs, axes) in enumerate(PICTURES):
        declared.append(f"k{number} : {block}{f' := ({inputs})' if inputs else ''};")
        positions = "".join(f"a.a{i} := {float(axis)}; " for i, axis in enumerate(axes))
        calls.append(f"{positions}error := k{number}.AxesToCartesian(f := f, cd := cd, a := a); v[{number}] := f.vT;")
    (folder / "places.st").write_text("\n".join(
        ["PROGRAM PLC_PRG", "VAR", "f : SMC_Frame; cd : CONFIGDATA; a : AXISPOS_REF; error : SMC_ERROR;",
         f"v : ARRAY[0..{len(PICTURES) - 1}] OF SMC_VECTOR3D;", *declared, "END_VAR", *calls, "END_PROGRAM", ""]), encoding="utf-8")
    run = subprocess.run([stride, "sim", folder / "places.st", "--for", "T#10ms", "--print", "PLC_PRG.v", "-W", "off=lints"],
                         check=True, capture_output=True, text=True)
    numbers = [float(value) for value in re.findall(r"\.d[XYZ] = (\S+)", run.stdout)]
    return [numbers[3 * i:3 * i + 3] for i in range(len(PICTURES))]


def main():
    stride, here = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(__file__).resolve().parent
    with tempfile.TemporaryDirectory() as name:
        out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else name)
        wrong = []
        for (draw, block, _, _), said in zip(PICTURES, places_of_blocks(stride, pathlib.Path(name))):
            picture = Picture()
            drawn = draw(picture)
            if max(abs(a - b) for a, b in zip(drawn, said)) > 1e-9:
                wrong.append(f"{block}: drawn at {drawn}, the block says {said}")
            picture.write(out / f"{draw.__name__}.svg")
        if wrong:
            sys.exit("\n".join(wrong))
        if len(sys.argv) == 2:
            old = [new.name for new in sorted(out.glob("*.svg"))
                   if not (here / new.name).exists() or new.read_bytes() != (here / new.name).read_bytes()]
            if old:
                sys.exit(f"out of date: {', '.join(old)}; draw them anew with docs/kinematics/figures.py STRIDE docs/kinematics")


if __name__ == "__main__":
    main()
