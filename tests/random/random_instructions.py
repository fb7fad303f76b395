#!/usr/bin/env python3
"""Random instruction lists (IL) whose values are computed here as well.

usage: random_instructions.py STRIDE [--seeds FIRST..LAST] [--count N] [--keep FOLDER]

A seed is a project of N programs, each an instruction list over variables of its own. The model is a machine with one current
result that steps through the instructions as they stand, with a stack for parentheses and jumps by line; it knows nothing of
expressions, which is what the compiler makes of the lines. Every variable must have the value that the machine leaves in it.
A project that disagrees is left in FOLDER (default: the temporary folder) and named.
"""
import random
import subprocess
import sys

from seeds import try_seeds

WIDTHS = {"BOOL": 1, "INT": 16, "DINT": 32, "WORD": 16}
COUNTS = {"BOOL": 5, "INT": 4, "DINT": 5, "WORD": 3}
BLOCK = """FUNCTION_BLOCK Gather
VAR_INPUT x : DINT := 1; up : BOOL := TRUE; END_VAR
VAR_OUTPUT sum, calls : DINT; END_VAR
LD calls
ADD 1
ST calls
LD up
JMPCN down
LD sum
ADD x
ST sum
RET
down:
LD sum
SUB x
ST sum
END_FUNCTION_BLOCK
FUNCTION Weigh : DINT
VAR_INPUT a, b, c : DINT; END_VAR
LD a
MUL 3
ADD( b
MUL -5
)
SUB c
ST Weigh
END_FUNCTION"""


def wrap(kind, value):
    """The value as a variable of the type holds it."""
    bits = WIDTHS[kind]
    value &= (1 << bits) - 1
    return value - (1 << bits) if kind in ("INT", "DINT") and value >> (bits - 1) else value


def quotient(a, b):
    q = abs(a) // abs(b)
    return q if (a < 0) == (b < 0) else -q


ARITHMETIC = {
    "ADD": lambda a, b: a + b,
    "SUB": lambda a, b: a - b,
    "MUL": lambda a, b: a * b,
    "DIV": quotient,
    "MOD": lambda a, b: a - b * quotient(a, b),
}
COMPARISONS = {
    "GT": lambda a, b: a > b,
    "GE": lambda a, b: a >= b,
    "EQ": lambda a, b: a == b,
    "NE": lambda a, b: a != b,
    "LE": lambda a, b: a <= b,
    "LT": lambda a, b: a < b,
}
BITWISE = {"AND": lambda a, b: a & b, "OR": lambda a, b: a | b, "XOR": lambda a, b: a ^ b, "&": lambda a, b: a & b}


def weigh(a, b, c):
    return a * 3 + b * -5 - c


FUNCTIONS = {"MAX": (2, max), "MIN": (2, min), "LIMIT": (3, lambda low, x, high: min(max(low, x), high)), "Weigh": (3, weigh)}


