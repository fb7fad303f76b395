#!/usr/bin/env python3
"""Writes the timing tables in tables/: scenarios from scenarios.py, expected outputs from models.py.

usage: generate.py [--check]     --check: says which tables differ from what would be written, and fails
"""
import math
import pathlib
import struct
import sys

import scenarios

FOLDER = pathlib.Path(__file__).parent / "tables"


def real_text(x):
    """The shortest decimal number that is this REAL."""
    if isinstance(x, float) and not math.isfinite(x):
        return {math.inf: "inf", -math.inf: "-inf"}.get(x, "nan")
    single = struct.unpack("<f", struct.pack("<f", float(x)))[0]
    for digits in range(1, 10):
        text = f"{single:.{digits}g}"
        if abs(float(text)) <= 3.4028235e38 and struct.unpack("<f", struct.pack("<f", float(text)))[0] == single:
            return text
    raise AssertionError(x)


def cell(kind, value):
    if kind == "BOOL":
        return "#" if value else "."
    if kind == "REAL":
        return real_text(value)
    if kind.startswith("STRING"):
        return "'" + "".join(c if " " < c < "\x7f" and c not in "'$" else f"${ord(c):02X}" for c in value) + "'"
    return str(int(value))


def table(block):
    lines = [f"# {line}" for line in block.about]
    lines += [f"call {block.call}"]
    lines += [f"local {name} : {kind}" for name, kind in block.local]
    lines += ["inputs  " + " ".join(f"{n}:{k}" for n, k in block.inputs)]
    lines += ["outputs " + " ".join(f"{n}:{k}" for n, k in block.outputs)]
    lines += [f"tolerance {name} {relative:g} {absolute:g}" for name, (relative, absolute) in block.tolerance.items()]
    for title, rows in block.scenarios:
        model = block.model()
        cells = [["t/ms"] + [n for n, _ in block.inputs] + ["|"] + [n for n, _ in block.outputs]]
        for t, values in rows:
            out = model.step(t, values)
            cells.append([str(t) if t == int(t) else f"{float(t):.6f}".rstrip("0")] + [cell(k, values[n]) for n, k in block.inputs] + ["|"] +
                         [cell(k, out[n]) for n, k in block.outputs])
        widths = [max(map(len, column)) for column in zip(*cells)]
        lines += ["", f"== {title}"]
        lines += [" ".join(c.rjust(w) for c, w in zip(row, widths)).rstrip() for row in cells]
    return "\n".join(lines) + "\n"


def main():
    check = "--check" in sys.argv[1:]
    differing = []
    names = set()
    for block in scenarios.blocks():
        path = FOLDER / f"{block.name}.txt"
        names.add(path.name)
        text = table(block)
        if not path.exists() or path.read_text() != text:
            differing.append(path.name)
            if not check:
                path.write_text(text)
    differing += [path.name for path in FOLDER.glob("*.txt") if path.name not in names]
    print(("differ: " if check else "written: ") + (", ".join(differing) or "none"))
    return 1 if check and differing else 0


if __name__ == "__main__":
    sys.exit(main())
