#!/usr/bin/env python3
"""Draws the pictures of docs/cnc-planner.md from what `stride cnc run` drives.

usage: figures.py STRIDE [OUT]

Without OUT it compares them with those that are there, and fails if one is out of date. Writes OUT/limits.svg (velocity over the way, under what limits it), OUT/corner.svg (a corner with three tolerances) and
OUT/override.svg (an override and a feed hold in the example MillingHead).
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

from svg_plot import COLORS, Plot

FEED, ACCELERATION, JERK = 100, 800, 20000

PATH = f"""% two corners
N10 G17
N20 G1 X40 F{FEED} E{ACCELERATION} E-{ACCELERATION}
N30 G3 X43 Y3 J3
N40 G1 Y30
N50 G2 X51 Y38 I8
N60 G1 X90
"""
LENGTHS = (40, 1.5 * math.pi, 27, 4 * math.pi, 39)
CORNER = """% a corner
N10 G1 X20 F100 E800 E-800
N20 Y20
"""


def run(stride, folder, text, *options):
    """The rows of a table of set positions."""
    program = folder / "p.cnc"
    program.write_text(text, encoding="utf-8")
    table = folder / "p.csv"
    subprocess.run([stride, "cnc", "run", program, "-o", table, *options], check=True, stdout=subprocess.DEVNULL)
    with table.open(encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def draw_limits(stride, folder, out):
    """Over the way: what each strip permits, and the velocity with and without a limit of the jerk."""
    limits = (f"--max-acceleration=X={ACCELERATION},Y={ACCELERATION}",)
    jerk = run(stride, folder, PATH, *limits, "--velocity-mode", "quadratic", "--jerk", str(JERK))
    free = run(stride, folder, PATH, *limits)
    ceilings, way = [], 0.0
    for length, radius in zip(LENGTHS, (None, 3, None, 8, None)):
        velocity = FEED if radius is None else min(FEED, math.sqrt(ACCELERATION * radius))
        ceilings += [(way, velocity), (way + length, velocity)]
        way += length
    plot = Plot((960, 330), (0, way, range(0, 121, 20)), (0, 112, range(0, 101, 25)), ("Way [mm]", "Velocity [mm/s]"))
    plot.line(ceilings, COLORS[3], "limits of the strips", 1.5, "5 3")
    plot.line([(row["way"], row["velocity"]) for row in free], COLORS[1], "trapezoid")
    plot.line([(row["way"], row["velocity"]) for row in jerk], COLORS[0], "quadratic: with limited jerk")
    plot.write(out / "limits.svg")


def draw_corner(stride, folder, out):
    """The same corner with three tolerances."""
    plot = Plot((560, 430), (15, 21, range(15, 22)), (-0.5, 4.5, range(5)), ("X [mm]", "Y [mm]"))
    plot.line([(15, 0), (20, 0), (20, 4.5)], COLORS[3], "programmed", 1.5, "5 3")
    for tolerance, color in (("0.2", COLORS[0]), ("0.5", COLORS[2]), ("1", COLORS[1])):
        rows = run(stride, folder, CORNER, "--blend", tolerance, "--velocity-mode", "quadratic", "--jerk", str(JERK),
                   f"--max-acceleration=X={ACCELERATION},Y={ACCELERATION}", "--cycle", "500us")
        shown = [(row["X"], row["Y"]) for row in rows if row["X"] >= 15 and row["Y"] <= 4.5]
        least = min(row["velocity"] for row in rows if 16 < row["X"] + row["Y"] < 24)
        plot.line(shown, color, f"{tolerance} mm: {least:.0f} mm/s")
    plot.write(out / "corner.svg")


def draw_override(stride, folder, out):
    """The operator of the example changes the override and holds the feed."""
    example = pathlib.Path(__file__).resolve().parents[2] / "examples" / "MillingHead"
    trace = folder / "mill.csv"
    names = ("Ipo.Interpolator.dVel", "g_rOverride", "g_bHold")
    subprocess.run([stride, "sim", example, "--for", "11s", "--script", example / "operator.script", "--trace",
                    ",".join(names), "--out", trace], check=True)
    subprocess.run([stride, "plot", trace, "--project", example, "--from", "3500ms", "--panel", "Velocity [mm/s]=" + names[0],
                    "--panel", "Override=" + names[1], "--panel", names[2], "-o", out / "override.svg"],
                   check=True, stdout=subprocess.DEVNULL)


def main():
    stride, here = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(__file__).resolve().parent
    with tempfile.TemporaryDirectory() as name:
        out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else name)
        draw_limits(stride, pathlib.Path(name), out)
        draw_corner(stride, pathlib.Path(name), out)
        draw_override(stride, pathlib.Path(name), out)
        if len(sys.argv) == 2:
            old = [new.name for new in sorted(out.glob("*.svg")) if new.read_bytes() != (here / new.name).read_bytes()]
            if old:
                sys.exit(f"out of date: {', '.join(old)}; draw them anew with docs/planner/figures.py STRIDE docs/planner")


if __name__ == "__main__":
    main()
