#!/usr/bin/env python3
"""Writes the tables of this folder: calls of standard functions and the values that they must have.

usage: generate.py

Nothing here asks Stride, nor do characters.py, libraries.py and selection.py. Integers are Python's, reals are exact
fractions or mpmath (Debian's python3-mpmath) with enough digits, dates are those of `datetime`, texts are lists of
characters. A table has the columns

  call       the call, $1, $2 … for the arguments, $r for an output
  types      of the arguments, separated by blanks
  result     type of the result
  arguments  ST literals, separated by " | "
  expected   an integer in the type's units; a real exactly (0x1.8p+0, nan, inf) or with 40 digits; a text as JSON
"""
import csv
import datetime
import json
import math
import pathlib
import random
import re
import sys
from fractions import Fraction

sys.dont_write_bytecode = True
from characters import characters
from libraries import memory, motion, system_strings
from model import (BITS, CHARACTERS, DAY, EPOCH, INTEGERS, SIGNED, TIMES, UNIT, UNSIGNED, WIDTH, Raw, clock_text, date_text, held,
                   double, from_bits, half_away, limits, literal, saturate, single, wrap)
from selection import logic, measures, powers, selection, wide_strings

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


# ---------------------------------------------------------------------------------------------------------------------
def mathematics():
    import mpmath
    table = Table("mathematics")
    rnd = table.random
    tiny = {"REAL": 2.0**-149, "LREAL": 2.0**-1074}
    normal = {"REAL": 2.0**-126, "LREAL": 2.0**-1022}
    huge = {"REAL": single(Fraction(2)**128 - Fraction(2)**104), "LREAL": sys.float_info.max}

    def exact(function, *xs):
        """As a decimal with 40 digits; enough of them inside for sin(2^1023)."""
        with mpmath.workprec(2400):
            y = function(*[mpmath.mpf(x) for x in xs])
            if mpmath.mag(y) > 1100 or (y != 0 and mpmath.mag(y) < -1200): # so far out that it must not be written down
                return "1e400" if y > 0 and mpmath.mag(y) > 0 else "-1e400" if mpmath.mag(y) > 0 else "0"
            return mpmath.nstr(y, 40, min_fixed=1, max_fixed=0, strip_zeros=False)

    def settled(kind, text):
        """Values beyond the largest are infinite, in a way that says so."""
        value = rounded(kind, Fraction(text))
        if value in (INF, -INF):
            return value
        return text

    functions = {
        "SQRT": (mpmath.sqrt, lambda x: NAN if x < 0 else None, (0, 1e30)),
        "LN": (mpmath.log, lambda x: NAN if x < 0 else -INF if x == 0 else None, (0, 1e30)),
        "LOG": (lambda x: mpmath.log(x, 10), lambda x: NAN if x < 0 else -INF if x == 0 else None, (0, 1e30)),
        "EXP": (mpmath.exp, lambda x: None, (-80, 80)),
        "SIN": (mpmath.sin, lambda x: None, (-10, 10)),
        "COS": (mpmath.cos, lambda x: None, (-10, 10)),
        "TAN": (mpmath.tan, lambda x: None, (-10, 10)),
        "ASIN": (mpmath.asin, lambda x: NAN if abs(x) > 1 else None, (-1, 1)),
        "ACOS": (mpmath.acos, lambda x: NAN if abs(x) > 1 else None, (-1, 1)),
        "ATAN": (mpmath.atan, lambda x: None, (-5, 5)),
    }
    at_infinity = {"SQRT": (NAN, INF), "LN": (NAN, INF), "LOG": (NAN, INF), "EXP": (0.0, INF), "SIN": (NAN, NAN),
                   "COS": (NAN, NAN), "TAN": (NAN, NAN), "ASIN": (NAN, NAN), "ACOS": (NAN, NAN)}
    keeps_sign_of_zero = ("SQRT", "SIN", "TAN", "ASIN", "ATAN")
    for kind in REALS:
        for name, (function, special, (low, high)) in functions.items():
            call = f"{name}($1)"
            put = lambda x, y: table.add(call, kind, [x], kind, y)
            put(NAN, NAN)
            if name == "ATAN":
                put(INF, exact(lambda: mpmath.pi / 2))
                put(-INF, exact(lambda: -mpmath.pi / 2))
            else:
                put(-INF, at_infinity[name][0])
                put(INF, at_infinity[name][1])
            for zero in (0.0, -0.0):
                y = special(zero)
                if y is None and name in keeps_sign_of_zero:
                    y = zero
                put(zero, y if y is not None else settled(kind, exact(function, 0)))
            xs = [tiny[kind], 3 * tiny[kind], normal[kind], normal[kind] * (1 - 2.0**-20), huge[kind], 0.5, 1.0, 1.5, 2.0,
                  3.0, 10.0, 100.0, 1000.0, 1e-5, 1e-10, 0.1, math.pi, math.pi / 2, math.pi / 4, 3 * math.pi / 4,
                  math.e, 88.0, 89.0, 104.0, 710.0, 709.78, 745.0, 746.0, 1e15, 1e22, 2.0**100, 2.0**127, 0.99999994,
                  1.0000001, 5e-8, 1.0 - 2.0**-24]
            if kind == "LREAL":
                xs += [2.0**1000, 2.0**1023, 1e300, 6381956970095103.0 * 2.0**797, 1.0 - 2.0**-53, 1.0 + 2.0**-52, 1e-300]
            xs += [-x for x in xs]
            xs += [rnd.uniform(low, high) for _ in range(25)]
            xs += [rnd.choice((1, -1)) * 2.0**rnd.uniform(-30, 30) for _ in range(10)]
            xs += [from_bits(kind, rnd.getrandbits(WIDTH[kind])) for _ in range(10)]
            for x in xs:
                x = single(x) if kind == "REAL" else x
                if x != x or abs(x) == INF:
                    continue
                if name == "EXP" and abs(x) > 1e6:
                    put(x, INF if x > 0 else 0.0)
                    continue
                y = special(x)
                put(x, y if y is not None else settled(kind, exact(function, x)))

    # atan2 with its 4 × 4 infinities and zeros, by IEEE 754-2008, 9.2.1
    pi = lambda n, d: exact(lambda: mpmath.pi * n / d)
    for kind in REALS:
        put = lambda y, x, r: table.add("ATAN2($1, $2)", f"{kind} {kind}", [y, x], kind, r)
        for s in (1.0, -1.0):
            n = int(s)
            put(s * 0.0, 0.0, s * 0.0)
            put(s * 0.0, 1.0, s * 0.0)
            put(s * 0.0, INF, s * 0.0)
            put(s * 0.0, -0.0, pi(n, 1))
            put(s * 0.0, -1.0, pi(n, 1))
            put(s * 2.0, -INF, pi(n, 1))
            put(s * 2.0, INF, s * 0.0)
            put(s * 2.0, 0.0, pi(n, 2))
            put(s * 2.0, -0.0, pi(n, 2))
            put(s * INF, 3.0, pi(n, 2))
            put(s * INF, INF, pi(n, 4))
            put(s * INF, -INF, pi(3 * n, 4))
        put(NAN, 1.0, NAN)
        put(1.0, NAN, NAN)
        for _ in range(60):
            y, x = (single(rnd.choice((1, -1)) * 2.0**rnd.uniform(-20, 20)) for _ in range(2))
            put(y, x, settled(kind, exact(mpmath.atan2, y, x)))
        for y, x in ((tiny[kind], huge[kind]), (huge[kind], tiny[kind]), (-tiny[kind], 1.0), (1.0, -huge[kind]), (1.0, 1.0)):
            put(y, x, settled(kind, exact(mpmath.atan2, y, x)))

    # pow, by IEEE 754-2008, 9.2.1
    for kind in REALS:
        put = lambda x, y, r: table.add("EXPT($1, $2)", f"{kind} {kind}", [x, y], kind, r)
        for y in (0.0, -0.0):
            for x in (0.0, 1.0, -3.0, INF, NAN):
                put(x, y, 1.0)
        for y in (5.0, -7.5, INF, -INF, NAN):
            put(1.0, y, 1.0)
        for s in (1.0, -1.0):
            put(s * 0.0, -3.0, s * INF)
            put(s * 0.0, -2.0, INF)
            put(s * 0.0, -2.5, INF)
            put(s * 0.0, 3.0, s * 0.0)
            put(s * 0.0, 2.0, 0.0)
            put(s * 0.0, 0.5, 0.0)
            put(s * 0.0, INF, 0.0)
            put(s * 0.0, -INF, INF)
            put(s * 0.5, INF, 0.0)
            put(s * 0.5, -INF, INF)
            put(s * 2.0, INF, INF)
            put(s * 2.0, -INF, 0.0)
        put(-1.0, INF, 1.0)
        put(-1.0, -INF, 1.0)
        put(-INF, -3.0, -0.0)
        put(-INF, -2.0, 0.0)
        put(-INF, 3.0, -INF)
        put(-INF, 2.0, INF)
        put(-INF, 0.5, INF)
        put(INF, 0.5, INF)
        put(INF, -0.5, 0.0)
        put(-2.0, 0.5, NAN)
        put(-2.0, 1e-3 if kind == "LREAL" else single(1e-3), NAN)
        put(NAN, 2.0, NAN)
        put(2.0, NAN, NAN)
        pairs = [(2.0, 10.0), (2.0, -10.0), (-2.0, 3.0), (-2.0, 4.0), (10.0, 5.0), (2.0, 0.5), (9.0, 0.5), (10.0, -3.0),
                 (2.0, 127.0), (2.0, -149.0), (2.0, -150.0), (2.0, 128.0), (2.0, 1023.0), (2.0, 1024.0), (2.0, -1074.0),
                 (2.0, -1076.0), (-3.0, 33.0), (1.0000001, 1e8), (0.9999999, 1e8), (1.5, 100.0), (7.0, 20.0)]
        pairs += [(2.0**rnd.uniform(-6, 6), rnd.uniform(-12, 12)) for _ in range(50)]
        for x, y in pairs:
            x, y = (single(x), single(y)) if kind == "REAL" else (x, y)
            put(x, y, settled(kind, exact(mpmath.power, x, y)))
    table.write()


