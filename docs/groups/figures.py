#!/usr/bin/env python3
"""Draws moving pictures of machines that are moved as groups, from what their examples drive in simulation.

usage: figures.py STRIDE [OUT]

Without OUT it says which of the pictures beside the examples are no longer what it would draw. OUT/belt-scara.svg: the example BeltScara,
seen from above.
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
FRAME = 0.08  # time between two pictures [s]


def simulate(stride, example, duration, columns):
    """A list of rows, each a dictionary of numbers: one every FRAME."""
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder) / "trace.csv"
        subprocess.run(
            [stride, "sim", EXAMPLES / example, "--for", duration, "--trace", ",".join(columns), "--out", trace],
            check=True, stdout=subprocess.DEVNULL)
        rows, due = [], 0.0
        for row in csv.DictReader(trace.open()):
            time = float(next(iter(row.values())))
            if time + 1e-9 < due:
                continue
            due += FRAME
            rows.append({name: float(row[name]) for name in columns})
        return rows


def number(value):
    text = f"{value:.1f}"
    return text[:-2] if text.endswith(".0") else text


def animate(kind, values, seconds):
    """Values of a transformation, one for each picture; one that never changes is none."""
    texts = [" ".join(number(value) for value in each) for each in values]
    return (f'<animateTransform attributeName="transform" type="{kind}" dur="{number(seconds)}s" '
            f'repeatCount="indefinite" values="{";".join(texts)}"/>')


class BeltScara:
    """The arm, and the parts on the belt, in the gripper and in the tray."""
    ARM1, ARM2 = 320, 260
    # As World.st has them.
    GAPS = [390, 265, 310, 445, 280, 350, 240]
    SIDES = [10, -35, 25, 0, 40]
    TURNS = [15, -40, 70, -5]
    COLUMNS = ["Shoulder.fSetPosition", "Elbow.fSetPosition", "Turn.fSetPosition", "Machine.Way", "Machine.Grip",
               "Machine.Status.InSync"]

    def __init__(self, stride):
        self.rows = simulate(stride, "BeltScara", "T#20s", self.COLUMNS)
        self.parts = self.followed()

    def tool(self, row):
        a = math.radians(row["Shoulder.fSetPosition"])
        b = a + math.radians(row["Elbow.fSetPosition"])
        return (self.ARM1 * math.cos(a) + self.ARM2 * math.cos(b), self.ARM1 * math.sin(a) + self.ARM2 * math.sin(b),
                row["Shoulder.fSetPosition"] + row["Elbow.fSetPosition"] + row["Turn.fSetPosition"])

    def starts(self):
        """Ways of the belt at which parts are at its origin."""
        way, ways = 100, []
        while way < self.rows[-1]["Machine.Way"] + 300:
            ways.append(way)
            way += self.GAPS[(len(ways) - 1) % len(self.GAPS)]
        return ways

    def followed(self):
        """For each part its places (x, y, angle) in each picture."""
        starts = self.starts()
        placed, held, before = {}, None, False
        tracks = [[] for _ in starts]
        for row in self.rows:
            places = [(350 - self.SIDES[i % 5], -320 + row["Machine.Way"] - start, 90 + self.TURNS[i % 4])
                      for i, start in enumerate(starts)]
            tool = self.tool(row)
            grips = row["Machine.Grip"] > 0
            if grips and not before:
                free = [i for i in range(len(starts)) if i not in placed]
                held = min(free, key=lambda i: math.dist(places[i][:2], tool[:2]))
                apart = (places[held][0] - tool[0], places[held][1] - tool[1], places[held][2] - tool[2])
                placed[held] = None
            if held is not None:
                placed[held] = (tool[0] + apart[0], tool[1] + apart[1], tool[2] + apart[2])
            if not grips:
                held = None
            before = grips
            for i, track in enumerate(tracks):
                x, y, angle = placed.get(i) or places[i]
                track.append((x, min(max(y, -420), 620), angle))
        return tracks

    def svg(self):
        seconds = FRAME * len(self.rows)
        shapes = []
        for track in self.parts:
            shapes.append('<g>' + animate("translate", [(x, y) for x, y, _ in track], seconds) +
                          '<g>' + animate("rotate", [(angle,) for *_, angle in track], seconds) +
                          '<rect x="-22" y="-13" width="44" height="26" rx="3" fill="#e69f00"/></g></g>')
        shoulder = animate("rotate", [(row["Shoulder.fSetPosition"],) for row in self.rows], seconds)
        elbow = animate("rotate", [(row["Elbow.fSetPosition"],) for row in self.rows], seconds)
        turn = animate("rotate", [(row["Turn.fSetPosition"],) for row in self.rows], seconds)
        jaws = '<path d="M-16-20h32M-16 20h32" stroke="#333" stroke-width="6"/>'
        arm = (f'<g stroke-linecap="round" opacity="0.85"><g>{shoulder}<path d="M0 0h{self.ARM1}" stroke="#0072b2" stroke-width="46"/>'
               f'<g transform="translate({self.ARM1} 0)"><g>{elbow}<path d="M0 0h{self.ARM2}" stroke="#56b4e9" stroke-width="34"/>'
               f'<g transform="translate({self.ARM2} 0)"><g>{turn}{jaws}</g></g></g></g></g></g>')
        return "\n".join([
            '<svg xmlns="http://www.w3.org/2000/svg" width="640" height="720" viewBox="-190 -500 640 850">',
            '<title>A Scara takes parts off a moving belt and puts them into a tray, seen from above</title>',
            '<rect x="-190" y="-500" width="640" height="850" fill="#fff"/>',
            '<g transform="scale(1 -1)" fill="none">',  # Y goes up
            '<rect x="290" y="-360" width="120" height="860" fill="#ddd"/>',
            '<rect x="-95" y="300" width="170" height="160" stroke="#888" stroke-width="3" fill="#f5f5f5"/>',
            *shapes,
            '<circle r="40" fill="#999"/>',
            arm,
            '</g>',
            '</svg>',
            ''])


PICTURES = {"belt-scara.svg": (BeltScara, "BeltScara/machine.svg")}


def main():
    stride = sys.argv[1]
    out = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    stale = []
    for name, (machine, place) in PICTURES.items():
        text = machine(stride).svg()
        if out:
            (out / name).write_text(text)
        elif not (EXAMPLES / place).exists() or (EXAMPLES / place).read_text() != text:
            stale.append(place)
    for place in stale:
        print(f"examples/{place} is not what docs/groups/figures.py draws")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
