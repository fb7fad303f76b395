"""Random types, initial values and global variables."""
from model import (BITS, NUMBERS, REALS, TIMES, Array, Enum, Ref, Skip, StringType, Struct, Subrange, limits, real_text, rounded, string_text, time_text)
from nodes import ELEMENTARY, Variable
from overlays import Image, Union, layout


class Declarations:
    def make_types(self):
        rng = self.rng
        for i in range(2):
            values, value = {}, 0
            for k in range(rng.randint(2, 5)):
                value += rng.randint(1, 4) if rng.random() < 0.4 else int(k > 0)
                values[f"e{i}m{k}"] = value
            self.enums.append(Enum(f"Enum{i}", values))
            self.text.append(f"TYPE Enum{i} : ({', '.join(f'{n} := {v}' for n, v in values.items())}); END_TYPE")
        for i in range(2):
            base = rng.choice(["INT", "DINT", "SINT", "UINT"])
            low = rng.randint(max(-50, limits(base)[0]), 10)
            self.subs.append(Subrange(f"Sub{i}", base, low, low + rng.randint(1, 60)))
            self.text.append(f"TYPE Sub{i} : {base}({low}..{self.subs[-1].high}); END_TYPE")
        for i in range(4):
            fields, defaults, lines = {}, {}, []
            for k in range(rng.randint(2, 5)):
                kind = self.some_type(1)
                fields[f"m{k}"] = kind
                line, defaults[f"m{k}"] = self.declare(f"m{k}", kind, 0.5)
                lines.append(line)
            self.structs.append(Struct(f"Struct{i}", fields, defaults))
            self.text += [f"TYPE Struct{i} : STRUCT", *lines, "END_STRUCT END_TYPE"]
            if i == 1:
                self.make_unions()
        low = rng.randint(-3, 3)
        for i in range(2):
            array = self.some_array(1) if i else Array(self.raw(), [(low, low + rng.randint(1, 4))])
            self.text.append(f"TYPE Array{i} : {array.name}; END_TYPE")
            self.arrays.append(Array(array.element, array.bounds, f"Array{i}"))

    def make_unions(self):
        """Unions of numbers and of what is made of them"""
        rng = self.rng
        while True:
            fields = {f"r{k}": self.raw() for k in range(rng.randint(2, 4))}
            raw = Struct("Raw", fields, {n: t.default() for n, t in fields.items()})
            if layout(raw)[0] == sum(layout(t)[0] for t in fields.values()):
                break  # what a copy leaves in gaps would be seen through the other fields
        self.text += ["TYPE Raw : STRUCT", *(f"  {n} : {t.name};" for n, t in fields.items()), "END_STRUCT END_TYPE"]
        for i in range(2):
            fields = {f"u{k}": self.raw() for k in range(rng.randint(1, 3))}
            low = rng.randint(-2, 2)
            fields["row"] = Array(self.raw(), [(low, low + rng.randint(1, 7))])
            if rng.random() < 0.7:
                fields["raw"] = raw
            if self.unions and rng.random() < 0.7:
                fields["inner"] = self.unions[0]
            union = Union(f"Union{i}", fields)
            self.unions.append(union)
            self.text += [f"TYPE Union{i} : UNION", *(f"  {n} : {t.name};" for n, t in fields.items()), "END_UNION END_TYPE"]

    def raw(self):
        return ELEMENTARY[self.rng.choice([*NUMBERS, *REALS])]

    def scalar(self):
        rng = self.rng
        choice = rng.random()
        if choice < 0.5:
            return ELEMENTARY[rng.choice(list(NUMBERS))]
        if choice < 0.62:
            return ELEMENTARY["BOOL"]
        if choice < 0.74:
            return ELEMENTARY[rng.choice(REALS)]
        if choice < 0.82:
            return ELEMENTARY[rng.choice(list(TIMES))]
        if choice < 0.92:
            return StringType(rng.choice([1, 3, 8, 20, 80]), rng.random() < 0.3)
        return rng.choice(self.enums + self.subs) if self.subs else ELEMENTARY["INT"]

    def some_array(self, depth):
        rng = self.rng
        bounds = []
        for _ in range(rng.choice([1, 1, 1, 2, 2, 3])):
            low = rng.choice([0, 1, rng.randint(-5, 5)])
            bounds.append((low, low + rng.randint(0, 3)))
        array = Array(self.some_type(depth - 1), bounds)
        if sum(1 for _ in array.flat("", array.default())) > 100:
            return Array(self.scalar(), bounds)
        return array

    def some_type(self, depth):
        choice = self.rng.random()
        if depth > 0 and choice < 0.15:
            return self.some_array(depth)
        if choice < 0.28 and self.structs:
            return self.rng.choice(self.structs)
        if choice < 0.32 and self.unions:
            return self.rng.choice(self.unions)
        if choice < 0.38 and self.arrays:
            return self.rng.choice(self.arrays)
        return self.scalar()

    def initial(self, kind, before=None):
        """(text, value) of an initial value; what it leaves out stays as before (or the type's default)"""
        rng, name = self.rng, kind.name
        before = kind.default() if before is None else before
        if isinstance(kind, Array):
            if len(kind.bounds) > 1 and isinstance(kind.element, Array):
                raise Skip  # a list within the list is a row, or an element?
            return self.initial_array(kind, before)
        if isinstance(kind, Struct):
            value, texts = kind.copy(before), []
            for field in rng.sample(list(kind.fields), rng.randint(1, len(kind.fields))):
                text, value[field] = self.initial(kind.fields[field], before[field])
                texts.append(f"{field} := {text}")
            return f"({', '.join(texts)})", value
        if isinstance(kind, Union):
            field = rng.choice([n for n, t in kind.fields.items() if t.name in NUMBERS or t.name in REALS])
            text, part = self.initial(kind.fields[field])
            value = kind.copy(before)
            value[field] = part
            for _ in kind.flat("", value):
                pass  # no REAL may be a NaN
            return f"({field} := {text})", value
        if isinstance(kind, StringType):
            value = self.letters(9, kind.family)
            return string_text(value, kind.family), value[:kind.size]
        if isinstance(kind, Enum):
            member, value = rng.choice(list(kind.members.items()))
            return rng.choice([member, f"{name}.{member}"]), value
        if isinstance(kind, Subrange):
            value = rng.randint(kind.low, kind.high)
            return str(value), value
        if name == "BOOL":
            value = rng.random() < 0.5
            return rng.choice([str(value).upper(), str(int(value))]), value
        if name in REALS:
            value = rng.choice([0.0, 1.0, -2.5, 0.1, 1e6, rng.uniform(-9, 9), rng.uniform(-1e5, 1e5)])
            return real_text(value), rounded(name, value)
        if name in TIMES:
            value = self.time_constant(name)
            return time_text(name, value), value
        low, high = limits(name)
        value = rng.choice([low, high, 0, 1, rng.randint(low, high), rng.randint(max(low, -9), 9)])
        text = f"16#{value:X}" if value >= 0 and rng.random() < 0.15 else str(value)
        return f"{name}#{text}" if rng.random() < 0.1 else text, value

    def initial_array(self, kind, before):
        rng = self.rng
        values, texts = [], []
        count = rng.randint(1, kind.count)
        while len(values) < count:
            # Elements that are repeated must not differ in what is left out.
            at = len(values)
            text, value = self.initial(kind.element, before[at])
            same = sum(1 for b in before[at:count] if b == before[at])
            times = rng.randint(1, same) if rng.random() < 0.4 and before[at:at + same] == [before[at]] * same else 1
            values += [kind.element.copy(value) for _ in range(times)]
            texts.append(f"{times}({text})" if times > 1 or rng.random() < 0.1 else text)
        values += [kind.element.copy(b) for b in before[len(values):]]
        return f"[{', '.join(texts)}]", values

    def declare(self, name, kind, chance=0.6):
        """(line, value)"""
        try:
            if self.rng.random() < chance:
                text, value = self.initial(kind)
                return f"  {name} : {kind.name} := {text};", value
        except Skip:
            pass
        return f"  {name} : {kind.name};", kind.default()

    def make_globals(self):
        lines, self.shared = [], []
        for i in range(12):
            kind = self.scalar() if i < 8 else self.some_type(1)
            line, self.globals[f"g{i}"] = self.declare(f"g{i}", kind)
            lines.append(line)
            self.shared.append(Variable(f"g{i}", kind, self.global_place(f"g{i}"), shared=True))
        self.globals["%"] = Image(64)
        located = ["  last AT %MB63 : BYTE;"]  # so that what no program uses of the image can be printed
        for i in range(4):
            kind = Array(self.raw(), [(1, self.rng.randint(2, 4))]) if i == 3 else self.raw()
            size, _ = layout(kind.element if i == 3 else kind)
            at = self.rng.randrange(24 // size) * size
            located.append(f"  at{i} AT %M{' BW D   L'[size]}{at // size} : {kind.name};")
            self.shared.append(Variable(f"at{i}", kind, self.image_place(kind, at), shared=True))
        for letter, name in self.rng.sample(list(zip("BWDL", BITS)), 2):
            at = self.rng.randrange(24 // layout(ELEMENTARY[name])[0])
            place = self.image_place(ELEMENTARY[name], at * layout(ELEMENTARY[name])[0])
            self.shared.append(Variable(f"%M{letter}{at}", ELEMENTARY[name], place, shared=True))
        constants = []
        for i in range(4):
            kind = self.scalar()
            line, self.globals[f"k{i}"] = self.declare(f"k{i}", kind, 1)
            constants.append(line)
            self.shared.append(Variable(f"k{i}", kind, self.global_place(f"k{i}"), False, const=True))
        self.text += ["VAR_GLOBAL", *lines, *located, "END_VAR", "VAR_GLOBAL CONSTANT", *constants, "END_VAR"]

    def image_place(self, kind, at):
        return lambda f: Ref(self.globals["%"], (kind, at))

    def global_place(self, name):
        return lambda f: Ref(self.globals, name)

    @staticmethod
    def local_place(name):
        return lambda f: Ref(f, name)

    def plain(self):
        while True:
            kind = self.scalar()
            if not isinstance(kind, StringType):
                return kind
