"""Types and values of the dialect, read from its definition, not from the compiler."""
import datetime
import math
import re
import struct

# name: (signed, bits)
INTS = {"SINT": (True, 8), "INT": (True, 16), "DINT": (True, 32), "LINT": (True, 64), "USINT": (False, 8),
        "UINT": (False, 16), "UDINT": (False, 32), "ULINT": (False, 64)}
BITS = {"BYTE": (False, 8), "WORD": (False, 16), "DWORD": (False, 32), "LWORD": (False, 64)}
NUMBERS = {**INTS, **BITS}
REALS = ("REAL", "LREAL")
# name: bits; LTIME has a sign; the long ones count ns
TIMES = {"TIME": 32, "LTIME": 64, "DATE": 32, "TOD": 32, "DT": 32, "LDATE": 64, "LTOD": 64, "LDT": 64}


class Skip(Exception):
    """This choice has no defined value, or costs too much; take another one."""


class Type:
    """An elementary type, or the base of the others."""

    def __init__(self, name, leaves=None):
        self.name = name
        self.leaves = leaves or {name}  # names of the elementary types within

    def default(self):
        return {"BOOL": False, "REAL": 0.0, "LREAL": 0.0}.get(self.name, 0)

    def copy(self, value):
        return value

    def flat(self, path, value):
        yield path, self, value


class StringType(Type):
    def __init__(self, size, wide=False):
        family = "WSTRING" if wide else "STRING"
        super().__init__(f"{family}({size})", {family})
        self.size, self.family = size, family

    def default(self):
        return ""


class Enum(Type):
    def __init__(self, name, members):
        super().__init__(name)
        self.members = members  # name: value

    def default(self):
        return next(iter(self.members.values()))


class Subrange(Type):
    def __init__(self, name, base, low, high):
        super().__init__(name, {base})
        self.base, self.low, self.high = base, low, high

    def default(self):
        return self.low if self.low > 0 else min(self.high, 0)


class Array(Type):
    def __init__(self, element, bounds, name=None):
        text = ", ".join(f"{low}..{high}" for low, high in bounds)
        super().__init__(name or f"ARRAY[{text}] OF {element.name}", element.leaves)
        self.element, self.bounds = element, bounds
        self.count = math.prod(high - low + 1 for low, high in bounds)

    def default(self):
        return [self.element.default() for _ in range(self.count)]

    def copy(self, value):
        return [self.element.copy(v) for v in value]

    def indices(self):
        result = [[]]
        for low, high in self.bounds:
            result = [r + [i] for r in result for i in range(low, high + 1)]
        return result

    def flat(self, path, value):
        for index, element in zip(self.indices(), value):
            # Directly nested arrays are printed with one list of indices.
            head = path[:-1] + "," if path.endswith("]") else path + "["
            yield from self.element.flat(f"{head}{','.join(map(str, index))}]", element)


class Struct(Type):
    def __init__(self, name, fields, defaults):
        super().__init__(name, set().union(*(t.leaves for t in fields.values())))
        self.fields, self.defaults = fields, defaults  # name: type, name: value

    def default(self):
        return {n: t.copy(self.defaults[n]) for n, t in self.fields.items()}

    def copy(self, value):
        return {n: t.copy(value[n]) for n, t in self.fields.items()}

    def flat(self, path, value):
        for name, kind in self.fields.items():
            yield from kind.flat(f"{path}.{name}", value[name])


class Overlay:
    """A value whose parts share bytes; see overlays.py."""


class OpenArray(Type):
    """ARRAY[*] of so many dimensions, of an in-out"""

    def __init__(self, element, dimensions):
        super().__init__(f"ARRAY[{', '.join('*' * dimensions)}] OF {element.name}", element.leaves)
        self.element, self.dimensions = element, dimensions


def same(kind, wanted):
    """Whether a variable of type kind can be bound to an in-out of type wanted"""
    if not isinstance(wanted, OpenArray) or kind is wanted:
        return kind is wanted
    dimensions = len(kind.bounds) if isinstance(kind, Array) else kind.dimensions if isinstance(kind, OpenArray) else 0
    return dimensions == wanted.dimensions and kind.element is wanted.element


class Ref:
    """A place: a key of a dictionary or an index of a list."""
    __slots__ = ("box", "key")

    def __init__(self, box, key):
        self.box, self.key = box, key

    def get(self):
        return self.box[self.key]

    def set(self, value):
        """A structure or an array stays where it is: another Ref may point into it."""
        if isinstance(value, Overlay):
            self.box[self.key].assign(value)
        elif isinstance(value, (list, dict)):
            keys = range(len(value)) if isinstance(value, list) else value
            for key in keys:
                Ref(self.box[self.key], key).set(value[key])
        else:
            self.box[self.key] = value


class OpenRef(Ref):
    """A place of an array together with its bounds"""
    __slots__ = ("bounds",)

    def __init__(self, ref, bounds):
        super().__init__(ref.box, ref.key)
        self.bounds = bounds


def limits(name):
    signed, bits = NUMBERS[name]
    return (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if signed else (0, (1 << bits) - 1)


def wrap(name, value):
    signed, bits = NUMBERS[name]
    value &= (1 << bits) - 1
    return value - (1 << bits) if signed and value >> (bits - 1) else value


def survives(a, b):
    """Every value of integer type a is one of b; bit strings and integers are not mixed here."""
    if (a in BITS) != (b in BITS):
        return False
    (signed_a, bits_a), (signed_b, bits_b) = NUMBERS[a], NUMBERS[b]
    if not signed_a:
        return bits_b > bits_a if signed_b else bits_b >= bits_a
    return signed_b and bits_b >= bits_a


def common(a, b):
    for name in (a, b, "INT", "DINT", "LINT"):
        if survives(a, name) and survives(b, name):
            return name
    raise Skip


def widened(name):
    return name if NUMBERS[name][1] >= 32 else "DWORD" if name in BITS else "DINT"


def single(value):
    """The REAL nearest to a float."""
    try:
        return struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)


