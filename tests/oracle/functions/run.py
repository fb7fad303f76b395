#!/usr/bin/env python3
"""Compares the standard functions with the tables of this folder.

usage: run.py STRIDE TABLE.csv… [--every-row-fails]

Each table becomes one program. Arguments stand in arrays that a loop calls the function with; a second array is
initialised with the same calls on literals, so that the compiler computes them. Results are compared bit by bit. For
mathematical functions, whose table has the exact value, the error is measured in units of the last place of the result's
type and printed; it must stay below the function's bound. With --every-row-fails each row must be reported.
"""
import csv
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
from model import WIDTH, from_bits, wrap

#: Largest error in units of the last place; correctly rounded is 0.5.
BOUND = {"SQRT": Fraction(1, 2)}
OTHERS = Fraction(1)
#: Written in ST, and no constant expressions therefore.
IN_ST = {f.stem for f in (pathlib.Path(__file__).parents[3] / "stdlib").glob("*/*.st")}
GROUPS_OF_PROGRAM = 16
PATTERN = {8: "BYTE", 16: "WORD", 32: "DWORD", 64: "LWORD"}


def is_text(kind):
    return kind.startswith(("STRING", "WSTRING"))


def call_of(template, arguments, result=""):
    call = re.sub(r"\$(\d)", lambda m: arguments[int(m[1]) - 1], template)
    return call.replace("$r", result)


class Group:
    """Rows with one call and the same types."""

    def __init__(self, number, call, types, result, rows):
        self.number, self.call, self.types, self.result, self.rows = number, call, types, result, rows
        self.name = re.match(r"\w*", call)[0]
        self.statement = "$r" in call
        self.folds = not self.statement and self.name not in IN_ST

    def type_text(self):
        if is_text(self.result):
            return ""
        n = len(self.rows) - 1
        return (f"  U{self.number} : UNION v : ARRAY [0..{n}] OF {self.result}; "
                f"bits : ARRAY [0..{n}] OF {PATTERN[WIDTH[self.result]]}; END_UNION\n")

    def array(self, kind):
        return f"ARRAY [0..{len(self.rows) - 1}] OF {kind}"

    def variables(self):
        k = self.number
        text = ""
        for j, kind in enumerate(self.types):
            text += f"  a{k}_{j} : {self.array(kind)} := [{', '.join(r[1][j] for r in self.rows)}];\n"
        holder = self.array(self.result) if is_text(self.result) else f"U{k}"
        text += f"  r{k} : {holder};\n"
        if self.folds:
            values = ", ".join(call_of(self.call, r[1]) for r in self.rows)
            text += f"  c{k} : {self.array(self.result)} := [{values}];\n"
            if not is_text(self.result):
                text += f"  f{k} : U{k};\n"
        return text

    def body(self):
        k = self.number
        target = f"r{k}[i]" if is_text(self.result) else f"r{k}.v[i]"
        call = call_of(self.call, [f"a{k}_{j}[i]" for j in range(len(self.types))], target)
        text = f"FOR i := 0 TO {len(self.rows) - 1} DO {call if self.statement else f'{target} := {call}'}; END_FOR\n"
        if self.folds and not is_text(self.result):
            text += f"f{k}.v := c{k};\n"
        return text

    def paths(self):
        k = self.number
        if is_text(self.result):
            return {"variables": f"r{k}"} | ({"literals": f"c{k}"} if self.folds else {})
        return {"variables": f"r{k}.bits"} | ({"literals": f"f{k}.bits"} if self.folds else {})


