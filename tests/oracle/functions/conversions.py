"""Conversions of numbers and times into each other; TO_Y and TRUNC_Y by the rows of the others."""
import math
import re
from fractions import Fraction

from model import INTEGERS, SIGNED, TIMES, UNIT, UNSIGNED, WIDTH, double, half_away, held, limits, saturate, single, wrap
from tables import INF, NAN, REALS, Table, integers_of, some_reals, time_values


def to_integer(x, kind, cutting=False):
    if x != x:
        return 0
    if abs(x) == INF:
        return limits(kind)[1 if x > 0 else 0]
    return saturate(kind, int(x) if cutting else half_away(Fraction(x)))


def between_times(value, source, target):
    """Units are converted, rounded down."""
    return held(target, wrap("LTIME", value * UNIT[source]) // UNIT[target])


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