class Machine:
    """Steps through instructions: (label, operator, operands). An operand is a number or the name of a variable."""

    def __init__(self, values):
        self.values = values  # name: [type, value]
        self.kind = self.result = None
        self.open = []  # (operator, type, result) of the parentheses

    def of(self, operand):
        return self.values[operand][1] if isinstance(operand, str) else operand

    def combine(self, operator, b):
        """The current result with `b`; both are DINT in arithmetic, alike in logic."""
        name = operator[:-1] if operator[:-1] in BITWISE and operator.endswith("N") else operator
        if name in ARITHMETIC:
            self.kind, self.result = "DINT", wrap("DINT", ARITHMETIC[name](self.result, b))
        elif name in COMPARISONS:
            self.kind, self.result = "BOOL", int(COMPARISONS[name](self.result, b))
        else:
            b = wrap(self.kind, ~b) if operator != name else b
            self.result = wrap(self.kind, BITWISE[name](self.result, b))

    def store(self, name, value):
        self.values[name][1] = wrap(self.values[name][0], value)

    def call(self, x, up):
        for name, value in (("fb.x", x), ("fb.up", up)):
            if value is not None:
                self.store(name, value)
        sign = 1 if self.values["fb.up"][1] else -1
        self.store("fb.calls", self.values["fb.calls"][1] + 1)
        self.store("fb.sum", self.values["fb.sum"][1] + sign * self.values["fb.x"][1])

    def step(self, operator, operands):
        """Label to go on with; "" to leave; None: the next line."""
        if operator in ("JMP", "JMPC", "JMPCN"):
            return operands[0] if operator == "JMP" or self.result == (operator == "JMPC") else None
        if operator in ("RET", "RETC", "RETCN"):
            return "" if operator == "RET" or self.result == (operator == "RETC") else None
        if operator in ("CAL", "CALC", "CALCN"):
            if operator == "CAL" or self.result == (operator == "CALC"):
                self.call(*(None if o is None else self.of(o) for o in operands))
        elif operator in ("LD", "LDN"):
            first = operands[0]
            self.kind = self.values[first][0] if isinstance(first, str) else operands[1]
            self.kind = "DINT" if self.kind == "INT" else self.kind
            value = self.of(first)
            self.result = wrap(self.kind, ~value) if operator == "LDN" else value
        elif operator in ("ST", "STN"):
            self.store(operands[0], ~self.result if operator == "STN" else self.result)
        elif operator in ("S", "R"):
            if self.result:
                self.store(operands[0], int(operator == "S"))
        elif operator == "NOT":
            self.result = wrap(self.kind, ~self.result)
        elif operator == ")":
            outer, kind, result = self.open.pop()
            b, self.kind, self.result = self.result, kind, result
            self.combine(outer, b)
        elif operator.endswith("("):
            self.open.append((operator[:-1], self.kind, self.result))
            if operands:
                self.step("LD", operands)
        elif operator in FUNCTIONS:
            self.kind, self.result = "DINT", wrap("DINT", FUNCTIONS[operator][1](self.result, *map(self.of, operands)))
        else:
            for operand in operands:
                self.combine(operator, self.of(operand))
        return None

    def run(self, lines):
        at = {label: i for i, (label, _, _) in enumerate(lines) if label}
        i = steps = 0
        while i < len(lines):
            _, operator, operands = lines[i]
            target = self.step(operator, operands) if operator else None
            if target == "":
                return
            i = i + 1 if target is None else at[target]
            steps += 1
            assert steps < 100000


