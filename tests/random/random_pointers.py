#!/usr/bin/env python3
"""Random loops over what pointers lead to, against an interpreter.

usage: random_pointers.py STRIDE [--seeds FIRST..LAST] [--count N] [--keep FOLDER]

A seed is a project of N cases: programs and function blocks whose loops read and write variables, what pointers and
pointers to pointers lead to, elements and members of all kinds, and hand pointers and in-outs to functions, blocks and
methods. In half of the projects each pointer leads to variables of its type; in the others one case makes an address in
another way (by a number, a sum, a union, another type), so that a pointer leads to a variable of another type: no loop of the
project may then rely on types. `stride sim` runs all cases with checks, each within a __TRY, and those that end also
without. What every variable holds, where every pointer leads and which exception came must be what the interpreter says.
"""
import random
import re
import subprocess
import sys

from model import wrap
from seeds import agree_in_both_modes, try_seeds

STOPS = {None: "RTSEXCPT_NOEXCEPTION", "null": "RTSEXCPT_ACCESS_VIOLATION"}
FUEL = 3000


class Skip(Exception):
    """It runs too long."""


class Null(Exception):
    """A pointer to nothing is followed."""


class Leave(Exception):
    """EXIT, CONTINUE or RETURN"""


class Cell:
    """A number, or a pointer to a cell or a node."""

    def __init__(self, kind):
        self.kind, self.value = kind, None if kind[0] == "P" else 0


class Record:
    """A node of a list, or an instance of a block."""

    def __init__(self, **cells):
        self.cells = cells


def follow(cell):
    if cell.value is None:
        raise Null
    return cell.value


DIRT = ["type", "number", "sum", "union", "index"]


