"""Random expressions of strings."""
from model import INTS, Skip, StringType, string_text
from nodes import CHARACTERS, WIDE, Node


class Texts:
    def string(self, depth, family="STRING"):
        rng = self.rng
        if depth <= 0 or rng.random() < 0.2:
            if rng.random() < 0.4:
                value = self.letters(6, family)
                return Node(string_text(value, family), family, lambda f: value, const=True)
            text, _, get = self.read(family)
            return Node(text, family, get)
        op = rng.choice(["CONCAT", "CONCAT", "LEFT", "RIGHT", "MID", "INSERT", "DELETE", "REPLACE", "SEL", "TEXT", "CALL"])
        if op == "CALL":
            call = self.call(depth, lambda t: isinstance(t, StringType) and t.family == family)
            return Node(call[0], family, call[2])
        if op == "TEXT" and family == "WSTRING":
            a = self.string(depth - 1)
            if a.const:
                raise Skip
            return Node(f"STRING_TO_WSTRING({a.text})", family, a.fn)
        if op == "TEXT":
            choice = rng.random()
            if choice < 0.1:
                return self.narrowed(self.string(depth - 1, "WSTRING"))
            if choice < 0.8:
                a = self.integer(depth - 1, INTS)
                if a.const:
                    raise Skip
                return Node(f"{a.kind}_TO_STRING({a.text})", "STRING", lambda f: str(a.fn(f)))
            a = self.boolean(depth - 1)
            return Node(f"BOOL_TO_STRING({a.text})", "STRING", lambda f: str(a.fn(f)).upper())
        a = self.string(depth - 1, family)
        if op == "CONCAT":
            b = self.string(depth - 1, family)

            def joined(f):
                x = a.fn(f)
                return self.short(x + b.fn(f))

            return Node(f"CONCAT({a.text}, {b.text})", family, joined)
        if op == "SEL":
            test, b = self.boolean(depth - 1), self.string(depth - 1, family)

            def chosen(f):
                return b.fn(f) if test.fn(f) else a.fn(f)

            return Node(f"SEL({test.text}, {a.text}, {b.text})", family, chosen)
        n_text, n = self.small()
        if op in ("LEFT", "RIGHT"):
            def part(f):
                x, count = a.fn(f), n(f)
                return x[:count] if op == "LEFT" else x[max(0, len(x) - count):]

            return Node(f"{op}({a.text}, {n_text})", family, part)
        p_text, p = self.small(1)
        if op == "MID":
            def middle(f):
                x, count, at = a.fn(f), n(f), p(f)
                return x[at - 1:at - 1 + count]

            return Node(f"MID({a.text}, {n_text}, {p_text})", family, middle)
        if op == "DELETE":
            def deleted(f):
                x, count, at = a.fn(f), n(f), p(f)
                return x[:at - 1] + x[at - 1 + count:]

            return Node(f"DELETE({a.text}, {n_text}, {p_text})", family, deleted)
        b = self.string(depth - 1, family)
        if op == "INSERT":
            def inserted(f):
                x, y, at = a.fn(f), b.fn(f), n(f)
                if at > len(x):
                    raise Skip
                return self.short(x[:at] + y + x[at:])

            return Node(f"INSERT({a.text}, {b.text}, {n_text})", family, inserted)

        def replaced(f):
            x, y, count, at = a.fn(f), b.fn(f), n(f), p(f)
            if at + count - 1 > len(x):
                raise Skip
            return self.short(x[:at - 1] + y + x[at - 1 + count:])

        return Node(f"REPLACE({a.text}, {b.text}, {n_text}, {p_text})", family, replaced)

    @staticmethod
    def narrowed(a):
        def run(f):
            value = a.fn(f)
            if any(c > "~" for c in value):
                raise Skip
            return value

        if a.const:
            raise Skip
        return Node(f"WSTRING_TO_STRING({a.text})", "STRING", run)

    @staticmethod
    def short(value):
        if len(value) > 200:
            raise Skip
        return value

    def letters(self, longest, family="STRING"):
        characters = CHARACTERS + WIDE if family == "WSTRING" else CHARACTERS
        return "".join(self.rng.choice(characters) for _ in range(self.rng.randint(0, longest)))

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
