#!/usr/bin/env python3
"""Runs every block of Standard and Util through its timing tables (README.md says what they look like).

usage: run.py STRIDE STRIDE_HOST [--only NAME,NAME] [--keep FOLDER]

All tables become one project: a program for each, called by an event task, which keeps the outputs of each call. A
scenario is one simulation, in which a script sets the inputs and raises the event at the time of each row; what was kept
must be the table. At the end each output of each table is falsified once, and the comparison has to notice it.
"""
import argparse
import concurrent.futures
import dataclasses
import math
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
from fractions import Fraction

FOLDER = pathlib.Path(__file__).parent / "tables"


@dataclasses.dataclass
class Scenario:
    title: str
    rows: list  # (time, inputs, outputs), texts


class Table:
    def __init__(self, path):
        self.name = path.stem
        self.call, self.local, self.tolerance, self.scenarios = "", [], {}, []
        self.inputs, self.outputs = [], []
        header = False
        for number, line in enumerate(path.read_text().splitlines(), 1):
            words = line.split()
            if not words or words[0].startswith("#") and not self.scenarios:
                continue
            if words[0] == "==":
                self.scenarios.append(Scenario(line[3:], []))
                header = True
            elif self.scenarios and header:
                header = False
            elif self.scenarios:
                bar = words.index("|")
                if bar != len(self.inputs) + 1 or len(words) != bar + 1 + len(self.outputs):
                    raise SystemExit(f"{path}:{number}: not as many columns as the table has")
                self.scenarios[-1].rows.append((Fraction(words[0]), words[1:bar], words[bar + 1:]))
            elif words[0] in ("inputs", "outputs"):
                setattr(self, words[0], [tuple(w.split(":")) for w in words[1:]])
            elif words[0] == "call":
                self.call = words[1:]
            elif words[0] == "local":
                self.local.append(line[6:])
            elif words[0] == "tolerance":
                self.tolerance[words[1]] = (float(words[2]), float(words[3]))
        assert self.call and self.outputs and self.scenarios, path

    def program(self):
        """The text of the PROGRAM that calls the block with its inputs."""
        kinds = {"REAL": "RealBits", "DT": "UDINT", "GEN_MODE": "INT"}
        inputs = [(n, k) for n, k in self.inputs if "[" not in n and "." not in n]
        declared = [f"  {n} : {kinds.get(k, k)};" for n, k in inputs] + [f"  {n} : {k};" for n, k in self.outputs]
        declared += [f"  {line};" for line in self.local]
        given = [f"{n} := " + {"REAL": f"{n}.r", "DT": f"UDINT_TO_DT({n})"}.get(k, n) for n, k in inputs]
        given += [f"{n} := {n}" for n in self.call[1:]]
        if self.call[0] == "function":
            body = f"result := {self.name}({', '.join(given)});"
        else:
            declared.append(f"  tested : {self.name};")
            body = f"tested({', '.join(given + [f'{n} => {n}' for n, _ in self.outputs])});"
        last = max(len(s.rows) for s in self.scenarios)
        declared.append("  calls : DINT;")
        for name, kind in self.outputs:
            kept = {"TIME": "UDINT", "DT": "UDINT", "LTIME": "LINT", "REAL": "RealBits"}.get(kind, kind)
            declared.append(f"  kept_{name} : ARRAY[0..{last}] OF {kept};")
            to = f"{kind}_TO_{kept}({name})" if kind in ("TIME", "DT", "LTIME") else name
            body += f"\nkept_{name}[calls]{'.r' if kind == 'REAL' else ''} := {to};"
        body += f"\ncalls := MIN(calls + 1, {last});"
        return f"PROGRAM P_{self.name}\nVAR\n" + "\n".join(declared) + f"\nEND_VAR\n{body}\nEND_PROGRAM\n"

    def script(self, number, scenario):
        lines, before, again = [f"at T#0ms: Main.which := {number}"], None, 0
        last = {}
        for t, inputs, _ in scenario.rows:
            again = again + 1 if t == before else 0
            before = t
            acts = []
            for (name, kind), text in zip(self.inputs, inputs):
                if last.get(name) != text:
                    acts.append(f"P_{self.name}.{name}{'.d' if kind == 'REAL' else ''} := {value(kind, text)}")
                    last[name] = text
            lines.append(f"at LT#{int(t * 1000000) + again * 1000}ns: " + "; ".join(acts + ["Main.tick := TRUE"]))
        return "\n".join(lines) + "\n"

    def differs(self, index, expected, actual):
        """Whether this cell of an output's column is wrong."""
        name, kind = self.outputs[index]
        if kind == "BOOL":
            return {"#": "TRUE", ".": "FALSE"}.get(expected) != actual
        if kind.startswith("STRING"):
            return "'" + re.sub(r"\$([0-9A-F]{2})", lambda c: chr(int(c[1], 16)), expected[1:-1]) + "'" != re.sub(r"\$(.)", r"\1", actual)
        if kind != "REAL":
            return int(expected) != int(actual)
        want, have = single(float(expected)), struct.unpack("<f", struct.pack("<I", int(actual)))[0]
        if not math.isfinite(want):
            return repr(want) != repr(have)
        relative, absolute = self.tolerance.get(name, (0, 0))
        return not abs(want - have) <= relative * abs(want) + absolute


