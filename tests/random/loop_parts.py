"""What the cases of random_loops.py are made of: places, and texts with what they mean."""
import re

from model import wrap

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
