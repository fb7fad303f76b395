#!/usr/bin/env python3
"""Draws the pictures of docs/cnc-tool.md and docs/cnc-processors.md from paths that the blocks drive.

usage: figures.py STRIDE [OUT]

Without OUT it says which of the pictures beside it are no longer what it would draw. It writes OUT/tool.svg (a contour and the tool's centre on both sides of it), OUT/loops.svg (a slot that is narrower than the tool, with its
loops and without), OUT/corner.svg (what SMC_RoundPath and SMC_SmoothPath put into a corner), and of the example LaserCut OUT/part.svg and
OUT/slit.svg (what the beam burns).
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "planner"))
from svg_plot import COLORS, Plot  # noqa: E402

# The contours; sentences from N100 on are drawn.
CONTOURS = {
    "Contour": """N10 G0 X0 Y0
N20 {on}
N100 G1 X40
N110 Y25
N120 X70
N130 X85 Y0
N140 G2 X115 I15
N150 G1 X135
N20 {off}
N30 G0 X0 Y-30
""",
    "Slot": """N10 G0 X0 Y0
N20 {on}
N100 G1 X30
N110 Y-18
N120 X37
N130 Y0
N140 X67
N20 {off}
N30 G0 X0 Y-30
""",
    "Corner": """N10 G0 X0 Y0