def single_of_int(value):
    """The REAL nearest to an integer of any size, rounded once."""
    magnitude = abs(value)
    extra = magnitude.bit_length() - 24
    if extra > 0:
        half, rest = 1 << (extra - 1), magnitude & ((1 << extra) - 1)
        magnitude >>= extra
        if rest > half or (rest == half and magnitude & 1):
            magnitude += 1
        magnitude <<= extra
    return float(-magnitude if value < 0 else magnitude)


def rounded(kind, value):
    if math.isnan(value):
        raise Skip
    return single(value) if kind == "REAL" else value


def real_to_int(kind, value):
    low, high = limits(kind)
    if math.isnan(value):
        raise Skip
    if math.isinf(value):
        return high if value > 0 else low
    whole = math.floor(abs(value))
    if abs(value) - whole >= 0.5:
        whole += 1
    return max(low, min(high, -whole if value < 0 else whole))


def divided(kind, a, b, op):
    if b == 0:
        raise Skip
    quotient = abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
    return wrap(kind, quotient if op == "/" else a - quotient * b)


UNITS = {"d": 86_400_000_000_000, "h": 3_600_000_000_000, "m": 60_000_000_000, "s": 1_000_000_000, "ms": 1_000_000,
         "us": 1_000, "ns": 1}
EPOCH = datetime.date(1970, 1, 1)


def time_text(kind, value):
    """A literal for a value of TIME (ms), LTIME (ns), DATE (s), TOD (ms), DT (s)."""
    if kind == "TIME":
        return f"T#{value}ms"
    if kind == "LTIME":
        return f"LTIME#{value}ns"
    if kind in ("LDATE", "LTOD", "LDT"):
        short, scale = {"LDATE": ("DATE", 10**9), "LTOD": ("TOD", 10**6), "LDT": ("DT", 10**9)}[kind]
        text = time_text(short, value // scale).split("#")[1]
        if kind == "LTOD":
            text = f"{text.split('.')[0]}.{value % 10**9:09}"
        elif kind == "LDT" and value % 10**9:
            text += f".{value % 10**9:09}"
        return f"{kind}#{text}"
    if kind == "DATE":
        return f"D#{EPOCH + datetime.timedelta(days=value // 86400)}"
    if kind == "TOD":
        seconds, ms = divmod(value, 1000)
        return f"TOD#{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}.{ms:03}"
    day, seconds = divmod(value, 86400)
    return f"DT#{EPOCH + datetime.timedelta(days=day)}-{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}"


def clock(text):
    """ns since midnight"""
    hours, minutes, seconds = text.split(":")
    whole, _, rest = seconds.partition(".")
    return ((int(hours) * 60 + int(minutes)) * 60 + int(whole)) * 10**9 + int((rest + "0" * 9)[:9])


def time_value(kind, text):
    body = text.split("#", 1)[1]
    if kind in ("TIME", "LTIME"):
        total = sum(int(n) * UNITS[u] for n, u in re.findall(r"(\d+)(ms|us|ns|d|h|m|s)", body))
        total = -total if body.startswith("-") else total
        return total // 1_000_000 if kind == "TIME" else total
    if kind in ("TOD", "LTOD"):
        return clock(body) // (10**6 if kind == "TOD" else 1)
    value = (datetime.date.fromisoformat(body[:10]) - EPOCH).days * 86400 * 10**9
    value += clock(body[11:]) if body[11:] else 0
    return value if kind in ("LDATE", "LDT") else value // 10**9


ESCAPES = {"$": "$", "'": "'", '"': '"', "L": "\n", "N": "\n", "P": "\f", "R": "\r", "T": "\t"}


def string_text(value, family="STRING"):
    quote = '"' if family == "WSTRING" else "'"

    def plain(c):
        if c in ("$", quote):
            return "$" + c
        return c if " " <= c <= "~" else f"${ord(c):04X}" if family == "WSTRING" else f"${ord(c):02X}"

    return quote + "".join(map(plain, value)) + quote


def string_value(text):
    digits = 4 if text.startswith('"') else 2

    def plain(match):
        body = match.group(1)
        return ESCAPES[body.upper()] if len(body) == 1 else chr(int(body, 16))

    return re.sub(rf"\$([0-9A-Fa-f]{{{digits}}}|.)", plain, text[1:-1])


def real_text(value):
    text = repr(float(value))
    if "e" in text:
        mantissa, exponent = text.split("e")
        return f"{mantissa if '.' in mantissa else mantissa + '.0'}E{int(exponent)}"
    return text


def agrees(kind, expected, text):
    """Whether a printed value is the expected one."""
    name = kind.name
    if isinstance(kind, Enum):
        return kind.members.get(text, text) in (expected, str(expected))
    if isinstance(kind, StringType):
        return string_value(text) == expected
    if name == "BOOL":
        return text == str(expected).upper()
    if name in REALS:
        found = float(text)
        return rounded(name, found) == expected
    if name in TIMES:
        return time_value(name, text) == expected
    return text == str(expected)
