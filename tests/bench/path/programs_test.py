#!/usr/bin/env python3
"""The programs have the moves that they are said to have, and those of LinuxCNC come over as they are meant."""

import math
import re
import statistics
import unittest

import from_linuxcnc
import programs

PLANES = {"G17": (0, 1), "G18": (2, 0), "G19": (1, 2)}


class Move:
    """One line of a program that is read back, without the code that wrote it."""

    def __init__(self, code, start, end, centre, plane, feed):
        self.code, self.start, self.end, self.centre, self.feed = code, start, end, centre, feed
        climb = [b - a for a, b in zip(start, end)]
        if code in ("G0", "G1"):
            self.length = math.hypot(*climb)
            return
        first, second = plane
        self.radius = math.hypot(centre[first], centre[second])
        to = [climb[axis] - centre[axis] for axis in range(3)]
        self.mismatch = abs(math.hypot(to[first], to[second]) - self.radius)
        turn = math.atan2(to[second], to[first]) - math.atan2(-centre[second], -centre[first])
        turn = turn % (2 * math.pi) if code == "G3" else -turn % (2 * math.pi)
        if climb[first] == climb[second] == 0:
            turn = 2 * math.pi
        self.sweep = turn
        third = 3 - first - second
        self.length = math.hypot(turn * self.radius, climb[third])


def moves_of(text):
    moves, place, feed, plane = [], [0.0, 0.0, 0.0], None, PLANES["G17"]
    head, *lines = text.splitlines()
    assert head.startswith("% "), head
    for row, line in enumerate(lines, 1):
        n, code, *words = line.split(" ")
        assert n == f"N{10 * row}", line
        if code in PLANES:
            plane = PLANES[code]
            continue
        end, centre = list(place), [0.0, 0.0, 0.0]
        for word in words:
            assert re.fullmatch(r"[XYZIJKF]-?\d+(\.\d+)?", word), line
            value = float(word[1:])
            if word[0] == "F":
                feed = value
            elif word[0] in "XYZ":
                end["XYZ".index(word[0])] = value
            else:
                centre["IJK".index(word[0])] = value
        moves.append(Move(code, place, end, centre, plane, feed))
        place = end
    return moves


def generated(name, velocity=250):
    return moves_of(programs.PROGRAMS[name](velocity).text())


def turns(moves):
    """Angles between lines in degrees."""
    directions = [[(b - a) / move.length for a, b in zip(move.start, move.end)] for move in moves]
    return [math.degrees(math.acos(max(-1, min(1, sum(x * y for x, y in zip(a, b))))))
            for a, b in zip(directions, directions[1:])]


class Programs(unittest.TestCase):
    def total(self, moves):
        return sum(move.length for move in moves)

    def test_numbers_of_moves_and_lengths(self):
        known = {"contour": (10000, 185.294), "spiral_lines": (491, 1975.143), "short_segments_0.001": (3000, 76.2),
                 "arc-arc-sawtooth": (48, 25.4 * 0.4 * (math.asin(0.25) + 47 * math.asin(math.sqrt(0.3125)))),
                 "square_spiral": (23, 25.4 * 1.77)}
        for name, (count, length) in known.items():
            with self.subTest(name):
                moves = generated(name)
                self.assertEqual(len(moves), count)
                self.assertAlmostEqual(self.total(moves), length, delta=0.01)

    def test_contour_has_noise_of_its_last_decimal(self):
        lines = generated("contour")[1:]
        self.assertAlmostEqual(statistics.mean(move.length for move in lines), 0.016, delta=0.0001)
        angles = turns(lines)
        self.assertGreater(max(angles), 8)
        self.assertAlmostEqual(max(math.hypot(*move.end) for move in lines), 25.4, delta=0.002)

    def test_random_lines_are_as_random(self):
        moves = generated("random_lines_0.001")
        self.assertEqual(len(moves), 4002)
        self.assertEqual([moves[0].end, moves[1].end], [[-0.1, 0, 0], [0, 0, 0]])
        lengths = sorted(move.length * 1000 for move in moves[2:])
        for part, known in ((0, 0.724), (0.05, 0.851), (0.5, 1.0), (0.95, 1.131), (0.9999, 1.210)):
            self.assertAlmostEqual(lengths[int(part * 4000)], known, delta=0.06)
        angles = sorted(turns(moves[2:]))
        for part, known in ((0.1, 6.13), (0.5, 15.28), (0.9, 25.15), (0.999, 41.2)):
            self.assertAlmostEqual(angles[int(part * 3999)], known, delta=0.15 * known)

    def test_sawtooth_has_true_arcs(self):
        moves = generated("arc-arc-sawtooth")
        self.assertEqual([move.code for move in moves], ["G2", "G3"] * 24)
        for move in moves:
            self.assertLess(move.mismatch, 1e-8)
            self.assertAlmostEqual(move.radius, 5.08, places=8)
            self.assertLess(move.sweep, math.pi)

    def test_square_spiral_grows(self):
        moves = generated("square_spiral")
        self.assertAlmostEqual(moves[0].feed, 5 * 25.4 / 60, places=8)
        self.assertTrue(all(abs(angle - 90) < 1e-9 for angle in turns(moves)[:-2]))
        self.assertEqual(moves[-1].end, [0, 0, -4.826])

    def test_feeds_are_limited(self):
        self.assertTrue(all(move.feed == 250 for move in generated("contour")))
        self.assertAlmostEqual(generated("contour", 1e9)[5].feed, 4232.91)


