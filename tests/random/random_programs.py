#!/usr/bin/env python3
"""Random well-typed programs whose values are computed here as well.

usage: random_programs.py STRIDE [--seeds FIRST..LAST] [--modes MODE,…] [--keep FOLDER]

A seed is a project: types, variables (also at overlapping addresses), interfaces, functions, function blocks and 100
programs (sections of five blocks, each with variables of its own). `stride sim` runs it in each MODE (O2, O0,
O2-unchecked, O0-unchecked; without --modes in all of them); every variable must have the value that the model in this
folder gives it; `--modes two` gives each seed two of them that differ in everything. Every fifth seed is a smaller project that ends with a run-time error, whose message and place are
known: it runs in the checked modes. With --small a seed has twelve programs and one function and block, besides those of
movers.py, for many seeds in little time. A project that disagrees is left in FOLDER (default: the temporary folder) and named.
"""
import random
import subprocess
import sys

from model import agrees
from programs import Generator
from seeds import try_seeds

MODES = {"O2": [], "O0": ["--debug"], "O2-unchecked": ["--unchecked"], "O0-unchecked": ["--debug", "--unchecked"]}
GROUPS, COUNT, POUS = 5, 20, 8


def check(options, seed):
    """How many programs agree in all modes, or None"""
    generator = Generator(random.Random(seed))
    groups, count, pous = (1, 12, 2) if options.small else (GROUPS, COUNT, POUS)
    error, programs = None, groups * count
    if seed % 5 == 0:
        programs = 3
        text, expected, message, (line, column) = generator.failing(programs - 1)
        error = f"error: {message} at random{seed}.st:{line}:{column} "
    else:
        text, expected = generator.program(groups, count, pous)
    source = options.keep / f"random{seed}.st"
    source.write_text("\n".join(text), encoding="utf-8")
    names = ["PLC_PRG", *(path for path, _, _ in expected if not path.startswith("PLC_PRG"))]
    modes = options.modes or list(MODES)
    if modes == ["two"]:
        modes = ["O2", "O0-unchecked"] if seed % 2 else ["O0", "O2-unchecked"]
    if error:
        modes = [mode for mode in modes if "unchecked" not in mode] or ["O2"]
    good = [run(options.stride, source, names, expected, mode, error) for mode in modes]
    if not all(good):
        return None
    source.unlink()
    return programs


def run(stride, source, names, expected, mode, error):
    result = subprocess.run([stride, "sim", source.name, "--for", "T#10ms", "--print", ",".join(names), "-W", "off=lints", *MODES[mode]],
                            capture_output=True, text=True, check=False, cwd=source.parent)
    found = dict(line.split(" = ", 1) for line in result.stdout.splitlines() if " = " in line)
    wrong = [(path, value) for path, kind, value in expected
             if path not in found or not agrees(kind, value, found[path])]
    if (error in result.stderr and result.returncode != 0 if error else result.returncode == 0) and not wrong:
        return True
    print(f"{source} ({mode}): exit code {result.returncode}, {len(wrong)} of {len(expected)} values differ")
    for path, value in wrong[:5]:
        print(f"  {path}: expected {value}, found {found.get(path)}")
    if error:
        print(f"  expected {error}")
    errors = result.stderr.split("\n\n")
    print("\n\n".join(e for e in errors if not e.startswith(("warning", "note")))[:1500])
    return False


def add_options(parser):
    parser.add_argument("--modes", type=lambda text: text.split(","))
    parser.add_argument("--small", action="store_true")


if __name__ == "__main__":
    sys.exit(try_seeds(check, "1..4", "programs", add_options))
