"""gdb for ST: values as ST literals, frames as POUs, `st print`, `st set`, `st break`, `st roots`, `st catch`.

Loaded by `stride debug`, or by hand: (gdb) source <prefix>/share/stride/gdb/stride.py
Knows the form of generated code (docs/developers/generated-code.md) and nothing of a particular program: types
come from the debug information, the names of enumerators from the application's type table.
"""

import datetime
import re
import struct
from fractions import Fraction

import gdb
import gdb.printing
import gdb.types
import gdb.xmethod
from gdb.FrameDecorator import FrameDecorator

# ---------------------------------------------------------------- values


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


class TextPrinter:
    def __init__(self, text):
        self.text = text

    def to_string(self):
        return self.text


# Kinds of the type table (runtime/iec/types.h) that the debug information of an array's elements does
# not tell apart: template arguments lose their typedefs.
KINDS = ["", "BOOL", "SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT", "BYTE", "WORD", "DWORD",
         "LWORD", "REAL", "LREAL", "TIME", "LTIME", "DATE", "LDATE", "TOD", "LTOD", "DT", "LDT", "STRING",
         "WSTRING", "CHAR", "WCHAR"]
ENUM, COMPOSED, ARRAY = 32, (33, 34, 35, 36), 37


def element_type(value):
    """The type (of gdb) that the elements of the array `value` have in ST, or None: the type table says it for arrays
    in the application's state."""
    try:
        base, table = int(state().address), next(applications())
    except (gdb.error, StopIteration):
        return None
    if value.address is None or not 0 <= int(value.address) - base < table.state_size:
        return None
    offset, size = int(value.address) - base, value.type.sizeof
    entries = table.roots
    while True:
        entry = next((e for e in entries if e.offset <= offset < e.offset + table.types[e.type].size), None)
        if entry is None:
            return None
        offset -= entry.offset
        found = table.types[entry.type]
        while found.kind == ARRAY:
            element = table.types[found.element]
            if found.size == size and offset % size == 0:
                return named_type(element)
            found, offset = element, offset % element.size
        if found.kind not in COMPOSED:
            return None
        entries = found.members


def named_type(entry):
    if entry.kind == ENUM:
        for name in (f"st::user::{entry.name}", entry.name):
            try:
                return gdb.lookup_type(name)
            except gdb.error:
                pass
    elif entry.kind < len(KINDS) and KINDS[entry.kind] in ELEMENTARY:
        return gdb.lookup_type(f"stride::{KINDS[entry.kind]}")
    return None


class ArrayPrinter:
    """ARRAY[lo..hi]: the elements under their ST indices."""

    def __init__(self, value):
        self.value = value
        self.low = int(value.type.strip_typedefs().template_argument(1))
        self.high = int(value.type.strip_typedefs().template_argument(2))

    def to_string(self):
        return f"ARRAY[{self.low}..{self.high}]"

    def children(self):
        elements, kind = self.value["v"], element_type(self.value)
        for index in range(self.low, self.high + 1):
            element = elements[index - self.low]
            yield f"[{index}]", element.cast(kind) if kind else element


def enumerators_of(name):
    """{value: enumerator} of the enumeration `name`, or None, from the applications' type tables."""
    for table in applications():
        for entry in table.types:
            if entry.kind == ENUM and entry.name == name:
                return entry.enumerators
    return None


class Member:
    """A member or a root: its type's number, and its offset in bytes."""

    def __init__(self, kind, offset):
        self.type, self.offset = kind, offset


class Type:
    """A type; sizes are in bytes."""

    def __init__(self, columns, numbers):
        self.name, element = columns[1], (columns + [""] * 2)[3]
        self.element = int(element) if element else None
        self.kind, self.size, _ = next(numbers), next(numbers), next(numbers)
        self.members, self.enumerators = [], {}


