#!/usr/bin/env python3
"""Random loops whose indices come to the limits of their arrays, against an interpreter in this file.

usage: random_loops.py STRIDE [--seeds FIRST..LAST] [--count N] [--keep FOLDER]

A seed is a project of N cases: programs, functions, function blocks, methods and derived blocks with FOR, WHILE and REPEAT
loops over variables of all sections, with aliases (in-outs, references, pointers, unions), calls that change what a loop
counts, CASE, EXIT, CONTINUE, JMP and RETURN. A case is first interpreted with arrays without limits; then its arrays get
just the indices that it used, or one less, so that it ends as it should or is stopped by a check. `stride sim` runs all cases
with checks, each within a __TRY, and those that end also without. What every variable holds and which exception came must
be what the interpreter says. A seed that disagrees is left in FOLDER (default: the temporary folder) and named.
"""
import random
import re
import subprocess
import sys

from model import NUMBERS, Skip, common, divided, limits, wrap, widened
from seeds import try_seeds

TYPES = ["DINT", "DINT", "DINT", "INT", "INT", "UINT", "SINT", "USINT", "UDINT", "LINT"]
FUEL = 4000
PRINTED = re.compile(r"[CG]\d")
STOPS = {"bounds": "RTSEXCPT_ARRAYBOUNDS", "zero": "RTSEXCPT_DIVIDEBYZERO", "range": "RTSEXCPT_OVERFLOW"}


class Stop(Exception):
    """A check fails."""


class Leave(Exception):
    """EXIT, CONTINUE, RETURN, or JMP to a label"""


class Node:
    def __init__(self, text, kind, fn, before=None, const=None):
        self.text, self.kind, self.fn, self.before, self.const = text, kind, fn, before or kind, const


class Cell:
    def __init__(self, kind, limits_=None):
        self.kind, self.limits, self.value = kind, limits_, 0

    def set(self, value):
        value = wrap(self.kind, value)
        if self.limits and not self.limits[0] <= value <= self.limits[1]:
            raise Stop("range")
        self.value = value


class Array:
    """Without limits until it has been seen which indices are used."""

    def __init__(self, kind, dimensions):
        self.kind, self.limits = kind, None
        self.seen = [[None, None] for _ in range(dimensions)]
        self.values = {}

    def check(self, at, index):
        if self.limits:
            if not self.limits[at][0] <= index <= self.limits[at][1]:
                raise Stop("bounds")
            return
        low, high = self.seen[at]
        self.seen[at] = [index if low is None else min(low, index), index if high is None else max(high, index)]


