#!/usr/bin/env python3
"""Simulates and draws the diagrams of the library's reference.

usage: figures.py STRIDE OUT [BLOCK...]

Writes OUT/LIBRARY/BLOCK.svg and .txt (the caption) for each diagrams/LIBRARY/BLOCK.st, or for the named blocks. README.md
says how such a file looks. Fails when a simulation fails or prints something, and, without names, when a function block of the
libraries below has neither a diagram nor a line in diagrams/without.txt.
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DIAGRAMS = HERE / "diagrams"
STDLIB = HERE.parent.parent / "stdlib"
LIBRARIES = ("SM_DriveBasic", "SM_PLCopen", "SM3_CamBuilder")


def public_blocks(library):
    """Names of the function blocks of a library that others may use."""
    blocks = set()
    for file in (STDLIB / library).glob("*.st"):
        text = file.read_text(encoding="utf-8")
        for match in re.finditer(r"^FUNCTION_BLOCK\s+(?:(?:ABSTRACT|FINAL|PUBLIC|INTERNAL)\s+)*(\w+)", text, re.MULTILINE):
            head = text[: match.start()].rsplit("END_FUNCTION_BLOCK", 1)[-1]
            if "{attribute 'hide'}" not in head:
                blocks.add(match.group(1))
    return blocks


def coverage():
    """What is missing or too much."""
    errors = []
    without = {}
    for number, line in enumerate((DIAGRAMS / "without.txt").read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        name, colon, reason = line.partition(":")
        if not colon or not reason.strip():
            errors.append(f"without.txt:{number}: expected BLOCK: REASON")
        without[name.strip()] = number
    known = set()
    for library in LIBRARIES:
        blocks = public_blocks(library)
        known |= blocks
        declared = {p.stem for p in (STDLIB / library).glob("*.st")}
        drawn = {p.stem for p in (DIAGRAMS / library).glob("*.st")}
        errors += [f"{library}/{b}: has no diagram and is not in without.txt" for b in sorted(blocks - drawn - without.keys())]
        errors += [f"{library}/{b}.st: the library has no such block or type" for b in sorted(drawn - declared)]
        errors += [f"without.txt:{without[b]}: {b} has a diagram" for b in sorted(drawn & without.keys())]
    errors += [f"without.txt:{n}: there is no function block {b}" for b, n in without.items() if b not in known]
    return errors


def header(file):
    """The values of the keys at the top of a diagram's program."""
    values, key = {}, None
    for line in file.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//"):
            break
        if match := re.match(r"// (CAPTION|FOR|TRACE): (.*)", line):
            key = match.group(1)
            values[key] = match.group(2).strip()
        elif key and line.startswith("//   "):
            values[key] += ("" if key == "TRACE" else " ") + line[2:].strip()
        else:
            key = None
    return values


def draw(stride, file, out):
    """Simulates and draws one diagram; what went wrong, or nothing."""
    name = f"{file.parent.name}/{file.name}"
    values = header(file)
    missing = [key for key in ("CAPTION", "FOR", "TRACE") if key not in values]
    if missing:
        return f"{name}: no {', '.join(missing)} at the top"
    svg = out / file.parent.name / f"{file.stem}.svg"
    svg.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        project = pathlib.Path(folder)
        shutil.copy(DIAGRAMS / "stride.toml", project)
        shutil.copy(file, project / "Main.st")
        trace = project / f"{file.stem}.csv"
        for command in (
            [stride, "sim", folder, "--color", "never", "-W", "off=lints", "--for", values["FOR"], "--trace", values["TRACE"],
             "--out", str(trace)],
            [stride, "plot", str(trace), "-o", str(svg)],
        ):
            result = subprocess.run(command, capture_output=True, text=True, check=False)
            printed = (result.stdout + result.stderr).strip()
            if result.returncode or printed:
                return f"{name}: " + ("\n".join(printed.splitlines()[:8]) or f"exit code {result.returncode}")
    svg.with_suffix(".txt").write_text(values["CAPTION"], encoding="utf-8")
    return None


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    stride, out, wanted = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]), set(sys.argv[3:])
    files = [f for f in sorted(DIAGRAMS.glob("*/*.st")) if not wanted or f.stem in wanted]
    errors = [f"there is no diagram {name}" for name in sorted(wanted - {f.stem for f in files})]
    if not wanted:
        errors += coverage()
        shutil.rmtree(out, ignore_errors=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        errors += [e for e in pool.map(lambda f: draw(stride, f, out), files) if e]
    for error in errors:
        print(error, file=sys.stderr)
    print(f"{len(files)} diagrams")
    sys.exit(1 if errors else 0)


main()
