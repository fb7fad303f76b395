"""ST literals as the bytes of a variable."""
import datetime
import re
import struct
from fractions import Fraction

import gdb

from .applications import enumerators_of

NANOSECONDS = {"d": 86400 * 10**9, "h": 3600 * 10**9, "m": 60 * 10**9, "s": 10**9, "ms": 10**6, "us": 10**3, "ns": 1}
PART = r"(\d[\d_]*(?:\.\d+)?)(ms|us|ns|d|h|m|s)"
PER_SECOND = {"TIME": 1000, "TOD": 1000, "DATE": 1, "DT": 1}
LIMITS = {"BYTE": (0, 8), "WORD": (0, 16), "DWORD": (0, 32), "LWORD": (0, 64), "CHAR": (0, 8), "WCHAR": (0, 16)}
for bits, part in ((8, "SINT"), (16, "INT"), (32, "DINT"), (64, "LINT")):
    LIMITS[part], LIMITS["U" + part] = (1, bits), (0, bits)


def st_type(kind):
    """The runtime's name of a type: INT, STRING<80>; what an enumeration or alias is made of."""
    while kind.code == gdb.TYPE_CODE_TYPEDEF and not (kind.name or "").startswith("stride::"):
        kind = kind.target()
    if kind.code == gdb.TYPE_CODE_INT: # an element: template arguments lose their typedefs
        return ("" if kind.is_signed else "U") + {1: "SINT", 2: "INT", 4: "DINT", 8: "LINT"}[kind.sizeof]
    if kind.code == gdb.TYPE_CODE_FLT:
        return "REAL" if kind.sizeof == 4 else "LREAL"
    return (kind.unqualified().name or "").removeprefix("stride::")


def seconds_of_day(text):
    hours, minutes, seconds = (text.split(":") + ["0"])[:3]
    return (int(hours) * 60 + int(minutes)) * 60 + Fraction(seconds)


def moment(text):
    """Nanoseconds of a time, date or time of day without its prefix; None: it is none."""
    if re.fullmatch(rf"-?({PART}_?)+", text):
        total = sum(Fraction(number.replace("_", "")) * NANOSECONDS[unit] for number, unit in re.findall(PART, text))
        return -total if text.startswith("-") else total
    found = re.fullmatch(r"(?:(\d+-\d+-\d+)(?:-|$))?(\d+:\d+(?::\d+(?:\.\d+)?)?)?", text)
    if not text or found is None:
        return None
    days = (datetime.date(*map(int, found[1].split("-"))) - datetime.date(1970, 1, 1)).days if found[1] else 0
    return (days * 86400 + (seconds_of_day(found[2]) if found[2] else 0)) * 10**9


def characters(text):
    """The codes of the text between the quotes."""
    short = {"T": 9, "N": 10, "L": 10, "P": 12, "R": 13}
    codes, digits = [], 2 if text[0] == "'" else 4
    for escape, plain in re.findall(rf"\$([0-9A-Fa-f]{{{digits}}}|.)|(.)", text[1:-1]):
        codes.append(ord(plain) if plain else int(escape, 16) if len(escape) > 1 else
                     short.get(escape.upper(), ord(escape)))
    return codes


def encoded(text, value):
    """The bytes of the literal `text` for the place `value`; None: it is no literal of that type."""
    kind, size = st_type(value.type), value.type.sizeof
    upper = text.upper()
    plain = text.rsplit("#", 1)[-1].lower() if re.match(r"[A-Z]\w*#", upper) else text
    if kind.startswith(("STRING<", "WSTRING<")) or kind in ("CHAR", "WCHAR"):
        wide = kind.startswith("W")
        if len(text) < 2 or text[0] != text[-1] or text[0] != ('"' if wide else "'"):
            return None
        unit = 2 if wide else 1
        codes = characters(text)
        room = 1 if kind.endswith("CHAR") else size // unit - 1
        if len(codes) > room or kind.endswith("CHAR") and len(codes) != 1 or any(c >> 8 * unit for c in codes):
            raise gdb.GdbError(f"{text} has no room in this {kind.split('<')[0]}")
        return b"".join(c.to_bytes(unit, "little") for c in codes).ljust(size, b"\0")
    if kind == "BOOL":
        number = {"TRUE": 1, "FALSE": 0, "1": 1, "0": 0}.get(upper.removeprefix("BOOL#"))
        return None if number is None else bytes([number])
    if kind in ("REAL", "LREAL"):
        try:
            return struct.pack("<f" if kind == "REAL" else "<d", float(plain.replace("_", "")))
        except ValueError:
            return None
    if kind.removeprefix("L") in PER_SECOND:
        when = moment(plain) if "#" in text else None
        if when is None:
            return None
        number = int(when * (10**9 if kind.startswith("L") else PER_SECOND[kind]) // 10**9)
        signed, bits = kind == "LTIME", 8 * size
    elif kind in LIMITS:
        signed, bits = LIMITS[kind]
        names = enumerators_of((value.type.name or "").rsplit("::", 1)[-1]) or {}
        known = {name.lower(): number for number, name in names.items()}
        found = re.fullmatch(r"(?:[A-Za-z]\w*#)?(-?)(?:(2|8|16)#)?([0-9A-Fa-f_]+)", text)
        if text.rsplit(".", 1)[-1].lower() in known:
            number = known[text.rsplit(".", 1)[-1].lower()]
        else:
            try:
                number = int(found[1] + found[3].replace("_", ""), int(found[2] or 10)) if found else None
            except ValueError:
                number = None
    else:
        return None
    if number is None:
        return None
    if not -(signed << bits - 1) <= number < 1 << bits - signed:
        raise gdb.GdbError(f"{text} is outside of {kind}")
    return number.to_bytes(size, "little", signed=bool(signed))
