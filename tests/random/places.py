"""Places that are read and written; calls; whatever may be assigned to a type."""
from model import BITS, INTS, NUMBERS, REALS, TIMES, Array, Enum, OpenArray, OpenRef, Skip, Ref, StringType, Struct, Subrange, same
from nodes import Node
from pous import Interface
from overlays import Union


class Places:
    # Places

    def place(self, wanted, write=False, const=False):
        """(text, type, function of the frame giving a Ref) of a variable or a part of one, of the leaf type wanted"""
        candidates = [v for v in self.scope.by_leaf.get(wanted, ()) if not (write and (not v.writable or v.name in self.scope.busy)) and (const or not v.const)]
        if not candidates:
            raise Skip
        v = self.rng.choice(candidates)
        return self.descend(v.name, v.kind, v.place, wanted)

    def descend(self, text, kind, place, wanted):
        rng = self.rng
        while True:
            if isinstance(kind, (Array, OpenArray)):
                text, kind, place = self.element(text, kind, place)
            elif isinstance(kind, (Struct, Union)):
                name = rng.choice([n for n, t in kind.fields.items() if wanted in t.leaves])
                text, kind, place = f"{text}.{name}", kind.fields[name], self.field(place, name)
            else:
                return text, kind, place

    @staticmethod
    def field(place, name):
        return lambda f: Ref(place(f).get(), name)

    def element(self, text, kind, place):
        if isinstance(kind, OpenArray):
            return self.open_element(text, kind, place)
        indices = [self.index(low, high) for low, high in kind.bounds]
        joint = "][" if self.rng.random() < 0.2 else ", "
        bounds = kind.bounds

        def run(f):
            box, offset = place(f).get(), 0
            for (low, high), (_, index) in zip(bounds, indices):
                offset = offset * (high - low + 1) + index(f) - low
            return Ref(box, offset)

        return f"{text}[{joint.join(t for t, _ in indices)}]", kind.element, run

    def open_element(self, text, kind, place):
        indices = [self.integer(1, INTS) for _ in range(kind.dimensions)]
        if any(INTS[i.kind] == (False, 64) for i in indices):
            raise Skip

        def run(f):
            ref, offset = place(f), 0
            for (low, high), node in zip(ref.bounds, indices):
                offset = offset * (high - low + 1) + max(low, min(high, node.fn(f))) - low
            return Ref(ref.get(), offset)

        texts = [f"LIMIT(LOWER_BOUND({text}, {d}), {n.text}, UPPER_BOUND({text}, {d}))" for d, n in enumerate(indices, 1)]
        return f"{text}[{', '.join(texts)}]", kind.element, run

    def index(self, low, high):
        rng = self.rng
        if rng.random() < 0.4 or self.in_call > 2:
            value = rng.randint(low, high)
            return str(value), lambda f: value
        node = self.integer(1)
        if NUMBERS[node.kind][1] == 64 and not INTS.get(node.kind, (False,))[0] or node.kind in BITS:
            raise Skip
        return f"LIMIT({low}, {node.text}, {high})", lambda f: max(low, min(high, node.fn(f)))

    def read(self, wanted, kinds=None):
        for _ in range(8):
            text, kind, place = self.place(wanted)
            if kinds is None or kind.name in kinds:
                return text, kind, lambda f: place(f).get()
        raise Skip

    # Anything

    def any(self, kind, depth):
        """An expression that can be assigned to kind; its function returns the value as kind holds it."""
        name = kind.name
        if isinstance(kind, StringType):
            a, size = self.string(depth, kind.family), kind.size
            return Node(a.text, name, lambda f: a.fn(f)[:size], const=a.const)
        if isinstance(kind, Subrange):
            if self.rng.random() < 0.3:
                value = self.rng.randint(kind.low, kind.high)
                return Node(str(value), name, lambda f: value, const=True)
            a = self.value_of(kind.base, depth - 1, True)
            if a.const:
                raise Skip
            return Node(f"LIMIT({kind.low}, {a.text}, {kind.high})", name,
                        lambda f: max(kind.low, min(kind.high, a.fn(f))))
        if isinstance(kind, Enum):
            return self.enumerator(kind)
        if isinstance(kind, Interface):
            return self.implementer(kind)
        if isinstance(kind, (Array, Struct, Union)):
            return self.whole(kind, depth)
        if name == "BOOL":
            if self.rng.random() < 0.05:
                value = self.rng.random() < 0.5
                return Node(str(value).upper(), name, lambda f: value, const=True)
            return self.boolean(depth)
        if name in REALS:
            return self.real(depth, name)
        if name in TIMES:
            return self.time(depth, name)
        return self.value_of(name, depth)

    def whole(self, kind, depth):
        """A structure or an array as a whole"""
        choices = [v for v in self.scope.variables if self.holds(v.kind, kind) and not v.const]
        if choices and (self.rng.random() < 0.7 or depth <= 0):
            v = self.rng.choice(choices)
            text, place = self.reach(v.name, v.kind, v.place, kind)
            return Node(text, kind.name, lambda f: kind.copy(place(f).get()))
        call = self.call(depth, lambda t: t is kind)
        return Node(call[0], kind.name, lambda f: kind.copy(call[2](f)))

    def holds(self, kind, wanted):
        if same(kind, wanted):
            return True
        if isinstance(kind, (Array, OpenArray)):
            return self.holds(kind.element, wanted)
        return isinstance(kind, (Struct, Union)) and any(self.holds(t, wanted) for t in kind.fields.values())

    def reach(self, text, kind, place, wanted):
        while not same(kind, wanted):
            if isinstance(kind, (Array, OpenArray)):
                text, kind, place = self.element(text, kind, place)
            else:
                name = self.rng.choice([n for n, t in kind.fields.items() if self.holds(t, wanted)])
                text, kind, place = f"{text}.{name}", kind.fields[name], self.field(place, name)
        if isinstance(wanted, OpenArray) and isinstance(kind, Array):
            return text, lambda f: OpenRef(place(f), kind.bounds)
        return text, place

    def target(self, wanted):
        """A place of exactly this type that may be written: (text, function)"""
        choices = [v for v in self.scope.variables if v.writable and v.name not in self.scope.busy and
                   self.holds(v.kind, wanted) and v.name[0] != "%"]
        if not choices:
            raise Skip
        v = self.rng.choice(self.rather_movable(choices))
        return self.reach(v.name, v.kind, v.place, wanted)

    def implementer(self, interface):
        choices = [(text, place) for text, place, known in self.implementers if known is interface]
        if not choices:
            raise Skip
        text, place = self.rng.choice(choices)
        return Node(text, interface.name, lambda f: place(f).get())

    def call(self, depth, wanted):
        """(text, type, function) of a call of a function or a method"""
        choices = [(f, None) for f in self.functions if f.result and wanted(f.result)]
        choices += [(m, o) for o in self.objects for m in o.methods if m.result and wanted(m.result)]
        if not choices or self.in_call > 2:
            raise Skip
        movers = [c for c in choices if c[0] in self.moving]
        return self.call_of(*self.rng.choice(movers if movers and self.rng.random() < 0.5 else choices), depth)

    def call_of(self, function, owner, depth):
        rng = self.rng
        self.in_call += 1
        try:
            parameters = list(function.inputs)
            named = rng.random() < 0.5 or function.outputs or function.in_outs
            if named:
                parameters = [p for p in parameters if p.needed or rng.random() < 0.7] + list(function.in_outs)
                parameters += [p for p in function.outputs if rng.random() < 0.7]
                rng.shuffle(parameters)
            texts, steps = [], []
            for p in parameters:
                if p in function.inputs:
                    a = self.any(p.kind, max(0, depth - 1))
                    texts.append(f"{p.name} := {a.text}" if named else a.text)
                    steps.append((p, a.fn))
                else:
                    text, place = self.target(p.kind)
                    texts.append(f"{p.name} {':=' if p in function.in_outs else '=>'} {text}")
                    steps.append((p, place))
        finally:
            self.in_call -= 1

        def run(frame):
            this = owner.place(frame).get() if owner else None
            return function.run(this, [(p, fn(frame)) for p, fn in steps])

        dot = f"{owner.text}." if owner and owner.text else ""
        actuals = "" if "." in function.key else f"({', '.join(texts)})"  # a property has none
        return f"{dot}{function.name}{actuals}", function.result, run