N20 {on}
N100 G1 X20
N110 Y20
N20 {off}
N30 G0 X0 Y-30
""",
}

# Each path: its program, the words around the contour, the processors.
PATHS = {
    "contour": ("Contour", "", "", ()),
    "left": ("Contour", "G41 D5", "G40", ("Tool",)),
    "right": ("Contour", "G42 D5", "G40", ("Tool",)),
    "slot": ("Slot", "", "", ()),
    "loops": ("Slot", "G41 D5", "G40", ("Tool",)),
    "clean": ("Slot", "G41 D5\nN21 G61", "G60\nN21 G40", ("Tool", "Loops")),
    "corner": ("Corner", "", "", ()),
    "arc": ("Corner", "G52 D10", "G50", ("Round",)),
    "cubic": ("Corner", "G51 D10", "G50", ("Smooth3",)),
    "quintic": ("Corner", "G51 D10", "G50", ("Smooth5",)),
}
BLOCKS = {
    "Tool": ("SMC_ToolCorr", ""),
    "Loops": ("SMC_AvoidLoop", ""),
    "Round": ("SMC_RoundPath", ""),
    "Smooth3": ("SMC_SmoothPath", ", eMode := SP_SPLINE3"),
    "Smooth5": ("SMC_SmoothPath", ", eMode := SP_SPLINE5_MIN_CURVATURE"),
}
MEMORY = "bExecute := TRUE, {inputs}, nSizeOutQueue := SIZEOF({buffer}), pbyBufferOutQueue := ADR({buffer})"
TOML = """[[task]]
name = "Task"
interval = "T#2ms"
programs = [{programs}]
"""


def program(name, contour, blocks):
    """A program that drives a contour through its blocks."""
    declared, calls, queue = [], [], "Decoder.poqDataOut"
    declared.append("Decoder : SMC_NCDecoder; Decoded : ARRAY[0..99] OF SMC_GEOINFO;")
    calls.append("Decoder(" + MEMORY.format(inputs=f"ncprog := {contour}", buffer="Decoded") + ");")
    for block in blocks:
        kind, more = BLOCKS[block]
        declared.append(f"{block} : {kind}; {block}Queue : ARRAY[0..99] OF SMC_GEOINFO;")
        calls.append(f"{block}(" + MEMORY.format(inputs=f"poqDataIn := {queue}", buffer=block + "Queue") + more + ");")
        queue = block + ".poqDataOut"
    declared.append("Check : SMC_CheckVelocities; Ipo : SMC_Interpolator;")
    calls.append(f"Check(bExecute := TRUE, poqDataIn := {queue}, dAngleTol := 1);")
    calls.append("Ipo(bExecute := TRUE, poqDataIn := Check.poqDataOut, dwIpoTime := 2000);")
    return "\n".join([f"PROGRAM {name}", "VAR", *declared, "END_VAR", *calls, "END_PROGRAM", ""])


def drive(stride, folder):
    """All paths, as lists of places."""
    text = []
    for name, (contour, on, off, blocks) in PATHS.items():
        nc = CONTOURS[contour].format(on=on or "G40", off=off or "G40")
        (folder / f"{name}_nc.cnc").write_text(f"% {name}\nN1 F100 E5000 E-5000\n{nc}", encoding="utf-8")
        text.append(program(name, f"{name}_nc", blocks))
    (folder / "Main.st").write_text("\n".join(text), encoding="utf-8")
    (folder / "stride.toml").write_text(TOML.format(programs=", ".join(f'"{name}"' for name in PATHS)), encoding="utf-8")
    table = folder / "paths.csv"
    columns = [f"{name}.Ipo.{pin}" for name in PATHS for pin in ("piSetPosition.dX", "piSetPosition.dY", "iActObjectSourceNo")]
    subprocess.run([stride, "sim", folder, "--for", "6s", "--trace", ",".join(columns), "--out", table, "-W", "off=lints"], check=True)
    with table.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [(float(row[f"{name}.Ipo.piSetPosition.dX"]), float(row[f"{name}.Ipo.piSetPosition.dY"])) for row in rows
                   if int(row[f"{name}.Ipo.iActObjectSourceNo"]) >= 100] for name in PATHS}


def draw_tool(paths, out):
    plot = Plot((900, 350), (-5, 140, range(0, 141, 20)), (-12, 36, range(-10, 31, 10)), ("X [mm]", "Y [mm]"))
    plot.line(paths["contour"], COLORS[3], "contour", 2.5)
    plot.line(paths["left"], COLORS[0], "G41 D5: to the left")
    plot.line(paths["right"], COLORS[1], "G42 D5: to the right")
    plot.write(out / "tool.svg")


def draw_loops(paths, out):
    plot = Plot((900, 390), (-3, 70, range(0, 71, 10)), (-20, 7.6, range(-20, 6, 5)), ("X [mm]", "Y [mm]"))
    plot.line(paths["slot"], COLORS[3], "contour", 2.5)
    plot.line(paths["loops"], COLORS[1], "G41 D5: SMC_ToolCorr", 1.5, "6 3")
    plot.line(paths["clean"], COLORS[0], "and SMC_AvoidLoop", 2.5)
    plot.write(out / "loops.svg")


def draw_corner(paths, out):
    plot = Plot((560, 560), (6, 21, range(6, 22, 2)), (-1, 14, range(0, 15, 2)), ("X [mm]", "Y [mm]"))
    for name, text, style in (("corner", "program", (COLORS[3], 1.5, "5 3")), ("arc", "arc", ("#a7d8c8", 6)),
                              ("cubic", "cubic", (COLORS[1], 2)), ("quintic", "degree 5", (COLORS[0], 2))):
        color, *more = style
        plot.line([(x, y) for x, y in paths[name] if x >= 6 and y <= 14], color, text, *more)
    plot.write(out / "corner.svg")


def drive_laser(stride, folder):
    """The example LaserCut: the places of the path with kerf correction where the beam is on, contour by contour, and those without it."""
    example = pathlib.Path(__file__).resolve().parents[2] / "examples" / "LaserCut"
    table = folder / "laser.csv"
    place = [f"Ipo.Interpolator.piSetPosition.{axis}" for axis in ("dX", "dY")]
    subprocess.run([stride, "sim", example, "--for", "27s", "--script", example / "operator.script", "--trace",
                    ",".join([*place, "Ipo.Interpolator.dwSwitches", "g_bKerf"]), "--out", table], check=True)
    runs = {"1": [[]], "0": [[]]}
    with table.open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            contours = runs[row["g_bKerf"]]
            if row["Ipo.Interpolator.dwSwitches"] != "0":
                contours[-1].append((float(row[place[0]]), float(row[place[1]])))
            elif contours[-1]:
                contours.append([])
    return [[contour for contour in run if contour] for run in runs.values()]


def draw_laser(runs, out):
    for name, size, x, y in (("part", (900, 572), (-6, 104, range(0, 101, 10)), (-3, 63, range(0, 61, 10))),
                             ("slit", (560, 560), (40.5, 49.5, range(41, 50)), (51.6, 60.8, range(52, 61)))):
        plot = Plot(size, x, y, ("X [mm]", "Y [mm]"))
        kerf = 0.3 * (plot.frame[2] - plot.frame[0]) / (x[1] - x[0])
        for run, texts, color, width in ((runs[0], ("burned by the beam",), "#f2b48a", kerf), (runs[1], ("contour",), COLORS[0], 1.2)):
            for contour, text in zip(reversed(run), (*texts, "", "", "")):
                shown = [place for place in contour if x[0] <= place[0] <= x[1] and y[0] <= place[1] <= y[1]]
                if shown:
                    plot.line([*shown[::3], shown[-1]], color, text, round(width, 1))
        plot.write(out / f"{name}.svg")


def main():
    stride, here = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(__file__).resolve().parent
    with tempfile.TemporaryDirectory() as name:
        out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else name)
        paths = drive(stride, pathlib.Path(name))
        for draw in (draw_tool, draw_loops, draw_corner):
            draw(paths, out)
        draw_laser(drive_laser(stride, pathlib.Path(name)), out)
        if len(sys.argv) == 2:
            old = [new.name for new in sorted(out.glob("*.svg")) if new.read_bytes() != (here / new.name).read_bytes()]
            if old:
                sys.exit(f"out of date: {', '.join(old)}; draw them anew with docs/processors/figures.py STRIDE docs/processors")


if __name__ == "__main__":
    main()