class Application:
    """What `description` (StrideAppV1) says of types, members, enumerators and roots: SymbolLines of
    runtime/app/abi.h."""

    def __init__(self, description):
        self.state_size, self.types, self.roots = int(description["stateSize"]), [], []
        lines = description["symbols"]
        if not lines or not lines["text"]:
            return  # not relocated yet
        inferior = gdb.selected_inferior()
        text = bytes(inferior.read_memory(int(lines["text"]), int(lines["length"]))).decode(errors="replace")
        values = b""
        for i in range(int(lines["numberLists"])):
            part = lines["numbers"][i]
            values += bytes(inferior.read_memory(int(part["values"]), 8 * int(part["count"])))
        numbers = iter(number for number, in struct.iter_unpack("<Q", values))
        for line in text.split("\n"):
            columns = line.split("\t")
            if line.startswith("T"):
                self.types.append(Type(columns, numbers))
            elif line.startswith("E"):
                self.types[-1].enumerators[int((columns + ["0"])[2])] = columns[1]
            elif line:
                members = self.roots if line.startswith("R") else self.types[-1].members
                members.append(Member(int(columns[2]), next(numbers)))


def applications():
    """The loaded applications. What is read of one is kept with its file."""
    for objfile in gdb.objfiles():
        found = getattr(objfile, "stride_application", None)
        if found is None:
            symbol = objfile.lookup_global_symbol("st::user::application__")
            if symbol is None:
                continue
            found = Application(symbol.value())
            if found.types:
                objfile.stride_application = found
        yield found


class Lookup(gdb.printing.PrettyPrinter):
    """Picks the printer by the ST type's name, which C++ keeps as that of a typedef."""

    def __init__(self):
        super().__init__("stride", [gdb.printing.SubPrettyPrinter("values")])

    def __call__(self, value):
        kind = value.type.unqualified()
        if kind.code == gdb.TYPE_CODE_REF:
            return self(value.referenced_value())
        name = kind.name or ""
        if kind.code == gdb.TYPE_CODE_TYPEDEF:
            return self.of_typedef(value, kind, name)
        if name.startswith("stride::STRING<"):
            return TextPrinter(text_literal(codes_of(value["s"], 1), "'"))
        if name.startswith("stride::WSTRING<"):
            return TextPrinter(text_literal(codes_of(value["s"], 2), '"'))
        if name.startswith("stride::Array<"):
            return ArrayPrinter(value)
        return None

    def of_typedef(self, value, kind, name):
        if name.startswith("stride::"):
            writer = ELEMENTARY.get(name[len("stride::"):])
            return TextPrinter(writer(value)) if writer else None
        if not name.startswith("st::"):
            return None
        target = kind.target()
        if target.code != gdb.TYPE_CODE_TYPEDEF or not target.name.startswith("stride::"):
            return self(value.cast(target))
        names = enumerators_of(name.rsplit("::", 1)[1])
        if names is None:
            return self(value.cast(target)) # an alias of an elementary type
        number = int(value)
        return TextPrinter(f"{names[number]} ({number})" if number in names else str(number))


# ---------------------------------------------------------------- a[i] as ST counts


class IndexWorker(gdb.xmethod.XMethodWorker):
    def get_arg_types(self):
        return gdb.lookup_type("long")

    def __call__(self, obj, index):
        if obj.type.strip_typedefs().code in (gdb.TYPE_CODE_PTR, gdb.TYPE_CODE_REF):
            obj = obj.referenced_value()
        kind = obj.type.strip_typedefs().unqualified()
        low, high = int(kind.template_argument(1)), int(kind.template_argument(2))
        if not low <= int(index) <= high:
            raise gdb.GdbError(f"index {int(index)} is outside of {low}..{high}")
        kind, found = element_type(obj), obj["v"][int(index) - low]
        return found.address.cast(kind.pointer()).dereference() if kind else found


class IndexMatcher(gdb.xmethod.XMethodMatcher):
    def __init__(self):
        super().__init__("stride-array")
        self.methods = [gdb.xmethod.XMethod("index")]

    def match(self, class_type, method_name):
        name = class_type.strip_typedefs().unqualified().name or ""
        return IndexWorker() if method_name == "operator[]" and name.startswith("stride::Array<") else None


# ---------------------------------------------------------------- frames

POU = re.compile(r"^st::(?:user::)?(?P<name>.+?)(?:::body__(?:call)?|__call)?(?:\(.*\))?$")


