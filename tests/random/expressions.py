"""Random expressions: text together with a function that computes the value."""
import math
import re

from model import (BITS, INTS, NUMBERS, REALS, TIMES, Array, Enum, Ref, Skip, StringType, Struct, Subrange, Type, common,
                   divided, limits, real_text, real_to_int, rounded, single, single_of_int, string_text, survives,
                   time_text, widened, wrap)

BOOL = Type("BOOL")
ELEMENTARY = {name: Type(name) for name in ["BOOL", *NUMBERS, *REALS, *TIMES]}
COMPARE = {"=": lambda a, b: a == b, "<>": lambda a, b: a != b, "<": lambda a, b: a < b, "<=": lambda a, b: a <= b,
           ">": lambda a, b: a > b, ">=": lambda a, b: a >= b}
PRECEDENCE = {"OR": 1, "OR_ELSE": 1, "XOR": 2, "AND": 3, "AND_THEN": 3, "&": 3, "=": 4, "<>": 4, "<": 5, "<=": 5, ">": 5, ">=": 5,
              "+": 6, "-": 6, "*": 7, "/": 7, "MOD": 7}
UNARY, PRIMARY = 8, 9
CHARACTERS = "abcdeXYZ 019.,$'\"%\\?#"


class Node:
    """An expression. `before` is an integer's type before operands were widened."""

    def __init__(self, text, kind, fn, before=None, prec=PRIMARY, const=False):
        self.text, self.kind, self.fn, self.prec, self.const = text, kind, fn, prec, const
        self.before = before or kind
        self.narrow = False  # a subrange

    def inside(self, level, rng):
        if self.prec >= level and rng.random() < 0.7:
            return self.text
        return self.text if self.prec == PRIMARY and rng.random() < 0.95 else f"({self.text})"


def binary(rng, op, left, right):
    level = PRECEDENCE[op]
    text = f"{left.inside(level, rng)} {op} {right.inside(level + 1, rng)}"
    return text, level


class Variable:
    """A name that can be read, and written unless it is busy or constant."""

    def __init__(self, name, kind, place, writable=True, shared=False, const=False):
        self.name, self.kind, self.place, self.writable, self.shared = name, kind, place, writable, shared
        self.const = const


class Scope:
    """What a body sees."""

    def __init__(self, variables):
        self.variables = variables
        self.busy = set()
        self.by_leaf = {}
        for v in variables:
            for leaf in v.kind.leaves:
                self.by_leaf.setdefault(leaf, []).append(v)