# ---------------------------------------------------------------------------------------------------------------------
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


def widened(kind):
    return kind if WIDTH[kind] >= 32 else "DWORD" if kind in BITS else "DINT"


def ieee(op, a, b, kind):
    """a op b, rounded once."""
    if a != a or b != b:
        return NAN
    try:
        if abs(a) == INF or abs(b) == INF or a == 0 or b == 0:  # exact, or decided by signs
            return {"ADD": lambda: a + b, "SUB": lambda: a - b, "MUL": lambda: a * b, "DIV": lambda: a / b}[op]()
    except ZeroDivisionError:
        sign = math.copysign(1, a) * math.copysign(1, b)
        return NAN if a == 0 else sign * INF
    x, y = Fraction(a), Fraction(b)
    r = {"ADD": x + y, "SUB": x - y, "MUL": x * y, "DIV": x / y}[op]
    value = rounded(kind, r)
    if value == 0 and op in ("MUL", "DIV"):
        return math.copysign(0.0, math.copysign(1, a) * math.copysign(1, b))
    return math.copysign(0.0, r) if value == 0 and r != 0 else value


def cut(a, b):
    q = abs(a) // abs(b)
    return q if (a < 0) == (b < 0) else -q


def numeric():
    table = Table("numeric")
    rnd = table.random
    for kind in INTEGERS:
        wide = widened(kind)
        values = integers_of(kind, rnd, 4)
        for v in values:
            table.add("ABS($1)", kind, [v], kind, wrap(kind, abs(v)))
        pairs = [(rnd.choice(values), rnd.choice(values)) for _ in range(12)]
        low, high = limits(kind)
        pairs += [(low, high), (high, low), (low, low), (high, high)]
        if low < 0:
            pairs.append((low, -1))
        for a, b in pairs:
            table.add("MIN($1, $2)", f"{kind} {kind}", [a, b], kind, min(a, b))
            table.add("MAX($1, $2)", f"{kind} {kind}", [a, b], kind, max(a, b))
            for name, sign in (("ADD", "+"), ("SUB", "-"), ("MUL", "*")):
                r = wrap(wide, {"ADD": a + b, "SUB": a - b, "MUL": a * b}[name])
                table.add(f"$1 {sign} $2", f"{kind} {kind}", [a, b], wide, r)
                table.third(f"{name}($1, $2)", f"{kind} {kind}", [a, b], wide, r)
            if b != 0:
                table.add("$1 / $2", f"{kind} {kind}", [a, b], wide, wrap(wide, cut(a, b)))
                table.third("DIV($1, $2)", f"{kind} {kind}", [a, b], wide, wrap(wide, cut(a, b)))
                table.add("$1 MOD $2", f"{kind} {kind}", [a, b], wide, wrap(wide, a - b * cut(a, b)))
            for sign, name, r in ((">", "GT", a > b), (">=", "GE", a >= b), ("=", "EQ", a == b), ("<=", "LE", a <= b),
                                  ("<", "LT", a < b), ("<>", "NE", a != b)):
                table.add(f"$1 {sign} $2", f"{kind} {kind}", [a, b], "BOOL", int(r))
                table.third(f"{name}($1, $2)", f"{kind} {kind}", [a, b], "BOOL", int(r))
        for _ in range(8):
            a, b, c = (rnd.choice(values) for _ in range(3))
            table.add("LIMIT($1, $2, $3)", f"{kind} {kind} {kind}", [a, b, c], kind, min(max(b, a), c))
            table.add("MAX($1, $2, $3)", f"{kind} {kind} {kind}", [a, b, c], kind, max(a, b, c))
            table.add("SEL($1, $2, $3)", f"BOOL {kind} {kind}", [a & 1, b, c], kind, c if a & 1 else b)
            table.add("MUX($1, $2, $3, $4)", f"INT {kind} {kind} {kind}", [a % 3, a, b, c], kind, (a, b, c)[a % 3])
            table.third("GT($1, $2, $3)", f"{kind} {kind} {kind}", [a, b, c], "BOOL", int(a > b > c))
            table.third("LE($1, $2, $3)", f"{kind} {kind} {kind}", [a, b, c], "BOOL", int(a <= b <= c))
            table.third("EQ($1, $2, $3)", f"{kind} {kind} {kind}", [a, b, b], "BOOL", int(a == b))
            table.third("ADD($1, $2, $3)", f"{kind} {kind} {kind}", [a, b, c], wide, wrap(wide, a + b + c))
            table.third("MUL($1, $2, $3)", f"{kind} {kind} {kind}", [a, b, c], wide, wrap(wide, a * b * c))
    for kind in REALS:
        values = some_reals(kind, rnd, 12)
        for v in values:
            table.add("ABS($1)", kind, [v], kind, abs(v))
            table.third("IS_VALID($1)", kind, [v], "BOOL", int(v == v and abs(v) != INF))
        for _ in range(60):
            a, b = rnd.choice(values), rnd.choice(values)
            for name, sign in (("ADD", "+"), ("SUB", "-"), ("MUL", "*"), ("DIV", "/")):
                table.add(f"$1 {sign} $2", f"{kind} {kind}", [a, b], kind, ieee(name, a, b, kind))
                table.third(f"{name}($1, $2)", f"{kind} {kind}", [a, b], kind, ieee(name, a, b, kind))
            for sign, name, r in ((">", "GT", a > b), (">=", "GE", a >= b), ("=", "EQ", a == b), ("<=", "LE", a <= b),
                                  ("<", "LT", a < b), ("<>", "NE", a != b)):
                table.add(f"$1 {sign} $2", f"{kind} {kind}", [a, b], "BOOL", int(r))
                table.third(f"{name}($1, $2)", f"{kind} {kind}", [a, b], "BOOL", int(r))
            if a == a and b == b and (a != b or a != 0):
                table.add("MIN($1, $2)", f"{kind} {kind}", [a, b], kind, min(a, b))
                table.add("MAX($1, $2)", f"{kind} {kind}", [a, b], kind, max(a, b))
    table.write()


