"""LIMIT, SEL, MUX, MIN, MAX and MOVE of all types, AND, OR, XOR and MOD as functions, EXPT of mixed types, sizes and bounds."""
from fractions import Fraction

from model import BITS, CHARACTERS, INTEGERS, TIMES, WIDTH, Raw, double, limits, single, wrap

INF = float("inf")
NAN = float("nan")


def values_of(kind, rnd):
    if kind == "BOOL":
        return [0, 1]
    if kind in ("REAL", "LREAL"):
        xs = [0.0, 1.0, -1.5, 0.1, 1e30, -1e-30, INF, -INF] + [rnd.uniform(-100, 100) for _ in range(4)]
        return [single(x) for x in xs] if kind == "REAL" else xs
    if kind in CHARACTERS:
        return [0, 1, 65, 97, 128, 255] + [0x20AC, 0xFFFF] * (kind == "WCHAR")
    if kind.startswith("STRING"):
        return ["", "a", "ab", "b", "Z", "é", "0", " ", "abcdefghijklmnopqrst"]
    if kind.startswith("WSTRING"):
        return ["", "a", "ab", "b", "Z", "é", "Ω", "€a", "abcdefghijklmnopqrst"]
    if kind in ("DATE", "LDATE"):
        day = 86400 * (10**9 if kind == "LDATE" else 1)
        return [day * d for d in (0, 1, 789, 11016, 20000, rnd.randrange(49710))]
    if kind in ("TOD", "LTOD"):
        top = 86400 * (10**9 if kind == "LTOD" else 1000)
        return [0, 1, top - 1, rnd.randrange(top), rnd.randrange(top)]
    low, high = limits(kind)
    if kind == "LDT":
        low = 0
    return [low, 0, 1, high, rnd.randint(low, high), rnd.randint(low, high)]


def selection(table):
    rnd = table.random
    kinds = ["BOOL", "REAL", "LREAL", *TIMES, *CHARACTERS, "STRING(20)", "WSTRING(20)"]
    for selector, kind in zip(("USINT", "DINT", "INT") * len(kinds), kinds):
        values = values_of(kind, rnd)
        for _ in range(10):
            a, b, c = (rnd.choice(values) for _ in range(3))
            three = f"{kind} {kind} {kind}"
            table.add("LIMIT($1, $2, $3)", three, [a, b, c], kind, min(max(b, a), c))
            if kind not in TIMES:
                table.add("MIN($1, $2, $3)", three, [a, b, c], kind, min(a, b, c))
                table.add("MAX($1, $2, $3)", three, [a, b, c], kind, max(a, b, c))
            g, k = rnd.randrange(2), rnd.randrange(3)
            table.add("SEL($1, $2, $3)", f"BOOL {kind} {kind}", [g, b, c], kind, c if g else b)
            table.add("MUX($1, $2, $3, $4)", f"{selector} {three}", [k, a, b, c], kind, (a, b, c)[k])
        for v in values:
            table.add("MOVE($1)", kind, [v], kind, v)
    for kind in INTEGERS:
        for v in (*limits(kind), 0, 1):
            table.add("MOVE($1)", kind, [v], kind, v)
    for kind in ("REAL", "LREAL"):
        for low, x, high in ((-1.0, NAN, 1.0), (-INF, NAN, INF), (-INF, 3.0, INF), (-1.0, INF, 1.0), (-1.0, -INF, 1.0), (2.0, 0.0, 1.0)):
            table.add("LIMIT($1, $2, $3)", f"{kind} {kind} {kind}", [low, x, high], kind, x if x != x else min(max(x, low), high))
        for v in (NAN, -0.0, 0.0):
            table.add("MOVE($1)", kind, [v], kind, v)
            table.add("SEL($1, $2, $3)", f"BOOL {kind} {kind}", [1, 5.0, v], kind, v)
            table.add("MUX($1, $2, $3)", f"INT {kind} {kind}", [0, v, 5.0], kind, v)


def logic(table):
    rnd = table.random
    operations = {"AND": lambda a, b: a & b, "OR": lambda a, b: a | b, "XOR": lambda a, b: a ^ b}
    for kind, width in (("BOOL", 1), *BITS.items()):
        top = (1 << width) - 1
        values = [0, top] + [rnd.randint(0, top) for _ in range(5)]
        for v in values:
            table.add("NOT($1)", kind, [v], kind, v ^ top)
            table.add("NOT $1", kind, [v], kind, v ^ top)
        for name, f in operations.items():
            for _ in range(6):
                a, b, c = (rnd.choice(values) for _ in range(3))
                table.add(f"{name}($1, $2)", f"{kind} {kind}", [a, b], kind, f(a, b))
                table.add(f"$1 {name} $2", f"{kind} {kind}", [a, b], kind, f(a, b))
                table.add(f"{name}($1, $2, $3)", f"{kind} {kind} {kind}", [a, b, c], kind, f(f(a, b), c))
            if kind != "BOOL":
                for wider, bits in BITS.items():
                    if bits > width:
                        b = rnd.getrandbits(bits)
                        table.add(f"{name}($1, $2)", f"{kind} {wider}", [values[2], b], wider, f(values[2], b))
    for kind in INTEGERS:
        wide = kind if WIDTH[kind] >= 32 else "DWORD" if kind in BITS else "DINT"
        low, high = limits(kind)
        for a, b in ((low, 7), (high, 7), (7, high), (100, 9), (low, 2), (rnd.randint(low, high), 13)):
            rest = abs(a) % b
            table.add("MOD($1, $2)", f"{kind} {kind}", [a, b], wide, wrap(wide, -rest if a < 0 else rest))


