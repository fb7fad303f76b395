"""Numbers and times as texts, and back."""
import math
from fractions import Fraction

from model import DAY, INTEGERS, TIMES, UNIT, clock_text, date_text, limits, single, wrap
from tables import INF, NAN, REALS, Table, integers_of, rounded, some_reals, time_values


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
