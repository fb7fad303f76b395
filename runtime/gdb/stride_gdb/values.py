"""Values as ST literals."""
import datetime

import gdb


def duration(units, per_second, prefix):
    """An ST duration literal of `units`, of which `per_second` make a second."""
    sign = "-" if units < 0 else ""
    rest = abs(units)
    parts = []
    scale = [("d", 86400 * per_second), ("h", 3600 * per_second), ("m", 60 * per_second), ("s", per_second)]
    if per_second >= 1000:
        scale.append(("ms", per_second // 1000))
    if per_second == 1000000000:
        scale += [("us", 1000), ("ns", 1)]
    for name, size in scale:
        count, rest = divmod(rest, size)
        if count:
            parts.append(f"{count}{name}")
    return f"{prefix}{sign}{''.join(parts) or '0' + ('ns' if per_second > 1000 else 'ms')}"


def time_of_day(units, per_second):
    seconds, fraction = divmod(units, per_second)
    digits = len(str(per_second)) - 1
    text = f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}"
    return text + (f".{fraction:0{digits}}".rstrip("0") if fraction else "")


def date(units, per_second):
    day = datetime.date(1970, 1, 1) + datetime.timedelta(days=units // (86400 * per_second))
    return day.isoformat()


def date_and_time(units, per_second):
    return f"{date(units, per_second)}-{time_of_day(units % (86400 * per_second), per_second)}"


def real(value, digits):
    number = float(value)
    for precision in range(1, digits + 1):
        text = f"{number:.{precision}g}"
        if gdb.Value(float(text)).cast(value.type.strip_typedefs()) == value:
            break
    return text if any(c in text for c in ".en") else text + ".0"


def text_literal(codes, quote):
    """An ST string literal of character codes, up to the NUL."""
    out = []
    for code in codes:
        if code == 0:
            break
        if chr(code) in (quote, "$"):
            out.append("$" + chr(code))
        elif code in (9, 10, 12, 13):
            out.append({9: "$T", 10: "$N", 12: "$P", 13: "$R"}[code])
        elif 32 <= code < 127 or code >= 160:
            out.append(chr(code))
        else:
            out.append(f"${code:02X}" if quote == "'" else f"${code:04X}")
    return quote + "".join(out) + quote


def codes_of(array, unit_bytes):
    """The elements of a C array of characters, read at once."""
    size = array.type.sizeof
    raw = bytes(gdb.selected_inferior().read_memory(int(array.address), size)) if array.address else \
        bytes(int(array[i]) & 0xFF for i in range(size))
    return [int.from_bytes(raw[i:i + unit_bytes], "little") for i in range(0, size, unit_bytes)]


ELEMENTARY = {
    "BOOL": lambda v: "TRUE" if int(v) & 0xFF else "FALSE",
    "SINT": lambda v: str(int(v)),
    "USINT": lambda v: str(int(v) & 0xFF),
    "BYTE": lambda v: f"16#{int(v) & 0xFF:02X}",
    "WORD": lambda v: f"16#{int(v):04X}",
    "DWORD": lambda v: f"16#{int(v):08X}",
    "LWORD": lambda v: f"16#{int(v):016X}",
    "REAL": lambda v: real(v, 9),
    "LREAL": lambda v: real(v, 17),
    "TIME": lambda v: duration(int(v), 1000, "T#"),
    "LTIME": lambda v: duration(int(v), 1000000000, "LTIME#"),
    "DATE": lambda v: "D#" + date(int(v), 1),
    "LDATE": lambda v: "LD#" + date(int(v), 1000000000),
    "TOD": lambda v: "TOD#" + time_of_day(int(v), 1000),
    "LTOD": lambda v: "LTOD#" + time_of_day(int(v), 1000000000),
    "DT": lambda v: "DT#" + date_and_time(int(v), 1),
    "LDT": lambda v: "LDT#" + date_and_time(int(v), 1000000000),
    "CHAR": lambda v: text_literal([int(v) & 0xFF], "'"),
    "WCHAR": lambda v: text_literal([int(v)], '"'),
}
