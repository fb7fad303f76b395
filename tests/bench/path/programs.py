#!/usr/bin/env python3
"""programs.py NAME | --all FOLDER [--velocity V] [--rapids G0|G1]: programs that planners of paths are measured by.

They have the geometry of six test programs of LinuxCNC's trajectory planner (tests/trajectory-planner/circular-arcs), by
formula: the same moves but for random_lines_0.001, which is another random walk with the same lengths, angles and
number of moves. Lengths in mm, feeds in mm/s and at most V, which is 250, where those of the originals are beyond what
a machine does.
"""

import argparse
import math
import pathlib
import random
import sys

from gcode import Program

INCH = 25.4
MINUTE = 60.0


def inches(*place):
    return [None if coordinate is None else coordinate * INCH for coordinate in place]


def contour(velocity):
    """From the centre onto a circle of 1 inch, which is 10,000 points, rounded to 0.0001 inch: a sixth of a line."""
    program = Program("contour", velocity)
    program.feed = 9999 * INCH / MINUTE
    for i in range(10000):
        turn = 2 * math.pi * i / 10000
        program.line(inches(round(math.sin(turn), 4), round(math.cos(turn), 4), None))
    return program


def spiral_lines(velocity):
    """Out and back, and a spiral of lines, a tenth of a radian each, inwards from 2 inches to about one."""
    program = Program("spiral_lines", velocity)
    program.line(inches(1, 0, 0), rapid=True, feed=velocity)
    program.line(inches(0, None, None), rapid=True, feed=velocity)
    program.feed = 999 * INCH / MINUTE
    for i in range(1000, 511, -1):
        turn = 0.1 * i
        program.line(inches(round(0.02 * turn * math.cos(turn), 6), round(0.02 * turn * math.sin(turn), 6), None))
    return program


def short_segments(velocity):
    """Along the edges of a cube of 1 inch, 1000 lines each."""
    program = Program("short_segments_0.001", velocity)
    program.feed = 999 * INCH / MINUTE
    for axis in range(3):
        for i in range(1, 1001):
            end = [None, None, None]
            end[axis] = i / 1000
            program.line(inches(*end))
    return program


def random_lines(velocity):
    """A random walk: 4000 lines of 0.001 mm more or less, each in the direction of the one before and something else."""
    chance = random.Random(4)
    program = Program("random_lines_0.001", velocity)
    program.line([-0.1, 0, 0], rapid=True, feed=velocity)
    program.feed = 20 / MINUTE
    program.line([0, None, None])
    program.feed = 999 / MINUTE
    direction = [1.0, 0.0, 0.0]
    place = [0.0, 0.0, 0.0]
    for _ in range(4000):
        direction = [part + chance.uniform(-0.36, 0.36) for part in direction]
        size = math.sqrt(sum(part * part for part in direction))
        direction = [part / size for part in direction]
        length = 0.001 * (1 + 0.17 * (chance.random() + chance.random() + chance.random() - 1.5))
        place = [round(here + length * part, 6) for here, part in zip(place, direction)]
        program.line(place)
    return program


def arc_arc_sawtooth(velocity):
    """48 arcs of 0.2 inch up and down, bent to one side and to the other in turn."""
    program = Program("arc-arc-sawtooth", velocity)
    program.feed = 1000 * INCH / MINUTE
    radius = 0.2
    start = (0.0, 0.0)
    for i in range(48):
        up = i % 2 == 0
        end = (i / 10, 0.1 if up else -0.1)
        chord = (end[0] - start[0], end[1] - start[1])
        half = math.hypot(*chord) / 2
        height = math.sqrt(radius * radius - half * half) / (2 * half)
        side = 1 if up else -1  # the centre of a clockwise arc lies right of the chord
        centre = (chord[0] / 2 + side * height * chord[1], chord[1] / 2 - side * height * chord[0], 0)
        program.arc(inches(*end, None), inches(*centre), clockwise=up)
        start = end
    return program


def square_spiral(velocity):
    """Down slowly, then around the centre along squares that grow, and back to it."""
    program = Program("square_spiral", velocity)
    program.feed = 5 * INCH / MINUTE
    program.line(inches(None, None, -0.19))
    program.feed = 1000 * INCH / MINUTE
    program.line(inches(0.01, None, None))
    program.line(inches(None, 0.02, None))
    for size in (0.02, 0.03, 0.04, 0.05, 0.06):
        if size > 0.02:
            program.line(inches(size, None, None))
            program.line(inches(None, size, None))
        program.line(inches(-size, None, None))
        program.line(inches(None, -size, None))
    program.line(inches(0, None, None))
    program.line(inches(None, 0, None))
    return program


PROGRAMS = {
    "contour": contour,
    "spiral_lines": spiral_lines,
    "short_segments_0.001": short_segments,
    "random_lines_0.001": random_lines,
    "arc-arc-sawtooth": arc_arc_sawtooth,
    "square_spiral": square_spiral,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name", nargs="?", choices=sorted(PROGRAMS))
    parser.add_argument("--all", metavar="FOLDER", type=pathlib.Path, help="all of them, as NAME.cnc")
    parser.add_argument("--velocity", type=float, default=250, help="the greatest feed [mm/s]")
    parser.add_argument("--rapids", choices=("G0", "G1"), default="G1", help="what rapid moves become")
    options = parser.parse_args()
    if (options.name is None) == (options.all is None):
        parser.error("a name or --all")
    if options.name:
        sys.stdout.write(PROGRAMS[options.name](options.velocity).text(options.rapids))
        return
    options.all.mkdir(parents=True, exist_ok=True)
    for name, make in PROGRAMS.items():
        (options.all / f"{name}.cnc").write_text(make(options.velocity).text(options.rapids))


if __name__ == "__main__":
    main()
