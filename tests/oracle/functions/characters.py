"""Conversions of CHAR and WCHAR: numbers of 8 and 16 bits without sign to all types but the texts."""
from fractions import Fraction

from model import CHARACTERS, INTEGERS, TIMES, UNIT, half_away, held, limits, saturate, single, wrap

INF = float("inf")


def characters(table):
    rnd = table.random
    put = lambda a, b, x, y: table.add(f"{a}_TO_{b}($1)", a, [x], b, y)
    codes = {"CHAR": [0, 1, 36, 39, 65, 127, 128, 233, 255], "WCHAR": [0, 1, 36, 34, 65, 127, 128, 255, 256, 0x20AC, 0x7FFF, 0xD83D, 0xFFFF]}
    for kind in CHARACTERS:
        high = limits(kind)[1]
        for v in codes[kind]:
            for b in {**INTEGERS, **TIMES}:
                put(kind, b, v, held(b, v) if b in TIMES else wrap(b, v))
            put(kind, "BOOL", v, int(v != 0))
            put(kind, "REAL", v, float(v))
            put(kind, "LREAL", v, float(v))
        for v in (0, 1):
            put("BOOL", kind, v, v)
        for a in INTEGERS:
            low, top = limits(a)
            for v in {low, top, 0, 65, min(255, top), rnd.randint(low, top), rnd.randint(low, top)}:
                put(a, kind, v, wrap(kind, v))
        for a in TIMES:
            second = 10**9 // UNIT[a]
            days = [86400 * second * d for d in (0, 1, 789, rnd.randrange(20000))]
            clock = [0, 65, 300, 65537, rnd.randrange(86400 * second)]
            for v in days if a in ("DATE", "LDATE") else clock:
                put(a, kind, v, wrap(kind, v))
        for a in ("REAL", "LREAL"):
            for x in (0.0, -0.0, 0.5, 0.49, 65.5, 66.5, -0.5, -1.0, high - 0.5, high + 0.25, high + 0.5, high + 1.0, 1e30, -1e30, INF, -INF,
                      float("nan")):
                x = single(x) if a == "REAL" else x
                put(a, kind, x, 0 if x != x else high if x == INF else 0 if x == -INF else saturate(kind, half_away(Fraction(x))))
    # one another and texts: what is not in Latin-1 becomes a question mark, no character is the character 0
    narrow = lambda code: code if code < 256 else ord("?")
    text = lambda code: chr(code) if code else ""
    for v in codes["CHAR"]:
        put("CHAR", "WCHAR", v, v)
        table.add("CHAR_TO_STRING($1)", "CHAR", [v], "STRING(80)", text(v))
        table.add("CHAR_TO_WSTRING($1)", "CHAR", [v], "WSTRING(80)", text(v))
    for v in codes["WCHAR"]:
        put("WCHAR", "CHAR", v, narrow(v))
        table.add("WCHAR_TO_STRING($1)", "WCHAR", [v], "STRING(80)", text(narrow(v)))
        if v not in (0xD83D, 0xFFFF):  # not a text of its own
            table.add("WCHAR_TO_WSTRING($1)", "WCHAR", [v], "WSTRING(80)", text(v))
    for word in ("", "a", "xyz", "$'", "é", "ÿz", " a", "1"):
        first = ord(word[0]) if word else 0
        for kind in CHARACTERS:
            table.add(f"STRING_TO_{kind}($1)", "STRING(80)", [word], kind, first)
            table.add(f"WSTRING_TO_{kind}($1)", "WSTRING(80)", [word], kind, first)
    for word in ("Ωa", "€", "Ā"):
        table.add("WSTRING_TO_CHAR($1)", "WSTRING(80)", [word], "CHAR", ord("?"))
        table.add("WSTRING_TO_WCHAR($1)", "WSTRING(80)", [word], "WCHAR", ord(word[0]))
