"""Expressions, variables and what a body sees of them."""
from model import NUMBERS, REALS, TIMES, Type

BOOL = Type("BOOL")
ELEMENTARY = {name: Type(name) for name in ["BOOL", *NUMBERS, *REALS, *TIMES]}
COMPARE = {"=": lambda a, b: a == b, "<>": lambda a, b: a != b, "<": lambda a, b: a < b, "<=": lambda a, b: a <= b,
           ">": lambda a, b: a > b, ">=": lambda a, b: a >= b}
PRECEDENCE = {"OR": 1, "OR_ELSE": 1, "XOR": 2, "AND": 3, "AND_THEN": 3, "&": 3, "=": 4, "<>": 4, "<": 5, "<=": 5, ">": 5, ">=": 5,
              "+": 6, "-": 6, "*": 7, "/": 7, "MOD": 7}
UNARY, PRIMARY = 8, 9
WIDE = "äΩ€Ж"
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
