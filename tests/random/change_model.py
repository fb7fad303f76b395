"""Declarations of a project, and what an online change from one to another makes of their values: the rules of
docs/online-change.md, written without Stride.

A value is a number, a text, a dict by member name, or a list; of an array also its first index. Names are kept as written.
"""

BITS = {"SINT": (True, 8), "INT": (True, 16), "DINT": (True, 32), "LINT": (True, 64), "USINT": (False, 8), "BYTE": (False, 8),
        "UINT": (False, 16), "WORD": (False, 16), "UDINT": (False, 32), "DWORD": (False, 32), "ULINT": (False, 64),
        "LWORD": (False, 64)}
SIMPLE = [*BITS, "BOOL", "REAL", "LREAL", "TIME", "LTIME"]


def holds_every(old, new):
    """Every value of the old elementary type is one of the new one."""
    if old == new:
        return True
    if old in BITS and new in BITS:
        (signed, bits), (new_signed, new_bits) = BITS[old], BITS[new]
        return bits <= new_bits if signed == new_signed else not signed and bits < new_bits
    if old in BITS:
        return BITS[old][1] <= {"REAL": 16, "LREAL": 32}.get(new, 0)
    return (old, new) in (("REAL", "LREAL"), ("TIME", "LTIME"))


class Simple:
    """An elementary type, with bounds where it is a subrange."""

    def __init__(self, kind, low=None, high=None):
        self.kind, self.low, self.high = kind, low, high

    def text(self):
        return self.kind if self.low is None else f"{self.kind} ({self.low}..{self.high})"

    def default(self):
        return 0 if self.low is None or self.low <= 0 <= self.high else self.low if self.low > 0 else self.high

    def same(self, other):
        return isinstance(other, Simple) and self.kind == other.kind


class Text:
    def __init__(self, length):
        self.length = length

    def text(self):
        return f"STRING({self.length})"

    def default(self):
        return ""

    def same(self, other):
        return isinstance(other, Text) and self.length == other.length


class Enum:
    """An enumeration: pairs of name and number, in their order."""

    def __init__(self, name, names):
        self.name, self.names, self.renamed = name, names, None

    def text(self):
        return self.name

    def default(self):
        return self.names[0][1]

    def same(self, other):
        return isinstance(other, Enum) and other.name in (self.name, self.renamed)


class Array:
    def __init__(self, low, high, element):
        self.low, self.high, self.element = low, high, element

    def text(self):
        return f"ARRAY [{self.low}..{self.high}] OF {self.element.text()}"

    def default(self):
        return [self.element.default() for _ in range(self.low, self.high + 1)]

    def same(self, other):
        return isinstance(other, Array) and (self.low, self.high) == (other.low, other.high) and self.element.same(other.element)


class Member:
    """A variable or a member, with an initial value or None."""

    def __init__(self, name, kind, init=None):
        self.name, self.type, self.init = name, kind, init
        self.renamed, self.constant, self.reset = None, False, False
        self.watched = False  # an address leads through it, so it does not become a constant

    def initial(self):
        return self.type.default() if self.init is None else self.init


class Record:
    """A structure (`is_block` False) or a block, with a base or None."""

    def __init__(self, name, is_block, base, members):
        self.name, self.is_block, self.base, self.members, self.renamed = name, is_block, base, members, None

    def text(self):
        return self.name

    def all(self):
        return (self.base.all() if self.base else []) + self.members

    def default(self):
        return {m.name: m.initial() for m in self.all()}

    def bases(self):
        return [self.base.name, *self.base.bases()] if self.base else []

    def same(self, other):
        return isinstance(other, Record) and other.name in (self.name, self.renamed)


def number_of(kind):
    """What a type is when its values are taken as numbers."""
    return "INT" if isinstance(kind, Enum) else kind.kind if isinstance(kind, Simple) else None


def carry_enum(old, value, new, initial):
    by_name, by_number = {n.lower(): v for n, v in new.names}, {v: n for n, v in reversed(new.names)}
    old_names = {n.lower() for n, _ in old.names}

    def moved(name, number):
        if name.lower() in by_name:
            return by_name[name.lower()]
        other = by_number.get(number)
        return None if other is None or other.lower() in old_names else number

    targets = {number: moved(name, number) for name, number in old.names}
    if not new.same(old) and None in targets.values():
        return initial
    found = targets.get(value, value)
    return initial if found is None else found


