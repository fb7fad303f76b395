"""The expressions of a case of random_loops.py: what is read, computed, compared, and the elements of arrays."""
from loop_parts import Node, Stop
from loop_variables import Variables
from model import common, divided, limits, widened, wrap


class Expressions(Variables):
    def some_constant(self, spread=12):
        low, high = limits(self.kind)
        value = self.origin + self.rng.randint(-2 if self.rng.random() < 0.2 else 0, spread)
        return max(low, min(high, value))

    def literal(self, value, kind=None):
        kind = kind or self.kind
        return Node(str(value), kind, lambda: value, const=value)

    def read(self):
        if self.busy and self.rng.random() < 0.7:
            text, key = self.rng.choice(self.busy)
        else:
            text, key = self.rng.choice(self.variables)
        return Node(text, self.kind, lambda: self.find(key).value)

    def value(self, depth=2):
        rng = self.rng
        choice = rng.random()
        if depth == 0 or choice < 0.35:
            if self.values and rng.random() < 0.2:
                return rng.choice(self.values)
            return self.read()
        if choice < 0.5:
            return self.literal(self.some_constant())
        if choice < 0.55 and self.changes:
            changer = rng.choice(self.changers)
            if changer[2]:
                return Node(changer[0], self.kind, changer[1])
        if choice < 0.6:
            inner = self.value(1)
            if inner.const is None and inner.before == self.kind:
                return Node(f"Plain_{self.kind}({inner.text})", self.kind, lambda: wrap(self.kind, wrap(self.kind, inner.fn()) + 1))
        return self.arithmetic(depth)

    def arithmetic(self, depth):
        rng = self.rng
        a = self.value(depth - 1)
        small = rng.choice([0, 1, 1, 2, 3, 7])
        b = self.value(depth - 1) if rng.random() < 0.4 else self.literal(small)
        if a.const is not None and b.const is not None:
            a = self.read()
        op = rng.choice(["+", "+", "+", "-", "-", "*", "/", "MOD"])
        if op in ("/", "MOD") and (b.const == 0 or (b.const is None and rng.random() < 0.7)):
            op = "+"
        if rng.random() < 0.2 and op in "+*":
            a, b = b, a
        kind = common(common(widened(common(a.before, b.before)), a.kind), b.kind)

        def run():
            x = wrap(kind, a.fn())
            y = wrap(kind, b.fn())
            if op in ("/", "MOD"):
                if y == 0:
                    raise Stop("zero")
                return divided(kind, x, y, op)
            return wrap(kind, x + y if op == "+" else x - y if op == "-" else x * y)

        return Node(f"({a.text} {op} {b.text})", kind, run, self.kind)

    def test(self):
        rng = self.rng
        a = self.value(1)
        while a.const is not None:
            a = self.value(1)
        b = self.literal(self.some_constant()) if rng.random() < 0.7 else self.value(1)
        op = rng.choice(["<", "<=", ">", ">=", "=", "<>"])
        compare = {"<": int.__lt__, "<=": int.__le__, ">": int.__gt__, ">=": int.__ge__, "=": int.__eq__, "<>": int.__ne__}[op]

        def run():
            x = a.fn()
            y = b.fn()
            return compare(x, y)

        return Node(f"{a.text} {op} {b.text}", "BOOL", run)

    def index(self):
        """Mostly of variables that loops count."""
        rng = self.rng
        if self.busy and rng.random() < (0.95 if self.clean else 0.75):
            text, key = rng.choice(self.busy)
            node = Node(text, self.kind, lambda: self.find(key).value)
            if rng.random() < 0.5:
                return node
            other = self.literal(rng.choice([1, 1, 2, 3])) if rng.random() < 0.7 else self.read()
            op = rng.choice(["+", "-", "+", "*"])
            kind = widened(self.kind)
            return Node(f"{node.text} {op} {other.text}", kind,
                        lambda: wrap(kind, {"+": lambda x, y: x + y, "-": lambda x, y: x - y, "*": lambda x, y: x * y}[op](node.fn(), other.fn())))
        node = self.value(1)
        return self.read() if node.const is not None else node

    def element(self):
        """(text, kind, place) of an element; place() checks the indices and gives (array, key)."""
        letter = self.rng.choice(list(self.arrays))
        _, text, _, dimensions, kind = self.arrays[letter]
        indices = [self.index() for _ in range(dimensions)]
        if dimensions == 1:
            text += f"[{indices[0].text}]"
        elif letter == "b":
            text += f"[{indices[0].text}, {indices[1].text}]"
        else:
            text += f"[{indices[0].text}][{indices[1].text}]"

        def place():
            array = self.made[letter]
            found = []
            for at, node in enumerate(indices):
                value = node.fn()
                array.check(at, value)
                found.append(value)
            return array, tuple(found)

        return text, kind, place