class Writer:
    """Makes one program."""

    def __init__(self, rnd):
        self.rnd = rnd
        self.lines = []
        self.labels = 0
        self.values = {}
        for kind, count in COUNTS.items():
            for k in range(count):
                self.values[f"{kind[0].lower()}{k}"] = [kind, self.some(kind)]
        self.values |= {"loops": ["DINT", 0], "fb.x": ["DINT", 1], "fb.up": ["BOOL", 1], "fb.sum": ["DINT", 0], "fb.calls": ["DINT", 0]}
        self.start = {name: value for name, (_, value) in self.values.items()}

    def some(self, kind):
        r = self.rnd
        if kind == "BOOL":
            return r.randrange(2)
        bits = WIDTHS[kind]
        if kind == "WORD":
            return r.choice([0, 1, 0x7FFF, 0x8000, 0xFFFF, r.getrandbits(16)])
        top = 1 << (bits - 1)
        return r.choice([0, 1, -1, top - 1, -top, top - 2, r.randrange(-100, 100), r.randrange(-top, top)])

    def name(self, kind):
        return f"{kind[0].lower()}{self.rnd.randrange(COUNTS[kind])}"

    def operand(self, kind, other_than_0=False):
        """Something of the type, or an INT for a DINT."""
        if other_than_0 or self.rnd.random() < 0.3:
            value = self.some(kind)
            return value if value or not other_than_0 else self.rnd.choice([-7, 3, 10])
        return self.name("INT" if kind == "DINT" and self.rnd.random() < 0.3 else kind)

    def put(self, operator, *operands, label=""):
        self.lines.append((label, operator, list(operands)))

    def label(self):
        self.labels += 1
        return f"l{self.labels}"

    def load(self, kind, operator="LD"):
        self.put(operator, self.name(kind)) if self.rnd.random() < 0.8 else self.put(operator, self.some(kind), kind)

    def arithmetic(self, depth):
        """Instructions that change a DINT."""
        r = self.rnd
        for _ in range(r.randrange(1, 4)):
            what = r.random()
            if what < 0.25 and depth < 3:
                self.nested(r.choice(["ADD", "SUB", "MUL"]), "DINT", depth, self.arithmetic)
            elif what < 0.4:
                name = r.choice(list(FUNCTIONS))
                self.put(name, *(self.operand("DINT") for _ in range(FUNCTIONS[name][0] - 1)))
            elif what < 0.5:
                self.put(r.choice(["ADD", "MUL"]), *(self.operand("DINT") for _ in range(r.randrange(2, 4))))
            else:
                operator = r.choice(["ADD", "SUB", "MUL", "DIV", "MOD"])
                self.put(operator, self.operand("DINT", operator in ("DIV", "MOD")))

    def nested(self, operator, kind, depth, inside):
        if self.rnd.random() < 0.5:
            first = self.operand(kind)
            self.put(operator + "(", *([first] if isinstance(first, str) else [first, kind]))
        else:
            self.put(operator + "(")
            self.load(kind)
        inside(depth + 1)
        self.put(")")

    def logic(self, kind, depth=0):
        r = self.rnd
        for _ in range(r.randrange(1, 4)):
            operator = r.choice(["AND", "OR", "XOR", "ANDN", "ORN", "XORN", "&", "&N"])
            what = r.random()
            if what < 0.25 and depth < 3:
                self.nested(operator, kind, depth, lambda d: self.logic(kind, d))
            elif what < 0.35:
                self.put("NOT")
            elif what < 0.5 and not operator.endswith("N") and operator != "&":
                self.put(operator, *(self.operand(kind) for _ in range(2)))
            else:
                self.put(operator, self.operand(kind))

    def condition(self):
        """Leaves a BOOL."""
        if self.rnd.random() < 0.5:
            self.load("BOOL", self.rnd.choice(["LD", "LDN"]))
            if self.rnd.random() < 0.6:
                self.logic("BOOL")
        else:
            self.load("DINT")
            if self.rnd.random() < 0.6:
                self.arithmetic(1)
            self.put(self.rnd.choice(list(COMPARISONS)), self.operand("DINT"))

    def store(self, kind):
        negated = kind in ("BOOL", "WORD") and self.rnd.random() < 0.3
        self.put("STN" if negated else "ST", self.name(kind))
        if kind == "BOOL" and self.rnd.random() < 0.3:
            self.put(self.rnd.choice("SR"), self.name(kind))

    def calculate(self):
        kind = self.rnd.choice(["DINT", "DINT", "WORD", "BOOL"])
        if kind == "BOOL":
            self.condition()
        else:
            self.load(kind, "LDN" if kind == "WORD" and self.rnd.random() < 0.3 else "LD")
            self.arithmetic(0) if kind == "DINT" else self.logic(kind)
        self.store(kind)
        if self.rnd.random() < 0.4:  # the current result stays
            self.arithmetic(1) if kind == "DINT" else self.logic(kind)
            self.store(kind)

    def call(self):
        arguments = [self.operand("DINT") if self.rnd.random() < 0.6 else None, self.operand("BOOL") if self.rnd.random() < 0.4 else None]
        if self.rnd.random() < 0.4:
            self.put("CAL", *arguments)
        else:
            self.condition()
            self.put(self.rnd.choice(["CALC", "CALCN"]), *arguments)
            if self.rnd.random() < 0.5:  # after a conditional call it is still there
                self.store("BOOL")

    def skip(self):
        """A jump over some lines; with the current result going along, or without."""
        target = self.label()
        if self.rnd.random() < 0.5:
            self.condition()
            self.put(self.rnd.choice(["JMPC", "JMPCN"]), target)
            self.logic("BOOL")
            self.put("", label=target)
            self.store("BOOL")
        else:
            if self.rnd.random() < 0.7:
                self.condition()
                self.put(self.rnd.choice(["JMPC", "JMPCN"]), target)
            else:
                self.put("JMP", target)
            for _ in range(self.rnd.randrange(1, 3)):
                self.calculate()
            self.put("", label=target)
            self.calculate()

    def loop(self):
        start = self.label()
        self.put("LD", self.rnd.randrange(1, 6), "DINT")
        self.put("ST", "loops")
        self.put("", label=start)
        self.calculate()
        self.put("LD", "loops")
        self.put("SUB", 1)
        self.put("ST", "loops")
        self.put("GT", 0)
        self.put("JMPC", start)

    def write(self):
        for _ in range(self.rnd.randrange(6, 14)):
            self.rnd.choice([self.calculate, self.calculate, self.call, self.skip, self.loop])()
        if self.rnd.random() < 0.5:
            self.condition()
            self.put(self.rnd.choice(["RETC", "RETCN"]))
            self.calculate()
        return self


