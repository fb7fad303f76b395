#!/usr/bin/env python3
"""from_linuxcnc.py FILE [--velocity V] [--rapids G0|G1] [--name NAME]: a program of LinuxCNC in Stride's G-code.

Moves (G0 to G3) in inches or millimetres, absolute or relative, arcs by centre or radius, parameters and expressions.
The result is in millimetres and seconds; spindle, tool, coolant, stops and path modes (G61, G64) are left out. What would
change the path and is not known (canned cycles, tool length, O words) is an error.

Debian's package linuxcnc-uspace has 3D_Chips.ngc, tort.ngc and arcspiral.ngc in /usr/share/linuxcnc/ncfiles
(`apt-get download linuxcnc-uspace`, `dpkg -x` unpacks it without installing it). The tort.ngc that LinuxCNC's planner is
tested with is the same but for feeds that no machine reaches: --full-feed.
"""

import argparse
import math
import pathlib
import re
import sys

from gcode import AXES, CENTRE, Program

# What does not change the path, in tenths: no compensation, no tool length, the first coordinate system, path modes,
# the end of canned cycles, feed per minute.
IGNORED_G = {400, 490, 540, 610, 640, 800, 940}
ENDS = {2, 30}
FUNCTIONS = {"sqrt": math.sqrt, "abs": abs, "round": round, "fix": math.floor, "fup": math.ceil,
             "sin": lambda x: math.sin(math.radians(x)), "cos": lambda x: math.cos(math.radians(x)),
             "tan": lambda x: math.tan(math.radians(x))}
OPERATORS = [{"+": lambda a, b: a + b, "-": lambda a, b: a - b},
             {"*": lambda a, b: a * b, "/": lambda a, b: a / b},
             {"**": lambda a, b: a ** b}]
TOKEN = re.compile(r"\*\*|[-+*/\[\]=]|#<[^>]*>|#|[a-z]+|\d+\.?\d*|\.\d+")


class ProgramError(Exception):
    pass


class Reader:
    """The words of a line, with the parameters' values."""

    def __init__(self, line, parameters):
        text = re.sub(r"\([^)]*\)|;.*", "", line).lower()
        text = re.sub(r"#<([^>]*)>", lambda name: "#<" + re.sub(r"\s", "", name[1]) + ">", text)
        bare = re.sub(r"\s", "", text)
        self.tokens = TOKEN.findall(bare)
        if "".join(self.tokens) != bare:
            raise ProgramError(f"cannot be read: {line.strip()}")
        self.at = 0
        self.parameters = parameters

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self):
        token = self.peek()
        self.at += 1
        return token

    def value(self):
        token = self.take()
        if token == "[":
            value = self.expression(0)
            if self.take() != "]":
                raise ProgramError("a bracket is not closed")
            return value
        if token in ("-", "+"):
            return -self.value() if token == "-" else self.value()
        if token.startswith("#"):
            name = token if len(token) > 1 else "#" + str(int(self.value()))
            if name not in self.parameters:
                raise ProgramError(f"{name} has no value")
            return self.parameters[name]
        if token in FUNCTIONS:
            return FUNCTIONS[token](self.value())
        try:
            return float(token)
        except ValueError:
            raise ProgramError(f"no number: {token!r}") from None

    def expression(self, level):
        if level == len(OPERATORS):
            return self.value()
        value = self.expression(level + 1)
        while self.peek() in OPERATORS[level]:
            value = OPERATORS[level][self.take()](value, self.expression(level + 1))
        return value

    def words(self):
        """(letter, value) of all words; parameters get theirs at the end of the line."""
        words, settings = [], {}
        while self.peek():
            token = self.take()
            if token.startswith("#"):
                name = token if len(token) > 1 else "#" + str(int(self.value()))
                if self.take() != "=":
                    raise ProgramError(f"{name} is not set")
                settings[name] = self.value()
            elif len(token) == 1 and token.isalpha():
                words.append((token.upper(), self.value()))
            else:
                raise ProgramError(f"no word: {token!r}")
        self.parameters.update(settings)
        return words


