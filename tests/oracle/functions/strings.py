"""Functions of character strings."""
from model import limits
from tables import Table


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
