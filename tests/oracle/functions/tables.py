"""The tables that generate.py writes, and the values that several of them try."""
import csv
import datetime
import json
import pathlib
import random

from model import DAY, EPOCH, UNIT, Raw, double, limits, literal, single

HERE = pathlib.Path(__file__).parent
INF = float("inf")
NAN = float("nan")
REALS = ("REAL", "LREAL")


class Table:
    edition3 = []  #: rows of functions that only edition 3 of the standard has; they have a table of their own
    written = {}  #: the rows of each table

    def __init__(self, name):
        self.name = name
        self.rows = []
        self.random = random.Random(name)

    def add(self, call, types, arguments, result, expected):
        self.rows.append(self.row(call, types, arguments, result, expected))

    def third(self, call, types, arguments, result, expected):
        self.edition3.append(self.row(call, types, arguments, result, expected))

    @staticmethod
    def row(call, types, arguments, result, expected):
        kinds = types.split()
        if isinstance(expected, float):
            expected = "nan" if expected != expected else expected.hex()
        elif result.startswith(("STRING", "WSTRING")):
            expected = json.dumps(expected)
        texts = [a if isinstance(a, Raw) else literal(k, a) for k, a in zip(kinds, arguments)]
        return [call, types, result, " | ".join(texts), str(expected)]

    def write(self):
        unique = [list(r) for r in dict.fromkeys(tuple(r) for r in self.rows)]
        self.written[self.name] = unique
        with open(HERE / f"{self.name}.csv", "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["call", "types", "result", "arguments", "expected"])
            writer.writerows(sorted(unique, key=lambda r: (r[0], r[1], r[2])))
        print(f"{self.name}.csv: {len(unique)} rows")


def rounded(kind, x):
    return single(x) if kind == "REAL" else double(x)


def integers_of(kind, rnd, n):
    low, high = limits(kind)
    return [v for v in (low, low + 1, -1, 0, 1, 2, high // 2, high - 1, high) if low <= v <= high] + \
        [rnd.randint(low, high) for _ in range(n)]


def some_reals(kind, rnd, n):
    xs = [0.0, -0.0, 1.0, -1.5, 0.1, 3.25, 1e10, -1e-10, 2.0**-126, 2.0**-149, 2.0**127, INF, -INF, NAN]
    if kind == "LREAL":
        xs += [2.0**-1074, 1.7976931348623157e308, -2.0**-1022]
    xs += [rnd.choice((1, -1)) * 2.0**rnd.uniform(-40, 40) for _ in range(n)]
    return [single(x) if kind == "REAL" else x for x in xs]


def time_values(kind, rnd, n):
    low, high = limits(kind)
    if kind in ("DATE", "LDATE"):
        day = DAY // UNIT[kind]
        values = [datetime.date(*d).toordinal() - EPOCH for d in
                  ((1970, 1, 1), (1972, 2, 29), (2000, 2, 29), (2000, 12, 31), (2100, 2, 28), (2100, 3, 1), (2106, 2, 6))]
        if kind == "LDATE":
            values += [datetime.date(*d).toordinal() - EPOCH for d in ((1969, 12, 31), (1900, 2, 28), (2262, 4, 11))]
        return [d * day for d in values + [rnd.randrange(49710) for _ in range(n)]]
    if kind in ("TOD", "LTOD"):
        day = DAY // UNIT[kind]
        return [0, 1, day - 1, day // 2] + [rnd.randrange(day) for _ in range(n)]
    if kind in ("DT", "LDT"):
        second = 10**9 // UNIT[kind]
        values = [0, 1, 68256000 * second, 951782400 * second + 1, 4107542399 * second, (2**32 - 1) * second]
        if kind == "LDT":
            values += [-1, -86400 * 10**9, 2**63 - 1]
            return values + [rnd.randint(0, 2**62) for _ in range(n)]
        return values + [rnd.randint(low, high) for _ in range(n)]
    values = [0, 1, 999, 1000, 86400000, high - 1, high]
    if kind == "LTIME":
        values += [-1, -10**9, 10**15]
    return values + [rnd.randint(low, high) for _ in range(n)]