def pou_name(function):
    """`Counter` of st::user::Counter::body__, `Counter.Reset` of a method; None: not of ST."""
    if not isinstance(function, str) or not function.startswith("st::"):
        return None
    name = POU.match(function).group("name")
    for inner, outer in (("__get", ".Get"), ("__set", ".Set")):
        if name.endswith(inner):
            name = name[:-len(inner)] + outer
    name = name.replace("::init__", " (initial values)").replace("::exit__", " (FB_Exit)")
    return name.replace("::", ".").replace("__", ".")


class PouFrame(FrameDecorator):
    """A frame of ST: the POU's name, its inputs and variables without what Stride adds."""

    def function(self):
        return pou_name(super().function()) or super().function()

    def visible(self, entries):
        return [e for e in entries or [] if "__" not in str(e.symbol()) and str(e.symbol()) != "this"]

    def frame_args(self):
        return self.visible(super().frame_args())

    def frame_locals(self):
        return self.visible(super().frame_locals())


class PouFilter:
    """`bt` shows the POUs; `bt -no-filters` everything."""

    def __init__(self):
        self.name = "stride"
        self.priority = 100
        self.enabled = True
        gdb.frame_filters[self.name] = self

    def filter(self, frames):
        frames = list(frames)
        kept = [PouFrame(f) for f in frames if pou_name(FrameDecorator.function(f))]
        return iter(kept or frames)


# ---------------------------------------------------------------- paths

STEP = re.compile(r"\s*(?:\.?\s*(?P<name>[A-Za-z_]\w*)|\[(?P<index>[^\]]*)\]|(?P<deref>\^))")


def field(value, name):
    """The member `name` of a structure, whatever its case, also an inherited one; or None."""
    kind = value.type.strip_typedefs()
    if kind.code in (gdb.TYPE_CODE_PTR, gdb.TYPE_CODE_REF):
        return field(value.referenced_value(), name)
    if kind.code not in (gdb.TYPE_CODE_STRUCT, gdb.TYPE_CODE_UNION):
        return None
    for member in kind.fields():
        if member.name and member.name.lower() in (name.lower(), name.lower() + "_"):
            return value[member]
    for member in kind.fields():
        if member.name == "base__":
            return field(value[member], name)
    return None


def local(name):
    """A variable of the selected frame: local, argument, or of its instance."""
    frame = gdb.selected_frame()
    block = frame.block() if frame.is_valid() else None
    while block is not None and not block.is_global and not block.is_static:
        for symbol in block:
            if (symbol.is_variable or symbol.is_argument) and symbol.name.lower() == name.lower():
                return symbol.value(frame) if symbol.needs_frame else symbol.value()
        if block.function is not None:
            break
        block = block.superblock
    try:
        return field(frame.read_var("this"), name)
    except ValueError:
        return None


def state():
    """The state of the application whose code is running."""
    frame = gdb.selected_frame()
    while frame is not None:
        try:
            context = frame.read_var("ctx__")
        except (ValueError, RuntimeError):
            context = None
        if context is not None and not context.is_optimized_out:
            if context.type.code == gdb.TYPE_CODE_REF:
                context = context.referenced_value().address
            return context["state"].cast(gdb.lookup_type("st::user::App__").pointer()).dereference()
        frame = frame.older()
    raise gdb.GdbError("no POU is being executed here: set a breakpoint in one and continue")


def roots():
    """(ST name, value) of every program and variable list, then of every global variable."""
    everything = state()
    lists = []
    for member in everything.type.fields():
        if member.name.endswith("__program"):
            yield member.name[:-len("__program")], everything[member]
        elif member.name.endswith("__") and everything[member].type.strip_typedefs().code == gdb.TYPE_CODE_STRUCT:
            lists.append((member.name[:-2].replace("__", "."), everything[member]))
    yield from lists
    for _, variables in lists:
        for member in variables.type.strip_typedefs().fields():
            yield member.name, variables[member]


