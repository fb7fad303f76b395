"""SysLibMem on the bytes of LWORDs and texts, SysLibStr, and the functions of SM_DriveBasic. `$r` in a call is a statement."""
import math
from fractions import Fraction

from model import double

INF = float("inf")
NAN = float("nan")


def moved(memory, to, start, count):
    piece = memory[start:start + count]
    return memory[:to] + piece + memory[to + len(piece):]


def swapped(memory, size, count):
    if size not in (2, 4, 8):
        return memory
    return b"".join(memory[i:i + size][::-1] for i in range(0, size * count, size)) + memory[size * count:]


def memory_of(kind, value):
    return value.to_bytes(8, "little") if kind == "LWORD" else value.encode("latin-1")


def value_of(kind, memory):
    return int.from_bytes(memory, "little") if kind == "LWORD" else memory.decode("latin-1")


def memory(table):
    rnd = table.random
    text = lambda n: "".join(chr(rnd.choice([*range(33, 127), *range(161, 256)])) for _ in range(n))
    for kind, length, rounds in (("LWORD", 8, 14), ("STRING(80)", 80, 25)):
        some = (lambda: rnd.getrandbits(64)) if kind == "LWORD" else (lambda: text(80))
        for _ in range(rounds):
            a, b = some(), some()
            x, y = memory_of(kind, a), memory_of(kind, b)
            n = rnd.choice([0, 1, 2, length - 1, length, rnd.randrange(length)])
            to, start = rnd.randrange(length - n + 1), rnd.randrange(length - n + 1)
            for name in ("SysMemCpy", "SysMemMove"):
                table.add(f"{name}(ADR($1), ADR($2), $3); $r := $1", f"{kind} {kind} UDINT", [a, b, n], kind, value_of(kind, y[:n] + x[n:]))
                table.add(f"{name}(ADR($1) + $2, ADR($1) + $3, $4); $r := $1", f"{kind} UDINT UDINT UDINT", [a, to, start, n], kind,
                          value_of(kind, moved(x, to, start, n)))
                table.add(f"$r := {name}(ADR($1), ADR($2), $3) = ADR($1)", f"{kind} {kind} UDINT", [a, b, n], "BOOL", 1)
            byte = rnd.choice([65, 200, 255, 0x100 + 66, 0xFFFFFF00 + 67] + [0, 0x100] * (kind == "LWORD"))
            filled = x[:to] + bytes([byte & 255]) * n + x[to + n:]
            table.add("SysMemSet(ADR($1) + $2, $3, $4); $r := $1", f"{kind} UDINT UDINT UDINT", [a, to, byte, n], kind, value_of(kind, filled))
            size = rnd.choice([2, 4, 8])
            count = rnd.randrange(length // size + 1)
            for size, count in ((size, count), (rnd.choice([0, 1, 3, 5, 16]), rnd.randrange(3))):
                numbers = f"{kind} UDINT UDINT"
                table.add("SysMemForceSwap(ADR($1), $2, $3); $r := $1", numbers, [a, size, count], kind, value_of(kind, swapped(x, size, count)))
                table.add("$r := SysMemForceSwap(ADR($1), $2, $3)", numbers, [a, size, count], "DINT", size * count if size in (2, 4, 8) else -1)
                table.add("SysMemSwap(ADR($1), $2, $3); $r := $1", numbers, [a, size, count], kind, a)
                table.add("$r := SysMemSwap(ADR($1), $2, $3)", numbers, [a, size, count], "DINT", 0 if size in (2, 4, 8) else -1)
            # equal up to a place
            place = rnd.randrange(length)
            z = x[:place] + y[place:]
            n = rnd.choice([0, place, place + 1, length, rnd.randrange(length + 1)])
            order = (x[:n] > z[:n]) - (x[:n] < z[:n])
            table.add("$r := SysMemCmp(ADR($1), ADR($2), $3)", f"{kind} {kind} UDINT", [a, value_of(kind, z), n], "DINT", order)


def system_strings(table):
    rnd = table.random
    word = lambda n: "".join(rnd.choice("abcäöÿ $'\"01~") for _ in range(n))
    for length in (1, 80, 2000):
        kind = f"STRING({length})"
        texts = ["", word(1), word(length), word(max(1, length // 2)), word(length)]
        for _ in range(14):
            s, t = rnd.choice(texts), rnd.choice(texts)
            if rnd.random() < 0.3:
                t = s[:rnd.randrange(len(s) + 1)]
            table.add("$r := SysStrLen(ADR($1))", kind, [s], "DINT", len(s))
            table.add("$r := SysStrCmp(ADR($1), ADR($2))", f"{kind} {kind}", [s, t], "DINT", (s > t) - (s < t))
            table.add("SysStrCpy(ADR($1), ADR($2)); $r := $1", f"{kind} {kind}", [s, t], kind, t)
            table.add("$r := SysStrCpy(ADR($1), ADR($2)) = ADR($1)", f"{kind} {kind}", [s, t], "BOOL", 1)


def motion(table):
    import mpmath
    rnd = table.random
    spread = lambda: rnd.choice((1, -1)) * 2.0**rnd.uniform(-30, 30)

    def remainder(x, m):
        """In [0, m[, rounded once."""
        period = abs(Fraction(m))
        if period == 0:
            return x
        value = double(Fraction(x) % period)
        return 0.0 if value >= abs(m) else value

    pairs = [(370.0, 360.0), (-10.0, 360.0), (720.0, 360.0), (-360.0, 360.0), (1e300, 3.0), (-1e300, 0.7), (1e17, 3.0), (-1e-20, 360.0),
             (5.5, -2.0), (-5.5, -2.0), (7.25, 0.0), (-7.25, 0.0), (5e-324, 1e-323), (1.5e-323, 1e-323), (1.7e308, 5e-324), (0.3, 0.1),
             (1.7976931348623157e308, 1.7e308), (-1.7976931348623157e308, 1.7e308), (0.0, 3.0)]
    for x, m in pairs + [(spread(), spread()) for _ in range(80)]:
        table.add("SMC_fmod($1, $2)", "LREAL LREAL", [x, m], "LREAL", remainder(x, m))
    for x, m in ((INF, 2.0), (-INF, 2.0), (NAN, 2.0), (2.0, NAN), (-2.0, NAN)):
        table.add("SMC_fmod($1, $2)", "LREAL LREAL", [x, m], "LREAL", NAN)
    for x in (0.0, -0.0, 5e-324, -5e-324, 1.0, -0.25, 1e300, -1e300, INF, -INF, NAN):
        table.add("SMC_sgn($1)", "LREAL", [x], "INT", (x > 0) - (x < 0))

    def angle(y, x):
        with mpmath.workprec(300):
            a = mpmath.atan2(mpmath.mpf(y), mpmath.mpf(x))
            a = a + 2 * mpmath.pi if a < 0 else a
            if float(a) >= 2 * math.pi:  # rounds to the period
                return 0.0
            return mpmath.nstr(a, 40, min_fixed=1, max_fixed=0, strip_zeros=False)

    points = [(0.0, 1.0), (1.0, 1.0), (2.0, 0.0), (0.0, -3.0), (-1.0, 0.0), (-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (-1e-300, 1.0), (0.0, 0.0),
              (1e-300, -1.0), (-1e-300, -1.0), (1e300, 1e-300), (1e300, 1e300), (-1e300, -1e-300), (5e-324, 5e-324), (-1e-9, 1.0), (1.0, 1e-17)]
    for y, x in points + [(spread(), spread()) for _ in range(80)]:
        table.add("SMC_atan2($1, $2)", "LREAL LREAL", [y, x], "LREAL", 0.0 if x == y == 0 else angle(y, x))
    for y, x in ((NAN, 1.0), (1.0, NAN)):
        table.add("SMC_atan2($1, $2)", "LREAL LREAL", [y, x], "LREAL", NAN)