def read(table):
    with open(table, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    groups = []
    for key, members in itertools.groupby(rows, key=lambda r: (r["call"], r["types"], r["result"])):
        members = [(m["expected"], m["arguments"].split(" | ")) for m in members]
        types = re.findall(r"ARRAY\[.*?\] OF \S+|\S+", key[1])
        groups.append(Group(len(groups), key[0], types, key[2], members))
    return groups


def run(stride, groups):
    text = "TYPE\n" + "".join(g.type_text() for g in groups) + "END_TYPE\n"
    # The C++ compiler takes far longer for one long program than for several short ones.
    parts = [groups[i:i + GROUPS_OF_PROGRAM] for i in range(0, len(groups), GROUPS_OF_PROGRAM)]
    for k, part in enumerate(parts):
        text += f"PROGRAM Part{k}\nVAR\n  i : DINT;\n" + "".join(g.variables() for g in part) + "END_VAR\n"
        text += "".join(g.body() for g in part) + "END_PROGRAM\n"
    text += "PROGRAM PLC_PRG\n" + "".join(f"Part{k}();\n" for k in range(len(parts))) + "END_PROGRAM\n"
    paths = ",".join(f"Part{k}.{p}" for k, part in enumerate(parts) for g in part for p in g.paths().values())
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "oracle.st"
        source.write_text(text, encoding="utf-8")
        done = subprocess.run([stride, "sim", str(source), "--for", "T#10ms", "-W", "off=lints", "--print", paths],
                              capture_output=True, cwd=folder, check=False)
    if done.returncode != 0:
        sys.stdout.write(done.stdout.decode("utf-8", "replace")[-2000:])
        sys.stderr.write(done.stderr.decode("utf-8", "replace")[:6000])
        sys.exit(f"{stride} gave {done.returncode}")
    values = {}
    for line in done.stdout.decode("utf-8", "surrogatepass").splitlines():
        match = re.match(r"Part\d+\.(\S+)\[(\d+)\] = (.*)$", line)
        if match:
            values[match[1], int(match[2])] = match[3]
    return values


def text_of(literal):
    wide = literal[0] == '"'
    named = {"L": "\n", "N": "\n", "P": "\f", "R": "\r", "T": "\t"}

    def escape(match):
        code = match[1]
        return named.get(code.upper()) or (chr(int(code, 16)) if len(code) > 1 else code)

    return re.sub(r"\$([0-9A-Fa-f]{4}|.)" if wide else r"\$([0-9A-Fa-f]{2}|.)", escape, literal[1:-1])


class Reals:
    """Errors in units of the last place, the largest of each function."""

    def __init__(self):
        self.largest = {}

    def good(self, group, got, expected):
        kind = group.result
        if expected in ("nan", "inf", "-inf") or expected.lstrip("-").startswith("0x"):
            wanted = float.fromhex(expected)
            if wanted != wanted:
                return got != got
            return got == wanted and str(got) == str(wanted)  # the sign of 0
        exact = Fraction(expected)
        if got != got:
            return False
        digits, smallest, top = (24, -149, 128) if kind == "REAL" else (53, -1074, 1024)
        if exact == 0:
            return got == 0
        magnitude = abs(exact)
        exponent = magnitude.numerator.bit_length() - magnitude.denominator.bit_length()
        exponent -= Fraction(2) ** exponent > magnitude
        unit = Fraction(2) ** max(exponent - digits + 1, smallest)
        value = Fraction(got) if abs(got) != float("inf") else Fraction(2) ** top * (1 if got > 0 else -1)
        error = abs(value - exact) / unit
        key = f"{group.name} {kind}"
        self.largest[key] = max(error, self.largest.get(key, Fraction(0)))
        return error <= BOUND.get(group.name, OTHERS)


def main():
    every_row_fails = "--every-row-fails" in sys.argv
    stride, *tables = [str(pathlib.Path(a).resolve()) for a in sys.argv[1:] if not a.startswith("--")]
    reals = Reals()
    rows = failed = checked = 0
    for table in tables:
        groups = read(table)
        values = run(stride, groups)
        for group in groups:
            for i, (expected, arguments) in enumerate(group.rows):
                rows += 1
                wrong = []
                for way, path in group.paths().items():
                    checked += 1
                    raw = values.get((path, i))
                    if raw is None:
                        wrong.append(f"with {way} no value")
                        continue
                    if is_text(group.result):
                        got, good = text_of(raw), text_of(raw) == json.loads(expected)
                    elif group.result in ("REAL", "LREAL"):
                        got = from_bits(group.result, int(raw))
                        good = reals.good(group, got, expected)
                    else:
                        got = int(raw) if group.result == "BOOL" else wrap(group.result, int(raw))
                        good = got == int(expected)
                    if not good:
                        wrong.append(f"with {way} {got!r}")
                failed += bool(wrong)
                if wrong and not every_row_fails and failed <= 60:
                    shown = [a if len(a) < 60 else a[:57] + "…" for a in arguments]
                    print(f"{call_of(group.call, shown, '…')} : {group.result} must be {expected[:80]}; {', '.join(wrong)}"[:600])
                if every_row_fails and len(wrong) != len(group.paths()):
                    print(f"not found: {call_of(group.call, arguments)} with {expected}")
    for key, error in sorted(reals.largest.items()):
        print(f"{key}: at most {float(error):.4f} units of the last place")
    print(f"{rows} rows, {checked} results, {failed} wrong rows")
    return int(failed != rows if every_row_fails else failed != 0 or rows == 0)


if __name__ == "__main__":
    sys.exit(main())