SAMPLE = """%
( a program ) ( of LinuxCNC )
#<scale> = 2.0 #1=[1+2*3]
n10 G21 g90 G64 P.1 (blend)
T1 M6 S100 M3
G0 X[#<scale>*1.5] Y#1 Z-.5
F600 X4 ; comment
G1Y[#1-2**2]
G91 G2 X2 Y0 R1
g90 G18 G3 X6 Z1.5 I0 K1
G17 G2 I1.5
G20 G1 X1 F12
M2
G1 X1000
"""


class FromLinuxCnc(unittest.TestCase):
    def convert(self, text):
        return moves_of(from_linuxcnc.convert(text, "sample", 250).text())

    def test_a_program_with_everything(self):
        moves = self.convert(SAMPLE)
        self.assertEqual([move.code for move in moves], ["G1", "G1", "G1", "G2", "G3", "G2", "G1"])
        self.assertEqual([move.end for move in moves],
                         [[3, 7, -0.5], [4, 7, -0.5], [4, 3, -0.5], [6, 3, -0.5], [6, 3, 1.5], [6, 3, 1.5], [25.4, 3, 1.5]])
        self.assertEqual([move.feed for move in moves], [250, 250, 10, 10, 10, 10, 5.08])
        self.assertEqual(moves[3].centre, [1, 0, 0])
        self.assertAlmostEqual(moves[4].length, math.pi)
        self.assertAlmostEqual(moves[5].length, 3 * math.pi)

    def test_rapids_can_stay(self):
        text = from_linuxcnc.convert("G0 X1\nG1 X2 F60\nG0 Y1", "x", 250).text("G0")
        self.assertEqual(text, "% x\nN10 G0 X1\nN20 G1 X2 F1\nN30 G0 Y1\n")

    def test_feeds_need_not_count(self):
        program = from_linuxcnc.convert("G20 G1 X1 F9\nY1 F8", "x", 70, full_feed=True)
        self.assertEqual(program.text(), "% x\nN10 G1 X25.4 F70\nN20 G1 Y25.4\n")

    def test_the_machine_says_the_unit(self):
        self.assertEqual(from_linuxcnc.convert("G1 X2 F60", "x", 250, 25.4).text(), "% x\nN10 G1 X50.8 F25.4\n")
        self.assertEqual(from_linuxcnc.convert("G21 G1 X2 F60", "x", 250, 25.4).text(), "% x\nN10 G1 X2 F1\n")

    def test_radii(self):
        small = 2 * math.atan2(4, 3)
        for code, radius, centre, sweep in (("G2", 5, [4, -3, 0], small), ("G3", 5, [4, 3, 0], small),
                                            ("G2", -5, [4, 3, 0], 2 * math.pi - small)):
            move, = self.convert(f"{code} X8 R{radius} F60")
            self.assertEqual([round(x, 9) for x in move.centre], centre)
            self.assertAlmostEqual(move.sweep, sweep)

    def test_absolute_centres(self):
        _, move = self.convert("G1 X2 Y1 F60 G90.1\nG3 X4 Y-1 I4 J1\n")
        self.assertEqual(move.centre, [2, 0, 0])
        self.assertAlmostEqual(move.sweep, math.pi / 2)

    def test_what_leads_nowhere_is_left_out(self):
        self.assertEqual(len(self.convert("G0 X0 Y0 Z0\nG1 X1 F9\nG1 X1\nX1 Y0\nM30")), 1)

    def test_what_is_not_known_is_said(self):
        for text, error in (("G1 X1\nG81 X1 Z-1 R2", "line 2: G81 is not known"), ("G93\n", "line 1: G93 is not known"),
                            ("G43 H1", "line 1: G43 is not known"), ("G1 X#5", "line 1: #5 has no value"),
                            ("G1 X[1+2", "line 1: a bracket is not closed"), ("G1 X1 A90", "line 1: the word A is not known"),
                            ("X1", "line 1: no G0, G1, G2 or G3 before the first coordinate"),
                            ("G1 X?", "line 1: cannot be read: G1 X?"),
                            ("G2 X8 R3", "line 1: the radius 3 does not reach the end"),
                            ("o100 call", "line 1: no word: 'call'")):
            with self.subTest(text), self.assertRaises(from_linuxcnc.ProgramError) as raised:
                self.convert(text)
            self.assertEqual(str(raised.exception), error)


if __name__ == "__main__":
    unittest.main()
