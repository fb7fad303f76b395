#!/usr/bin/env python3
"""Random loops whose indices come to the limits of their arrays, against an interpreter.

usage: random_loops.py STRIDE [--seeds FIRST..LAST] [--count N] [--keep FOLDER]

A seed is a project of N cases: programs, functions, function blocks, methods and derived blocks with FOR, WHILE and REPEAT
loops over variables of all sections, with aliases (in-outs, references, pointers, unions), calls that change what a loop
counts, CASE, EXIT, CONTINUE, JMP and RETURN. A case is first interpreted with arrays without limits; then its arrays get
just the indices that it used, or one less, so that it ends as it should or is stopped by a check. `stride sim` runs all cases
with checks, each within a __TRY, and those that end also without. What every variable holds and which exception came must
be what the interpreter says. A seed that disagrees is left in FOLDER (default: the temporary folder) and named.
"""
import random
import re
import subprocess
import sys

from loop_parts import FUEL, PRINTED, STOPS, TYPES, Array, Leave, Stop
from loop_statements import Statements
from model import NUMBERS, Skip, limits
from seeds import agree_in_both_modes, try_seeds


class Case(Statements):
    def __init__(self, rng, number):
        self.rng, self.number = rng, number
        self.style = rng.choice(["program", "program", "function", "function", "block", "method", "derived"])
        self.kind = rng.choice(TYPES)
        self.origin = 0
        if rng.random() < 0.15:
            low, high = limits(self.kind)
            self.origin = rng.choice([high - 12, low + 4, high // 2])
        elif rng.random() < 0.2 and NUMBERS[self.kind][0]:
            self.origin = -5
        # Where all is as the analysis likes it, but for one thing perhaps, indices are proven.
        self.clean = rng.random() < 0.6
        self.dirt = 0.1 if self.clean else 1.0
        if self.clean:
            self.kind = rng.choice(["DINT", "DINT", "INT", "UINT", "SINT", "LINT"])
        self.sections, self.globals, self.first, self.helpers, self.methods = {}, [], [], [], []
        self.cells, self.arrays, self.pointers, self.targets = {}, {}, {}, {}
        self.variables, self.names, self.busy = [], 0, []
        self.changers, self.values = [], []
        self.loops, self.labels, self.fuel = 0, 0, 0
        self.open, self.used = [], set()
        self.declare()
        self.change()
        self.lines, self.run_body = self.block(3)
        self.settle()

    def interpret(self, bounds):
        for cell in self.cells.values():
            cell.value = 0
        self.pointers = dict(self.targets)
        self.made = {}
        for letter, (_, _, _, dimensions, kind) in self.arrays.items():
            self.made[letter] = Array(kind, dimensions)
            self.made[letter].limits = bounds and bounds[letter]
        self.fuel, self.stop = FUEL, None
        try:
            self.run_body()
        except Leave as leave:
            if leave.args[0] != "RETURN":
                raise
        except Stop as stop:
            self.stop = stop.args[0]

    def settle(self):
        """Chooses the limits of the arrays."""
        rng = self.rng
        self.interpret(None)
        bounds = {}
        for letter, array in self.made.items():
            bounds[letter] = []
            for low, high in array.seen:
                if low is None:
                    low, high = 0, 3
                if high - low > 3000 or low < -(1 << 31) or high >= 1 << 31:
                    raise Skip
                if rng.random() < 0.25 and high > low:
                    low += 1
                elif rng.random() < 0.33 and high > low:
                    high -= 1
                bounds[letter].append((low, high))
        for letter, pair in bounds.items():
            if len(pair) == 2 and (pair[0][1] - pair[0][0] + 1) * (pair[1][1] - pair[1][0] + 1) > 5000:
                raise Skip
        self.bounds = bounds
        self.interpret(bounds)
        self.lines_of_text = self.text()

    def array_type(self, letter):
        kind, pairs = self.arrays[letter][4], [f"{low}..{high}" for low, high in self.bounds[letter]]
        return f"ARRAY[{pairs[0]}] OF ARRAY[{pairs[1]}] OF {kind}" if letter == "c" else f"ARRAY[{', '.join(pairs)}] OF {kind}"

    def declared(self, sections):
        lines = []
        for section in sections:
            if section in self.sections:
                word = {"LOCAL": "VAR", "BASE": "VAR", "METHOD_IN_OUT": "VAR_IN_OUT"}.get(section, section)
                lines += [word, *self.sections[section], "END_VAR"]
        return lines

    def text(self):
        n, kind = self.number, self.kind
        for letter, (_, _, where, _, _) in self.arrays.items():
            line = f"  {letter} : {self.array_type(letter)};"
            if where == "own":
                self.sections.setdefault("VAR", []).append(line)
            else:
                self.globals.append(line.replace(f"  {letter} :", f"  G{n}_{letter} :"))
        body = ["  " + line for line in self.first] + self.lines
        arguments = f"io := G{n}_g" if any(s in self.sections for s in ("VAR_IN_OUT", "METHOD_IN_OUT")) else ""
        lines = list(self.helpers)
        usual = ["VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR_STAT", "VAR CONSTANT"]
        if self.style == "program":
            lines += [f"PROGRAM C{n}", *self.declared(usual), *body, *self.methods, "END_PROGRAM"]
            call = f"C{n}();"
        elif self.style == "function":
            lines += [f"FUNCTION C{n} : BOOL", *self.declared(usual), *body, "END_FUNCTION"]
            call = f"C{n}({arguments});"
        elif self.style == "derived":
            lines += [f"FUNCTION_BLOCK B{n}", *self.declared(["BASE"])]
            lines += [f"METHOD Hook : {kind}", "END_METHOD"] if self.hook else []
            lines += ["END_FUNCTION_BLOCK", f"FUNCTION_BLOCK C{n} EXTENDS B{n}", *self.declared(usual), *body, *self.methods, "END_FUNCTION_BLOCK"]
            call = f"G{n}_fb();"
        elif self.style == "block":
            lines += [f"FUNCTION_BLOCK C{n}", *self.declared(usual), *body, *self.methods, "END_FUNCTION_BLOCK"]
            call = f"G{n}_fb({arguments});"
        else:
            lines += [f"FUNCTION_BLOCK C{n}", *self.declared(usual), *self.methods, f"METHOD Go : BOOL",
                      *self.declared(["METHOD_IN_OUT", "LOCAL"]), *body, "END_METHOD", "END_FUNCTION_BLOCK"]
            call = f"G{n}_fb.Go({arguments});"
        if self.style not in ("program", "function"):
            self.globals.append(f"  G{n}_fb : C{n};")
        self.call = ["__TRY", f"  {call}", f"  e[{n}] := 1;", f"__CATCH (exc)", f"  k[{n}] := exc;", "__ENDTRY"]
        return lines + ["VAR_GLOBAL", *self.globals, "END_VAR"]

    def expected(self):
        found = {f"PLC_PRG.e[{self.number}]": "0" if self.stop else "1"}
        found[f"PLC_PRG.k[{self.number}]"] = STOPS[self.stop] if self.stop else "RTSEXCPT_NOEXCEPTION"
        for key, cell in self.cells.items():
            if PRINTED.match(key):
                found[key] = str(cell.value)
        for letter, (key, _, where, _, kind) in self.arrays.items():
            if not PRINTED.match(key):
                continue
            ranges = [range(low, high + 1) for low, high in self.bounds[letter]]
            indices = [(i,) for i in ranges[0]] if len(ranges) == 1 else [(i, j) for i in ranges[0] for j in ranges[1]]
            for at in indices:
                found[f"{key}[{','.join(map(str, at))}]"] = str(self.made[letter].values.get(at, 0))
        return found


def some_cases(rng, count):
    cases = []
    while len(cases) < count:
        try:
            case = Case(rng, len(cases))
            if case.stop is None or rng.random() < 0.5:
                cases.append(case)
        except Skip:
            pass
    return cases


def common_text(kinds):
    """What all cases use"""
    lines = []
    for kind in kinds:
        lines += [f"TYPE U_{kind} : UNION one, two : {kind}; END_UNION END_TYPE", f"TYPE S_{kind} : STRUCT n, m : {kind}; END_STRUCT END_TYPE",
                  f"FUNCTION Plain_{kind} : {kind}", f"VAR_INPUT i : {kind}; END_VAR", f"Plain_{kind} := i + 1;", "END_FUNCTION",
                  f"FUNCTION Small_{kind} : DINT", f"VAR_INPUT i : {kind}; END_VAR",
                  f"Small_{kind} := TO_DINT(i MOD 1000);" if NUMBERS[kind][1] > 8 else f"Small_{kind} := i;", "END_FUNCTION"]
    return lines


def project(cases, count):
    lines = common_text(sorted(set(TYPES)))
    calls = []
    for case in cases:
        case.line = len(lines) + 1
        lines += case.lines_of_text
        calls += ["  " + line for line in case.call]
    return [*lines, "PROGRAM PLC_PRG", "VAR", "  exc : __SYSTEM.ExceptionCode;", f"  e : ARRAY[0..{count - 1}] OF DINT;",
            f"  k : ARRAY[0..{count - 1}] OF __SYSTEM.ExceptionCode;", "END_VAR", *calls, "END_PROGRAM", ""]


def plain(path):
    """Rows and columns in one pair of brackets"""
    return path.replace("][", ",").replace(", ", ",")


def run(options, source, cases, arguments):
    """True: everything is as expected"""
    expected = {}
    for case in cases:
        expected.update(case.expected())
    names = ["PLC_PRG.e", "PLC_PRG.k"] + sorted({re.match(r"\w+(\.\w+)*", key).group() for key in expected if not key.startswith("PLC_PRG")})
    result = subprocess.run([options.stride, "sim", source.name, "--for", "T#10ms", "--print", ",".join(names), "-W", "off=all-warnings", *arguments],
                            capture_output=True, text=True, check=False, cwd=source.parent)
    found = {plain(line.split(" = ")[0]): line.split(" = ", 1)[1] for line in result.stdout.splitlines() if " = " in line}
    wrong = {key: value for key, value in expected.items() if found.get(key) != value}
    if result.returncode == 0 and not wrong:
        return True
    print(f"{source} {' '.join(arguments)}: exit code {result.returncode}, {len(wrong)} of {len(expected)} values differ")
    if result.returncode == 0:
        for key, value in list(wrong.items())[:12]:
            print(f"  {key}: expected {value}, found {found.get(key)}")
    print(result.stderr[:3000])
    return False


def without_errors(options, source, cases):
    """The compiler sees by itself that some constants are none of an array or a subrange."""
    source.write_text("\n".join(project(cases, options.count)), encoding="utf-8")
    result = subprocess.run([options.stride, "check", source.name, "-W", "off=all-warnings", "--max-errors", "0"], capture_output=True, text=True,
                            check=False, cwd=source.parent)
    wrong = [int(line) for line in re.findall(r"--> \S+:(\d+):", result.stderr)]
    foreign = [code for code in re.findall(r"error\[(\w+)\]", result.stderr) if code not in ("SE0415", "SE0409", "SE0402", "SE0411")]
    if foreign:
        print(result.stderr[:3000])
    bad = {max((case.line, case.number) for case in cases if case.line <= line)[1] for line in wrong}
    return [case for case in cases if case.number not in bad]


def check(options, seed):
    """How many cases agree, or None"""
    rng = random.Random(seed)
    cases = without_errors(options, options.keep / f"loops{seed}.st", some_cases(rng, options.count))
    return agree_in_both_modes(options, f"loops{seed}", cases, lambda chosen: project(chosen, options.count), run)


def add_options(parser):
    parser.add_argument("--count", type=int, default=40)


if __name__ == "__main__":
    sys.exit(try_seeds(check, "1..4", "cases", add_options))