class Expressions:
    def __init__(self, rng, budget):
        self.rng, self.budget = rng, budget
        self.functions, self.objects = [], []  # callable in expressions
        self.enums, self.scope, self.in_call = [], None, 0

    # Places

    def place(self, wanted, write=False, const=False):
        """(text, type, function of the frame giving a Ref) of a variable or a part of one, of the leaf type wanted"""
        candidates = [v for v in self.scope.by_leaf.get(wanted, ()) if not (write and (not v.writable or v.name in self.scope.busy)) and (const or not v.const)]
        if not candidates:
            raise Skip
        v = self.rng.choice(candidates)
        return self.descend(v.name, v.kind, v.place, wanted)

    def descend(self, text, kind, place, wanted):
        rng = self.rng
        while True:
            if isinstance(kind, Array):
                text, kind, place = self.element(text, kind, place)
            elif isinstance(kind, Struct):
                name = rng.choice([n for n, t in kind.fields.items() if wanted in t.leaves])
                text, kind, place = f"{text}.{name}", kind.fields[name], self.field(place, name)
            else:
                return text, kind, place

    @staticmethod
    def field(place, name):
        return lambda f: Ref(place(f).get(), name)

    def element(self, text, kind, place):
        indices = [self.index(low, high) for low, high in kind.bounds]
        joint = "][" if self.rng.random() < 0.2 else ", "
        bounds = kind.bounds

        def run(f):
            box, offset = place(f).get(), 0
            for (low, high), (_, index) in zip(bounds, indices):
                offset = offset * (high - low + 1) + index(f) - low
            return Ref(box, offset)

        return f"{text}[{joint.join(t for t, _ in indices)}]", kind.element, run

    def index(self, low, high):
        rng = self.rng
        if rng.random() < 0.4 or self.in_call > 2:
            value = rng.randint(low, high)
            return str(value), lambda f: value
        node = self.integer(1)
        if NUMBERS[node.kind][1] == 64 and not INTS.get(node.kind, (False,))[0] or node.kind in BITS:
            raise Skip
        return f"LIMIT({low}, {node.text}, {high})", lambda f: max(low, min(high, node.fn(f)))

    def read(self, wanted, kinds=None):
        for _ in range(8):
            text, kind, place = self.place(wanted)
            if kinds is None or kind.name in kinds:
                return text, kind, lambda f: place(f).get()
        raise Skip

    # Integers and bit strings

    def integer(self, depth, names=NUMBERS):
        """A number of whatever type comes out."""
        rng = self.rng
        if depth <= 0 or rng.random() < 0.15:
            name = rng.choice(list(names))
            if rng.random() < 0.08:
                value = rng.choice([*limits(name), rng.randint(*limits(name)), rng.randint(0, 9)])
                return Node(f"{name}#{value}", name, lambda f: value, prec=UNARY, const=True)
            if rng.random() < 0.1:
                constants = [v for v in self.scope.variables if v.const and v.kind.name == name]
                if constants:
                    v = rng.choice(constants)
                    return Node(v.name, name, lambda f: v.place(f).get(), const=True)
            text, kind, get = self.read(name)
            node = Node(text, name, get)
            node.narrow = isinstance(kind, Subrange)
            return node
        choice = rng.random()
        if choice < 0.42:
            return self.arithmetic(depth, names)
        if choice < 0.55:
            return self.bitwise(depth, names)
        if choice < 0.62:
            a = self.integer(depth - 1, names)
            if a.const or a.before != a.kind:
                raise Skip
            return Node(f"NOT {a.inside(UNARY, rng)}", a.kind, lambda f: wrap(a.kind, ~a.fn(f)), prec=UNARY)
        if choice < 0.67:
            a = self.integer(depth - 1, INTS)
            if a.const:
                raise Skip
            kind = widened(a.kind)
            if not INTS[kind][0]:
                raise Skip
            text = a.text if a.prec == PRIMARY else f"({a.text})"
            return Node(f"-{text}", kind, lambda f: wrap(kind, -a.fn(f)), before=a.before, prec=UNARY)
        if choice < 0.75 and names is not INTS:
            return self.shifted(depth)
        if choice < 0.85:
            return self.converted(depth, rng.choice(list(names)))
        if choice < 0.93:
            return self.selected(depth, lambda: self.integer(depth - 1, names))
        call = self.call(depth, lambda kind: kind.name in names)
        return Node(call[0], call[1].name, call[2])

    def pair(self, depth, names):
        """Two operands, one of which may be a literal."""
        left = self.integer(depth - 1, names)
        if self.rng.random() < 0.3 and not left.const:
            low, high = limits(left.before)
            value = self.rng.choice([low, high, 0, 1, 2, 3, 10, self.rng.randint(low, high)])
            value = max(low, min(high, value))
            text = str(value)
            if value >= 0 and self.rng.random() < 0.2:
                text = f"16#{value:X}"
            # A literal fits the other operand's type and takes it on.
            right = Node(text, left.before, lambda f: value, prec=PRIMARY if value >= 0 else UNARY, const=True)
        else:
            right = self.integer(depth - 1, names)
        if left.const and right.const:
            raise Skip
        return (left, right) if self.rng.random() < 0.8 or not right.const else (right, left)

    def arithmetic(self, depth, names):
        rng = self.rng
        op = rng.choice(["+", "-", "*", "/", "MOD"])
        a, b = self.pair(depth, rng.choice([INTS, INTS, BITS]) if names is NUMBERS else names)
        before = common(a.before, b.before)
        kind = common(common(widened(before), a.kind), b.kind)
        if b.const and op in ("/", "MOD") and b.fn(None) == 0:
            raise Skip
        text, prec = binary(rng, op, a, b)

        def run(f):
            x, y = wrap(kind, a.fn(f)), wrap(kind, b.fn(f))
            if op in ("/", "MOD"):
                return divided(kind, x, y, op)
            return wrap(kind, x + y if op == "+" else x - y if op == "-" else x * y)

        return Node(text, kind, run, before, prec)

    def bitwise(self, depth, names):
        rng = self.rng
        op = rng.choice(["AND", "OR", "XOR"])
        a, b = self.pair(depth, rng.choice([INTS, BITS, BITS]) if names is NUMBERS else names)
        kind = common(a.before, b.before)
        if NUMBERS[kind][1] < max(NUMBERS[a.kind][1], NUMBERS[b.kind][1]):
            raise Skip
        text, prec = binary(rng, op, a, b)

        def run(f):
            x, y = wrap(kind, a.fn(f)), wrap(kind, b.fn(f))
            return wrap(kind, x & y if op == "AND" else x | y if op == "OR" else x ^ y)

        return Node(text, kind, run, None, prec)

    def shifted(self, depth):
        """Shifts and rotations keep to the width of a bit string."""
        kind = self.rng.choice(list(BITS))
        text, _, get = self.read(kind)
        bits, op = BITS[kind][1], self.rng.choice(["SHL", "SHR", "ROL", "ROR"])
        count, amount = self.amount(bits)

        def run(f):
            value = get(f)
            n = amount(f)
            if op in ("ROL", "ROR"):
                n = n % bits if op == "ROL" else -n % bits
                return wrap(kind, value << n | value >> (bits - n))
            return wrap(kind, value << n) if op == "SHL" else value >> n

        return Node(f"{op}({text}, {count})", kind, run)

    def amount(self, bits):
        if self.rng.random() < 0.7:
            n = self.rng.choice([0, 1, bits - 1, bits, self.rng.randint(0, bits + 3)])
            return str(n), lambda f: n
        text, _, get = self.read("USINT")
        return text, get

    def selected(self, depth, make):
        """SEL, MUX, MIN, MAX, LIMIT of operands of one type"""
        rng = self.rng
        nodes = [make()]
        for _ in range(30):
            if len(nodes) == 3:
                break
            node = make()
            if node.kind == nodes[0].kind:
                nodes.append(node)
        if len(nodes) < 3 or all(n.const for n in nodes) or any(n.before != n.kind or n.narrow for n in nodes):
            raise Skip
        a, b, c = nodes
        kind, op = a.kind, rng.choice(["SEL", "MUX", "MIN", "MAX", "LIMIT"])
        if op == "SEL":
            test = self.boolean(depth - 1)

            def run(f):
                return b.fn(f) if test.fn(f) else a.fn(f)  # the other one is not computed

            return Node(f"SEL({test.text}, {a.text}, {b.text})", kind, run)
        if op == "MUX":
            k = rng.randint(0, 2)
            return Node(f"MUX({k}, {a.text}, {b.text}, {c.text})", kind, nodes[k].fn)
        if op == "LIMIT":
            def run(f):
                low, value, high = a.fn(f), b.fn(f), c.fn(f)
                return min(max(low, value), high)  # the upper limit wins

            return Node(f"LIMIT({a.text}, {b.text}, {c.text})", kind, run)
        pick = min if op == "MIN" else max
        chosen = nodes[:rng.randint(2, 3)]
        return Node(f"{op}({', '.join(n.text for n in chosen)})", kind, lambda f: pick([n.fn(f) for n in chosen]))

    def converted(self, depth, kind):
        """X_TO_Y of something, of type kind (a number, BOOL excluded)"""
        rng = self.rng
        choice = rng.random()
        if choice < 0.55:
            a = self.integer(depth - 1)
            if a.const or a.kind == kind:
                raise Skip
            source, fn = a.kind, lambda f: wrap(kind, a.fn(f))
        elif choice < 0.75:
            a = self.real(depth - 1, rng.choice(REALS))
            if a.const:
                raise Skip
            if rng.random() < 0.3 and kind == "DINT":
                def cut(f):
                    value = a.fn(f)
                    if math.isinf(value) or abs(value) >= 2**31 or math.isnan(value):
                        raise Skip
                    return math.trunc(value)

                return Node(f"TRUNC({a.text})", kind, cut)
            source, fn = a.kind, lambda f: real_to_int(kind, a.fn(f))
        elif choice < 0.87:
            a = self.boolean(depth - 1)
            source, fn = "BOOL", lambda f: int(a.fn(f))
        else:
            source = rng.choice(["TIME", "TOD", "DT"])
            a = self.time(depth - 1, source)
            fn = lambda f: wrap(kind, a.fn(f))
        name = f"TO_{kind}" if rng.random() < 0.25 else f"{source}_TO_{kind}"
        return Node(f"{name}({a.text})", kind, fn)

    def value_of(self, kind, depth, exact=False):
        """An expression that may be assigned to integer type kind (exact: is of it), and its value as that type"""
        rng = self.rng
        if rng.random() < 0.12:
            value = rng.choice([*limits(kind), rng.randint(*limits(kind)), rng.randint(0, 20)])
            return Node(str(value), kind, lambda f: value, const=True)
        a = self.integer(depth, BITS if kind in BITS and rng.random() < 0.7 else NUMBERS)
        if a.const:
            raise Skip
        if a.kind == kind or (not exact and survives(a.kind, kind) and rng.random() < 0.8):
            return Node(a.text, kind, a.fn)
        if a.kind != a.before and a.before == kind and not exact:
            return Node(a.text, kind, lambda f: wrap(kind, a.fn(f)))
        return Node(f"{a.kind}_TO_{kind}({a.text})", kind, lambda f: wrap(kind, a.fn(f)))

    # Reals

    def real(self, depth, kind):
        rng = self.rng
        if depth <= 0 or rng.random() < 0.2:
            text, _, get = self.read(kind)
            return Node(text, kind, get)
        choice = rng.random()
        if choice < 0.5:
            op = rng.choice(["+", "-", "*", "/"])
            a = self.real(depth - 1, kind)
            other = rng.random()
            if other < 0.25:
                value = rng.choice([0.1, 0.5, 2.0, -3.75, 1e10, 1.5e-3, 100.0, rng.uniform(-50, 50)])
                value = rounded(kind, value) if rng.random() < 0.5 else value
                b = Node(real_text(value), kind, lambda f: rounded(kind, value), prec=PRIMARY if value >= 0 else UNARY,
                         const=True)
            elif other < 0.4:  # an integer that fits becomes a real of itself
                text, _, get = self.read(rng.choice(["SINT", "INT", "USINT", "UINT"]))
                b = Node(text, kind, lambda f: float(get(f)))
            elif other < 0.55 and kind == "LREAL":
                b = self.real(depth - 1, "REAL")
            else:
                b = self.real(depth - 1, kind)
            if rng.random() < 0.4:
                a, b = b, a
            if a.const and b.const:
                raise Skip
            text, prec = binary(rng, op, a, b)
            return Node(text, kind, lambda f: self.compute(kind, op, a.fn(f), b.fn(f)), prec=prec)
        if choice < 0.6:
            a = self.real(depth - 1, kind)
            text = a.text if a.prec == PRIMARY else f"({a.text})"
            return Node(f"-{text}", kind, lambda f: -a.fn(f), prec=UNARY)
        if choice < 0.72:
            a = self.integer(depth - 1, INTS)
            if a.const:
                raise Skip
            fn = (lambda f: single_of_int(a.fn(f))) if kind == "REAL" else lambda f: float(a.fn(f))
            name = f"TO_{kind}" if rng.random() < 0.2 else f"{a.kind}_TO_{kind}"
            return Node(f"{name}({a.text})", kind, fn)
        if choice < 0.78:
            other = "LREAL" if kind == "REAL" else "REAL"
            a = self.real(depth - 1, other)
            return Node(f"{other}_TO_{kind}({a.text})", kind, lambda f: rounded(kind, a.fn(f)))
        if choice < 0.84:
            a = self.real(depth - 1, kind)
            return Node(f"ABS({a.text})", kind, lambda f: abs(a.fn(f)))
        if choice < 0.89:
            a = self.real(depth - 1, kind)

            def root(f):
                value = abs(a.fn(f))
                return math.inf if math.isinf(value) else rounded(kind, math.sqrt(value))

            return Node(f"SQRT(ABS({a.text}))", kind, root)
        if choice < 0.96:
            return self.selected(depth, lambda: self.real(depth - 1, kind))
        call = self.call(depth, lambda t: t.name == kind)
        return Node(call[0], kind, call[2])

    @staticmethod
    def compute(kind, op, a, b):
        if op == "/":
            if b == 0:
                if a == 0 or math.isnan(a):
                    raise Skip
                return math.copysign(math.inf, a) * math.copysign(1, b)
            value = a / b
        else:
            value = a + b if op == "+" else a - b if op == "-" else a * b
        return rounded(kind, value)

    # BOOL

    def boolean(self, depth):
        rng = self.rng
        if depth <= 0 or rng.random() < 0.12:
            if rng.random() < 0.3:
                kind = rng.choice(list(NUMBERS))
                text, _, get = self.read(kind)
                bit = rng.randrange(NUMBERS[kind][1])
                return Node(f"{text}.{bit}", "BOOL", lambda f: bool(get(f) >> bit & 1))
            text, _, get = self.read("BOOL")
            return Node(text, "BOOL", get)
        choice = rng.random()
        if choice < 0.5:
            return self.comparison(depth)
        if choice < 0.6:
            a = self.boolean(depth - 1)
            return Node(f"NOT {a.inside(UNARY, rng)}", "BOOL", lambda f: not a.fn(f), prec=UNARY)
        if choice < 0.66:
            call = self.call(depth, lambda t: t.name == "BOOL")
            return Node(call[0], "BOOL", call[2])
        if choice < 0.7:
            a = self.integer(depth - 1)
            if a.const:
                raise Skip
            return Node(f"{a.kind}_TO_BOOL({a.text})", "BOOL", lambda f: a.fn(f) != 0)
        op = rng.choice(["AND", "OR", "XOR", "AND_THEN", "OR_ELSE", "=", "<>", "&"])
        a, b = self.boolean(depth - 1), self.boolean(depth - 1)
        text, prec = binary(rng, op, a, b)
        if op == "AND_THEN":
            return Node(text, "BOOL", lambda f: a.fn(f) and b.fn(f), prec=prec)
        if op == "OR_ELSE":
            return Node(text, "BOOL", lambda f: a.fn(f) or b.fn(f), prec=prec)

        def run(f):
            x, y = a.fn(f), b.fn(f)
            return (x and y) if op in ("AND", "&") else (x or y) if op == "OR" else (x != y) if op in ("XOR", "<>") \
                else x == y

        return Node(text, "BOOL", run, prec=prec)

    def comparison(self, depth):
        rng = self.rng
        op = rng.choice(list(COMPARE))
        choice = rng.random()
        if choice < 0.5:
            a, b = self.pair(depth, rng.choice([INTS, INTS, BITS]))
            common(common(widened(a.before), a.kind), common(widened(b.before), b.kind))
        elif choice < 0.68:
            kind = rng.choice(REALS)
            a, b = self.real(depth - 1, kind), self.real(depth - 1, kind)
        elif choice < 0.82:
            a, b = self.string(depth - 1), self.string(depth - 1)
        elif choice < 0.93:
            kind = rng.choice(list(TIMES))
            a, b = self.time(depth - 1, kind), self.time(depth - 1, kind)
        else:
            enum = rng.choice(self.enums)
            a, b = self.enumerator(enum), self.enumerator(enum)
        if a.const and b.const:
            raise Skip
        text, prec = binary(rng, op, a, b)
        test = COMPARE[op]

        def run(f):
            x = a.fn(f)
            return test(x, b.fn(f))

        return Node(text, "BOOL", run, prec=prec)

    def enumerator(self, enum):
        rng = self.rng
        if rng.random() < 0.5:
            name, value = rng.choice(list(enum.members.items()))
            text = rng.choice([f"{enum.name}.{name}", f"{enum.name}#{name}", name])
            return Node(text, enum.name, lambda f: value, const=True)
        text, _, get = self.read(enum.name)
        return Node(text, enum.name, get)

    # Times

    def time(self, depth, kind):
        rng = self.rng
        choice = rng.random()
        if depth <= 0 or choice < 0.25:
            text, _, get = self.read(kind)
            return Node(text, kind, get)
        if choice < 0.35:
            value = self.time_constant(kind)
            return Node(time_text(kind, value), kind, lambda f: value, const=True)
        bits = TIMES[kind]
        mask = (1 << bits) - 1
        if kind in ("TIME", "LTIME"):
            if choice < 0.6:
                op = rng.choice("+-")
                a, b = self.time(depth - 1, kind), self.time(depth - 1, kind)
                if a.const and b.const:
                    raise Skip
                text, prec = binary(rng, op, a, b)

                def run(f):
                    x, y = a.fn(f), b.fn(f)
                    return self.duration(kind, x + y if op == "+" else x - y)

                return Node(text, kind, run, prec=prec)
            if choice < 0.7:
                a, n = self.time(depth - 1, kind), rng.randint(1, 9)
                if a.const:
                    raise Skip
                op = rng.choice("*/")
                text, prec = binary(rng, op, a, Node(str(n), "INT", None))
                return Node(text, kind, lambda f: self.scaled(kind, a.fn(f), n, op), prec=prec)
            if choice < 0.8:
                a = self.integer(depth - 1, INTS)
                if a.const or kind == "LTIME":
                    raise Skip
                return Node(f"{a.kind}_TO_TIME({a.text})", kind, lambda f: a.fn(f) & mask)
            if choice < 0.86 and kind == "LTIME":
                a = self.time(depth - 1, "TIME")
                return Node(f"TIME_TO_LTIME({a.text})", kind, lambda f: a.fn(f) * 1_000_000)
            if choice < 0.92 and kind == "TIME":
                other = rng.choice(["DT", "TOD"])
                a, b = self.time(depth - 1, other), self.time(depth - 1, other)
                if a.const and b.const:
                    raise Skip
                text, prec = binary(rng, "-", a, b)
                scale = 1000 if other == "DT" else 1

                def difference(f):
                    x, y = a.fn(f), b.fn(f)
                    if x < y or (x - y) * scale > mask:
                        raise Skip
                    return (x - y) * scale

                return Node(text, kind, difference, prec=prec)
        elif kind in ("DT", "TOD") and choice < 0.7:
            step = rng.randint(1, 5000)
            a, op = self.time(depth - 1, kind), rng.choice("+-")
            if a.const:
                raise Skip
            text, prec = binary(rng, op, a, Node(f"T#{step}s", "TIME", None))
            step *= 1000 if kind == "TOD" else 1
            top = 86_399_999 if kind == "TOD" else mask

            def moved(f):
                value = a.fn(f) + (step if op == "+" else -step)
                if not 0 <= value <= top:
                    raise Skip
                return value

            return Node(text, kind, moved, prec=prec)
        return self.selected(depth, lambda: self.time(depth - 1, kind))

    @staticmethod
    def duration(kind, value):
        """TIME has 32 bits without a sign, LTIME 64 with one."""
        return value & 0xFFFFFFFF if kind == "TIME" else wrap("LINT", value)

    def scaled(self, kind, value, n, op):
        if op == "*":
            return self.duration(kind, value * n)
        return value // n if value >= 0 else -(-value // n)

    def time_constant(self, kind):
        rng = self.rng
        if kind == "DATE":
            return rng.randint(0, 40000) * 86400
        if kind == "TOD":
            return rng.randint(0, 86_399_999)
        if kind == "TIME":
            return rng.choice([0, 1, 2**32 - 1, rng.randint(0, 10**6), rng.randint(0, 2**32 - 1)])
        return rng.randint(0, 10**12) if kind == "LTIME" else rng.randint(0, 4_000_000_000)

    # Strings

    def string(self, depth):
        rng = self.rng
        if depth <= 0 or rng.random() < 0.2:
            if rng.random() < 0.4:
                value = self.letters(6)
                return Node(string_text(value), "STRING", lambda f: value, const=True)
            text, _, get = self.read("STRING")
            return Node(text, "STRING", get)
        op = rng.choice(["CONCAT", "CONCAT", "LEFT", "RIGHT", "MID", "INSERT", "DELETE", "REPLACE", "SEL", "TEXT", "CALL"])
        if op == "CALL":
            call = self.call(depth, lambda t: isinstance(t, StringType))
            return Node(call[0], "STRING", call[2])
        if op == "TEXT":
            choice = rng.random()
            if choice < 0.8:
                a = self.integer(depth - 1, INTS)
                if a.const:
                    raise Skip
                return Node(f"{a.kind}_TO_STRING({a.text})", "STRING", lambda f: str(a.fn(f)))
            a = self.boolean(depth - 1)
            return Node(f"BOOL_TO_STRING({a.text})", "STRING", lambda f: str(a.fn(f)).upper())
        a = self.string(depth - 1)
        if op == "CONCAT":
            b = self.string(depth - 1)

            def joined(f):
                x = a.fn(f)
                return self.short(x + b.fn(f))

            return Node(f"CONCAT({a.text}, {b.text})", "STRING", joined)
        if op == "SEL":
            test, b = self.boolean(depth - 1), self.string(depth - 1)

            def chosen(f):
                return b.fn(f) if test.fn(f) else a.fn(f)

            return Node(f"SEL({test.text}, {a.text}, {b.text})", "STRING", chosen)
        n_text, n = self.small()
        if op in ("LEFT", "RIGHT"):
            def part(f):
                x, count = a.fn(f), n(f)
                return x[:count] if op == "LEFT" else x[max(0, len(x) - count):]

            return Node(f"{op}({a.text}, {n_text})", "STRING", part)
        p_text, p = self.small(1)
        if op == "MID":
            def middle(f):
                x, count, at = a.fn(f), n(f), p(f)
                return x[at - 1:at - 1 + count]

            return Node(f"MID({a.text}, {n_text}, {p_text})", "STRING", middle)
        if op == "DELETE":
            def deleted(f):
                x, count, at = a.fn(f), n(f), p(f)
                return x[:at - 1] + x[at - 1 + count:]

            return Node(f"DELETE({a.text}, {n_text}, {p_text})", "STRING", deleted)
        b = self.string(depth - 1)
        if op == "INSERT":
            def inserted(f):
                x, y, at = a.fn(f), b.fn(f), n(f)
                if at > len(x):
                    raise Skip
                return self.short(x[:at] + y + x[at:])

            return Node(f"INSERT({a.text}, {b.text}, {n_text})", "STRING", inserted)

        def replaced(f):
            x, y, count, at = a.fn(f), b.fn(f), n(f), p(f)
            if at + count - 1 > len(x):
                raise Skip
            return self.short(x[:at - 1] + y + x[at - 1 + count:])

        return Node(f"REPLACE({a.text}, {b.text}, {n_text}, {p_text})", "STRING", replaced)

    @staticmethod
    def short(value):
        if len(value) > 200:
            raise Skip
        return value

    def letters(self, longest):
        return "".join(self.rng.choice(CHARACTERS) for _ in range(self.rng.randint(0, longest)))

    def small(self, low=0):
        """A small number that is not negative"""
        rng = self.rng
        choice = rng.random()
        if choice < 0.6:
            n = rng.randint(low, 7)
            return str(n), lambda f: n
        if choice < 0.75:
            a = self.string(1)
            if a.const and low:
                raise Skip
            return (f"LEN({a.text})", lambda f: len(a.fn(f))) if not low else \
                (f"LEN({a.text}) + 1", lambda f: len(a.fn(f)) + 1)
        if choice < 0.85 and low:
            a, b = self.string(1), self.string(1)
            if a.const or b.const:
                raise Skip

            def found(f):
                x = a.fn(f)
                y = b.fn(f)
                if y == "" or x.find(y) < 0:
                    raise Skip
                return x.find(y) + 1

            return f"FIND({a.text}, {b.text})", found
        node = self.index(low, 9)
        return node

    # Anything

    def any(self, kind, depth):
        """An expression that can be assigned to kind; its function returns the value as kind holds it."""
        name = kind.name
        if isinstance(kind, StringType):
            a, size = self.string(depth), kind.size
            return Node(a.text, name, lambda f: a.fn(f)[:size], const=a.const)
        if isinstance(kind, Subrange):
            if self.rng.random() < 0.3:
                value = self.rng.randint(kind.low, kind.high)
                return Node(str(value), name, lambda f: value, const=True)
            a = self.value_of(kind.base, depth - 1, True)
            if a.const:
                raise Skip
            return Node(f"LIMIT({kind.low}, {a.text}, {kind.high})", name,
                        lambda f: max(kind.low, min(kind.high, a.fn(f))))
        if isinstance(kind, Enum):
            return self.enumerator(kind)
        if isinstance(kind, (Array, Struct)):
            return self.whole(kind, depth)
        if name == "BOOL":
            if self.rng.random() < 0.05:
                value = self.rng.random() < 0.5
                return Node(str(value).upper(), name, lambda f: value, const=True)
            return self.boolean(depth)
        if name in REALS:
            return self.real(depth, name)
        if name in TIMES:
            return self.time(depth, name)
        return self.value_of(name, depth)

    def whole(self, kind, depth):
        """A structure or an array as a whole"""
        choices = [v for v in self.scope.variables if self.holds(v.kind, kind) and not v.const]
        if choices and (self.rng.random() < 0.7 or depth <= 0):
            v = self.rng.choice(choices)
            text, place = self.reach(v.name, v.kind, v.place, kind)
            return Node(text, kind.name, lambda f: kind.copy(place(f).get()))
        call = self.call(depth, lambda t: t is kind)
        return Node(call[0], kind.name, lambda f: kind.copy(call[2](f)))

    def holds(self, kind, wanted):
        if kind is wanted:
            return True
        if isinstance(kind, Array):
            return self.holds(kind.element, wanted)
        return isinstance(kind, Struct) and any(self.holds(t, wanted) for t in kind.fields.values())

    def reach(self, text, kind, place, wanted):
        while kind is not wanted:
            if isinstance(kind, Array):
                text, kind, place = self.element(text, kind, place)
            else:
                name = self.rng.choice([n for n, t in kind.fields.items() if self.holds(t, wanted)])
                text, kind, place = f"{text}.{name}", kind.fields[name], self.field(place, name)
        return text, place

    def target(self, wanted, shared=True, but=()):
        """A place of exactly this type that may be written: (text, function)"""
        choices = [v for v in self.scope.variables if v.writable and v.name not in self.scope.busy and
                   self.holds(v.kind, wanted) and (shared or not v.shared) and v.name not in but]
        if not choices:
            raise Skip
        v = self.rng.choice(choices)
        return self.reach(v.name, v.kind, v.place, wanted)

    def call(self, depth, wanted):
        """(text, type, function) of a call of a function or a method"""
        choices = [(f, None) for f in self.functions if f.result and wanted(f.result)]
        choices += [(m, o) for o in self.objects for m in o.methods if m.result and wanted(m.result)]
        if not choices or self.in_call > 2:
            raise Skip
        return self.call_of(*self.rng.choice(choices), depth)

    def call_of(self, function, owner, depth):
        rng = self.rng
        self.in_call += 1
        try:
            parameters = list(function.inputs)
            named = rng.random() < 0.5 or function.outputs or function.in_outs
            if named:
                parameters = [p for p in parameters if p.needed or rng.random() < 0.7] + list(function.in_outs)
                parameters += [p for p in function.outputs if rng.random() < 0.7]
                rng.shuffle(parameters)
            texts, steps, roots = [], [], set()
            for p in parameters:
                if p in function.inputs:
                    a = self.any(p.kind, max(0, depth - 1))
                    texts.append(f"{p.name} := {a.text}" if named else a.text)
                    steps.append((p, a.fn))
                else:
                    # An output must not be another name of something that the function uses.
                    text, place = self.target(p.kind, p in function.in_outs and not function.outputs, roots)
                    if function.outputs:
                        roots.add(re.split(r"[.\[]", text)[0])
                    texts.append(f"{p.name} {':=' if p in function.in_outs else '=>'} {text}")
                    steps.append((p, place))
        finally:
            self.in_call -= 1

        def run(frame):
            this = owner.place(frame).get() if owner else None
            return function.run(this, [(p, fn(frame)) for p, fn in steps])

        dot = f"{owner.text}." if owner and owner.text else ""
        return f"{dot}{function.name}({', '.join(texts)})", function.result, run


__all__ = ["BOOL", "ELEMENTARY", "Expressions", "Node", "Scope", "Variable", "single"]
