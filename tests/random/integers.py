"""Random expressions of integers and bit strings."""
import math

from model import (BITS, INTS, NUMBERS, REALS, OpenArray, Skip, Subrange, common, divided, limits, real_to_int, survives, widened, wrap)
from nodes import PRIMARY, UNARY, Node, binary


class Integers:
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
        if choice < 0.95:
            return self.part() if names is not INTS else self.bound()
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

    def part(self):
        """A byte, word … of a bit string or integer"""
        kind = self.rng.choice([n for n in NUMBERS if NUMBERS[n][1] > 8])
        text, _, get = self.read(kind)
        letter, name, number = self.some_part(kind)
        bits = NUMBERS[name][1]
        return Node(f"{text}.%{letter}{number}", name, lambda f: get(f) >> number * bits & (1 << bits) - 1)

    def some_part(self, kind):
        letter, name = self.rng.choice([(x, n) for x, n in zip("BWD", BITS) if NUMBERS[n][1] < NUMBERS[kind][1]])
        return letter, name, self.rng.randrange(NUMBERS[kind][1] // NUMBERS[name][1])

    def bound(self):
        """A bound of an ARRAY[*]"""
        arrays = [v for v in self.scope.variables if isinstance(v.kind, OpenArray)]
        if not arrays:
            raise Skip
        v, which = self.rng.choice(arrays), self.rng.randrange(2)
        d = self.rng.randint(1, v.kind.dimensions)
        return Node(f"{'UPPER' if which else 'LOWER'}_BOUND({v.name}, {d})", "DINT", lambda f: v.place(f).bounds[d - 1][which])

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
