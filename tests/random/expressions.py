"""Random expressions: text together with a function that computes the value."""
from integers import Integers
from places import Places
from texts import Texts
from values import Values


class Expressions(Places, Integers, Values, Texts):
    def __init__(self, rng, budget):
        self.rng, self.budget = rng, budget
        self.functions, self.objects = [], []  # callable in expressions
        self.enums, self.scope, self.in_call = [], None, 0
