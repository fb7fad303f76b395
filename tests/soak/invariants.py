"""What must hold of every run, whatever happened to it."""
import csv
import pathlib
import re


def read_trace(path):
    """Columns and rows of a trace; a last line without an end (the writer was killed) is left out."""
    text = pathlib.Path(path).read_text(encoding="utf-8")
    lines = text.split("\n")[:-1]
    rows = list(csv.reader(lines))
    return (rows[0], rows[1:]) if rows else ([], [])


def by_cycle(rows, column=1):
    """The first row of each value of the program's counter of cycles. After the program's end the counter stands still."""
    found = {}
    for row in rows:
        found.setdefault(int(row[column]), row[column + 1:])
    return found


def same_course(round_, traced, reference, what):
    """The axes of both traces do the same in every cycle that both have. How many cycles were compared."""
    columns, rows = traced
    _, expected_rows = reference
    found, expected = by_cycle(rows), by_cycle(expected_rows)
    common = sorted(set(found) & set(expected))
    for cycle in common:
        if found[cycle] != expected[cycle]:
            wrong = [f"{name} is {a}, not {b}" for name, a, b in zip(columns[2:], found[cycle], expected[cycle]) if a != b]
            round_.expect(False, f"{what}: cycle {cycle}: {', '.join(wrong)}")
            break
    return len(common)


def steps_within_limits(round_, project, traced, what):
    """From cycle to cycle no set value goes further than the axis may, where no row is missing."""
    columns, rows = traced
    places = {name: i for i, name in enumerate(columns)}
    for axis in project.axes:
        at, speed = places[f"{axis.name}.fSetPosition"], places[f"{axis.name}.fSetVelocity"]
        largest, change = project.limits(axis)
        for before, row in zip(rows, rows[1:]):
            if int(row[1]) != int(before[1]) + 1:
                continue
            step = abs(float(row[at]) - float(before[at]))
            if axis.rotary:
                step = min(step, 360.0 - step)
            if step > largest or abs(float(row[speed]) - float(before[speed])) > change:
                round_.expect(False, f"{what}: {axis.name} leaps in cycle {row[1]}: from {before[at]} ({before[speed]}/s) to {row[at]} ({row[speed]}/s), "
                                     f"allowed are {largest:.6g} and {change:.6g}")
                break


def movers_within_limits(round_, project, values, what):
    """The same, of what the movers themselves have seen; `values` are printed or read ones by name."""
    for axis in project.axes:
        largest, change = project.limits(axis)
        seen = {name: float(values[f"PLC_PRG.m{axis.name}.{name}"]) for name in ("maxStep", "maxChange", "errors")}
        round_.expect(seen["maxStep"] <= largest and seen["maxChange"] <= change and seen["errors"] == 0,
                      f"{what}: {axis.name} ({axis.kind}) had {seen}, allowed are {largest:.6g} and {change:.6g}")


def printed(text):
    """Values of --print by name"""
    return dict(line.split(" = ", 1) for line in text.splitlines() if " = " in line)


STATISTICS = re.compile(r"^\s*(\S+)\s+(\d+)\s+(\d+)\s+(\d+)\s", re.MULTILINE)


def statistics(text, task):
    """Cycles, overruns and watchdog hits of a task in the table at the end of a run; nothing without it"""
    for name, cycles, overruns, watchdog in STATISTICS.findall(text):
        if name == task:
            return int(cycles), int(overruns), int(watchdog)
    return None


def descriptors(pid):
    """How many files a process has open"""
    return len(list(pathlib.Path(f"/proc/{pid}/fd").iterdir()))


def resident_kib(pid):
    """VmRSS"""
    return int(re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text()).group(1))


def mappings(pid):
    """How many pieces of memory a process has mapped"""
    return len(pathlib.Path(f"/proc/{pid}/maps").read_text().splitlines())