def single(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def value(kind, text):
    if kind == "BOOL":
        return "TRUE" if text == "#" else "FALSE"
    if kind == "REAL":
        return f"16#{struct.unpack('<I', struct.pack('<f', float(text)))[0]:08X}"
    return f"T#{text}ms" if kind == "TIME" else f"LTIME#{text}ns" if kind == "LTIME" else text


def project(tables, folder):
    (folder / "stride.toml").write_text('[project]\nname = "Blocks"\n[[task]]\nname = "Table"\nkind = "event"\n'
                                        'event = "Main.tick"\nprograms = ["Main"]\n'
                                        '[[task]]\nname = "Idle"\ninterval = "T#1h"\npriority = 31\nprograms = ["Idle"]\n')
    cases = "".join(f"  {i}: P_{t.name}();\n" for i, t in enumerate(tables))
    (folder / "Main.st").write_text(
        "TYPE RealBits : UNION r : REAL; d : DWORD; END_UNION END_TYPE\n"
        f"PROGRAM Main\nVAR\n  tick : BOOL;\n  which : INT;\nEND_VAR\ntick := FALSE;\nCASE which OF\n{cases}END_CASE\nEND_PROGRAM\nPROGRAM Idle\n;\nEND_PROGRAM\n")
    for table in tables:
        (folder / f"P_{table.name}.st").write_text(table.program())


def compare(table, scenario, trace):
    """What is wrong, as text; empty if nothing is."""
    rows = trace
    if len(rows) != len(scenario.rows):
        return f"{len(rows)} rows instead of {len(scenario.rows)}"
    for (t, inputs, outputs), row in zip(scenario.rows, rows):
        for i, expected in enumerate(outputs):
            if table.differs(i, expected, row[i]):
                shown = " ".join(f"{n}={v}" for (n, _), v in zip(table.inputs, inputs))
                return f"at {float(t):.12g} ms, {shown}: {table.outputs[i][0]} is {row[i]}, not {expected}"
    return ""


def blind(table, scenario, trace):
    """Outputs whose falsified values the comparison does not notice."""
    unseen = []
    for i, (name, kind) in enumerate(table.outputs):
        row = len(scenario.rows) // 2
        t, inputs, outputs = scenario.rows[row]
        wrong = list(outputs)
        if kind == "BOOL":
            wrong[i] = "#" if outputs[i] == "." else "."
        elif kind == "REAL":
            wrong[i] = str(float(outputs[i]) * 1.00001 + 0.001) if math.isfinite(float(outputs[i])) else "0"
        else:
            wrong[i] = "'?'" if kind.startswith("STRING") else str(int(outputs[i]) + 1)
        rows = scenario.rows[:row] + [(t, inputs, wrong)] + scenario.rows[row + 1:]
        if not compare(table, Scenario(scenario.title, rows), trace):
            unseen.append(name)
    return unseen


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("stride")
    parser.add_argument("host")
    parser.add_argument("--only", default="")
    parser.add_argument("--keep")
    options = parser.parse_args()
    only = [name for name in options.only.split(",") if name]
    tables = [Table(path) for path in sorted(FOLDER.glob("*.txt")) if not only or path.stem in only]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(options.keep or temporary)
        folder.mkdir(exist_ok=True)
        project(tables, folder)
        app = folder / "app.so"
        build = subprocess.run([options.stride, "build", str(folder), "--debug", "-W", "off=lints", "-W", "off=all-warnings", "-o", str(app)],
                               capture_output=True, text=True, check=False)
        if build.returncode:
            print(build.stdout + build.stderr)
            return 1

        def run(job):
            number, table, index, scenario = job
            script = folder / f"{table.name}.{index}.script"
            script.write_text(table.script(number, scenario))
            kept = [f"P_{table.name}.kept_{n}" for n, _ in table.outputs]
            names = ",".join([f"P_{table.name}.calls"] + kept)
            end = int(scenario.rows[-1][0]) + 1
            result = subprocess.run([options.host, "sim", str(app), "--for", f"LT#{end}ms", "--script", str(script), "--print", names, "--quiet"],
                                    capture_output=True, text=True, encoding="latin-1", check=False)
            if result.returncode:
                return job, result.stdout + result.stderr, []
            printed = dict(line.split(" = ", 1) for line in result.stdout.splitlines())
            columns = [[printed[f"{name}[{i}]{'.d' if kind == 'REAL' else ''}"] for i in range(int(printed[f"P_{table.name}.calls"]))]
                       for name, (_, kind) in zip(kept, table.outputs)]
            trace = list(zip(*columns))
            return job, compare(table, scenario, trace), trace

        jobs = [(n, t, i, s) for n, t in enumerate(tables) for i, s in enumerate(t.scenarios)]
        failed = rows = 0
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for (_, table, index, scenario), problem, trace in pool.map(run, jobs):
                rows += len(scenario.rows)
                if not problem and index == len(table.scenarios) - 1:
                    unseen = blind(table, scenario, trace)
                    problem = f"wrong values of {', '.join(unseen)} go unnoticed" if unseen else ""
                if problem:
                    failed += 1
                    print(f"{table.name}: {scenario.title}: {problem}")
        print(f"{len(tables)} tables, {len(jobs)} scenarios, {rows} rows, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