class Converter:
    def __init__(self, name, velocity, unit, full_feed):
        self.program = Program(name, velocity)
        self.full_feed = full_feed
        self.program.feed = self.rapid = velocity
        self.unit = unit  # [mm]
        self.absolute, self.absolute_centre = True, False
        self.plane = "XY"
        self.motion = None
        self.parameters = {}
        self.ended = False

    def line(self, text):
        if self.ended or text.strip() in ("", "%"):
            return
        coordinates, others = {}, {}
        for letter, value in Reader(text.lstrip("/"), self.parameters).words():
            if letter == "G":
                self.code(round(10 * value))
            elif letter == "M":
                self.ended = self.ended or int(value) in ENDS
            elif letter in AXES:
                coordinates[letter] = value * self.unit
            elif letter in "IJKR":
                others[letter] = value * self.unit
            elif letter == "F" and not self.full_feed:
                self.program.feed = value * self.unit / 60
            elif letter in "ABCUVWOLEH":
                raise ProgramError(f"the word {letter} is not known")
        if coordinates or (others and self.motion in (2, 3)):
            self.move(coordinates, others)

    def code(self, tenths):
        planes = {170: "XY", 180: "ZX", 190: "YZ"}
        if tenths in (0, 10, 20, 30):
            self.motion = tenths // 10
        elif tenths in planes:
            self.plane = planes[tenths]
        elif tenths in (200, 210):
            self.unit = 25.4 if tenths == 200 else 1.0
        elif tenths in (900, 910):
            self.absolute = tenths == 900
        elif tenths in (901, 911):
            self.absolute_centre = tenths == 901
        elif tenths not in IGNORED_G:
            raise ProgramError(f"G{tenths / 10:g} is not known")

    def move(self, coordinates, others):
        start = self.program.place
        end = list(start)
        for letter, value in coordinates.items():
            axis = AXES.index(letter)
            end[axis] = value if self.absolute else start[axis] + value
        if self.motion is None:
            raise ProgramError("no G0, G1, G2 or G3 before the first coordinate")
        if self.motion in (0, 1):
            if self.motion == 0:
                self.program.line(end, rapid=True, feed=self.rapid)
            else:
                self.program.line(end)
            return
        first, second = (AXES.index(axis) for axis in self.plane)
        clockwise = self.motion == 2
        if "R" in others:
            centre = self.centre_by_radius(start, end, others["R"], clockwise, first, second)
        else:
            centre = [others.get(letter, 0.0) for letter in CENTRE]
            if self.absolute_centre:
                centre = [there - here for here, there in zip(start, centre)]
        self.program.arc(end, centre, clockwise, self.plane)

    @staticmethod
    def centre_by_radius(start, end, radius, clockwise, first, second):
        chord = (end[first] - start[first], end[second] - start[second])
        half = math.hypot(*chord) / 2
        if half == 0 or half > abs(radius) * 1.001:
            raise ProgramError(f"the radius {radius:g} does not reach the end")
        height = math.sqrt(max(0.0, radius * radius - half * half)) / (2 * half)
        side = height if clockwise == (radius > 0) else -height
        centre = [0.0, 0.0, 0.0]
        centre[first] = chord[0] / 2 + side * chord[1]
        centre[second] = chord[1] / 2 - side * chord[0]
        return centre


def convert(text, name, velocity, unit=1.0, full_feed=False):
    """The program, or a ProgramError that says the line."""
    converter = Converter(name, velocity, unit, full_feed)
    for row, line in enumerate(text.splitlines(), 1):
        try:
            converter.line(line)
        except (ProgramError, ZeroDivisionError) as error:
            raise ProgramError(f"line {row}: {error}") from None
    return converter.program


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--velocity", type=float, default=250, help="the greatest feed [mm/s]")
    parser.add_argument("--rapids", choices=("G0", "G1"), default="G1", help="what rapid moves become")
    parser.add_argument("--name", help="of the program")
    parser.add_argument("--full-feed", action="store_true", help="feeds of the program do not count: all moves at V")
    parser.add_argument("--inches", action="store_true", help="of programs that do not say it: as LinuxCNC, by the machine")
    options = parser.parse_args()
    try:
        program = convert(options.file.read_text(errors="replace"), options.name or options.file.stem, options.velocity,
                          25.4 if options.inches else 1.0, options.full_feed)
    except ProgramError as error:
        sys.exit(f"{options.file}: {error}")
    sys.stdout.write(program.text(options.rapids))


if __name__ == "__main__":
    main()