def powers(table):
    """EXPT is LREAL unless both arguments are REAL."""
    import mpmath
    rnd = table.random

    def power(x, y):
        x, y = Fraction(x), Fraction(y)
        if x == 0 and y < 0:
            return INF
        if y.denominator == 1 and abs(y) < 2000:
            exact = x**y.numerator
        else:
            with mpmath.workprec(400):
                value = mpmath.power(mpmath.mpf(x.numerator) / x.denominator, mpmath.mpf(y.numerator) / y.denominator)
                return mpmath.nstr(value, 40, min_fixed=1, max_fixed=0, strip_zeros=False)
        value = double(exact)
        if abs(value) == INF or Fraction(value) == exact:
            return value
        with mpmath.workprec(400):
            return mpmath.nstr(mpmath.mpf(exact.numerator) / exact.denominator, 40, min_fixed=1, max_fixed=0, strip_zeros=False)

    for kind in ("SINT", "INT", "LINT", "USINT", "UDINT"):
        signed = limits(kind)[0] < 0
        exponents = [0, 1, 2, 3, 10, 31, 100] + [-1, -2, -7] * signed
        for base in ("REAL", "LREAL"):
            for x in (2.0, -3.0, 0.5, 10.0, 1.5, 0.0, -1.0, 0.1):
                for n in rnd.sample(exponents, 3):
                    x = single(x) if base == "REAL" else x
                    table.add("EXPT($1, $2)", f"{base} {kind}", [x, n], "LREAL", power(x, n))
        for x in (0, 1, 2, 3, 10, 127) + (-1, -2, -128) * signed:
            for n in rnd.sample(exponents, 3):
                table.add("EXPT($1, $2)", f"{kind} {kind}", [x, n], "LREAL", power(x, n))
            for y in (0.5, 2.0, 1.25, 0.0):
                if x >= 0 or y in (2.0, 0.0):
                    table.add("EXPT($1, $2)", f"{kind} LREAL", [x, y], "LREAL", power(x, y))
                    table.add("EXPT($1, $2)", f"{kind} REAL", [x, y], "LREAL", power(x, y))
    for x, y in ((2.0, 0.5), (9.0, 0.5), (0.1, 3.0), (7.0, -1.5), (1e10, 3.0)):
        table.add("EXPT($1, $2)", "REAL LREAL", [single(x), y], "LREAL", power(single(x), y))
        table.add("EXPT($1, $2)", "LREAL REAL", [x, single(y)], "LREAL", power(x, single(y)))


def measures(table):
    """SIZEOF of variables; bounds of arrays by the declaration."""
    bytes_ = {"BOOL": 1, **{k: w // 8 for k, w in WIDTH.items()}}
    size = lambda kind, v: table.add("$r := SIZEOF($1)", kind, [v], "DINT", bytes_[kind])
    for kind in bytes_:
        size(kind, 0.0 if kind in ("REAL", "LREAL") else 0)
    for n in (1, 7, 80, 255, 1000):  # with the end mark
        table.add("$r := SIZEOF($1)", f"STRING({n})", [""], "DINT", n + 1)
        table.add("$r := SIZEOF($1)", f"WSTRING({n})", [""], "DINT", 2 * (n + 1))
    for kind, zero in (("BOOL", "FALSE"), ("INT", "0"), ("LREAL", "0.0"), ("TIME", "T#0s"), ("STRING(3)", "''")):
        for bounds in (((0, 0),), ((1, 10),), ((-3, 5),), ((-7, -2),), ((0, 1), (4, 9)), ((-1, 1), (0, 0), (100, 102))):
            text = ",".join(f"{a}..{b}" for a, b in bounds)
            array = f"ARRAY[{text}] OF {kind}"
            count = 1
            for a, b in bounds:
                count *= b - a + 1
            value = Raw(f"[{count}({zero})]")
            table.add("$r := SIZEOF($1)", array, [value], "DINT", count * (4 if kind == "STRING(3)" else bytes_[kind]))
            for d, (a, b) in enumerate(bounds if kind == "INT" else (), 1):
                table.add(f"$r := LOWER_BOUND($1, {d})", array, [value], "DINT", a)
                table.add(f"$r := UPPER_BOUND($1, {d})", array, [value], "DINT", b)


def wide_strings(table):
    """The functions of MID, RIGHT, INSERT and DELETE under their names for WSTRING."""
    rnd = table.random
    word = lambda n: "".join(rnd.choice("abcäΩЖ€ $'\"01~") for _ in range(n))
    for length in (1, 80, 255):
        kind, result = f"WSTRING({length})", "WSTRING(255)"
        texts = ["", word(1), word(length), word(max(1, length // 2))]
        for _ in range(14):
            s, t = rnd.choice(texts), rnd.choice(texts + ["b", "ab"])[:length]
            n = rnd.choice([-1, 0, 1, 2, 3, length // 2, length, length + 1, 300, 32767])
            p = rnd.choice([-5, 0, 1, 2, 3, length // 2, length, length + 1, 300, 32767])
            at, behind, n0 = max(p, 1) - 1, min(max(p, 0), len(s)), max(n, 0)
            table.add("WMID($1, $2, $3)", f"{kind} INT INT", [s, n, p], result, s[at:at + n0])
            table.add("WRIGHT($1, $2)", f"{kind} INT", [s, n], result, s[max(len(s) - n0, 0):])
            table.add("WINSERT($1, $2, $3)", f"{kind} {kind} INT", [s, t, p], result, (s[:behind] + t + s[behind:])[:255])
            table.add("WDELETE($1, $2, $3)", f"{kind} INT INT", [s, n, p], result, s[:at] + s[at + n0:])