def resolve(path):
    """The value that an ST path names, seen from the selected frame."""
    position, value, walked = 0, None, ""
    while position < len(path.rstrip()):
        step = STEP.match(path, position)
        if step is None:
            raise gdb.GdbError(f"`{path[position:]}` is no part of an ST path like Main.axis[3].fPos")
        position = step.end()
        if step.group("name"):
            value = first(step.group("name")) if value is None else field(value, step.group("name"))
            if value is None:
                where = f" in `{walked}`" if walked else "; `st roots` lists the programs and global variables"
                raise gdb.GdbError(f"there is no `{step.group('name')}`{where}")
        elif value is None:
            raise gdb.GdbError("a path begins with a name")
        elif step.group("index") is not None:
            for index in step.group("index").split(","):
                value = element(value, index)
        else:
            value = value.dereference()
        walked = path[:position].strip()
    if value is None:
        raise gdb.GdbError("say what: st print Main.axis[3].fPos")
    return value.referenced_value() if value.type.code == gdb.TYPE_CODE_REF else value


def first(name):
    found = local(name)
    if found is not None:
        return found
    return next((value for root, value in roots() if root.lower() == name.lower()), None)


def element(value, text):
    try:
        index = int(text)
    except ValueError:
        index = int(resolve(text.strip()))
    if value.type.code == gdb.TYPE_CODE_REF:
        value = value.referenced_value()
    if not (value.type.strip_typedefs().name or "").startswith("stride::Array<"):
        raise gdb.GdbError(f"`[{text}]`: that is no array")
    return IndexWorker()(value, index)


# ---------------------------------------------------------------- literals

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


# ---------------------------------------------------------------- commands


class St(gdb.Command):
    """Commands for ST programs."""

    def __init__(self):
        super().__init__("st", gdb.COMMAND_DATA, prefix=True)


class Print(gdb.Command):
    """st print PATH: a variable by its ST path, whatever its case.
Local names first, then programs and global variables: st print Main.axis[3].fPos, st print p^.x"""

    def __init__(self):
        super().__init__("st print", gdb.COMMAND_DATA)

    def invoke(self, argument, from_tty):
        print(f"{argument.strip()} = {resolve(argument).format_string()}")


class Set(gdb.Command):
    """st set PATH := VALUE: gives a variable a value, an ST literal or another variable of its type.
st set Main.delay := T#2s, st set gText := 'new', st set Main.color := green"""

    def __init__(self):
        super().__init__("st set", gdb.COMMAND_DATA)

    def invoke(self, argument, from_tty):
        path, assign, text = argument.partition(":=")
        path, text = path.strip(), text.strip()
        if not assign or not path or not text:
            raise gdb.GdbError("say what: st set Main.total := 20")
        place = resolve(path)
        if place.address is None:
            raise gdb.GdbError(f"`{path}` has no address")
        data = encoded(text, place)
        if data is None:
            kind = st_type(place.type)
            try:
                source = resolve(text)
            except gdb.GdbError:
                raise gdb.GdbError(f"`{text}` is neither a literal for `{path}` ({kind}) nor a variable")
            if st_type(source.type) != kind or not kind or source.address is None:
                raise gdb.GdbError(f"`{text}` is of another type than `{path}` ({kind})")
            data = bytes(gdb.selected_inferior().read_memory(int(source.address), source.type.sizeof))
        gdb.selected_inferior().write_memory(int(place.address), data)


class Roots(gdb.Command):
    """st roots: the programs, variable lists and global variables."""

    def __init__(self):
        super().__init__("st roots", gdb.COMMAND_DATA)

    def invoke(self, argument, from_tty):
        for name, _ in roots():
            print(name)


class Start(gdb.Command):
    """st start: run until the application is loaded, so that breakpoints find its POUs."""

    def __init__(self):
        super().__init__("st start", gdb.COMMAND_RUNNING)

    def invoke(self, argument, from_tty):
        program = gdb.execute("show args", to_string=True).split('"', 1)[1].rsplit('"', 1)[0]
        application = next((word for word in program.split() if word.endswith(".so")), None)
        if application is None:
            raise gdb.GdbError(f"there is no application in the arguments of the program: {program}")
        gdb.execute(f"tcatch load {re.escape(application.rsplit('/', 1)[-1].strip(chr(39)))}$", to_string=True)
        gdb.execute("run", to_string=True)