# ---------------------------------------------------------------------------------------------------------------------
def bits():
    table = Table("bits")
    rnd = table.random
    for kind, width in INTEGERS.items():
        mask = (1 << width) - 1
        for _ in range(14):
            v = rnd.choice(integers_of(kind, rnd, 3))
            n = rnd.choice([0, 1, 2, 3, 7, 8, 9, 15, 16, 31, 32, 33, 63, 64, 65, 1000, -1, -3, -64, rnd.randrange(width)])
            outside = n < 0 or n >= width
            types = f"{kind} INT"
            table.add("SHL($1, $2)", types, [v, n], kind, 0 if outside else wrap(kind, v << n))
            table.add("SHR($1, $2)", types, [v, n], kind, (-1 if v < 0 else 0) if outside else v >> n)
            k = n % width
            u = v & mask
            left = (u << k | u >> width - k) & mask
            right = (u >> k | u << width - k) & mask
            table.add("ROL($1, $2)", types, [v, n], kind, wrap(kind, left))
            table.add("ROR($1, $2)", types, [v, n], kind, wrap(kind, right))
    table.write()


# ---------------------------------------------------------------------------------------------------------------------
def patterns(table):
    """Byte order and decimal digits, for edition 3's table."""
    rnd = table.random
    for kind, width in INTEGERS.items():
        mask = (1 << width) - 1
        for v in integers_of(kind, rnd, 4):
            swapped = int.from_bytes((v & mask).to_bytes(width // 8, "little"), "big")
            for name in ("TO_BIG_ENDIAN", "FROM_BIG_ENDIAN"):
                table.third(f"{name}($1)", kind, [v], kind, wrap(kind, swapped))
            for name in ("TO_LITTLE_ENDIAN", "FROM_LITTLE_ENDIAN"):
                table.third(f"{name}($1)", kind, [v], kind, v)
    for kind in TIMES:
        for v in [rnd.randrange(1 << 24) for _ in range(2)]:
            if kind in ("DATE", "LDATE"):
                v = v // 4096 * (86400 * 10**9 // UNIT[kind])
            swapped = int.from_bytes(v.to_bytes(WIDTH[kind] // 8, "little"), "big")
            table.third("TO_BIG_ENDIAN($1)", kind, [v], kind, wrap(kind, swapped))

    def digits(v):
        text = f"{v:X}"
        return int(text) if text.isdigit() else None

    for kind, width in BITS.items():
        number = {8: "USINT", 16: "UINT", 32: "UDINT", 64: "ULINT"}[width]
        values = [0, 1, 9, 16, 0x99, 0x0A, 0xA0, (1 << width) - 1, int("9" * (width // 4), 16), 0x12 << width - 8]
        values += [int("".join(rnd.choice("0123456789") for _ in range(width // 4)), 16) for _ in range(8)]
        values += [rnd.getrandbits(width) for _ in range(4)]
        for v in values:
            d = digits(v)
            table.third("IS_VALID_BCD($1)", kind, [v], "BOOL", int(d is not None))
            table.third(f"{kind}_BCD_TO_{number}($1)", kind, [v], number, d or 0)
            table.third(f"BCD_TO_{number}($1)", kind, [v], number, d or 0)
            table.third(f"{kind}_BCD_TO_USINT($1)", kind, [v], "USINT", (d or 0) & 255)
        for n in integers_of(number, rnd, 5) + [9, 10, 99, 100]:
            text = str(n)[-(width // 4):]
            table.third(f"{number}_TO_BCD_{kind}($1)", number, [n], kind, int(text, 16))
            table.third(f"TO_BCD_{kind}($1)", number, [n], kind, int(text, 16))
            table.third("TO_BCD_BYTE($1)", number, [n], "BYTE", int(str(n)[-2:], 16))


# ---------------------------------------------------------------------------------------------------------------------
def to_integer(x, kind, cutting=False):
    if x != x:
        return 0
    if abs(x) == INF:
        return limits(kind)[1 if x > 0 else 0]
    return saturate(kind, int(x) if cutting else half_away(Fraction(x)))


def between_times(value, source, target):
    """Units are converted, rounded down."""
    return held(target, wrap("LTIME", value * UNIT[source]) // UNIT[target])


def turned(kind, clock, time, way):
    """A time of day after a duration, or before it. Less than a day below the wrap a TIME is one below 0."""
    if way[1] == "TIME" and time > 2**32 - 86400000:
        time -= 2**32
    return (clock * UNIT[kind] + way[0] * time * UNIT[way[1]]) // UNIT[kind] % (DAY // UNIT[kind])


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


def conversions():
    table = Table("conversions")
    rnd = table.random
    put = lambda a, b, x, y: table.add(f"{a}_TO_{b}($1)", a, [x], b, y)
    # integers among each other, with BOOL and to reals
    for a in INTEGERS:
        values = integers_of(a, rnd, 2)
        for b in INTEGERS:
            if a != b:
                for v in rnd.sample(values, 4) + [limits(a)[1]]:
                    put(a, b, v, wrap(b, v))
        for v in values:
            put(a, "BOOL", v, int(v != 0))
            put(a, "LREAL", v, double(Fraction(v)))
            put(a, "REAL", v, single(Fraction(v)))
            table.add(f"TO_REAL($1)", a, [v], "REAL", single(Fraction(v)))
        for t in TIMES:
            for v in rnd.sample(values, 2):
                put(a, t, v, held(t, v))
        for v in (0, 1):
            put("BOOL", a, v, v)
    for v in (2**24 + 1, 2**53 + 1, 2**53 + 3, 2**62 + 2**38 + 1, 2**62 + 3 * 2**38 - 1, 2**63 - 1, 2**63 - 513,
              2**54 + 2**30 + 1, 9007199791611905):
        for kind in ("LINT", "ULINT", "LWORD"):
            put(kind, "REAL", v, single(Fraction(v)))
            put(kind, "LREAL", v, double(Fraction(v)))
    for v in (2**64 - 1, 2**63 + 2**39, 2**63 + 2**39 + 1, 2**63 + 1025):
        put("ULINT", "REAL", v, single(Fraction(v)))
        put("ULINT", "LREAL", v, double(Fraction(v)))
    # reals
    for kind in REALS:
        for b in {**INTEGERS, **TIMES}:
            low, high = limits(b)
            xs = [0.0, -0.0, 0.5, -0.5, 0.49999997, 1.5, -1.5, 2.5, -2.5, 1e30, -1e30, INF, -INF, NAN]
            if kind == "LREAL":
                xs += [0.49999999999999994, -0.49999999999999994]
            for limit in (low, high):
                xs += [float(limit), limit + 0.5, limit - 0.5, limit + 0.25, limit + 1.0, limit - 1.0]
            xs += [rnd.uniform(low, high) for _ in range(2)]
            for x in xs:
                x = single(x) if kind == "REAL" else x
                put(kind, b, x, held(b, to_integer(x, b)))
                if b in SIGNED or b in UNSIGNED:
                    table.third(f"{kind}_TRUNC_{b}($1)", kind, [x], b, to_integer(x, b, True))
        for x in (0.0, -0.0, 0.9999999, -0.9999999, 2.5, -2.5, 2147483647.5, -2147483648.5, 1e20, -1e20, INF, -INF, NAN):
            x = single(x) if kind == "REAL" else x
            table.add("TRUNC($1)", kind, [x], "DINT", to_integer(x, "DINT", True))
            table.third("TRUNC_INT($1)", kind, [x], "INT", to_integer(x, "INT", True))
            put(kind, "BOOL", x, int(x != 0 or x != x))
        put("BOOL", kind, 1, 1.0)
    for x in [0.1, 1.0 + 2.0**-24, 1.0 + 3 * 2.0**-24, 1.0 + 2.0**-24 + 2.0**-50, 2.0**-150, 3 * 2.0**-150, 2.0**-151, 2.0**128,
              3.4028235677973366e38, 3.4028235677973362e38, -1e300, -0.0, INF, NAN] + \
            [rnd.uniform(-1, 1) * 10.0**rnd.randint(-44, 38) for _ in range(20)]:
        put("LREAL", "REAL", x, math.copysign(single(x), x) if x == x else x)
    for x in some_reals("REAL", rnd, 5):
        put("REAL", "LREAL", x, x)
    # times among each other and to numbers
    for a in TIMES:
        values = time_values(a, rnd, 3)
        for b in TIMES:
            if a != b:
                for v in values:
                    put(a, b, v, between_times(v, a, b))
        for v in values:
            for b in ("BYTE", "INT", "UDINT", "LINT", "ULINT"):
                put(a, b, v, wrap(b, v))
            for b in ("SINT", "DINT", "USINT", "UINT", "WORD", "DWORD", "LWORD"):
                put(a, b, v, wrap(b, v))
            put(a, "BOOL", v, int(v != 0))
            put(a, "LREAL", v, double(Fraction(v)))
            put(a, "REAL", v, single(Fraction(v)))
        for v in (0, 1):
            put("BOOL", a, v, held(a, v))
    table.write()


# ---------------------------------------------------------------------------------------------------------------------
def real_text(x, kind):
    """The shortest digits that read back as the value; plain or with exponent, whichever is shorter; at least one decimal."""
    if x != x:
        return "NaN"
    if abs(x) == INF:
        return "Infinity" if x > 0 else "-Infinity"
    sign = "-" if math.copysign(1, x) < 0 else ""
    x = abs(x)
    if x == 0:
        return sign + "0.0"
    for n in range(17):
        text = f"{x:.{n}e}"
        if (single(float(text)) if kind == "REAL" else float(text)) == x:
            break
    mantissa, exponent = text.split("e")
    exponent = int(exponent)
    digits = mantissa.replace(".", "").rstrip("0") or "0"
    scientific = digits[0] + ("." + digits[1:] if len(digits) > 1 else "") + f"e{'-' if exponent < 0 else '+'}{abs(exponent):02}"
    if exponent < 0:
        plain = "0." + "0" * (-exponent - 1) + digits
    elif exponent + 1 >= len(digits):
        plain = str(int(x))
    else:
        plain = digits[:exponent + 1] + "." + digits[exponent + 1:]
    best = plain if len(plain) <= len(scientific) else scientific
    if "." not in best:
        best = best.replace("e", ".0e") if "e" in best else best + ".0"
    return sign + best


def time_text(kind, v):
    if kind in ("TIME", "LTIME"):
        ns = abs(v) * UNIT[kind]
        text = ""
        for unit, size in (("d", DAY), ("h", 3600 * 10**9), ("m", 60 * 10**9), ("s", 10**9), ("ms", 10**6), ("us", 1000),
                           ("ns", 1)):
            n, ns = divmod(ns, size)
            text += f"{n}{unit}" if n else ""
        return ("T#" if kind == "TIME" else "LTIME#") + ("-" if v < 0 else "") + (text or "0ms")
    days, clock = divmod(v * UNIT[kind], DAY)
    fraction = clock % 10**9
    places = 0 if fraction == 0 else 3 if fraction % 10**6 == 0 else 6 if fraction % 1000 == 0 else 9
    if kind in ("DATE", "LDATE"):
        return ("D#" if kind == "DATE" else "LDATE#") + date_text(days)
    if kind in ("TOD", "LTOD"):
        return f"{kind}#" + clock_text(clock, places)
    return f"{kind}#" + date_text(days) + "-" + clock_text(clock, places)


def texts():
    table = Table("texts")
    rnd = table.random
    put = lambda a, x, y: (table.add(f"{a}_TO_STRING($1)", a, [x], "STRING(80)", y),
                           table.add(f"{a}_TO_WSTRING($1)", a, [x], "WSTRING(80)", y))
    parse = lambda b, text, y: (table.add(f"STRING_TO_{b}($1)", "STRING(80)", [text], b, y),
                                table.add(f"WSTRING_TO_{b}($1)", "WSTRING(80)", [text], b, y))
    for kind in INTEGERS:
        low, high = limits(kind)
        for v in integers_of(kind, rnd, 3):
            put(kind, v, str(v))
            parse(kind, str(v), v)
        for text, v in (("", 0), ("abc", 0), ("12abc", 12), ("  42", 42), ("+7", 7), ("-1", -1), ("16#7F", 127), ("2#101", 5),
                        ("1_000", 1000), ("- 5", 0), (str(high + 1), high + 1), (str(low - 1), low - 1), ("3.9", 3)):
            parse(kind, text, wrap(kind, v))
    for v in (0, 1):
        put("BOOL", v, "TRUE" if v else "FALSE")
    for text, v in (("TRUE", 1), ("true", 1), ("FALSE", 0), ("1", 1), ("0", 0), ("", 0), ("yes", 0)):
        parse("BOOL", text, v)
    for kind in REALS:
        for x in some_reals(kind, rnd, 20) + [100.0, 1e20, 123456.75, 1e22, 1e-5, 0.001, 1e15, 1e16, 1e17]:
            x = single(x) if kind == "REAL" else x
            put(kind, x, real_text(x, kind))
            if x == x:
                parse(kind, real_text(x, kind), x)
        for text, x in (("", 0), ("x", 0), ("1", 1), ("1.5e3", 1500), ("-2.5E-2", Fraction(-1, 40)), ("1e", 1), ("1.5.2", Fraction(3, 2)),
                        ("  7", 7), ("1_000.5", Fraction(2001, 2)), ("5.", 5), (".5", Fraction(1, 2)), ("-.5", Fraction(-1, 2)),
                        ("+.5e-3", Fraction(1, 2000)), ("-5.", -5), ("5.e3", 5000), (".25E+1", Fraction(5, 2)), ("+7", 7), (".", 0), ("-.", 0),
                        (".e5", 0), ("e5", 0), ("..5", 0), ("-", 0), ("+", 0), ("- 5", 0), ("--5", 0), ("+-5", 0), ("5 ", 5), (" .5 ", Fraction(1, 2)),
                        ("\t.5", Fraction(1, 2)), ("5. 5", 5), ("._5", 0), (".5_5", Fraction(11, 20)), ("5_.5", 5), ("5,5", 5), (".5.5", Fraction(1, 2)),
                        ("1e5", 10**5), ("1E+5", 10**5), ("1e-5", Fraction(1, 10**5)), ("1 e5", 1), ("1e 5", 1), ("1e5.5", 10**5), ("0x10", 0),
                        ("16#10", 16), ("1.e", 1), ("00.50", Fraction(1, 2)), ("0.0001e4", 1), ("100000e-5", 1)):
            parse(kind, text, rounded(kind, Fraction(x)))
        parse(kind, "1e400", INF)
        parse(kind, "-1e400", -INF)
        parse(kind, "1e-400", 0.0)
        # beyond the range or below it, wherever the digits stand
        for text, x in (("0.1e400", INF), (".1e400", INF), ("00001e400", INF), ("0.00001e-400", 0.0), (".1e-400", 0.0),
                        ("1" + 60 * "0" + "e-400", 0.0), ("0." + 60 * "0" + "1e400", INF), ("1e99999999999999999999", INF),
                        ("1e-99999999999999999999", 0.0), ("-0.1e400", -INF)):
            parse(kind, text, x)
        parse(kind, "nan", NAN)
        # between two values, just above and below the middle
        for text in ("16777217", "16777217.0000001", "16777216.9999999", "9007199254740993", "9007199254740993.0001",
                     "1.00000005960464477540", "1.00000005960464477539", "1.00000005960464477538",
                     "2.2250738585072011e-308", "7.0064923216240854e-46", "7.0064923216240853e-46", "3.4028235677973366e38",
                     "3.4028235677973365e38"):
            parse(kind, text, rounded(kind, Fraction(text)))
    for kind in TIMES:
        for v in time_values(kind, rnd, 6):
            text = time_text(kind, v)
            put(kind, v, text)
            parse(kind, text, v)
            parse(kind, text.split("#")[1], v)
        parse(kind, "", 0)
        parse(kind, "rubbish", 0)
    for text, ms in (("T#1d2h3m4s5ms", 93784005), ("t#1.5s", 1500), ("TIME#90m", 5400000), ("2h_30m", 9000000), ("T#100", 0),
                     ("T#1s1s", 1000), ("T#5ms 3", 5)):
        parse("TIME", text, ms)
    for text, days in (("D#2000-02-29", 11016), ("D#2100-02-29", 0), ("2001-02-29", 0), ("DATE#1972-02-29", 789),
                       ("D#1999-13-01", 0), ("D#1999-12-32", 0)):
        parse("DATE", text, days * 86400)
    table.write()


# ---------------------------------------------------------------------------------------------------------------------
def strings():
    """Positions count from 1, those below count as 1; counts below 0 as 0; what is not there is not taken."""
    table = Table("strings")
    rnd = table.random

    def cut_out(s, n, p):
        at = max(p, 1) - 1
        return s[at:at + max(n, 0)]

    def spliced(s, what, n, p):
        at = min(max(p, 1) - 1, len(s))
        return s[:at] + what + s[at + max(n, 0):]

    alphabets = {"STRING": "abcäöÿ $'\"01~", "WSTRING": "abcäΩЖ€ $'\"01~"}
    for name, alphabet in alphabets.items():
        word = lambda n: "".join(rnd.choice(alphabet) for _ in range(n))
        for length in (1, 80, 255):
            kind = f"{name}({length})"
            result = f"{name}(255)"
            texts_ = ["", word(1), word(length), word(length - 1) if length > 1 else "x", word(max(1, length // 2))]
            for _ in range(14):
                s, t = rnd.choice(texts_), rnd.choice(texts_ + ["b", "ab", "", "a"])[:length]
                n = rnd.choice([-1, 0, 1, 2, 3, length // 2, length - 1, length, length + 1, 300, 32767])
                p = rnd.choice([-5, -1, 0, 1, 2, 3, length // 2, length, length + 1, length + 2, 300, 32767])
                two, num = f"{kind} {kind}", f"{kind} INT"
                table.add("LEN($1)", kind, [s], "INT", len(s))
                table.add("LEFT($1, $2)", num, [s, n], result, s[:max(n, 0)])
                table.add("RIGHT($1, $2)", num, [s, n], result, s[len(s) - min(max(n, 0), len(s)):])
                table.add("MID($1, $2, $3)", num + " INT", [s, n, p], result, cut_out(s, n, p))
                table.add("DELETE($1, $2, $3)", num + " INT", [s, n, p], result, spliced(s, "", n, p))
                table.add("CONCAT($1, $2)", two, [s, t], result, (s + t)[:255])
                at = min(max(p, 0), len(s))
                table.add("INSERT($1, $2, $3)", two + " INT", [s, t, p], result, (s[:at] + t + s[at:])[:255])
                table.add("REPLACE($1, $2, $3, $4)", two + " INT INT", [s, t, n, p], result, spliced(s, t, n, p)[:255])
                table.add("FIND($1, $2)", two, [s, t], "INT", s.find(t) + 1 if t else 0)
                table.add("$1 < $2", two, [s, t], "BOOL", int(s < t))
                table.add("$1 >= $2", two, [s, t], "BOOL", int(s >= t))
                table.add("$1 = $2", two, [s, t], "BOOL", int(s == t))
                table.third("GE($1, $2)", two, [s, t], "BOOL", int(s >= t))
                table.third("EQ($1, $2, $1)", two, [s, t], "BOOL", int(s == t))
                if name == "WSTRING":
                    table.third("WLEN($1)", kind, [s], "INT", len(s))
                    table.third("WLEFT($1, $2)", num, [s, n], result, s[:max(n, 0)])
                    table.third("WCONCAT($1, $2)", two, [s, t], result, (s + t)[:255])
                    table.third("WREPLACE($1, $2, $3, $4)", two + " INT INT", [s, t, n, p], result, spliced(s, t, n, p)[:255])
                    table.third("WFIND($1, $2)", two, [s, t], "INT", s.find(t) + 1 if t else 0)
                table.add("MAX($1, $2)", two, [s, t], result, max(s, t))
                u = "x€"[:n % 2] if name == "WSTRING" else "xy"[:n % 3]
                table.add("CONCAT($1, $2, $3)", f"{two} {name}(20)", [s, t, u], result, (s + t + u)[:255])
                table.add("CONCAT($1, $2, $3, $1)", f"{two} {name}(20)", [s, t, u], result, (s + t + u + s)[:255])
    # numbers of characters at the limits of their types: what is large stays large
    word = "abcdef"
    for kind in ("USINT", "DINT", "UDINT", "DWORD", "LINT", "ULINT", "LWORD"):
        for n in sorted({3, *limits(kind), limits(kind)[1] // 2 + 1}):
            one = f"STRING(20) {kind}"
            table.add("LEFT($1, $2)", one, [word, n], "STRING(20)", word[:max(n, 0)])
            table.add("RIGHT($1, $2)", one, [word, n], "STRING(20)", word[max(6 - max(n, 0), 0):])
            for p in (3, n):
                table.add("MID($1, $2, $3)", f"{one} {kind}", [word, n, p], "STRING(20)", cut_out(word, n, p))
                table.add("DELETE($1, $2, $3)", f"{one} {kind}", [word, n, p], "STRING(20)", spliced(word, "", n, p))
                table.add("REPLACE($1, $2, $3, $4)", f"STRING(20) STRING(20) {kind} {kind}", [word, "x", n, p], "STRING(20)",
                          spliced(word, "x", n, p))
            at = min(max(n, 0), 6)
            table.add("INSERT($1, $2, $3)", f"STRING(20) STRING(20) {kind}", [word, "x", n], "STRING(20)", word[:at] + "x" + word[at:])
    # at the limit of INT and beyond
    for name, length in (("STRING", 32767), ("STRING", 32768), ("WSTRING", 32768)):
        kind = f"{name}({length})"
        table.add("LEN($1)", kind, ["a" * length], "DINT" if length > 32767 else "INT", length)
    kind = "STRING(32769)"
    table.add("FIND($1, $2)", f"{kind} STRING(80)", ["a" * 32767 + "bc", "bc"], "DINT", 32768)
    # characters that take two places
    face = "\U0001F600"
    kind = "WSTRING(20)"
    table.add("LEN($1)", kind, [face], "INT", 2)
    table.add("LEN($1)", kind, ["a" + face + "b"], "INT", 4)
    table.add("LEFT($1, $2)", f"{kind} INT", ["a" + face + "b", 3], kind, "a" + face)
    table.add("LEN(LEFT($1, $2))", f"{kind} INT", ["a" + face + "b", 2], "INT", 2)
    table.add("MID($1, $2, $3)", f"{kind} INT INT", ["a" + face + "b", 2, 2], kind, face)
    table.add("RIGHT($1, $2)", f"{kind} INT", ["a" + face + "b", 3], kind, face + "b")
    table.add("FIND($1, $2)", f"{kind} {kind}", ["a" + face + "b", "b"], "INT", 4)
    table.add("FIND($1, $2)", f"{kind} {kind}", ["a" + face + "b", face], "INT", 2)
    table.add("DELETE($1, $2, $3)", f"{kind} INT INT", ["a" + face + "b", 2, 2], kind, "ab")
    table.add("WSTRING_TO_STRING($1)", kind, ["aΩ" + face + "é"], "STRING(80)", "a???é")
    table.add("STRING_TO_WSTRING($1)", "STRING(20)", ["aéÿ"], "WSTRING(80)", "aéÿ")
    table.write()


# ---------------------------------------------------------------------------------------------------------------------
def dates():
    table = Table("dates")
    rnd = table.random

    def pairs(a, b, n=6):
        one, two = time_values(a, rnd, 6), time_values(b, rnd, 6)
        return [(rnd.choice(one), rnd.choice(two)) for _ in range(n)] + [(one[-1], two[0]), (one[0], two[-1]), (one[0], two[0])]

    # one kind with the fraction of the other
    day = 86400000
    for a, b in [(0, -1), (0, 1), (day - 1, 999999), (day - 1, 10**6), (1, -10**6 - 1), (5, 2**63 - 1), (5, -2**63)]:
        table.add("$1 + $2", "TOD LTIME", [a, b], "TOD", turned("TOD", a, b, (1, "LTIME")))
        table.add("$1 - $2", "TOD LTIME", [a, b], "TOD", turned("TOD", a, b, (-1, "LTIME")))
        table.add("$1 + $2", "LTOD LTIME", [a, b], "LTOD", turned("LTOD", a, b, (1, "LTIME")))
    for a, b in [(0, 1), (10**6, 2**32 - 1), (0, 2**32 - 1), (86400 * 10**9 - 1, 1), (5, 2**32 - day), (5, 2**32 - day + 1)]:
        table.add("$1 + $2", "LTOD TIME", [a, b], "LTOD", turned("LTOD", a, b, (1, "TIME")))
        table.add("$1 - $2", "LTOD TIME", [a, b], "LTOD", turned("LTOD", a, b, (-1, "TIME")))
    for p in ("", "L"):
        time, tod, dt, date = p + "TIME", p + "TOD", p + "DT", p + "DATE"
        for a, b in pairs(time, time, 10):
            table.add(f"ADD_{time}($1, $2)", f"{time} {time}", [a, b], time, wrap(time, a + b))
            table.add(f"SUB_{time}($1, $2)", f"{time} {time}", [a, b], time, wrap(time, a - b))
            table.add("$1 < $2", f"{time} {time}", [a, b], "BOOL", int(a < b))
            table.third("ADD($1, $2)", f"{time} {time}", [a, b], time, wrap(time, a + b))
            table.third("LT($1, $2)", f"{time} {time}", [a, b], "BOOL", int(a < b))
            table.add("MAX($1, $2)", f"{time} {time}", [a, b], time, max(a, b))
        for kind in (tod, dt):
            for a, b in pairs(kind, time, 10):
                # exact, then rounded down to the type's unit
                later = turned(kind, a, b, (1, time)) if kind == tod else wrap(kind, (a * UNIT[kind] + b * UNIT[time]) // UNIT[kind])
                table.add(f"ADD_{kind}_{time}($1, $2)", f"{kind} {time}", [a, b], kind, later)
                table.add("$1 + $2", f"{kind} {time}", [a, b], kind, later)
                table.third("ADD($1, $2)", f"{kind} {time}", [a, b], kind, later)
                earlier = turned(kind, a, b, (-1, time)) if kind == tod else wrap(kind, (a * UNIT[kind] - b * UNIT[time]) // UNIT[kind])
                table.add(f"SUB_{kind}_{time}($1, $2)", f"{kind} {time}", [a, b], kind, earlier)
        day = DAY // UNIT[tod]
        for a, b in [(0, 1), (day - 1, 1), (day - 1, 0), (0, day - 1), (day - 1, day), (1, 2 * day - 1), (day // 2, 40 * day)]:
            table.add("$1 + $2", f"{tod} {time}", [a, b], tod, (a + b) % day)
            table.add("$1 - $2", f"{tod} {time}", [a, b], tod, (a - b) % day)
            if b < day:  # a difference below 0 leads back
                table.add("$1 + ($2 - $1)", f"{tod} {tod}", [a, b], tod, b)
                table.add("$1 - ($1 - $2)", f"{tod} {tod}", [a, b], tod, b)
        for kind in (tod, dt, date):
            for a, b in pairs(kind, kind, 10):
                table.add(f"SUB_{kind}_{kind}($1, $2)", f"{kind} {kind}", [a, b], time,
                          wrap(time, (a - b) * UNIT[kind] // UNIT[time]))
        for a in time_values(time, rnd, 4):
            for b in (0, 1, 3, 7, -1 if p else 2, rnd.randint(2, 1000)):
                table.add("$1 * $2", f"{time} INT", [a, b], time, wrap(time, a * b))
                for name in (f"MUL_{time}",) if p else ("MUL_TIME", "MULTIME", "MUL"):
                    table.third(f"{name}($1, $2)", f"{time} INT", [a, b], time, wrap(time, a * b))
                if b != 0:
                    table.add("$1 / $2", f"{time} INT", [a, b], time, wrap(time, cut(a, b)))
                    for name in (f"DIV_{time}",) if p else ("DIV_TIME", "DIVTIME", "DIV"):
                        table.third(f"{name}($1, $2)", f"{time} INT", [a, b], time, wrap(time, cut(a, b)))
    for a in (0, 1, 3, 1000, 86400000):
        for f in (0.5, 0.25, 2.5, 0.0):
            table.add("$1 * $2", "TIME LREAL", [a, f], "TIME", half_away(a * Fraction(f)))
            table.third("MUL_TIME($1, $2)", "TIME LREAL", [a, f], "TIME", half_away(a * Fraction(f)))
            if f:
                table.add("$1 / $2", "TIME LREAL", [a, f], "TIME", half_away(a / Fraction(f)))
                table.third("DIV_TIME($1, $2)", "TIME LREAL", [a, f], "TIME", half_away(a / Fraction(f)))

    days = [datetime.date(*d) for d in ((1970, 1, 1), (1972, 2, 29), (1999, 12, 31), (2000, 2, 28), (2000, 2, 29), (2000, 3, 1),
                                        (2000, 12, 31), (2024, 2, 29), (2038, 1, 19), (2100, 2, 28), (2100, 3, 1), (2106, 2, 6))]
    days += [datetime.date.fromordinal(EPOCH + rnd.randrange(49710)) for _ in range(20)]
    far = [datetime.date(*d) for d in ((1677, 9, 22), (1900, 2, 28), (1900, 3, 1), (1969, 12, 31), (2200, 2, 28), (2262, 4, 10))]
    number = lambda d: d.toordinal() - EPOCH
    for d in days + far:
        for date in ("DATE", "LDATE"):
            if date == "DATE" and d in far:
                continue
            unit = DAY // UNIT[date]
            v = number(d) * unit
            table.add(f"CONCAT_{date}($1, $2, $3)", "INT INT INT", [d.year, d.month, d.day], date, v)
            table.add("DAY_OF_WEEK($1)", date, [v], "INT", d.isoweekday() % 7)
            for part, kind, value in (("YEAR", "UINT", d.year), ("MONTH", "USINT", d.month), ("DAY", "USINT", d.day)):
                table.add(f"SPLIT_{date}($1, {part} => $r)", date, [v], kind, value)
    # parts beyond their ranges carry on
    for y, m, d in ((2023, 13, 1), (2024, 0, 31), (2024, -11, 1), (2024, 3, 0), (2023, 2, 29), (2024, 1, 366), (2000, 25, -3)):
        years, month = divmod(m - 1, 12)
        v = number(datetime.date(y + years, month + 1, 1)) + d - 1
        table.add("CONCAT_DATE($1, $2, $3)", "INT INT INT", [y, m, d], "DATE", v * 86400)
    for _ in range(30):
        h, m, s, ms, us, ns = (rnd.randrange(24), rnd.randrange(60), rnd.randrange(60), rnd.randrange(1000), rnd.randrange(1000),
                               rnd.randrange(1000))
        d = rnd.choice(days)
        tod = ((h * 60 + m) * 60 + s) * 1000 + ms
        ltod = tod * 10**6 + us * 1000 + ns
        dt = number(d) * 86400 + tod // 1000
        if dt >= 2**32:
            continue
        ldt = number(d) * DAY + ltod
        four, six, three = "INT INT INT INT", "INT INT INT INT INT INT", "INT INT INT"
        table.add("CONCAT_TOD($1, $2, $3, $4)", four, [h, m, s, ms], "TOD", tod)
        table.add("CONCAT_LTOD($1, $2, $3, $4, $5, $6)", six, [h, m, s, ms, us, ns], "LTOD", ltod)
        table.add("CONCAT_LTOD($1, $2, $3, $4)", four, [h, m, s, ms], "LTOD", tod * 10**6)
        table.add("CONCAT_DT($1, $2, $3, $4, $5, $6, $7)", f"{three} {four}", [d.year, d.month, d.day, h, m, s, ms], "DT", dt)
        table.add("CONCAT_LDT($1, $2, $3, $4, $5, $6, $7, $8, $9)", f"{three} {six}",
                  [d.year, d.month, d.day, h, m, s, ms, us, ns], "LDT", ldt)
        table.add("CONCAT_DATE_TOD($1, $2)", "DATE TOD", [number(d) * 86400, tod], "DT", dt)
        table.add("CONCAT_DATE_LTOD($1, $2)", "DATE LTOD", [number(d) * 86400, ltod], "LDT", ldt)
        clock = (("HOUR", "USINT", h), ("MINUTE", "USINT", m), ("SECOND", "USINT", s))
        day = (("YEAR", "UINT", d.year), ("MONTH", "USINT", d.month), ("DAY", "USINT", d.day))
        fine = (("MILLISECOND", "UINT", ms), ("MICROSECOND", "UINT", us), ("NANOSECOND", "UINT", ns))
        for kind, v, parts in (("TOD", tod, clock + fine[:1]), ("LTOD", ltod, clock + fine), ("DT", dt, day + clock),
                               ("LDT", ldt, day + clock + fine)):
            part, small, value = rnd.choice(parts)
            table.add(f"SPLIT_{kind}($1, {part} => $r)", kind, [v], small, value)
            part, small, value = rnd.choice(parts)
            table.add(f"SPLIT_{kind}($1, {part} => $r)", kind, [v], small, value)
    for h, m, s, ms in ((24, 0, 0, 0), (25, 1, 2, 3), (0, 0, 0, -1), (-1, 0, 0, 0), (23, 59, 60, 0)):
        tod = (((h * 60 + m) * 60 + s) * 1000 + ms) % 86400000
        table.add("CONCAT_TOD($1, $2, $3, $4)", "INT INT INT INT", [h, m, s, ms], "TOD", tod)
    table.add("CONCAT_DT($1, $2, $3, $4, $5, $6, $7)", "INT INT INT INT INT INT INT", [2106, 2, 7, 6, 28, 15, 999], "DT", 2**32 - 1)
    table.add("CONCAT_DT($1, $2, $3, $4, $5, $6, $7)", "INT INT INT INT INT INT INT", [2106, 2, 7, 6, 28, 16, 0], "DT", 0)
    table.add("CONCAT_DT($1, $2, $3, $4, $5, $6, $7)", "INT INT INT INT INT INT INT", [1970, 1, 1, 0, 0, 1, -1], "DT", 0)
    table.add("CONCAT_DATE($1, $2, $3)", "INT INT INT", [2106, 2, 8], "DATE", held("DATE", 49711 * 86400))
    table.write()


# ---------------------------------------------------------------------------------------------------------------------
def conversions_to(table):
    """TO_Y($1) as X_TO_Y($1) of some X, TRUNC_Y($1) as X_TRUNC_Y($1)."""
    calls = {}
    for name in ("conversions", "texts", "characters", "edition3"):
        for row in Table.written[name]:
            call = re.fullmatch(r"([A-Z]+)_(TO|TRUNC)_([A-Z]+)\(\$1\)", row[0])
            if call and {call[1], call[3]} <= {*WIDTH, "STRING", "WSTRING"}:
                calls.setdefault(f"{call[2]}_{call[3]}($1)", {}).setdefault((row[1], row[2]), []).append(row[3:])
    for call, groups in calls.items():
        for types in table.random.sample(sorted(groups), min(6, len(groups))):
            rows = groups[types]
            for row in rows if call.startswith("TRUNC") else table.random.sample(rows, min(4, len(rows))):
                table.rows.append([call, *types, *row])


def more(name, *functions):
    table = Table(name)
    for function in functions:
        function(table)
    table.write()


if __name__ == "__main__":
    for function in (mathematics, numeric, bits, conversions, texts, strings, dates):
        function()
    more("characters", characters)
    more("selection", selection, logic, powers, measures, wide_strings)
    more("libraries", memory, system_strings, motion)
    edition3 = Table("edition3")
    patterns(edition3)
    edition3.rows = Table.edition3
    edition3.write()
    more("conversions_to", conversions_to)
