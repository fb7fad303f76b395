"""Values of the elementary types outside of Stride: limits, literals, rounding. Python's standard library only."""
import datetime
import struct
from fractions import Fraction

SIGNED = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64}
UNSIGNED = {"USINT": 8, "UINT": 16, "UDINT": 32, "ULINT": 64}
BITS = {"BYTE": 8, "WORD": 16, "DWORD": 32, "LWORD": 64}
INTEGERS = {**SIGNED, **UNSIGNED, **BITS}
TIMES = {"TIME": 32, "LTIME": 64, "DATE": 32, "LDATE": 64, "TOD": 32, "LTOD": 64, "DT": 32, "LDT": 64}
CHARACTERS = {"CHAR": 8, "WCHAR": 16}
WIDTH = {**INTEGERS, **TIMES, **CHARACTERS, "BOOL": 8, "REAL": 32, "LREAL": 64}
SIGNED_KINDS = set(SIGNED) | {"LTIME", "LDATE", "LTOD", "LDT"}
#: Nanoseconds per unit
UNIT = {"TIME": 10**6, "TOD": 10**6, "DATE": 10**9, "DT": 10**9, "LTIME": 1, "LDATE": 1, "LTOD": 1, "LDT": 1}
DAY = 86400 * 10**9
EPOCH = datetime.date(1970, 1, 1).toordinal()


def limits(kind):
    width = WIDTH[kind]
    return (-(1 << width - 1), (1 << width - 1) - 1) if kind in SIGNED_KINDS else (0, (1 << width) - 1)


def wrap(kind, value):
    """The lower bits, as a value of the type."""
    width = WIDTH[kind]
    value &= (1 << width) - 1
    return value - (1 << width) if kind in SIGNED_KINDS and value >> width - 1 else value


def saturate(kind, value):
    low, high = limits(kind)
    return min(max(value, low), high)


def half_away(x):
    """The nearest integer of a Fraction, halves away from zero."""
    whole = (abs(x) + Fraction(1, 2)).__floor__()
    return -whole if x < 0 else whole


def single(x):
    """A Fraction (or float) rounded once to binary32, half to even; a Python float."""
    if isinstance(x, float):
        if x != x or x in (float("inf"), float("-inf")) or x == 0:
            return x
        x = Fraction(x)
    return nearest(x, 24, -149, 128)


def double(x):
    return nearest(x, 53, -1074, 1024)


def nearest(x, digits, smallest, largest):
    """A Fraction rounded to a binary format, half to even."""
    if x == 0:
        return 0.0
    magnitude = abs(x)
    exponent = magnitude.numerator.bit_length() - magnitude.denominator.bit_length()
    if Fraction(2) ** exponent > magnitude:
        exponent -= 1
    step = max(exponent - digits + 1, smallest)
    scaled = magnitude / Fraction(2) ** step
    whole = scaled.__floor__()
    rest = scaled - whole
    if rest > Fraction(1, 2) or (rest == Fraction(1, 2) and whole % 2 == 1):
        whole += 1
    value = whole * Fraction(2) ** step
    if value >= Fraction(2) ** largest:
        result = float("inf")
    else:
        result = float(value)  # exact
    return -result if x < 0 else result


def bits_of(kind, x):
    return struct.unpack("<I", struct.pack("<f", x))[0] if kind == "REAL" else struct.unpack("<Q", struct.pack("<d", x))[0]


def from_bits(kind, bits):
    return struct.unpack("<f", struct.pack("<I", bits))[0] if kind == "REAL" else struct.unpack("<d", struct.pack("<Q", bits))[0]


def date_text(days):
    """yyyy-mm-dd of a day since 1970-01-01."""
    return datetime.date.fromordinal(EPOCH + days).isoformat()


def clock_text(ns, places):
    seconds, rest = divmod(ns, 10**9)
    text = f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}"
    return text + (f".{rest:09}"[:places + 1] if places else "")


class Raw(str):
    """An argument that is ST already."""


def held(kind, units):
    """A number of a kind's units as the kind holds it: a DATE is the day that it lies in, a TOD the time of that day."""
    if kind in ("TOD", "LTOD"):
        return units % (DAY // UNIT[kind])
    units = wrap(kind, units)
    if kind in ("DATE", "LDATE"):
        day = DAY // UNIT[kind]
        first = -(-limits(kind)[0] // day) * day  # the range of LDATE begins within a day
        return max(units // day * day, first)
    return units


def literal(kind, value):
    """The value as an ST expression with a type of its own."""
    if kind == "BOOL":
        return "TRUE" if value else "FALSE"
    if kind in INTEGERS:
        return f"{kind}#{value}"
    if kind in ("REAL", "LREAL"):
        if value != value:
            return f"STRING_TO_{kind}('NaN')"
        if value in (float("inf"), float("-inf")):
            return f"STRING_TO_{kind}('{'-' if value < 0 else ''}Infinity')"
        text = repr(value)
        if "." not in text:
            text = text.replace("e", ".0e")
        return f"{kind}#{text}"
    if kind == "TIME":
        return f"T#{value}ms"
    if kind == "LTIME" and value > -(1 << 63):  # which cannot be written
        return f"LTIME#{'-' if value < 0 else ''}{abs(value)}ns"
    if kind == "LTIME":
        return f"LINT_TO_LTIME({value})"
    if kind in ("TOD", "LTOD", "DATE", "LDATE", "DT", "LDT"):
        ns = value * UNIT[kind]
        days, clock = divmod(ns, DAY)
        within = (value >= 0 or kind in ("LDATE", "LDT")) and ((kind in ("TOD", "LTOD") and days == 0) or (kind in ("DATE", "LDATE") and clock == 0) or \
            kind in ("DT", "LDT"))
        if within:
            places = 9 if kind in ("LTOD", "LDT") else 3 if kind == "TOD" else 0
            if kind in ("TOD", "LTOD"):
                return f"{kind}#{clock_text(clock, places)}"
            if kind in ("DATE", "LDATE"):
                return f"{'D' if kind == 'DATE' else kind}#{date_text(days)}"
            return f"{kind}#{date_text(days)}-{clock_text(clock, places)}"
        return f"LINT_TO_{kind}({value})"
    if kind in CHARACTERS:
        if value == 0 or 0xD800 <= value < 0xE000:  # no characters of texts
            return f"UINT_TO_{kind}({value})"
        text = literal("WSTRING" if kind == "WCHAR" else "STRING", chr(value))
        return f"{kind}#{text[text.index('#') + 1:]}"
    if kind.startswith(("STRING", "WSTRING")):
        wide = kind.startswith("W")
        quote = '"' if wide else "'"
        out = ""
        for c in value:
            if c in ("$", quote):
                out += "$" + c
            elif ord(c) < 32 or 127 <= ord(c) < 160:
                out += f"${ord(c):04X}" if wide else f"${ord(c):02X}"
            else:
                out += c
        return f"{'WSTRING' if wide else 'STRING'}#{quote}{out}{quote}"
    raise ValueError(kind)