class Case:
    def __init__(self, rng, number):
        self.rng, self.number = rng, number
        self.style = rng.choice(["program", "program", "function", "function", "block", "method", "derived"])
        self.kind = rng.choice(TYPES)
        self.origin = 0
        if rng.random() < 0.15:
            low, high = limits(self.kind)
            self.origin = rng.choice([high - 12, low + 4, high // 2])
        elif rng.random() < 0.2 and NUMBERS[self.kind][0]:
            self.origin = -5
        # Where all is as the analysis likes it, but for one thing perhaps, indices are proven.
        self.clean = rng.random() < 0.6
        self.dirt = 0.1 if self.clean else 1.0
        if self.clean:
            self.kind = rng.choice(["DINT", "DINT", "INT", "UINT", "SINT", "LINT"])
        self.sections, self.globals, self.first, self.helpers, self.methods = {}, [], [], [], []
        self.cells, self.arrays, self.pointers, self.targets = {}, {}, {}, {}
        self.variables, self.names, self.busy = [], 0, []
        self.changers, self.values = [], []
        self.loops, self.labels, self.fuel = 0, 0, 0
        self.open, self.used = [], set()
        self.declare()
        self.change()
        self.lines, self.run_body = self.block(3)
        self.settle()

    # --- variables

    def name(self, stem):
        self.names += 1
        return f"{stem}{self.names}"

    def cell(self, key, kind, text, limits_=None):
        self.cells[key] = Cell(kind, limits_)
        self.variables.append((text, key))
        return key

    def own(self, section, name, type_):
        self.sections.setdefault(section, []).append(f"  {name} : {type_};")

    def path(self, name):
        """Where it is printed, or None"""
        if self.style == "program":
            return f"C{self.number}.{name}"
        return None if self.style == "function" else f"G{self.number}_fb.{name}"

    def declare(self):
        rng, kind = self.rng, self.kind
        sections = {"program": ["VAR"], "function": ["VAR", "VAR", "VAR_INPUT", "VAR_STAT"],
                    "block": ["VAR", "VAR_INPUT", "VAR_OUTPUT"], "method": ["VAR", "LOCAL"], "derived": ["VAR", "BASE"]}[self.style]
        for _ in range(rng.randint(2, 4)):
            name = self.name("v")
            section = sections[0] if self.clean and rng.random() < 0.8 else rng.choice(sections)
            key = self.path(name) if section not in ("LOCAL", "VAR_INPUT") or self.style == "block" else None
            limits_, type_ = None, kind
            if rng.random() < 0.08 * self.dirt and section != "VAR_STAT":
                limits_ = (0, 30)
                type_ = f"{kind}(0..30)"
            self.own(section, name, type_ + (" := 0" if section == "VAR_INPUT" else ""))
            self.cell(key or name, kind, name, limits_)
        self.globals.append(f"  G{self.number}_g : {kind};")
        self.cell(f"G{self.number}_g", kind, f"G{self.number}_g")
        if rng.random() < 0.3 * self.dirt:
            self.own("VAR", "u", f"U_{kind}")
            key = self.path("u.one") or "u.one"
            self.cell(key, kind, "u.one")
            self.variables.append(("u.two", key))
        if rng.random() < 0.2 * self.dirt:
            self.own("VAR", "s", f"S_{kind}")
            self.cell(self.path("s.m") or "s.m", kind, "s.m")
        plain = [(t, k) for t, k in self.variables if self.cells[k].limits is None]
        if rng.random() < 0.2 * self.dirt:
            self.own("VAR", "r", f"REFERENCE TO {kind}")
            text, key = rng.choice(plain)
            self.first.append(f"r REF= {text};")
            self.variables.append(("r", key))
        if rng.random() < 0.3 * self.dirt:
            self.own("VAR", "p", f"POINTER TO {kind}")
            text, key = rng.choice(plain)
            self.first.append(f"p := ADR({text});")
            self.targets["p"] = key
            self.variables.append(("p^", "p"))
            self.repoint = plain
        if self.style in ("function", "block", "method") and rng.random() < 0.3 * self.dirt:
            self.own("VAR_IN_OUT" if self.style != "method" else "METHOD_IN_OUT", "io", kind)
            self.variables.append(("io", f"G{self.number}_g"))
        if rng.random() < 0.3:
            self.own("VAR CONSTANT", "K", f"{kind} := {self.some_constant()}")
            value = int(self.sections["VAR CONSTANT"][-1].split(":= ")[1].rstrip(";"))
            self.values.append(Node("K", kind, lambda: value))
        for letter, dimensions in (("a", 1), ("b", 2), ("c", 2)):
            if letter != "a" and rng.random() < 0.5:
                continue
            where = rng.choice(["own", "own", "global"])
            text = letter if where == "own" else f"G{self.number}_{letter}"
            key = self.path(letter) if where == "own" else text
            self.arrays[letter] = (key or letter, text, where, dimensions, rng.choice(["DINT", kind]))
        self.cells_of_result()

    def cells_of_result(self):
        self.own("VAR", "x", "DINT")
        self.cells[self.path("x") or "x"] = Cell("DINT")
        self.result = self.path("x") or "x"

    def change(self):
        """What changes variables from elsewhere: a function, an action, a method."""
        rng, kind, n = self.rng, self.kind, self.number
        step = rng.choice([1, 2, 5, 100])

        def changing(key):
            def run():
                cell = self.find(key)
                cell.set(cell.value + step)
                return cell.value
            return run

        key = f"G{n}_g"
        self.helpers += [f"FUNCTION H{n} : {kind}", f"G{n}_g := G{n}_g + {step};", f"H{n} := G{n}_g;", "END_FUNCTION"]
        self.changers.append((f"H{n}()", changing(key), True))
        self.helpers += [f"FUNCTION O{n} : {kind}", f"VAR_IN_OUT io : {kind}; END_VAR", f"io := io + {step};", f"O{n} := io;",
                         "END_FUNCTION"]
        for text, key in self.variables:
            if key in self.cells and self.cells[key].limits is None and text != "p^" and rng.random() < 0.5:
                self.changers.append((f"O{n}(io := {text})", changing(key), True))
        owns = [(t, k) for t, k in self.variables if k in self.cells and self.cells[k].limits is None and t[0] == "v" and
                k != t]
        if owns and self.style == "program":
            text, key = rng.choice(owns)
            self.methods += ["ACTION Act", f"{text} := {text} + {step};", "END_ACTION"]
            self.changers.append(("Act()", changing(key), False))
            text, key = rng.choice(owns)
            self.helpers += [f"FUNCTION Q{n} : {kind}", f"C{n}.{text} := C{n}.{text} + {step};", f"Q{n} := C{n}.{text};", "END_FUNCTION"]
            self.changers.append((f"Q{n}()", changing(key), True))
        elif owns and self.style != "function":
            text, key = rng.choice(owns)
            self.methods += [f"METHOD Bump : {kind}", f"{text} := {text} + {step};", f"Bump := {text};", "END_METHOD"]
            self.changers.append((rng.choice(["Bump()", "THIS^.Bump()"]), changing(key), True))
            if self.style == "derived":
                base = [(t, k) for t, k in owns if f"  {t} : {kind};" in self.sections.get("BASE", [])]
                if base:
                    text, key = rng.choice(base)
                    self.hook = text
                    self.methods += [f"METHOD Hook : {kind}", f"{text} := {text} + {step};", f"Hook := {text};", "END_METHOD"]
                    self.changers.append((rng.choice(["Hook()", "THIS^.Hook()"]), changing(key), True))
        self.changes = rng.random() < 0.35 * (self.dirt + 0.1)

    hook = None
    repoint = None

    def find(self, key):
        return self.cells[self.pointers.get(key, key)]

    # --- expressions

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

    # --- statements

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

    # --- the whole

    def interpret(self, bounds):
        for cell in self.cells.values():
            cell.value = 0
        self.pointers = dict(self.targets)
        self.made = {}
        for letter, (_, _, _, dimensions, kind) in self.arrays.items():
            self.made[letter] = Array(kind, dimensions)
            self.made[letter].limits = bounds and bounds[letter]
        self.fuel, self.stop = FUEL, None
        try:
            self.run_body()
        except Leave as leave:
            if leave.args[0] != "RETURN":
                raise
        except Stop as stop:
            self.stop = stop.args[0]

    def settle(self):
        """Chooses the limits of the arrays."""
        rng = self.rng
        self.interpret(None)
        bounds = {}
        for letter, array in self.made.items():
            bounds[letter] = []
            for low, high in array.seen:
                if low is None:
                    low, high = 0, 3
                if high - low > 3000 or low < -(1 << 31) or high >= 1 << 31:
                    raise Skip
                if rng.random() < 0.25 and high > low:
                    low += 1
                elif rng.random() < 0.33 and high > low:
                    high -= 1
                bounds[letter].append((low, high))
        for letter, pair in bounds.items():
            if len(pair) == 2 and (pair[0][1] - pair[0][0] + 1) * (pair[1][1] - pair[1][0] + 1) > 5000:
                raise Skip
        self.bounds = bounds
        self.interpret(bounds)
        self.lines_of_text = self.text()

    def array_type(self, letter):
        kind, pairs = self.arrays[letter][4], [f"{low}..{high}" for low, high in self.bounds[letter]]
        return f"ARRAY[{pairs[0]}] OF ARRAY[{pairs[1]}] OF {kind}" if letter == "c" else f"ARRAY[{', '.join(pairs)}] OF {kind}"

    def declared(self, sections):
        lines = []
        for section in sections:
            if section in self.sections:
                word = {"LOCAL": "VAR", "BASE": "VAR", "METHOD_IN_OUT": "VAR_IN_OUT"}.get(section, section)
                lines += [word, *self.sections[section], "END_VAR"]
        return lines

    def text(self):
        n, kind = self.number, self.kind
        for letter, (_, _, where, _, _) in self.arrays.items():
            line = f"  {letter} : {self.array_type(letter)};"
            if where == "own":
                self.sections.setdefault("VAR", []).append(line)
            else:
                self.globals.append(line.replace(f"  {letter} :", f"  G{n}_{letter} :"))
        body = ["  " + line for line in self.first] + self.lines
        arguments = f"io := G{n}_g" if any(s in self.sections for s in ("VAR_IN_OUT", "METHOD_IN_OUT")) else ""
        lines = list(self.helpers)
        usual = ["VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR_STAT", "VAR CONSTANT"]
        if self.style == "program":
            lines += [f"PROGRAM C{n}", *self.declared(usual), *body, *self.methods, "END_PROGRAM"]
            call = f"C{n}();"
        elif self.style == "function":
            lines += [f"FUNCTION C{n} : BOOL", *self.declared(usual), *body, "END_FUNCTION"]
            call = f"C{n}({arguments});"
        elif self.style == "derived":
            lines += [f"FUNCTION_BLOCK B{n}", *self.declared(["BASE"])]
            lines += [f"METHOD Hook : {kind}", "END_METHOD"] if self.hook else []
            lines += ["END_FUNCTION_BLOCK", f"FUNCTION_BLOCK C{n} EXTENDS B{n}", *self.declared(usual), *body, *self.methods, "END_FUNCTION_BLOCK"]
            call = f"G{n}_fb();"
        elif self.style == "block":
            lines += [f"FUNCTION_BLOCK C{n}", *self.declared(usual), *body, *self.methods, "END_FUNCTION_BLOCK"]
            call = f"G{n}_fb({arguments});"
        else:
            lines += [f"FUNCTION_BLOCK C{n}", *self.declared(usual), *self.methods, f"METHOD Go : BOOL",
                      *self.declared(["METHOD_IN_OUT", "LOCAL"]), *body, "END_METHOD", "END_FUNCTION_BLOCK"]
            call = f"G{n}_fb.Go({arguments});"
        if self.style not in ("program", "function"):
            self.globals.append(f"  G{n}_fb : C{n};")
        self.call = ["__TRY", f"  {call}", f"  e[{n}] := 1;", f"__CATCH (exc)", f"  k[{n}] := exc;", "__ENDTRY"]
        return lines + ["VAR_GLOBAL", *self.globals, "END_VAR"]

    def expected(self):
        found = {f"PLC_PRG.e[{self.number}]": "0" if self.stop else "1"}
        found[f"PLC_PRG.k[{self.number}]"] = STOPS[self.stop] if self.stop else "RTSEXCPT_NOEXCEPTION"
        for key, cell in self.cells.items():
            if PRINTED.match(key):
                found[key] = str(cell.value)
        for letter, (key, _, where, _, kind) in self.arrays.items():
            if not PRINTED.match(key):
                continue
            ranges = [range(low, high + 1) for low, high in self.bounds[letter]]
            indices = [(i,) for i in ranges[0]] if len(ranges) == 1 else [(i, j) for i in ranges[0] for j in ranges[1]]
            for at in indices:
                found[f"{key}[{','.join(map(str, at))}]"] = str(self.made[letter].values.get(at, 0))
        return found


def some_cases(rng, count):
    cases = []
    while len(cases) < count:
        try:
            case = Case(rng, len(cases))
            if case.stop is None or rng.random() < 0.5:
                cases.append(case)
        except Skip:
            pass
    return cases


def common_text(kinds):
    """What all cases use"""
    lines = []
    for kind in kinds:
        lines += [f"TYPE U_{kind} : UNION one, two : {kind}; END_UNION END_TYPE", f"TYPE S_{kind} : STRUCT n, m : {kind}; END_STRUCT END_TYPE",
                  f"FUNCTION Plain_{kind} : {kind}", f"VAR_INPUT i : {kind}; END_VAR", f"Plain_{kind} := i + 1;", "END_FUNCTION",
                  f"FUNCTION Small_{kind} : DINT", f"VAR_INPUT i : {kind}; END_VAR",
                  f"Small_{kind} := TO_DINT(i MOD 1000);" if NUMBERS[kind][1] > 8 else f"Small_{kind} := i;", "END_FUNCTION"]
    return lines


def project(cases, count):
    lines = common_text(sorted(set(TYPES)))
    calls = []
    for case in cases:
        case.line = len(lines) + 1
        lines += case.lines_of_text
        calls += ["  " + line for line in case.call]
    return [*lines, "PROGRAM PLC_PRG", "VAR", "  exc : __SYSTEM.ExceptionCode;", f"  e : ARRAY[0..{count - 1}] OF DINT;",
            f"  k : ARRAY[0..{count - 1}] OF __SYSTEM.ExceptionCode;", "END_VAR", *calls, "END_PROGRAM", ""]


def plain(path):
    """Rows and columns in one pair of brackets"""
    return path.replace("][", ",").replace(", ", ",")


def run(options, source, cases, arguments):
    """True: everything is as expected"""
    expected = {}
    for case in cases:
        expected.update(case.expected())
    names = ["PLC_PRG.e", "PLC_PRG.k"] + sorted({re.match(r"\w+(\.\w+)*", key).group() for key in expected if not key.startswith("PLC_PRG")})
    result = subprocess.run([options.stride, "sim", source.name, "--for", "T#10ms", "--print", ",".join(names), "-W", "off=all-warnings", *arguments],
                            capture_output=True, text=True, check=False, cwd=source.parent)
    found = {plain(line.split(" = ")[0]): line.split(" = ", 1)[1] for line in result.stdout.splitlines() if " = " in line}
    wrong = {key: value for key, value in expected.items() if found.get(key) != value}
    if result.returncode == 0 and not wrong:
        return True
    print(f"{source} {' '.join(arguments)}: exit code {result.returncode}, {len(wrong)} of {len(expected)} values differ")
    if result.returncode == 0:
        for key, value in list(wrong.items())[:12]:
            print(f"  {key}: expected {value}, found {found.get(key)}")
    print(result.stderr[:3000])
    return False


def without_errors(options, source, cases):
    """The compiler sees by itself that some constants are none of an array or a subrange."""
    source.write_text("\n".join(project(cases, options.count)), encoding="utf-8")
    result = subprocess.run([options.stride, "check", source.name, "-W", "off=all-warnings", "--max-errors", "0"], capture_output=True, text=True,
                            check=False, cwd=source.parent)
    wrong = [int(line) for line in re.findall(r"--> \S+:(\d+):", result.stderr)]
    foreign = [code for code in re.findall(r"error\[(\w+)\]", result.stderr) if code not in ("SE0415", "SE0409", "SE0402", "SE0411")]
    if foreign:
        print(result.stderr[:3000])
    bad = {max((case.line, case.number) for case in cases if case.line <= line)[1] for line in wrong}
    return [case for case in cases if case.number not in bad]


def check(options, seed):
    """How many cases agree, or None"""
    rng = random.Random(seed)
    cases = without_errors(options, options.keep / f"loops{seed}.st", some_cases(rng, options.count))
    good = True
    for arguments, chosen in (([], cases), (["--unchecked"], [case for case in cases if case.stop is None])):
        source = options.keep / f"loops{seed}{'u' if arguments else ''}.st"
        source.write_text("\n".join(project(chosen, options.count)), encoding="utf-8")
        if run(options, source, chosen, arguments):
            source.unlink()
        else:
            good = False
    return len(cases) if good else None


def add_options(parser):
    parser.add_argument("--count", type=int, default=40)


if __name__ == "__main__":
    sys.exit(try_seeds(check, "1..4", "cases", add_options))
