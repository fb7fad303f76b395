"""Arithmetic, comparisons, selection, shifts, byte order and decimal digits."""
import math
from fractions import Fraction

from model import BITS, INTEGERS, TIMES, UNIT, WIDTH, limits, wrap
from tables import INF, NAN, REALS, Table, integers_of, rounded, some_reals


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