def match_members(old, new):
    """By name of the new one: which old one it is. `old` and `new` are lists of members."""
    by_name = {m.name.lower(): m for m in old}
    source, taken = {}, set()
    for member in new:
        was = by_name.get((member.renamed or "").lower())
        own = by_name.get(member.name.lower())
        done = own is not None and own.renamed is not None and own.renamed == member.renamed
        if member.renamed and member.renamed != member.name and was and was.name not in taken and not done:
            source[member.name] = was
            taken.add(was.name)
    for member in new:
        own = by_name.get(member.name.lower())
        if member.name not in source and own and own.name not in taken:
            source[member.name] = own
            taken.add(own.name)
    return source


def carry_members(old, old_value, new, new_value):
    """The members of the new one, from those of the old one."""
    source, result = match_members(old, new), {}
    for member in new:
        initial = new_value[member.name]
        was = source.get(member.name)
        if was is None or was.constant or member.constant or was.reset or member.reset:
            result[member.name] = initial
        else:
            result[member.name] = carry(was.type, old_value[was.name], member.type, initial)
    return result


def related(old, new):
    """Two records whose members are the same variables."""
    if old.is_block != new.is_block:
        return False
    return not new.is_block or new.same(old) or new.name in old.bases() or old.name in new.bases()


def follow(old, new, steps):
    """Where what lies at `steps` (names, indices) of the old one lies in the new one: steps and type; None: nowhere."""
    if not steps:
        return [], new
    first, rest = steps[0], steps[1:]
    if isinstance(old, Array) and isinstance(new, Array) and new.low <= first <= new.high:
        found = follow(old.element, new.element, rest)
        return found and ([first, *found[0]], found[1])
    if isinstance(old, Record) and isinstance(new, Record) and related(old, new):
        return follow_member(old.all(), new.all(), first, rest)
    return None


def follow_member(old, new, name, rest):
    types = {m.name: m.type for m in new}
    for own, was in match_members(old, new).items():
        if was.name == name:
            found = follow(was.type, types[own], rest)
            return found and ([own, *found[0]], found[1])
    return None


def reaches(pointee, kind):
    """A pointer to `pointee` may point to a variable of a type: yes, no, or None where no rule says so."""
    if isinstance(pointee, Text) and isinstance(kind, Text):
        return kind.length >= pointee.length
    if isinstance(pointee, Array) and isinstance(kind, Array):
        return True if pointee is kind else None
    if isinstance(pointee, Simple) and isinstance(kind, Simple):
        return pointee.kind == kind.kind
    if isinstance(kind, (Record, Array)) and pointee is not kind:
        return None  # what begins there may be of that type
    return pointee is kind


def carry(old, value, new, initial):
    """The value of a variable of the new type whose old one was `value`."""
    if isinstance(old, Text) and isinstance(new, Text):
        return value[:new.length]
    if isinstance(old, Enum) and isinstance(new, Enum):
        return carry_enum(old, value, new, initial)
    if isinstance(new, Simple) and number_of(old) and holds_every(number_of(old), new.kind):
        return value if new.low is None or new.low <= value <= new.high else initial
    if isinstance(old, Array) and isinstance(new, Array):
        return [carry(old.element, value[i - old.low], new.element, initial[i - new.low]) if old.low <= i <= old.high
                else initial[i - new.low] for i in range(new.low, new.high + 1)]
    if isinstance(old, Record) and isinstance(new, Record) and related(old, new):
        return carry_members(old.all(), value, new.all(), initial)
    return initial


def leaves(kind, value, path):
    """All elementary values below: path, type, value."""
    if isinstance(kind, Array):
        for i, element in enumerate(value):
            yield from leaves(kind.element, element, f"{path}[{kind.low + i}]")
    elif isinstance(kind, Record):
        for member in kind.all():
            yield from leaves(member.type, value[member.name], f"{path}.{member.name}")
    else:
        yield path, kind, value


def literal(kind, value):
    """As `stride` writes and reads it."""
    if isinstance(kind, Text):
        return f"'{value}'"
    if isinstance(kind, Enum):
        return next((name for name, number in kind.names if number == value), str(value))
    if kind.kind == "BOOL":
        return "TRUE" if value else "FALSE"
    if kind.kind in ("REAL", "LREAL"):
        return repr(float(value))
    if kind.kind in ("TIME", "LTIME"):
        return f"{'T' if kind.kind == 'TIME' else 'LTIME'}#{value}ms"
    return str(value)
