"""Random expressions of REAL, BOOL, enumerations and times."""
import math

from model import (BITS, INTS, NUMBERS, REALS, TIMES, Skip, common, real_text, rounded, single_of_int, time_text, widened, wrap)
from nodes import COMPARE, PRIMARY, UNARY, Node, binary


class Values:
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
            family = rng.choice(["STRING", "STRING", "WSTRING"])
            a, b = self.string(depth - 1, family), self.string(depth - 1, family)
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
            if choice < 0.83 and kind == "LTIME":
                return self.apart(depth)
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
        elif kind in ("LDT", "LTOD") and choice < 0.7:
            return self.moved(depth, kind)
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

    def moved(self, depth, kind):
        """LDT or LTOD and a duration"""
        a, b, op = self.time(depth - 1, kind), self.time(depth - 1, "LTIME"), self.rng.choice("+-")
        if a.const and b.const:
            raise Skip
        text, prec = binary(self.rng, op, a, b)
        top = 86_400 * 10**9 - 1 if kind == "LTOD" else 10**19 // 2

        def run(f):
            x, y = a.fn(f), b.fn(f)
            value = x + y if op == "+" else x - y
            if not 0 <= value <= top:
                raise Skip
            return value

        return Node(text, kind, run, prec=prec)

    def apart(self, depth):
        """The duration between two LDT or LTOD"""
        kind = self.rng.choice(["LDT", "LTOD", "LDATE"])
        a, b = self.time(depth - 1, kind), self.time(depth - 1, kind)
        if a.const and b.const:
            raise Skip
        text, prec = binary(self.rng, "-", a, b)

        def run(f):
            x, y = a.fn(f), b.fn(f)
            if x < y:
                raise Skip
            return x - y

        return Node(text, "LTIME", run, prec=prec)

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
        if kind == "LDATE":
            return rng.randint(0, 60000) * 86400 * 10**9
        if kind == "LTOD":
            return rng.randint(0, 86_400 * 10**9 - 1)
        if kind == "LDT":
            return rng.randint(0, 5 * 10**9) * 10**9 + rng.choice([0, rng.randrange(10**9)])
        if kind == "TOD":
            return rng.randint(0, 86_399_999)
        if kind == "TIME":
            return rng.choice([0, 1, 2**32 - 1, rng.randint(0, 10**6), rng.randint(0, 2**32 - 1)])
        return rng.randint(0, 10**12) if kind == "LTIME" else rng.randint(0, 4_000_000_000)