class Case:
    """K is the type of the numbers that K pointers lead to, S another one of the same size."""

    def __init__(self, rng, number, kinds, dirt):
        self.rng, self.number, self.dirt = rng, number, dirt
        self.k, self.s = kinds
        self.style = rng.choice(["program", "program", "block"])
        self.loops, self.depth = 0, 0
        self.prologue = [self.aim(kind) for kind in ("PK", "PK", "PK", "PN", "PN", "PN", "PPK", "PPN", "LINK", "LINK", "LINK", "Q")]
        if dirt:
            self.prologue += [self.stray()]
        body = [self.loop(2) for _ in range(rng.randint(1, 3))]
        self.body = self.prologue + body
        self.interpret()

    # What there is

    def memory(self):
        k, s = self.k, self.s
        cells = {f"k{i}": Cell(k) for i in (1, 2, 3)} | {f"s{i}": Cell(s) for i in (1, 2)} | {"i": Cell("DINT"), "j": Cell("DINT")}
        cells |= {f"pk{i}": Cell("PK") for i in (1, 2)} | {f"pn{i}": Cell("PN") for i in (1, 2, 3)}
        cells |= {"ppk": Cell("PPK"), "ppn": Cell("PPN"), "ps": Cell("PS")}
        cells |= {f"a[{i}]": Cell(k) for i in range(6)}
        for i in range(4):
            node = Record(next=Cell("PN"), val=Cell(k), hits=Cell(s))
            cells[f"n[{i}]"] = node
            cells |= {f"n[{i}].{name}": cell for name, cell in node.cells.items()}
        for b in ("b", "c"):
            block = Record(n=Cell(k), m=Cell(s), q=Cell("PK"))
            cells[b] = block
            cells |= {f"{b}.{name}": cell for name, cell in block.cells.items()}
        return cells

    def at(self, name):
        return lambda: self.cells[name]

    # Places: (text, what finds the cell, pointers that must not be 0)

    def place(self, kind, depth=2):
        rng = self.rng
        if kind == "K":
            plain = ["k1", "k1", "k2", "k3", f"a[{rng.randrange(6)}]", f"n[{rng.randrange(4)}].val", "b.n"]
            if depth and rng.random() < 0.5 and (kind := rng.choice(["PK", "PN"])) in self.followed:
                return self.behind("PK", depth) if kind == "PK" else self.member("val", depth)
        elif kind == "S":
            plain = ["s1", "s1", "s2", f"n[{rng.randrange(4)}].hits", "c.m"]
            if depth and rng.random() < 0.6 and self.dirt:
                return self.behind("PS", 0)
            if depth and rng.random() < 0.4 and "PN" in self.followed:
                return self.member("hits", depth)
        elif kind == "PK":
            plain = ["pk1", "pk1", "pk2", "b.q"]
            if depth and rng.random() < 0.2 and kind in self.followed and "PPK" in self.followed:
                return self.behind("PPK", depth)
        elif kind == "PN":
            plain = ["pn1", "pn1", "pn2", "pn3", f"n[{rng.randrange(4)}].next"]
            if depth and rng.random() < 0.35 and kind in self.followed:
                return self.behind("PPN", depth) if "PPN" in self.followed and rng.random() < 0.4 else self.member("next", depth)
        else:
            plain = [kind.lower()]
        name = rng.choice(plain)
        return name, self.at(name), []

    def behind(self, kind, depth):
        text, find, needs = self.place(kind, depth - 1)
        return text + "^", lambda: follow(find()), [*needs, (text, find)]

    def member(self, name, depth):
        text, find, needs = self.place("PN", depth - 1)
        return f"{text}^.{name}", lambda: follow(find()).cells[name], [*needs, (text, find)]

    def value(self, kind):
        """A number: (text, what gives it, needs)"""
        rng = self.rng
        number = {"K": self.k, "S": self.s}[kind]
        text, find, needs = self.place(kind)
        choice = rng.random()
        if choice < 0.25:
            constant = rng.randint(1, 50)
            return str(constant), lambda: constant, []
        if choice < 0.5:
            return text, lambda: wrap(number, find().value), needs
        if choice < 0.6 and kind == "S":
            other, find2, more = self.place("K")
            return f"{text} + TO_{number}({other})", lambda: wrap(number, wrap(number, find().value) + wrap(number, wrap(self.k, find2().value))), needs + more
        constant = rng.randint(1, 9)
        return f"{text} + {constant}", lambda: wrap(number, wrap(number, find().value) + constant), needs

    # Statements: (lines, what runs them)

    def guarded(self, text, run, needs):
        """Mostly nothing is followed that is 0."""
        if not needs or self.rng.random() < 0.02:
            return [text], run

        def test():
            if all(find().value is not None for _, find in needs):
                run()

        condition = " AND_THEN ".join(f"{pointer} <> 0" for pointer, _ in needs)
        return [f"IF {condition} THEN", f"  {text}", "END_IF"], test

    def aim(self, kind):
        rng = self.rng
        if kind == "Q":
            kind, pointer = "PK", rng.choice(["b.q", "c.q"])
        elif kind == "LINK":
            kind, pointer = "PN", f"n[{rng.randrange(4)}].next"
        else:
            pointer = {"PK": rng.choice(["pk1", "pk2"]), "PN": rng.choice(["pn1", "pn2", "pn3"])}.get(kind, kind.lower())
        to = {"PK": ["k1", "k1", "k2", f"a[{rng.randrange(6)}]", f"n[{rng.randrange(4)}].val", "b.n", "c.n"],
              "PN": [f"n[{rng.randrange(4)}]"], "PPK": ["pk1", "pk2", "b.q"],
              "PPN": ["pn1", "pn2", "pn3", f"n[{rng.randrange(4)}].next"]}[kind]
        name = rng.choice(to)

        def run():
            self.cells[pointer].value = self.cells[name]

        return [f"{pointer} := ADR({name});"], run

    def stray(self):
        """`ps`, a POINTER TO S, leads to a variable of type K afterwards: to k1, or to k2, which lies behind s2."""
        how, k, s = self.dirt, self.k, self.s
        name = "k2" if how in ("sum", "index") else "k1"
        lines = {"type": ["ps := ADR(k1);"], "number": ["u := ADR(k1);", "ps := u;"], "sum": [f"ps := ADR(s2) + SIZEOF({s});"],
                 "union": ["un.one := ADR(k1);", "ps := un.two;"], "index": ["ps := ADR(s2);", "ps := ADR(ps[1]);"]}[how]

        def run():
            self.cells["ps"].value = self.cells[name]

        return lines, run

    def assignment(self):
        rng = self.rng
        kind = rng.choice(["K", "K", "S", "S", "PK", "PN", "PN"])
        text, find, needs = self.place(kind)
        if kind in ("K", "S"):
            value, give, more = self.value(kind)
            number = {"K": self.k, "S": self.s}[kind]

            def run():
                cell = find()
                cell.value = wrap(number, give())
        else:
            value, source, more = self.place(kind) if rng.random() < 0.93 else ("0", lambda: Cell(kind), [])

            def run():
                cell = find()
                cell.value = source().value
        return self.guarded(f"{text} := {value};", run, needs + more)

    def call(self):
        """What is handed to others, which write there."""
        rng, k, s = self.rng, self.k, self.s
        choice = rng.randrange(6)
        by = rng.randint(1, 9)
        text, find, needs = self.place("K", 1) if choice in (0, 4) else self.place("PK", 1)

        def add(kind, cell, number):
            cell.value = wrap(kind, wrap(kind, cell.value) + number)

        if choice == 0:
            return self.guarded(f"Add(io := {text}, more := {by});", lambda: add(k, find(), by), needs)
        if choice == 1:
            return self.guarded(f"Put(pt := {text}, more := {by});", lambda: add(k, follow(find()), by), [*needs, (text, find)])
        block = rng.choice(["b", "c"])
        if choice == 2:
            def poke():
                add(k, follow(find()), by)
                add(s, self.cells[f"{block}.m"], 1)
            return self.guarded(f"{block}.Poke(pt := {text}, more := {by});", poke, [*needs, (text, find)])
        if choice == 3:
            def body():
                if self.cells[f"{block}.q"].value is not None:
                    add(k, self.cells[f"{block}.q"].value, by)
                add(k, self.cells[f"{block}.n"], 1)
            return [f"{block}(more := {by});"], body
        if choice == 4:
            def through():
                add(k, find(), by)
                add(s, self.cells["led.m"], 1)
            return self.guarded(f"led(io := {text}, more := {by});", through, needs)
        link, find2, more = self.place("PN", 1)

        def step():
            node = follow(find2())
            add(s, node.cells["hits"], by)
        return self.guarded(f"Hit(node := {link}^, more := {by});", step, [*more, (link, find2)])

    def statement(self, depth):
        rng = self.rng
        choice = rng.random()
        if depth and choice < 0.15:
            return self.loop(depth - 1)
        if choice < 0.2:
            text, find, needs = self.place("K")
            limit, word = rng.randint(0, 60), rng.choice(["EXIT", "CONTINUE", "CONTINUE", "RETURN"])

            def leave():
                if wrap(self.k, find().value) > limit:
                    raise Leave(word)

            return self.guarded(f"IF {text} > {limit} THEN {word}; END_IF", leave, needs)
        if choice < 0.2 + self.aims:
            return self.aim(rng.choice(["PK", "PN", "PPK", "PPN", "LINK"]))
        if choice < 0.2 + self.aims + self.calls:
            return self.call()
        return self.assignment()

    def block(self, depth):
        self.loops += 1
        parts = [self.statement(depth) for _ in range(self.rng.randint(1, 5))]
        self.loops -= 1

        def run():
            for _, part in parts:
                self.tick()
                part()

        return ["  " + line for lines, _ in parts for line in lines], run

    def tick(self):
        self.fuel -= 1
        if self.fuel < 0:
            raise Skip

    def round(self, body):
        """False: EXIT"""
        self.tick()
        try:
            body()
        except Leave as leave:
            if leave.args[0] == "RETURN":
                raise
            return leave.args[0] == "CONTINUE"
        return True

    def loop(self, depth):
        rng = self.rng
        if not self.loops:
            self.choose()
        if rng.random() < 0.5 and self.loops < 2:
            variable = "ij"[self.loops]
            last = rng.randint(1, 6)
            lines, body = self.block(depth)

            def count():
                cell = self.cells[variable]
                cell.value = 0
                while cell.value <= last:
                    if not self.round(body):
                        return
                    cell.value += 1

            return [f"FOR {variable} := 0 TO {last} DO", *lines, "END_FOR"], count
        text, find, needs = self.place("PN", 0)
        lines, body = self.block(depth)
        limit = rng.randint(2, 8)
        self.counters += 1
        counter = f"w{self.counters}"

        def walk():
            rounds = self.cells.setdefault(counter, Cell("DINT"))
            rounds.value = 0
            while find().value is not None and rounds.value < limit:
                def whole():
                    rounds.value += 1
                    body()
                    if find().value is not None:
                        find().value = find().value.cells["next"].value
                if not self.round(whole):
                    return

        return ([f"{counter} := 0;", f"WHILE {text} <> 0 AND_THEN {counter} < {limit} DO", f"  {counter} := {counter} + 1;", *lines,
                 f"  IF {text} <> 0 THEN {text} := {text}^.next; END_IF", "END_WHILE"], walk)

    def choose(self):
        """What an outermost loop may do: the less it does, the more it may keep in registers."""
        rng = self.rng
        self.calls = rng.choice([0, 0, 0.15])
        self.aims = rng.choice([0, 0, 0, 0.05])
        self.followed = {kind for kind in ("PK", "PN", "PPK", "PPN") if rng.random() < 0.4} | {"PS"}

    counters = 0
    followed = {"PK", "PN", "PPK", "PPN"}

    # Running it

    def interpret(self):
        self.cells = self.memory()
        self.cells["led.m"] = Cell(self.s)
        self.fuel, self.stop = FUEL, None
        try:
            for _, run in self.body:
                run()
        except Leave:
            pass
        except Null:
            self.stop = "null"
        # Where the pointers lead.
        for at, (_, find, number) in enumerate(self.marks()):
            if find() is not None:
                cell = find()
                cell.value = wrap(number, wrap(number, cell.value) + 1000 * (at + 1))

    def marks(self):
        """Texts of pointers, what finds the cell that is marked there, its type"""
        for name in ("pk1", "pk2", "b.q", "c.q"):
            yield f"IF {name} <> 0 THEN {name}^", (lambda name=name: self.cells[name].value), self.k
        for name in ("pn1", "pn2", "pn3", *(f"n[{i}].next" for i in range(4))):
            yield (f"IF {name} <> 0 THEN {name}^.hits",
                   (lambda name=name: self.cells[name].value and self.cells[name].value.cells["hits"]), self.s)

    def text(self):
        n, k, s = self.number, self.k, self.s
        word = "PROGRAM" if self.style == "program" else "FUNCTION_BLOCK"
        lines = [f"{word} C{n}", "VAR", f"  k1 : {k};", f"  s1, s2 : {s};", f"  k2, k3 : {k};", "  i, j : DINT;",
                 f"  pk1, pk2 : POINTER TO {k};", "  pn1, pn2, pn3 : POINTER TO Node;", f"  ppk : POINTER TO POINTER TO {k};",
                 "  ppn : POINTER TO POINTER TO Node;", f"  ps : POINTER TO {s};", f"  a : ARRAY[0..5] OF {k};", "  n : ARRAY[0..3] OF Node;",
                 "  b, c : Block;", "  led : Led;", *(f"  w{at} : DINT;" for at in range(1, self.counters + 1))]
        lines += {"number": ["  u : ULINT;"], "union": ["  un : Both;"]}.get(self.dirt, [])
        lines += ["END_VAR", "IF marking THEN"]
        lines += [f"  {text} := {text.split()[-1]} + {1000 * (at + 1)}; END_IF" for at, (text, _, _) in enumerate(self.marks())]
        lines += ["  RETURN;", "END_IF"]
        lines += [line for part, _ in self.body for line in part]
        lines += [f"END_{word}"]
        self.name = f"C{n}"
        if self.style == "block":
            self.name = f"G{n}"
            lines += ["VAR_GLOBAL", f"  G{n} : C{n};", "END_VAR"]
        return lines

    def expected(self):
        found = {f"PLC_PRG.k[{self.number}]": STOPS[self.stop]}
        for name, cell in self.cells.items():
            if isinstance(cell, Cell) and cell.kind[0] != "P":
                found[f"{self.name}.{name}"] = str(wrap(cell.kind, cell.value))
        return found


