#!/usr/bin/env python3
"""Random well-typed programs whose values are computed here as well.

usage: random_programs.py STRIDE [--seeds FIRST..LAST] [--keep FOLDER]

Each program is run by `stride sim`; every variable must have the value that this file's own reading of the dialect's
semantics gives it (widening, wrapping, evaluation of AND/OR, FOR at the limits of its type, EXIT and CONTINUE through
CASE). A program that disagrees is left in FOLDER (default: the temporary folder) and named.
"""
import argparse
import pathlib
import random
import subprocess
import sys
import tempfile

# name: (signed, bits)
TYPES = {"SINT": (True, 8), "INT": (True, 16), "DINT": (True, 32), "LINT": (True, 64), "USINT": (False, 8),
         "UINT": (False, 16)}
MAX_STEPS = 20000


class Skip(Exception):
    """This choice has no defined value; take another one."""


class ExitLoop(Exception):
    pass


class ContinueLoop(Exception):
    pass


def limits(name):
    signed, bits = TYPES[name]
    return (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if signed else (0, (1 << bits) - 1)


def wrap(name, value):
    signed, bits = TYPES[name]
    value &= (1 << bits) - 1
    return value - (1 << bits) if signed and value >> (bits - 1) else value


def survives(a, b):
    (signed_a, bits_a), (signed_b, bits_b) = TYPES[a], TYPES[b]
    if not signed_a:
        return bits_b > bits_a if signed_b else bits_b >= bits_a
    return signed_b and bits_b >= bits_a


def common(a, b):
    for name in (a, b, "INT", "DINT", "LINT"):
        if survives(a, name) and survives(b, name):
            return name
    raise Skip


def widened(name):
    return "DINT" if TYPES[name][1] < 32 else name


class Expressions:
    """A straight list of assignments of random expressions."""

    def __init__(self, rng):
        self.rng = rng
        self.numbers, self.bools = {}, {}
        for name in TYPES:
            low, high = limits(name)
            for i in range(2):
                value = rng.choice([low, high, 1, rng.randint(low, high), rng.randint(max(low, -9), 9)])
                self.numbers[f"{name.lower()}{i}"] = (name, value)
        for i in range(3):
            self.bools[f"flag{i}"] = rng.random() < 0.5

    def number(self, depth):
        """(text, type, type before widening, value)"""
        rng = self.rng
        if depth == 0 or rng.random() < 0.15:
            name = rng.choice(list(self.numbers))
            kind, value = self.numbers[name]
            return name, kind, kind, value
        choice = rng.random()
        if choice < 0.5:
            return self.arithmetic(depth)
        if choice < 0.75:
            op = rng.choice(["AND", "OR", "XOR"])
            left, left_type, left_common, a = self.number(depth - 1)
            right, right_type, right_common, b = self.number(depth - 1)
            kind = common(left_common, right_common)
            if TYPES[kind][1] < max(TYPES[left_type][1], TYPES[right_type][1]):
                raise Skip
            a, b = wrap(kind, a), wrap(kind, b)
            return f"({left} {op} {right})", kind, kind, wrap(kind, {"AND": a & b, "OR": a | b, "XOR": a ^ b}[op])
        text, kind, before, value = self.number(depth - 1)
        if choice < 0.85:
            return f"(NOT {text})", kind, kind, wrap(kind, ~value)
        if choice < 0.93:
            return f"(-{text})", widened(kind), before, wrap(widened(kind), -value)
        other, other_kind, _, other_value = self.number(depth - 1)
        if other_kind != kind:
            raise Skip
        selector, selected = self.boolean(depth - 1)
        return f"SEL({selector}, {text}, {other})", kind, kind, other_value if selected else value

    def arithmetic(self, depth):
        op = self.rng.choice(["+", "-", "*", "/", "MOD"])
        left, left_type, left_common, a = self.number(depth - 1)
        right, right_type, right_common, b = self.number(depth - 1)
        before = common(left_common, right_common)
        kind = common(common(widened(before), left_type), right_type)
        a, b = wrap(kind, a), wrap(kind, b)
        if op in ("/", "MOD"):
            if b == 0:
                raise Skip
            quotient = abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
            value = quotient if op == "/" else a - quotient * b
        else:
            value = {"+": a + b, "-": a - b, "*": a * b}[op]
        return f"({left} {op} {right})", kind, before, wrap(kind, value)

    def boolean(self, depth):
        rng = self.rng
        if depth == 0 or rng.random() < 0.1:
            name = rng.choice(list(self.bools))
            return name, self.bools[name]
        choice = rng.random()
        if choice < 0.45:
            op = rng.choice(["=", "<>", "<", "<=", ">", ">="])
            left, _, _, a = self.number(depth - 1)
            right, _, _, b = self.number(depth - 1)
            return f"({left} {op} {right})", {"=": a == b, "<>": a != b, "<": a < b, "<=": a <= b, ">": a > b,
                                              ">=": a >= b}[op]
        text, a = self.boolean(depth - 1)
        if choice < 0.6:
            return f"(NOT {text})", not a
        op = rng.choice(["AND", "OR", "XOR", "AND_THEN", "OR_ELSE", "=", "<>"])
        right, b = self.boolean(depth - 1)
        return f"({text} {op} {right})", {"AND": a and b, "OR": a or b, "XOR": a != b, "AND_THEN": a and b,
                                          "OR_ELSE": a or b, "=": a == b, "<>": a != b}[op]

    def program(self, count=150):
        declarations = [f"  {name} : {kind} := {value};" for name, (kind, value) in self.numbers.items()]
        declarations += [f"  {name} : BOOL := {str(value).upper()};" for name, value in self.bools.items()]
        body, expected = [], {}
        while len(expected) < count:
            name = f"result{len(expected)}"
            try:
                if self.rng.random() < 0.6:
                    text, kind, _, value = self.number(self.rng.randint(1, 5))
                    expected[name] = str(value)
                else:
                    text, value = self.boolean(self.rng.randint(1, 5))
                    kind, expected[name] = "BOOL", str(value).upper()
            except Skip:
                continue
            declarations.append(f"  {name} : {kind};")
            body.append(f"  {name} := {text};")
        return declarations, body, expected


class ControlFlow:
    """Nested loops, branches, EXIT and CONTINUE. A statement is (lines, function of the variables' values)."""

    NAMES = [name for name in TYPES if name != "LINT"]

    def __init__(self, rng):
        self.rng = rng
        self.variables = {f"{name.lower()}{i}": name for name in self.NAMES for i in range(3)}
        self.steps = 0

    def tick(self):
        self.steps += 1
        if self.steps > MAX_STEPS:
            raise Skip

    def value(self):
        rng = self.rng
        choice = rng.random()
        if choice < 0.4:
            name = rng.choice(list(self.variables))
            return name, lambda state: state[name]
        if choice < 0.6:
            constant = rng.randint(-5, 5)
            return str(constant), lambda state: constant
        (left, a), (right, b), sign = self.value(), self.value(), rng.choice([1, -1])
        return f"({left} {'+' if sign > 0 else '-'} {right})", lambda state: wrap("DINT", a(state) + sign * b(state))

    def condition(self):
        (left, a), (right, b) = self.value(), self.value()
        op = self.rng.choice(["<", ">", "=", "<>"])
        test = {"<": int.__lt__, ">": int.__gt__, "=": int.__eq__, "<>": int.__ne__}[op]
        return f"{left} {op} {right}", lambda state: test(a(state), b(state))

    def block(self, depth, in_loop, busy):
        parts = [self.statement(depth, in_loop, busy) for _ in range(self.rng.randint(1, 3))]

        def run(state):
            for _, part in parts:
                part(state)

        return ["  " + line for text, _ in parts for line in text], run

    def statement(self, depth, in_loop, busy):
        choice = self.rng.random()
        if depth == 0 or choice < 0.35:
            return self.assignment(busy)
        if choice < 0.5:
            return self.branches(depth, in_loop, busy)
        if choice < 0.62:
            return self.case(depth, in_loop, busy)
        if choice < 0.82:
            return self.counting(depth, busy)
        if choice < 0.9:
            return self.guarded(depth, busy, is_while=True)
        if in_loop and choice < 0.97:
            word, leave = self.rng.choice([("EXIT", ExitLoop), ("CONTINUE", ContinueLoop)])
            text, test = self.condition()

            def run(state):
                if test(state):
                    raise leave

            return [f"IF {text} THEN {word}; END_IF"], run
        return self.guarded(depth, busy, is_while=False)

    def assignment(self, busy):
        free = [name for name in self.variables if name not in busy]
        name = self.rng.choice(list(busy) if busy and self.rng.random() < 0.1 else free)
        kind = self.variables[name]
        text, value = self.value()

        def run(state):
            state[name] = wrap(kind, value(state))

        return [f"{name} := {text if kind == 'DINT' else f'DINT_TO_{kind}({text})'};"], run

    def branches(self, depth, in_loop, busy):
        tests = [(self.condition(), self.block(depth - 1, in_loop, busy)) for _ in range(self.rng.randint(1, 3))]
        otherwise = self.block(depth - 1, in_loop, busy) if self.rng.random() < 0.5 else None
        lines = []
        for i, ((text, _), (body, _)) in enumerate(tests):
            lines += [f"{'ELSIF' if i else 'IF'} {text} THEN", *body]
        if otherwise:
            lines += ["ELSE", *otherwise[0]]

        def run(state):
            for (_, test), (_, body) in tests:
                if test(state):
                    return body(state)
            return otherwise[1](state) if otherwise else None

        return [*lines, "END_IF"], run

    def case(self, depth, in_loop, busy):
        rng = self.rng
        text, selector = self.value()
        lines, arms, used = [f"CASE {text} + zero OF"], [], set()
        for _ in range(rng.randint(1, 4)):
            ranges = []
            for _ in range(rng.randint(1, 3)):
                low = rng.randint(-8, 8)
                values = range(low, low + rng.choice([0, 0, 0, 2, 60]) + 1)
                if used.isdisjoint(values):
                    used.update(values)
                    ranges.append(values)
            if ranges:
                body, run_body = self.block(depth - 1, in_loop, busy)
                labels = ", ".join(str(r[0]) if len(r) == 1 else f"{r[0]}..{r[-1]}" for r in ranges)
                lines += [f"  {labels}:", *body]
                arms.append((ranges, run_body))
        otherwise = self.block(depth - 1, in_loop, busy) if rng.random() < 0.5 else None
        if otherwise:
            lines += ["ELSE", *otherwise[0]]

        def run(state):
            value = selector(state)
            for ranges, body in arms:
                if any(value in r for r in ranges):
                    return body(state)
            return otherwise[1](state) if otherwise else None

        return [*lines, "END_CASE"], run

    def counting(self, depth, busy):
        rng = self.rng
        name = rng.choice([n for n in self.variables if n not in busy])
        kind = self.variables[name]
        low, high = limits(kind)
        first = rng.choice([low, high, rng.randint(max(low, -20), min(high, 20)), high - rng.randint(0, 6),
                            low + rng.randint(0, 6)])
        last = max(low, min(high, first + rng.randint(-6, 20)))
        step = rng.choice([None, None, 1, 2, 3, -1, -2, 7])
        body, run_body = self.block(depth - 1, True, busy | {name})
        lines, by = [], "" if step is None else f" BY {step}"
        if step is not None and rng.random() < 0.3:  # a step known at run time only
            variable = f"step{'' if TYPES[kind][0] else 'u'}{TYPES[kind][1]}"
            lines, by = [f"{variable} := {step};"], f" BY {variable}"
        stride = step or 1

        def run(state):
            state[name] = first
            more = first <= last if stride > 0 else first >= last
            while more:
                self.tick()
                try:
                    run_body(state)
                except ExitLoop:
                    break
                except ContinueLoop:
                    pass
                i = state[name]
                more = (i <= last and last - i >= stride) if stride > 0 else (i >= last and i - last >= -stride)
                state[name] = wrap(kind, i + stride)

        return [*lines, f"FOR {name} := {first} TO {last}{by} DO", *body, "END_FOR"], run

    def guarded(self, depth, busy, is_while):
        """WHILE or REPEAT, with a counter that ends it."""
        body, run_body = self.block(depth - 1, True, busy)
        text, test = self.condition()
        if is_while:
            lines = [f"WHILE {text} AND guard < 400 DO", "  guard := guard + 1;", *body, "END_WHILE"]
        else:
            lines = ["REPEAT", "  guard := guard + 1;", *body, f"UNTIL {text} OR guard > 400 END_REPEAT"]

        def run(state):
            while not is_while or (test(state) and state["guard"] < 400):
                self.tick()
                state["guard"] += 1
                try:
                    run_body(state)
                except ExitLoop:
                    break
                except ContinueLoop:
                    pass
                if not is_while and (test(state) or state["guard"] > 400):
                    break

        return lines, run

    def program(self):
        while True:
            self.steps = 0
            try:
                blocks = [self.block(5, False, frozenset()) for _ in range(5)]
                state = dict.fromkeys([*self.variables, "guard"], 0)
                for _, run in blocks:
                    run(state)
                break
            except Skip:
                continue
        declarations = [f"  {name} : {kind};" for name, kind in self.variables.items()]
        declarations.append("  guard, zero : DINT; step8 : SINT; step16 : INT; step32, stepu8, stepu16 : DINT;")
        return declarations, [line for text, _ in blocks for line in text], {n: str(v) for n, v in state.items()}


def check(stride, folder, seed):
    rng = random.Random(seed)
    declarations, body, expected = (Expressions if seed % 2 else ControlFlow)(rng).program()
    source = folder / f"random{seed}.st"
    source.write_text("\n".join(["PROGRAM PLC_PRG", "VAR", *declarations, "END_VAR", *body, "END_PROGRAM", ""]))
    result = subprocess.run([stride, "sim", source, "--for", "T#10ms", "--print", "PLC_PRG"], capture_output=True,
                            text=True, check=False)
    found = dict(line.split(" = ", 1) for line in result.stdout.splitlines() if " = " in line)
    wrong = [name for name, value in expected.items() if found.get(f"PLC_PRG.{name}") != value]
    if result.returncode == 0 and not wrong:
        source.unlink()
        return True
    print(f"{source}: exit code {result.returncode}")
    for name in wrong[:5]:
        print(f"  {name}: expected {expected[name]}, found {found.get(f'PLC_PRG.{name}')}")
    print(result.stderr[:1000])
    return False


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("stride")
    parser.add_argument("--seeds", default="1..20")
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path(tempfile.gettempdir()))
    options = parser.parse_args()
    first, last = map(int, options.seeds.split(".."))
    results = [check(options.stride, options.keep, seed) for seed in range(first, last + 1)]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
