#!/usr/bin/env python3
"""Random sequences at axes of TSX CSY 85 modules, run by the built `stride`, against the rules of csy_model.py.

usage: csy_states.py STRIDE [--seeds FIRST..LAST] [--keep FOLDER] [--all]

A seed is a sequence at one imaginary axis: permissions, edges, moves, stops, manual mode, exchanges of commands and parameters.
Twenty axes, four to a module, make a project. The first difference of a sequence is printed (with --all: each), with its seed,
its cycle, what was expected and got, and the events before it. What the specification leaves open: see csy_model.py.
"""
import argparse
import csv
import pathlib
import random
import subprocess
import sys
import tempfile

import csy_model
import csy_sequences

AXES = 20


def rows_of(path, count):
    """The rows of each axis, by the names of the words"""
    words = csy_sequences.WORDS + ("position", "set")
    out = [[] for _ in range(count)]
    with open(path, encoding="utf-8", newline="") as file:
        lines = csv.reader(file)
        next(lines)
        for line in lines:
            for i in range(count):
                first = 1 + i * len(words)
                out[i].append({name: float(text) if "." in text or "e" in text else int(text)
                               for name, text in zip(words, line[first:first + len(words)])})
    return out


def show(seed, sequence, found, all_of_them):
    for cycle, what, expected, got in found if all_of_them else found[:1]:
        print(f"seed {seed}, cycle {cycle}: {what}: expected {expected}, got {got}")
    before = [event for event in sequence.events if event[0] <= found[0][0]][-12:]
    outputs = csy_sequences.OUTPUTS
    for cycle, kind, number, value in before:
        what = ("outputs", "parameter", "exchange", "action", "PARAM_CMD_1", "PARAM_CMD_3", "PARAM_CMD_4",
                "REMOTE_POSITION")[kind]
        text = " ".join(name for i, name in enumerate(outputs) if number >> i & 1) if kind == csy_sequences.OUT else (
            csy_sequences.EXCHANGES[number] if kind == csy_sequences.ASK else f"{number} {value}")
        print(f"  {cycle}: {what} {text}")


def check(options, seeds):
    """How many sequences of a project agree"""
    sequences = [csy_sequences.Sequence(random.Random(seed)) for seed in seeds]
    folder = options.keep / f"csy{seeds[0]}"
    names = csy_sequences.write(folder, sequences)
    trace = folder / "trace.csv"
    time = f"T#{csy_sequences.CYCLES * 4}ms"
    result = subprocess.run([options.stride, "sim", str(folder), "--for", time, "--trace", ",".join(names), "--out", str(trace),
                             "-W", "off=lints"], capture_output=True, text=True, check=False)
    if result.returncode:
        print(f"{folder}: {result.stderr[:3000]}")
        return 0
    good = 0
    for i, (seed, rows) in enumerate(zip(seeds, rows_of(trace, len(seeds)))):
        found = csy_model.Judge(sequences[i], 9 + i % 4, rows).run()
        if found:
            show(seed, sequences[i], found, options.all)
        good += not found
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stride", type=lambda text: str(pathlib.Path(text).resolve()))
    parser.add_argument("--seeds", default="1..60")
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args()
    first, _, last = options.seeds.partition("..")
    seeds = list(range(int(first), int(last or first) + 1))
    with tempfile.TemporaryDirectory() as folder:
        options.keep = options.keep or pathlib.Path(folder)
        good = sum(check(options, seeds[i:i + AXES]) for i in range(0, len(seeds), AXES))
    print(f"{good} of {len(seeds)} sequences agree")
    return 0 if good == len(seeds) else 1


if __name__ == "__main__":
    sys.exit(main())
