"""The statements of a case of random_loops.py."""
from loop_expressions import Expressions
from loop_parts import Leave, Stop
from model import NUMBERS, Skip, divided, limits, widened, wrap


class Statements(Expressions):
    def block(self, depth):
        rng = self.rng
        label = None
        if rng.random() < 0.15:
            self.labels += 1
            label = f"L{self.labels}"
            self.open.append(label)
        parts = [self.statement(depth) for _ in range(rng.choice([1, 2, 2, 3]))]
        if label:
            self.open.remove(label)
            if label in self.used:
                return self.leading_out(parts, label)
        if rng.random() < 0.06 and len(parts) >= 2:
            return self.jumping(parts)
        return self.together(parts)

    def leading_out(self, parts, label):
        """A label after the statements, to which some of them jump."""
        lines, body = self.together(parts)

        def run():
            try:
                body()
            except Leave as leave:
                if leave.args[0] != label:
                    raise
            self.cells[self.result].set(self.cells[self.result].value + 1)

        return [*lines, f"  {label}:", "  x := x + 1;"], run

    def together(self, parts):
        def run():
            for _, part in parts:
                self.tick()
                part()

        return ["  " + line for lines, _ in parts for line in lines], run

    def jumping(self, parts):
        """A label before one of the statements, and a jump to it before another one."""
        rng = self.rng
        self.labels += 1
        label = f"L{self.labels}"
        to, start = rng.randrange(len(parts)), rng.randrange(len(parts))
        test = self.test()
        lines = []
        for at, (texts, _) in enumerate(parts):
            lines += [f"  {label}:"] if at == to else []
            lines += [f"  IF {test.text} THEN JMP {label}; END_IF"] if at == start else []
            lines += ["  " + text for text in texts]

        def run():
            at = 0
            while at < len(parts):
                self.tick()
                if at == start and test.fn():
                    at = to
                    continue
                parts[at][1]()
                at += 1

        return lines, run

    def tick(self):
        self.fuel -= 1
        if self.fuel < 0:
            raise Skip

    def statement(self, depth):
        rng = self.rng
        choice = rng.random()
        if depth and choice < 0.4 + 0.3 * (depth == 3):
            return rng.choice([self.for_loop, self.for_loop, self.while_loop, self.while_loop, self.repeat_loop])(depth)
        if depth and choice < 0.8 and choice > 0.72:
            return self.case(depth)
        if depth and choice < 0.9 and choice > 0.8:
            test = self.test()
            lines, body = self.block(depth - 1)
            return [f"IF {test.text} THEN", *lines, "END_IF"], lambda: test.fn() and body()
        if choice > 0.93:
            word = rng.choice(["EXIT", "CONTINUE", "CONTINUE"]) if self.loops else "RETURN"
            if self.open and rng.random() < 0.5:
                word = rng.choice(self.open)
                self.used.add(word)
            if word != "RETURN" or rng.random() < 0.3:
                test = self.test()

                def leave():
                    if test.fn():
                        raise Leave(word)

                shown = word if word.isalpha() else f"JMP {word}"
                return [f"IF {test.text} THEN {shown}; END_IF"], leave
        if choice > 0.9 and self.changes:
            text, run, _ = rng.choice(self.changers)
            return [f"{text};"], run
        return self.assignment()

    def assignment(self):
        rng = self.rng
        if rng.random() < (0.8 if self.busy else 0.5):
            text, kind, place = self.element()
            if rng.random() < 0.3:
                return self.into_result(text, place)
            value = self.value(1)
            if kind != self.kind and not (kind == "DINT" and widened(self.kind) == "DINT" and NUMBERS[self.kind][1] < 32):
                value = self.literal(rng.randint(1, 99), "DINT")

            def run():
                array, key = place()
                array.values[key] = wrap(kind, value.fn())

            return [f"{text} := {value.text};"], run
        if self.repoint and rng.random() < 0.15:
            text, key = rng.choice(self.repoint)

            def aim():
                self.pointers["p"] = key

            return [f"p := ADR({text});"], aim
        free = [v for v in self.variables if v not in self.busy and v[1] not in {k for _, k in self.busy}]
        text, key = rng.choice(free if free and rng.random() < (0.97 if self.clean else 0.8) else self.variables)
        value = self.value(2)
        return [f"{text} := {value.text};"], lambda: self.store(key, value)

    def store(self, key, value):
        cell = self.find(key)
        cell.set(value.fn())

    def into_result(self, text, place):
        def run():
            old = self.cells[self.result].value
            array, key = place()
            value = array.values.get(key, 0)
            self.cells[self.result].set(old + (abs(value) % 1000) * (-1 if value < 0 else 1))

        return [f"x := x + {self.as_dint(text)};"], run

    def as_dint(self, text):
        return f"Small_{self.element_kind(text)}({text})"

    def element_kind(self, text):
        for _, name, _, _, kind in self.arrays.values():
            if text.startswith(name + "["):
                return kind
        raise Skip

    def case(self, depth):
        rng = self.rng
        node = self.read()
        low = self.some_constant()
        high = min(low + rng.randint(0, 4), limits(self.kind)[1])
        first, one = self.block(depth - 1)
        second, two = self.block(depth - 1)
        label = f"{low}" if low == high else f"{low}..{high}"
        return ([f"CASE {node.text} OF", f"  {label}:", *first, "ELSE", *second, "END_CASE"],
                lambda: one() if low <= node.fn() <= high else two())

    def counting(self, text, key, depth):
        """The body of a loop, in which the variable is mostly left alone."""
        self.busy.append((text, key))
        self.loops += 1
        lines, body = self.block(depth - 1)
        self.loops -= 1
        self.busy.pop()
        return lines, body

    def round(self, body):
        """False: EXIT"""
        self.tick()
        try:
            body()
        except Leave as leave:
            if leave.args[0] == "EXIT":
                return False
            if leave.args[0] != "CONTINUE":
                raise
        return True

    def loop_variable(self):
        free = [v for v in self.variables if v[1] not in {k for _, k in self.busy}]
        return self.rng.choice(free if free and self.rng.random() < 0.9 else self.variables)

    def for_loop(self, depth):
        rng = self.rng
        text, key = self.loop_variable()
        known = 0.9 if self.clean else 0.6
        first = self.literal(self.some_constant(5)) if rng.random() < known else self.value(2)
        last = self.literal(self.some_constant()) if rng.random() < known else self.value(2)
        step = rng.choice([None, None, None, 1, 2, 3, -1, -1, -2])
        by = None if step is None else self.literal(step)
        if step is not None and step > 0 and rng.random() < 0.25:
            by = self.read()
        if step is not None and step < 0 and not NUMBERS[self.kind][0]:
            by = self.literal(step, "DINT")
        if step is not None and step < 0:
            first, last = last, first
        lines, body = self.counting(text, key, depth)

        def run():
            cell = self.find(key)
            cell.set(first.fn())
            end = wrap(self.kind, last.fn())
            size = 1 if by is None else by.fn()
            going = cell.value <= end if size >= 0 else cell.value >= end
            while going:
                if not self.round(body):
                    return
                following = cell.value + size
                going = following <= end if size >= 0 else following >= end
                cell.value = wrap(cell.kind, following)

        shown = "" if by is None else f" BY {by.text}"
        return [f"FOR {text} := {first.text} TO {last.text}{shown} DO", *lines, "END_FOR"], run

    def while_loop(self, depth):
        rng = self.rng
        text, key = self.loop_variable()
        up = rng.random() < 0.6
        start, end = sorted([self.some_constant(), self.some_constant()])
        if not up:
            start, end = end, start
        first = self.literal(start) if rng.random() < 0.8 else self.value(1)
        op = rng.choice(["<", "<="] if up else [">", ">="])
        step = rng.choice([("+", 1), ("+", 1), ("+", 2), ("*", 2), ("*", 3)] if up else [("-", 1), ("-", 1), ("-", 3), ("/", 2)])
        by = self.literal(step[1]) if rng.random() < (0.9 if self.clean else 0.8) else self.read()
        also = self.test() if rng.random() < 0.3 else None
        word = rng.choice(["AND", "AND_THEN"])
        lines, body = self.counting(text, key, depth)
        kind = widened(self.kind)
        after = self.assignment() if rng.random() < 0.15 else ([], lambda: None)

        def advance():
            cell = self.find(key)
            x, y = cell.value, by.fn()
            if step[0] == "/":
                if y == 0:
                    raise Stop("zero")
                cell.set(divided(kind, x, y, "/"))
            else:
                cell.set(wrap(kind, x + y if step[0] == "+" else x - y if step[0] == "-" else x * y))

        def holds():
            value = self.find(key).value
            left = {"<": value < end, "<=": value <= end, ">": value > end, ">=": value >= end}[op]
            if also is None or (word == "AND_THEN" and not left):
                return left
            return also.fn() and left

        def run():
            self.store(key, first)
            before[1]()
            while holds():
                def whole():
                    body()
                    advance()
                    after[1]()
                if not self.round(whole):
                    return

        before = self.assignment() if rng.random() < 0.2 else ([], lambda: None)
        shown = f"{text} {op} {end}" + (f" {word} {also.text}" if also else "")
        return ([f"{text} := {first.text};", *before[0], f"WHILE {shown} DO", *lines, f"  {text} := {text} {step[0]} {by.text};",
                 *("  " + line for line in after[0]), "END_WHILE"], run)

    def repeat_loop(self, depth):
        text, key = self.loop_variable()
        first, end = self.literal(self.some_constant(4)), self.some_constant()
        lines, body = self.counting(text, key, depth)

        def run():
            self.store(key, first)
            while True:
                def whole():
                    body()
                    cell = self.find(key)
                    cell.set(cell.value + 1)
                if not self.round(whole) or self.find(key).value > end:
                    return

        return [f"{text} := {first.text};", "REPEAT", *lines, f"  {text} := {text} + 1;", f"UNTIL {text} > {end}", "END_REPEAT"], run
