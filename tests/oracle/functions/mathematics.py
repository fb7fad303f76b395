"""The mathematical functions, with mpmath's digits."""
import math
import sys
from fractions import Fraction

from model import WIDTH, from_bits, single
from tables import INF, NAN, REALS, Table, rounded


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