def literal(value, kind):
    if kind == "BOOL":
        return "TRUE" if value else "FALSE"
    return f"WORD#16#{value:X}" if kind == "WORD" else f"{kind}#{value}"


def text_of(operator, operands, kind):
    """`kind`: the type of literals in the line"""
    if operator.startswith("CAL"):
        named = [f"{name} := {text(o, k)}" for name, o, k in zip(("x", "up"), operands, ("DINT", "BOOL")) if o is not None]
        return f"{operator} fb({', '.join(named)})"
    if operator in ("LD", "LDN") or operator.endswith("("):
        return f"{operator} {text(operands[0], operands[-1])}" if operands else operator
    return f"{operator} {', '.join(text(o, kind) for o in operands)}".rstrip()


def text(operand, kind):
    return operand if isinstance(operand, str) else literal(operand, kind)


def source_of(name, writer):
    """The program as text. A literal has the type of what is calculated."""
    out = [f"PROGRAM {name}", "VAR"]
    for kind, count in COUNTS.items():
        out += [f"  {n} : {kind} := {literal(writer.start[n], kind)};" for n in (f"{kind[0].lower()}{k}" for k in range(count))]
    out += ["  loops : DINT;", "  fb : Gather;", "END_VAR"]
    kinds = []  # of the enclosing parentheses
    kind = "BOOL"
    for label, operator, operands in writer.lines:
        if label:
            out.append(f"{label}:")
        if not operator:
            continue
        if operator == ")":
            kind = kinds.pop()
        elif operator.endswith("("):
            kinds.append(kind)
        elif operator in ("LD", "LDN"):
            first = operands[0]
            kind = writer.values[first][0] if isinstance(first, str) else operands[1]
            kind = "DINT" if kind == "INT" else kind
        out.append(text_of(operator, operands, kind))
        if operator in COMPARISONS:
            kind = "BOOL"
    return out + ["END_PROGRAM"]


def check(options, seed):
    rnd = random.Random(f"instructions {seed}")
    writers = [Writer(rnd).write() for _ in range(options.count)]
    lines = BLOCK.split("\n")
    expected = {}
    for k, writer in enumerate(writers):
        lines += source_of(f"P{k}", writer)
        values = {name: [kind, value] for name, (kind, value) in writer.values.items()}
        Machine(values).run(writer.lines)
        for name, (kind, value) in values.items():
            expected[f"P{k}.{name}"] = literal(value, kind) if kind == "BOOL" else str(value)
    lines += ["PROGRAM PLC_PRG", "VAR n : INT; END_VAR", *(f"P{k}();" for k in range(options.count)), "END_PROGRAM"]
    source = options.keep / f"instructions{seed}.st"
    source.write_text("\n".join(lines) + "\n", encoding="utf-8")
    names = ",".join(f"P{k}" for k in range(options.count))
    result = subprocess.run([options.stride, "sim", source.name, "--for", "T#10ms", "--print", names, "-W", "off=all-warnings"],
                            capture_output=True, text=True, check=False, cwd=source.parent)
    found = dict(line.split(" = ", 1) for line in result.stdout.splitlines() if " = " in line)
    wrong = [name for name, value in expected.items() if not same(found.get(name), value)]
    if result.returncode == 0 and not wrong:
        source.unlink()
        return len(writers)
    print(f"{source}: exit code {result.returncode}, {len(wrong)} of {len(expected)} values differ")
    for name in wrong[:5]:
        print(f"  {name}: expected {expected[name]}, found {found.get(name)}")
    print(result.stderr[:1500])
    return None


def same(found, value):
    if found is None:
        return False
    return int(found[3:], 16) == int(value) if found.startswith("16#") else found == value


def add_options(parser):
    parser.add_argument("--count", type=int, default=30)


if __name__ == "__main__":
    sys.exit(try_seeds(check, "1..3", "programs", add_options))