class Break(gdb.Command):
    """st break POU: stop when a program, block, function or method (Block.Method) is entered."""

    def __init__(self):
        super().__init__("st break", gdb.COMMAND_BREAKPOINTS)

    def invoke(self, argument, from_tty):
        name = argument.strip().replace(".", "::")
        if not name:
            raise gdb.GdbError("say where: st break Counter, st break Counter.Reset")
        for place in (f"st::user::{name}::body__", f"st::user::{name}", f"st::{name}::body__", f"st::{name}"):
            try:
                gdb.decode_line(place)
            except gdb.error:
                continue
            gdb.Breakpoint(function=place, qualified=True)
            return
        loaded = any(True for _ in applications())
        hint = "its name as in ST: Counter, Counter.Reset" if loaded else "`st start` loads the application"
        raise gdb.GdbError(f"there is no POU `{argument.strip()}`; {hint}")


CONDITION = re.compile(r"\s(?:if\b|thread\s|task\s|mask\s)|$")


def lasting(expression):
    """What names the same place as gdb's expression without the frame, if it is in the application's state; or None."""
    try:
        base, table = int(state().address), next(applications())
        place = gdb.parse_and_eval(f"&({expression})")
        if not 0 <= int(place) - base < table.state_size:
            return None
    except (gdb.error, gdb.GdbError, StopIteration):
        return None
    stem = name = "watched_" + re.sub(r"\W+", "_", expression.strip()).strip("_")
    number = 1
    while (known := gdb.convenience_variable(name)) is not None and int(known) != int(place):
        number += 1
        name = f"{stem}_{number}"
    gdb.set_convenience_variable(name, place)
    return "*$" + name


class Watch(gdb.Command):
    """Stops when a variable changes (rwatch: is read; awatch: either): watch total, watch total if n > 3.
That of a program or an instance is watched from cycle to cycle, any other one until its POU ends."""

    def __init__(self, name, kind):
        super().__init__(name, gdb.COMMAND_BREAKPOINTS, gdb.COMPLETE_EXPRESSION)
        self.kind = kind

    def invoke(self, argument, from_tty):
        if not argument.strip():
            raise gdb.GdbError("say what: watch total, watch total if n > 3")
        expression = argument[:CONDITION.search(argument).start()]
        place = lasting(expression)
        rest = argument[len(expression):]
        if place: # in its condition, too, which is tested where the variable changes
            rest = re.sub(rf"(?<![\w.]){re.escape(expression.strip())}(?![\w.\[])", lambda _: f"({place})", rest)
        try:
            gdb.Breakpoint((place or expression) + rest, gdb.BP_WATCHPOINT, self.kind)
        except gdb.error as error:
            raise gdb.GdbError(str(error))


class Catch(gdb.Command):
    """st catch: stop where an ST exception (division by zero, index, null pointer …) is raised."""

    def __init__(self):
        super().__init__("st catch", gdb.COMMAND_BREAKPOINTS)

    def invoke(self, argument, from_tty):
        for function in ("stride::raise", "stride::raiseDetail"):
            gdb.Breakpoint(function)


def install():
    gdb.printing.register_pretty_printer(None, Lookup(), replace=True)
    gdb.xmethod.register_xmethod_matcher(None, IndexMatcher(), replace=True)
    PouFilter()
    for command in (St, Start, Print, Set, Roots, Break, Catch):
        command()
    Watch("watch", gdb.WP_WRITE)
    Watch("rwatch", gdb.WP_READ)
    Watch("awatch", gdb.WP_ACCESS)
    # The application is loaded by the host, so breakpoints in it wait; names are as in ST; `step` goes
    # over the runtime's helpers.
    gdb.execute("set breakpoint pending on")
    gdb.execute("set case-sensitive off", to_string=True)
    gdb.execute("skip -gfi */runtime/iec/*", to_string=True)
    gdb.execute("set print pretty on")


install()
