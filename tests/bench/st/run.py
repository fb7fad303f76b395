#!/usr/bin/env python3
"""run.py BUILD [--verify] [--runs N] [--only REGEX] [--instructions]: ST against hand-written C++.

Each programs/NAME.st is built by `stride build` with and without checks, its twin programs/NAME.cpp
with the same flags. st_harness runs the three side by side, compares their checksums and takes the
shortest of many interleaved runs. The result is a Markdown table. --verify compares the checksums and
looks into the object code only; --instructions counts instructions under callgrind instead of time.
"""

import argparse
import concurrent.futures
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
# As compiler/project/toolchain.cpp has them.
FLAGS = ["-std=c++20", "-fPIC", "-fwrapv", "-fno-strict-aliasing", "-fno-finite-loops",
         "-fno-delete-null-pointer-checks", "-ffp-contract=off", "-fvisibility=hidden", "-fno-rtti",
         "-O2", "-g1", "-fno-optimize-sibling-calls", "-fno-partial-inlining", "-falign-functions=64",
         "-falign-loops=32", "-fno-tree-slp-vectorize", "-fno-gcse"]
# What no generated code of the suite may call: the heap, the C++ library's machinery.
FORBIDDEN = re.compile(r"\b(malloc|calloc|realloc|free|_Zn[wa]\w*|_Zd[la]\w*|__cxa_pure_virtual|_ZTV\w*)$")


def command(arguments, **options):
    done = subprocess.run(arguments, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
    return done.stdout


def build(build_dir, work, name):
    """The three shared objects of a program."""
    source = HERE / "programs" / name
    made = [work / f"{name}.{kind}.so" for kind in ("checked", "unchecked", "twin")]
    for target, options in zip(made, ([], ["--unchecked"])):
        command([build_dir / "stride", "build", f"{source}.st", "-o", target, *options],
                env=os.environ | {"XDG_CACHE_HOME": str(work / f"cache-{name}")})
    command([os.environ.get("STRIDE_CXX") or "g++", *FLAGS, "-Wall", "-Wextra", "-Werror", "-I", ROOT,
             "-shared", f"{source}.cpp", "-o", made[2], build_dir / "lib" / "libstride_runtime_iec.a"])
    return made


def objects_are_plain(work, name):
    """No heap, no virtual table in the object code that was generated from the program."""
    found = []
    for unit in sorted((work / f"cache-{name}").rglob("*.o")):
        for line in command(["nm", "--undefined-only", unit]).splitlines():
            if FORBIDDEN.search(line):
                found.append(f"{name}: {line.split()[-1]}")
    return found


def instructions(build_dir, made, cycles=20):
    """Instructions per cycle: the difference between runs of one and of more cycles."""
    counts = []
    for which in range(3):
        totals = []
        for n in (1, 1 + cycles):
            done = subprocess.run(
                ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                 build_dir / "tests" / "st_harness", "--only", str(which), "--cycles", str(n), *made],
                capture_output=True, text=True, check=True)
            totals.append(int(re.search(r"Collected : (\d+)", done.stderr).group(1)))
        counts.append((totals[1] - totals[0]) / cycles)
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--verify", action="store_true")
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--only", default="")
    parser.add_argument("--instructions", action="store_true")
    options = parser.parse_args()
    build_dir = options.build.resolve()
    names = sorted(p.stem for p in (HERE / "programs").glob("*.st") if re.search(options.only, p.stem))
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            made = dict(zip(names, pool.map(lambda name: build(build_dir, work, name), names)))
        harness = build_dir / "tests" / "st_harness"
        if options.verify:
            failed = []
            for name in names:
                failed += objects_are_plain(work, name)
                done = subprocess.run([harness, "--verify", *made[name]], capture_output=True, text=True)
                if done.returncode != 0:
                    failed.append(f"{name}: {done.stderr.strip()}")
            print(f"{len(names)} programs, {len(failed)} failures")
            sys.exit("\n".join(failed) if failed else 0)
        unit = "instructions" if options.instructions else "time"
        print(f"| program | C++ {unit} | checks off | checks on |")
        print("|---|---:|---:|---:|")
        ratios = []
        for name in names:
            if options.instructions:
                checked, unchecked, twin = instructions(build_dir, made[name])
                shown = f"{twin:,.0f}"
            else:
                checked, unchecked, twin = map(float, command(
                    [harness, "--runs", str(options.runs), *made[name]]).split())
                shown = f"{twin / 1000:.2f} µs"
            ratios.append((unchecked / twin, checked / twin))
            print(f"| `{name}` | {shown} | {ratios[-1][0]:.2f} | {ratios[-1][1]:.2f} |", flush=True)
        mean = [math.exp(sum(math.log(r[i]) for r in ratios) / len(ratios)) for i in range(2)]
        print(f"| geometric mean | | {mean[0]:.2f} | {mean[1]:.2f} |")


if __name__ == "__main__":
    main()