def common_text(k, s, dirt):
    lines = ["TYPE Node : STRUCT", "  next : POINTER TO Node;", f"  val : {k};", f"  hits : {s};", "END_STRUCT END_TYPE",
             "FUNCTION Add : BOOL", f"VAR_IN_OUT io : {k}; END_VAR", f"VAR_INPUT more : {k}; END_VAR", "io := io + more;", "END_FUNCTION",
             "FUNCTION Put : BOOL", f"VAR_INPUT pt : POINTER TO {k}; more : {k}; END_VAR", "pt^ := pt^ + more;", "END_FUNCTION",
             "FUNCTION Hit : BOOL", "VAR_IN_OUT node : Node; END_VAR", f"VAR_INPUT more : {s}; END_VAR", "node.hits := node.hits + more;", "END_FUNCTION",
             "FUNCTION_BLOCK Block", "VAR_INPUT", f"  more : {k};", f"  n : {k};", f"  m : {s};", f"  q : POINTER TO {k};", "END_VAR",
             "IF q <> 0 THEN q^ := q^ + more; END_IF", "n := n + 1;", "METHOD Poke : BOOL", f"VAR_INPUT pt : POINTER TO {k}; more : {k}; END_VAR",
             "pt^ := pt^ + more;", "m := m + 1;", "END_METHOD", "END_FUNCTION_BLOCK",
             "FUNCTION_BLOCK Led", f"VAR_IN_OUT io : {k}; END_VAR", f"VAR_INPUT more : {k}; END_VAR", f"VAR m : {s}; END_VAR", "io := io + more;",
             "m := m + 1;", "END_FUNCTION_BLOCK", "VAR_GLOBAL marking : BOOL; END_VAR"]
    if dirt == "union":
        lines += ["TYPE Both : UNION", f"  one : POINTER TO {k};", f"  two : POINTER TO {s};", "END_UNION END_TYPE"]
    return lines


def some_cases(rng, count):
    kinds = rng.choice([("DINT", "UDINT"), ("UDINT", "DINT"), ("LINT", "ULINT"), ("INT", "UINT")])
    dirt = rng.choice([None] * len(DIRT) + DIRT)
    cases = []
    while len(cases) < count:
        try:
            # One stray pointer spoils all.
            cases.append(Case(rng, len(cases), kinds, dirt if rng.random() < 0.5 or not cases else None))
        except Skip:
            pass
    return cases, common_text(*kinds, dirt)


def project(cases, common, count):
    lines = list(common)
    calls = []
    for case in cases:
        lines += case.text()
        for mark in ("FALSE", "TRUE"):
            catch = [f"__CATCH (exc)", f"  k[{case.number}] := exc;"] if mark == "FALSE" else ["__CATCH (exc)", "  exc := exc;"]
            calls += [f"marking := {mark};", "__TRY", f"  {case.name}();", *catch, "__ENDTRY"]
    return [*lines, "PROGRAM PLC_PRG", "VAR", "  exc : __SYSTEM.ExceptionCode;", f"  k : ARRAY[0..{count - 1}] OF __SYSTEM.ExceptionCode;",
            "END_VAR", *calls, "END_PROGRAM", ""]


def run(options, source, cases, arguments):
    """True: everything is as expected"""
    expected = {}
    for case in cases:
        expected.update(case.expected())
    names = ["PLC_PRG.k"] + [case.name for case in cases]
    result = subprocess.run([options.stride, "sim", source.name, "--for", "T#10ms", "--print", ",".join(names), "-W", "off=all-warnings", *arguments],
                            capture_output=True, text=True, check=False, cwd=source.parent)
    found = {line.split(" = ")[0]: line.split(" = ", 1)[1] for line in result.stdout.splitlines() if " = " in line}
    wrong = {key: value for key, value in expected.items() if found.get(key) != value}
    if result.returncode == 0 and not wrong:
        return True
    print(f"{source} {' '.join(arguments)}: exit code {result.returncode}, {len(wrong)} of {len(expected)} values differ")
    if result.returncode == 0:
        for key, value in list(wrong.items())[:12]:
            print(f"  {key}: expected {value}, found {found.get(key)}")
    print(result.stderr[:3000])
    return False


def check(options, seed):
    """How many cases agree, or None"""
    cases, common = some_cases(random.Random(seed), options.count)
    return agree_in_both_modes(options, f"pointers{seed}", cases, lambda chosen: project(chosen, common, options.count), run)


def add_options(parser):
    parser.add_argument("--count", type=int, default=40)


if __name__ == "__main__":
    sys.exit(try_seeds(check, "1..4", "cases", add_options))
