"""Random statements, functions, function blocks and programs."""
import copy

from expressions import COMPARE, ELEMENTARY, Expressions, Scope, Variable
from model import (INTS, NUMBERS, REALS, TIMES, Array, Enum, Ref, Skip, StringType, Struct, Subrange, limits, real_text,
                   rounded, string_text, time_text, wrap)

MAX_STEPS = 1500
METHODS = True


class ExitLoop(Exception):
    pass


class ContinueLoop(Exception):
    pass


class ReturnNow(Exception):
    pass


class Member:
    """A variable of a block, as its methods see it"""

    def __init__(self, name, kind):
        self.name, self.kind = name, kind


class Owner:
    """Whose methods can be called: the text before the dot, the place of the instance, the methods"""

    def __init__(self, text, place, methods):
        self.text, self.place, self.methods = text, place, methods


class Budget:
    def __init__(self):
        self.left = 0

    def tick(self):
        self.left -= 1
        if self.left < 0:
            raise Skip


class Parameter:
    def __init__(self, name, kind, default=None, needed=False):
        self.name, self.kind, self.default, self.needed = name, kind, default, needed


class Pou:
    """A function or the type of a function block."""

    def __init__(self, name, result, inputs, outputs, in_outs):
        self.name, self.result, self.inputs, self.outputs, self.in_outs = name, result, inputs, outputs, in_outs
        self.locals, self.instances, self.methods = [], [], {}
        self.body, self.budget = None, None

    def run(self, this, arguments):
        """A call of a function, or of a method of instance this. Arguments: parameter with a value, or with a place."""
        if this and self.virtual:
            method = this["type"].find(self.name)
            if method is not self:
                # Both have the same parameters.
                return method.run(this, arguments)
        self.budget.tick()
        frame = {p.name: p.kind.copy(p.default) for p in self.inputs}
        frame |= {n: k.copy(v) for n, k, v in self.locals}
        frame |= {p.name: p.kind.default() for p in self.outputs}
        if self.result:
            frame[self.name] = self.result.default()
        frame["this"] = this
        results = []
        for p, value in arguments:
            if p in self.outputs:
                results.append((p, value))
            else:
                frame[p.name] = value
        self.execute(frame)
        for p, place in results:
            place.set(p.kind.copy(frame[p.name]))
        return frame.get(self.name)

    def execute(self, frame):
        try:
            self.body(frame)
        except ReturnNow:
            pass

    # Blocks

    base, virtual = None, True

    def new(self):
        instance = self.base.new() if self.base else {}
        instance["type"] = self
        instance |= {p.name: p.kind.copy(p.default) for p in self.inputs}
        instance |= {p.name: p.kind.default() for p in self.outputs}
        instance |= {n: k.copy(v) for n, k, v in self.locals}
        instance |= {n: block.new() for n, block in self.instances}
        return instance

    def find(self, name):
        """The method of this name that an instance of this block has"""
        return self.methods[name] if name in self.methods or not self.base else self.base.find(name)

    def all_methods(self):
        found = self.base.all_methods() if self.base else {}
        return {**found, **self.methods}

    def all_outputs(self):
        return [*(self.base.all_outputs() if self.base else []), *self.outputs]

    def all_inputs(self):
        return [*(self.base.all_inputs() if self.base else []), *self.inputs]

    def all_in_outs(self):
        return [*(self.base.all_in_outs() if self.base else []), *self.in_outs]

    def flat(self, path, value):
        if self.base:
            yield from self.base.flat(path, value)
        for p in [*self.inputs, *self.outputs]:
            yield from p.kind.flat(f"{path}.{p.name}", value[p.name])
        for n, kind, _ in self.locals:
            yield from kind.flat(f"{path}.{n}", value[n])
        for n, block in self.instances:
            yield from block.flat(f"{path}.{n}", value[n])


class Instance:
    """A function block that a body may call: text, block, place"""

    def __init__(self, text, block, place):
        self.text, self.block, self.place = text, block, place


class Generator(Expressions):
    """Everything of one project; `globals` are the values while it runs."""

    def __init__(self, rng):
        self.budget = Budget()
        super().__init__(rng, self.budget)
        self.text, self.blocks, self.globals, self.holders = [], [], {}, {}
        self.guard_count = 0  # of the project: an inherited name must not come again
        self.in_loop, self.guards, self.in_section = 0, [], False
        self.types, self.structs, self.subs, self.arrays, self.instances = [], [], [], [], []
        self.make_types()
        self.make_globals()

    # Types and initial values

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
        for i in range(2):
            array = self.some_array(1)
            self.text.append(f"TYPE Array{i} : {array.name}; END_TYPE")
            self.arrays.append(Array(array.element, array.bounds, f"Array{i}"))

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
            return StringType(rng.choice([1, 3, 8, 20, 80]))
        return rng.choice(self.enums + self.subs) if self.subs else ELEMENTARY["INT"]

    def some_array(self, depth):
        rng = self.rng
        bounds = []
        for _ in range(rng.choice([1, 1, 1, 2, 2, 3])):
            low = rng.choice([0, 1, rng.randint(-5, 5)])
            bounds.append((low, low + rng.randint(0, 3)))
        return Array(self.some_type(depth - 1), bounds)

    def some_type(self, depth):
        choice = self.rng.random()
        if depth > 0 and choice < 0.15:
            return self.some_array(depth)
        if choice < 0.3 and self.structs:
            return self.rng.choice(self.structs)
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
        if isinstance(kind, StringType):
            value = self.letters(9)
            return string_text(value), value[:kind.size]
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
        constants = []
        for i in range(4):
            kind = self.scalar()
            line, self.globals[f"k{i}"] = self.declare(f"k{i}", kind, 1)
            constants.append(line)
            self.shared.append(Variable(f"k{i}", kind, self.global_place(f"k{i}"), False, const=True))
        self.text += ["VAR_GLOBAL", *lines, "END_VAR", "VAR_GLOBAL CONSTANT", *constants, "END_VAR"]

    def global_place(self, name):
        return lambda f: Ref(self.globals, name)

    @staticmethod
    def local_place(name):
        return lambda f: Ref(f, name)

    # Functions and blocks

    def pou(self, name, is_function, base=None):
        rng = self.rng
        tag = f"d{name[-1]}" if base else ""  # members of a derived block have names of their own
        result = self.some_type(1) if is_function and rng.random() < 0.9 else None
        if result is not None and isinstance(result, Array) and result not in self.arrays:
            result = rng.choice(self.arrays)
        inputs, lines = [], []
        for i in range(rng.randint(0 if is_function else 1, 4)):
            kind = self.some_type(1)
            line, default = self.declare(f"{tag}in{i}", kind, 0.4)
            inputs.append(Parameter(f"{tag}in{i}", kind, default, is_function and ":=" not in line))
            lines.append(line)
        outputs = [Parameter(f"{tag}out{i}", self.some_type(1)) for i in range(rng.choice([0, 0, 1, 2] if is_function else [1, 2, 3]))]
        # Formals and actuals are of one and the same type, so it has a name.
        in_outs = [Parameter(f"io{i}", rng.choice([self.plain(), *self.structs, *self.arrays]))
                   for i in range(0 if base else rng.choice([0, 0, 1, 2]))]
        pou = Pou(name, result, inputs, outputs, in_outs)
        pou.budget = self.budget
        variables = [Variable(p.name, p.kind, self.local_place(p.name)) for p in inputs + outputs]
        variables += [Variable(p.name, p.kind, self.in_out_place(p.name), shared=True) for p in in_outs]
        local_lines = []
        for i in range(rng.randint(3, 6)):
            kind = self.scalar() if i < 3 else self.some_type(1)
            line, value = self.declare(f"{tag}v{i}", kind)
            local_lines.append(line)
            pou.locals.append((f"{tag}v{i}", kind, value))
            variables.append(Variable(f"{tag}v{i}", kind, self.local_place(f"{tag}v{i}")))
        static_lines = []
        if is_function:
            if result:
                variables.append(Variable(name, result, self.local_place(name)))
            for i in range(rng.choice([0, 0, 1])):
                kind, key = self.scalar(), f"{name}.s{i}"
                line, self.globals[key] = self.declare(f"s{i}", kind)
                static_lines.append(line)
                variables.append(Variable(f"s{i}", kind, self.global_place(key), shared=True))
        instances = []
        if not is_function:
            for i in range(rng.choice([0, 0, 1, 2]) if self.blocks else 0):
                block = rng.choice(self.blocks)
                if block.all_in_outs():
                    continue
                pou.instances.append((f"{tag}f{i}", block))
                local_lines.append(f"  {tag}f{i} : {block.name};")
                instances.append(self.instance(f"{tag}f{i}", block, self.local_place(f"{tag}f{i}"), variables))
        method_lines, members = [], []
        if not is_function:
            pou.base = base
            members = [Member(v.name, v.kind) for v in variables if not v.shared and "." not in v.name]
            pou.members = [*(base.members if base else []), *members]
            if base:
                variables += [Variable(m.name, m.kind, self.local_place(m.name)) for m in base.members]
            for i in range(3 if METHODS else 0):
                method_lines += self.method(pou, f"Meth{i}", i)
        objects = [Owner("", self.itself, list(pou.all_methods().values())),
                   Owner("THIS^", self.itself, list(pou.all_methods().values()))] if METHODS and not is_function else []
        self.enter(variables, instances, objects)
        body, pou.body = self.block(2)
        if base and rng.random() < 0.6 and METHODS and not base.all_in_outs():
            inner = pou.body

            def with_base(f):
                base.execute(f)
                inner(f)

            body, pou.body = ["  SUPER^();", *body], with_base
        pou.locals += [(g, ELEMENTARY["DINT"], 0) for g in self.guards]
        local_lines += [f"  {g} : DINT;" for g in self.guards]
        head = f"FUNCTION {name}{' : ' + result.name if result else ''}" if is_function else f"FUNCTION_BLOCK {name}"
        head += f" EXTENDS {base.name}" if base else ""
        sections = [("VAR_INPUT", lines), ("VAR_OUTPUT", [f"  {p.name} : {p.kind.name};" for p in outputs]),
                    ("VAR_IN_OUT", [f"  {p.name} : {p.kind.name};" for p in in_outs]), ("VAR", local_lines),
                    ("VAR_STAT", static_lines)]
        self.text.append(head)
        for word, entries in sections:
            if entries:
                self.text += [word, *entries, "END_VAR"]
        self.text += [*method_lines, *body, "END_FUNCTION" if is_function else "END_FUNCTION_BLOCK"]
        (self.functions if is_function else self.blocks).append(pou)

    @staticmethod
    def itself(frame):
        """The instance whose body or method runs"""
        return Ref({"this": frame.get("this") or frame}, "this")

    def method(self, block, name, rank):
        """A method of a block (with body); one of the base's is overridden with the same parameters"""
        rng = self.rng
        old = block.base.all_methods().get(name) if block.base else None
        if old and rng.random() < 0.4:
            return []
        if old:
            method = Pou(name, old.result, old.inputs, old.outputs, old.in_outs)
        else:
            result = rng.choice([self.scalar(), self.scalar(), rng.choice(self.structs)])
            inputs = [Parameter(f"a{i}", self.some_type(0), None, True) for i in range(rng.randint(0, 2))]
            for p in inputs:
                p.default = p.kind.default()
            in_outs = [Parameter(f"io{i}", self.plain()) for i in range(rng.choice([0, 0, 1]))]
            method = Pou(name, result, inputs, [], in_outs)
        method.budget = self.budget
        lines = [f"METHOD {name} : {method.result.name}"]
        if method.inputs:
            lines += ["VAR_INPUT", *(f"  {p.name} : {p.kind.name};" for p in method.inputs), "END_VAR"]
        if method.in_outs:
            lines += ["VAR_IN_OUT", *(f"  {p.name} : {p.kind.name};" for p in method.in_outs), "END_VAR"]
        variables = [Variable(p.name, p.kind, self.local_place(p.name)) for p in method.inputs]
        variables += [Variable(p.name, p.kind, self.in_out_place(p.name), shared=True) for p in method.in_outs]
        variables.append(Variable(name, method.result, self.local_place(name)))
        variables += [Variable(m.name, m.kind, self.this_place(m.name), shared=True) for m in block.members]
        local_lines = []
        for i in range(2):
            kind = self.scalar()
            line, value = self.declare(f"l{i}", kind)
            local_lines.append(line)
            method.locals.append((f"l{i}", kind, value))
            variables.append(Variable(f"l{i}", kind, self.local_place(f"l{i}")))
        lower = [m for n, m in block.all_methods().items() if int(n[-1]) < rank]
        objects = [Owner("", self.itself, lower), Owner("THIS^", self.itself, lower)]
        if old:
            super_of = copy.copy(block.base.find(name))
            super_of.virtual = False  # SUPER^ means the base's own
            objects += [Owner("SUPER^", self.itself, [super_of])] * 2
        self.enter(variables, [], objects)
        body, method.body = self.block(1)
        method.locals += [(g, ELEMENTARY["DINT"], 0) for g in self.guards]
        lines += ["VAR", *local_lines, *(f"  {g} : DINT;" for g in self.guards), "END_VAR", *body, "END_METHOD"]
        block.methods[name] = method
        return lines

    @staticmethod
    def this_place(name):
        return lambda f: Ref(f["this"], name)

    def plain(self):
        while True:
            kind = self.scalar()
            if not isinstance(kind, StringType):
                return kind

    def instance(self, text, block, place, variables):
        for p in block.all_outputs():
            variables.append(Variable(f"{text}.{p.name}", p.kind, self.member(place, p.name), writable=False))
        return Instance(text, block, place)

    def member(self, place, name):
        return lambda f: Ref(place(f).get(), name)

    @staticmethod
    def in_out_place(name):
        return lambda f: f[name]

    def enter(self, variables, instances=(), objects=()):
        self.scope = Scope(variables + self.shared)
        self.objects = [*objects, *(Owner(i.text, i.place, list(i.block.all_methods().values())) for i in instances)]
        self.instances, self.in_loop, self.guards = list(instances), 0, []

    # Statements: (lines, function of the frame)

    def block(self, depth):
        parts = []
        for _ in range(self.rng.choice([1, 1, 2, 2, 3])):
            parts.append(self.some_statement(depth))

        def run(f):
            for _, part in parts:
                part(f)

        return ["  " + line for lines, _ in parts for line in lines], run

    def some_statement(self, depth):
        for _ in range(200):
            saved = set(self.scope.busy), self.in_loop
            try:
                return self.statement(depth)
            except Skip:
                self.scope.busy, self.in_loop, self.in_call = saved[0], saved[1], 0
        return [";"], lambda f: None

    def statement(self, depth):
        rng = self.rng
        choice = rng.random()
        if depth == 0 or choice < 0.45:
            return self.simple()
        if choice < 0.6:
            return self.branches(depth)
        if choice < 0.68:
            return self.case(depth)
        if choice < 0.82:
            return self.counting(depth)
        if choice < 0.88:
            return self.over_array(depth)
        if choice < 0.97:
            return self.guarded(depth)
        if self.in_loop:
            word, leave = rng.choice([("EXIT", ExitLoop), ("CONTINUE", ContinueLoop)])
        else:
            if self.in_section:
                raise Skip
            word, leave = "RETURN", ReturnNow
        test = self.boolean(2)

        def run(f):
            if test.fn(f):
                raise leave

        return [f"IF {test.text} THEN {word}; END_IF"], run

    def simple(self):
        choice = self.rng.random()
        if choice < 0.12 and self.instances:
            return self.block_call()
        if choice < 0.2:
            functions = [f for f in self.functions if f.outputs or f.in_outs] or self.functions
            if not functions:
                raise Skip
            text, _, run = self.call_of(self.rng.choice(functions), None, 2)
            return [f"{text};"], run
        if choice < 0.25:
            return self.bit_assignment()
        if choice < 0.29:
            return self.set_reset()
        return self.assignment()

    def any_target(self, shared=True):
        """(text, type, place) of anything that can be assigned"""
        rng = self.rng
        choices = [v for v in self.scope.variables if v.writable and v.name not in self.scope.busy and
                   (shared or not v.shared)]
        v = rng.choice(choices)
        text, kind, place = v.name, v.kind, v.place
        while isinstance(kind, (Array, Struct)) and rng.random() < 0.85:
            if isinstance(kind, Array):
                text, kind, place = self.element(text, kind, place)
            else:
                name = rng.choice(list(kind.fields))
                text, kind, place = f"{text}.{name}", kind.fields[name], self.field(place, name)
        return text, kind, place

    def assignment(self):
        text, kind, place = self.any_target()
        value = self.any(kind, self.rng.randint(1, 4))
        if self.rng.random() < 0.06 and not isinstance(kind, (Array, Struct)):
            other, second = self.target(kind)

            def chained(f):
                first = place(f)
                last = second(f)
                result = value.fn(f)
                last.set(result)
                first.set(result)

            return [f"{text} := {other} := {value.text};"], chained

        def run(f):
            target = place(f)
            target.set(kind.copy(value.fn(f)))

        return [f"{text} := {value.text};"], run

    def bit_assignment(self):
        kind = self.rng.choice(list(NUMBERS))
        text, _, place = self.place(kind, write=True)
        bit, value = self.rng.randrange(NUMBERS[kind][1]), self.boolean(2)

        def run(f):
            ref = place(f)
            on = value.fn(f)
            ref.set(wrap(kind, ref.get() | 1 << bit if on else ref.get() & ~(1 << bit)))

        return [f"{text}.{bit} := {value.text};"], run

    def set_reset(self):
        text, _, place = self.place("BOOL", write=True)
        test, on = self.boolean(2), self.rng.random() < 0.5

        def run(f):
            ref = place(f)
            if test.fn(f):
                ref.set(on)

        return [f"{text} {'S=' if on else 'R='} {test.text};"], run

    def block_call(self):
        rng = self.rng
        target = rng.choice(self.instances)
        block = target.block
        in_outs = block.all_in_outs()
        parameters = [p for p in block.all_inputs() if rng.random() < 0.7] + in_outs
        rng.shuffle(parameters)
        texts, steps, after = [], [], []
        self.in_call += 1
        for p in parameters:
            if p in in_outs:
                text, place = self.target(p.kind)
                texts.append(f"{p.name} := {text}")
                steps.append((p.name, place))
            else:
                value = self.any(p.kind, 2)
                texts.append(f"{p.name} := {value.text}")
                steps.append((p.name, value.fn))
        for p in block.all_outputs():
            if rng.random() < 0.3:
                text, place = self.target(p.kind, shared=False)
                if text.startswith("f") or "[" in text:
                    continue
                texts.append(f"{p.name} => {text}")
                after.append((p, place))
        self.in_call -= 1

        def run(f):
            self.budget.tick()
            instance = target.place(f).get()
            for name, step in steps:
                instance[name] = step(f)
            block.execute(instance)
            for p in in_outs:
                del instance[p.name]
            for p, place in after:
                place(f).set(p.kind.copy(instance[p.name]))

        return [f"{target.text}({', '.join(texts)});"], run

    def branches(self, depth):
        rng = self.rng
        arms = [(self.boolean(rng.randint(1, 3)), self.block(depth - 1)) for _ in range(rng.randint(1, 3))]
        otherwise = self.block(depth - 1) if rng.random() < 0.5 else None
        lines = []
        for i, (test, (body, _)) in enumerate(arms):
            lines += [f"{'ELSIF' if i else 'IF'} {test.text} THEN", *body]
        if otherwise:
            lines += ["ELSE", *otherwise[0]]

        def run(f):
            for test, (_, body) in arms:
                if test.fn(f):
                    return body(f)
            return otherwise[1](f) if otherwise else None

        return [*lines, rng.choice(["END_IF", "END_IF;"])], run

    def case(self, depth):
        rng = self.rng
        if rng.random() < 0.25:
            enum = rng.choice(self.enums)
            text, _, get = self.read(enum.name)
            values = [(n, [v]) for n, v in enum.members.items()]
            rng.shuffle(values)
            groups = [values[i:i + 2] for i in range(0, len(values), 2)][:3]
            labels = [(", ".join(rng.choice([n, f"{enum.name}.{n}"]) for n, _ in g), [w for _, v in g for w in v]) for g in groups]
        else:
            node = self.integer(2, INTS)
            if node.const or node.narrow:
                raise Skip
            text, get = node.text, node.fn
            low, high = limits(node.kind)
            labels, used = [], set()
            for _ in range(rng.randint(1, 5)):
                ranges = []
                for _ in range(rng.randint(1, 3)):
                    first = rng.choice([low, high, rng.randint(-8, 8), rng.randint(-8, 8), rng.randint(0, 100)])
                    first = max(low, min(high, first))
                    values = range(first, min(high, first + rng.choice([0, 0, 0, 2, 60])) + 1)
                    if used.isdisjoint(values):
                        used.update(values)
                        ranges.append(values)
                if ranges:
                    label = ", ".join(str(r[0]) if len(r) == 1 else f"{r[0]}..{r[-1]}" for r in ranges)
                    labels.append((label, [v for r in ranges for v in r]))
            if not labels:
                raise Skip
        arms = [(label, set(values), self.block(depth - 1)) for label, values in labels]
        otherwise = self.block(depth - 1) if rng.random() < 0.5 else None
        lines = [f"CASE {text} OF"]
        for label, _, (body, _) in arms:
            lines += [f"  {label}:", *body]
        if otherwise:
            lines += ["ELSE", *otherwise[0]]

        def run(f):
            value = get(f)
            for _, values, (_, body) in arms:
                if value in values:
                    return body(f)
            return otherwise[1](f) if otherwise else None

        return [*lines, rng.choice(["END_CASE", "END_CASE;"])], run

    def counter(self):
        names = [v for v in self.scope.variables if v.kind.name in INTS and v.writable and not v.shared and
                 v.name not in self.scope.busy and "." not in v.name]
        if not names:
            raise Skip
        return self.rng.choice(names)

    def counting(self, depth):
        rng = self.rng
        v = self.counter()
        kind, place = v.kind.name, v.place
        low, high = limits(kind)
        first = rng.choice([low, high, rng.randint(max(low, -20), 20), high - rng.randint(0, 6), low + rng.randint(0, 6)])
        last = max(low, min(high, first + rng.randint(-6, 12)))
        step = rng.choice([None, None, 1, 2, 3, -1, -2, 7])
        last_text, end = str(last), lambda f: last
        if rng.random() < 0.3:
            text, _, get = self.read(kind)
            # The end is computed once, before the loop; a spread of 0..7 keeps it short.
            if first + 7 <= high:
                last_text, end = f"{first} + ({text} AND 7)", lambda f: first + (get(f) & 7)
        self.scope.busy.add(v.name)
        self.in_loop += 1
        lines, body = self.block(depth - 1)
        self.in_loop -= 1
        self.scope.busy.discard(v.name)
        stride = step or 1

        def run(f):
            ref = place(f)
            ref.set(first)
            limit = end(f)
            more = first <= limit if stride > 0 else first >= limit
            while more:
                self.budget.tick()
                try:
                    body(f)
                except ExitLoop:
                    break
                except ContinueLoop:
                    pass
                i = ref.get()
                more = i + stride <= limit if stride > 0 else i + stride >= limit
                ref.set(wrap(kind, i + stride))

        by = "" if step is None else f" BY {step}"
        return [f"FOR {v.name} := {first} TO {last_text}{by} DO", *lines, "END_FOR"], run

    def over_array(self, depth):
        """A loop over an array's elements, as people write it: indices straight from the counter."""
        rng = self.rng
        arrays = [v for v in self.scope.variables if isinstance(v.kind, Array) and len(v.kind.bounds) == 1 and
                  v.writable and v.name not in self.scope.busy]
        if not arrays:
            raise Skip
        array, v = rng.choice(arrays), self.counter()
        low, high = array.kind.bounds[0]
        if not limits(v.kind.name)[0] <= low <= high <= limits(v.kind.name)[1]:
            raise Skip
        kind, element = v.kind.name, array.kind.element
        self.scope.busy |= {v.name, array.name}
        offset = rng.choice([0, 0, 1]) if high > low else 0
        value = self.any(element, 2)
        previous = rng.random() < 0.5
        self.scope.busy -= {v.name, array.name}

        def run(f):
            ref = v.place(f)
            ref.set(low)
            more = True
            while more:
                self.budget.tick()
                i, box = ref.get(), array.place(f).get()
                if not low <= i <= high - offset:
                    raise Skip
                if offset and previous:
                    Ref(box, i - low).set(element.copy(box[i + 1 - low]))
                else:
                    Ref(box, i + offset - low).set(element.copy(value.fn(f)))  # the place is found first
                i = ref.get()
                more = i < high - offset
                ref.set(wrap(kind, i + 1))

        index = f"{v.name} + {offset}" if offset else v.name
        statement = f"{array.name}[{v.name}] := {array.name}[{index}];" if offset and previous else \
            f"{array.name}[{index}] := {value.text};"
        return [f"FOR {v.name} := {low} TO {high - offset} DO", f"  {statement}", "END_FOR"], run

    def guarded(self, depth):
        """WHILE or REPEAT, with a counter that ends it."""
        rng = self.rng
        test, most = self.boolean(2), rng.randint(0, 6)
        self.in_loop += 1
        lines, body = self.block(depth - 1)
        self.in_loop -= 1
        is_while = rng.random() < 0.5
        self.guard_count += 1
        key = f"{self.prefix}guard{self.guard_count}"
        self.guards.append(key)
        if is_while:
            head = [f"WHILE {test.inside(4, rng)} AND {key} < {most} DO", f"  {key} := {key} + 1;"]
            text = [f"{key} := 0;", *head, *lines, "END_WHILE"]
        else:
            text = [f"{key} := 0;", "REPEAT", f"  {key} := {key} + 1;", *lines,
                    f"UNTIL {test.inside(3, rng)} OR {key} > {most} END_REPEAT"]

        def run(f):
            f[key] = 0
            while True:
                self.budget.tick()
                if is_while:
                    more = test.fn(f)
                    if not (more and f[key] < most):
                        break
                f[key] += 1
                try:
                    body(f)
                except ExitLoop:
                    break
                except ContinueLoop:
                    pass
                if not is_while:
                    done = test.fn(f)
                    if done or f[key] > most:
                        break

        return text, run

    prefix = ""

    # Programs: sections of the body of a group, each with variables of its own

    def section(self, number, group):
        """Adds a program that runs without an error to group."""
        rng = self.rng
        while True:
            self.prefix = f"p{number}_"
            variables, lines, fields, instances = [], [], [], []
            for i in range(rng.randint(7, 10)):
                kind, name = self.scalar() if i < 7 else self.some_type(2), f"p{number}_v{i}"
                line, value = self.declare(name, kind)
                lines.append(line)
                fields.append((name, kind, value))
                variables.append(Variable(name, kind, self.local_place(name)))
            starts = self.pointers(number, variables, lines)
            for i in range(rng.choice([0, 1, 2])):
                name = f"p{number}_f{i}"
                made = self.block_variable(name, rng.choice(self.blocks), variables, instances)
                lines.append(f"  {name} : {made.name};")
                fields.append((name, made, None))
            self.enter(variables, instances)
            self.in_section = True
            parts = [starts] if starts else []
            parts += [self.some_statement(rng.choice([0, 1, 2, 2, 3])) for _ in range(rng.randint(3, 6))]
            self.in_section = False
            fields += [(g, ELEMENTARY["DINT"], 0) for g in self.guards]
            lines += [f"  {g} : DINT;" for g in self.guards]
            self.prefix = ""
            before = copy.deepcopy(self.globals)
            state = {n: k.new() if v is None else k.copy(v) for n, k, v in fields}
            self.budget.left = MAX_STEPS
            try:
                for _, part in parts:
                    part(state)
            except (Skip, OverflowError):
                self.globals.clear()
                self.globals.update(before)
                continue
            group.lines += lines
            group.body += [f"  // program {number}", *("  " + line for text, _ in parts for line in text)]
            group.fields += [(n, k, state[n]) for n, k, _ in fields]
            return

    def pointers(self, number, variables, lines):
        """Pointers and references, bound by the first statements of a program"""
        rng = self.rng
        bound = []
        for i in range(rng.choice([0, 0, 1, 2])):
            v = rng.choice(variables)
            name, is_pointer = f"p{number}_q{i}", rng.random() < 0.5
            lines.append(f"  {name} : {'POINTER' if is_pointer else 'REFERENCE'} TO {v.kind.name};")
            text = f"{name} := ADR({v.name});" if is_pointer else f"{name} REF= {v.name};"
            bound.append((text, name, v.place))
            variables.append(Variable(f"{name}^" if is_pointer else name, v.kind, self.in_out_place(name), shared=True))

        def run(f):
            for _, name, place in bound:
                f[name] = place(f)

        return ([text for text, _, _ in bound], run) if bound else None

    def block_variable(self, name, block, variables, instances):
        """A block, an array of blocks or a structure with a block"""
        choice = self.rng.random()
        place = self.local_place(name)
        if choice < 0.5:
            instances.append(self.instance(name, block, place, variables))
            return block
        if choice < 0.75:
            many = BlockArray(block, self.rng.randint(-2, 2), 2)
            for i in range(2):
                instances.append(self.instance(f"{name}[{many.low + i}]", block, self.member(place, i), variables))
            return many
        holder = self.holders.get(block.name)
        if not holder:
            holder = self.holders[block.name] = Holder(f"Hold{block.name}", block)
            self.text.append(f"TYPE {holder.name} : STRUCT n : INT := 3; b : {block.name}; END_STRUCT END_TYPE")
        instances.append(self.instance(f"{name}.b", block, self.member(place, "b"), variables))
        return holder

    def fault(self, number, group):
        """Adds statements that end with a run-time error to group: its message, its place within the line"""
        rng = self.rng
        name = f"p{number}_"
        size, low = rng.randint(2, 6), rng.randint(-3, 3)
        start, bad, ahead = rng.randint(0, 9), rng.randint(1, 3), rng.randint(0, 3)
        low_value, high_value = low - 1 - rng.randint(0, 3), low + size + rng.randint(0, 3)
        outside = rng.choice([low_value, high_value])
        place = f"{name}a[{name}i + {name}k]"
        kind = rng.choice(["index", "target", "loop", "divide", "modulo", "subrange", "pointer", "function"])
        fields = [(f"{name}a", Array(ELEMENTARY["INT"], [(low, low + size - 1)]), None), (f"{name}i", ELEMENTARY["INT"], 0),
                  (f"{name}k", ELEMENTARY["INT"], 0), (f"{name}x", ELEMENTARY["DINT"], start)]
        lines = [f"  {n} : {k.name};" for n, k, _ in fields[:3]] + [f"  {name}x : DINT := {start};"]
        body, state = [], {n: k.default() if v is None else v for n, k, v in fields}
        range_text = f"{low}..{low + size - 1}"
        if kind in ("index", "target"):
            body += [f"{name}i := {outside - ahead};", f"{name}k := {ahead};"]
            state[f"{name}i"], state[f"{name}k"] = outside - ahead, ahead
            line = f"{name}x := {name}x + {place};" if kind == "index" else f"{place} := DINT_TO_INT({name}x);"
            column = line.index(f"{name}i +")
            text = f"array index out of range: index {outside} is outside {range_text}"
        elif kind == "loop":
            body.append(f"FOR {name}i := {low} TO {low + size + bad} DO")
            line = f"  {name}a[{name}i] := {name}i;"
            state[f"{name}a"], state[f"{name}i"] = list(range(low, low + size)), low + size
            column = line.index("[") + 1
            text = f"array index out of range: index {low + size} is outside {range_text}"
        elif kind in ("divide", "modulo"):
            op = "/" if kind == "divide" else "MOD"
            line = f"IF {name}x >= 0 THEN {name}x := ({name}x + 1) {op} ({name}k * {bad}); END_IF"
            column, text = line.index(f" {op} ") + 1, "division by zero"
        elif kind == "subrange":
            lines.append(f"  {name}s : INT({low}..{low + size - 1}) := {low};")
            body.append(f"{name}i := {outside};")
            state[f"{name}i"] = outside
            line = f"{name}s := {name}i;"
            column, text = line.index(":= ") + 3, f"value outside its subrange type: value {outside} is outside {range_text}"
        elif kind == "pointer":
            lines.append(f"  {name}p : POINTER TO INT;")
            line = f"{name}i := {name}k; {name}x := {name}x + {name}p^;"
            column, text = line.index(f"{name}p^"), "use of a null pointer or reference"
        else:
            self.text += ["FUNCTION Quotient : DINT VAR_INPUT a, b : DINT; END_VAR", "  Quotient := a / b;", "END_FUNCTION"]
            line = f"{name}x := Quotient({name}x, {name}k);"
            column, text = None, "division by zero"
        if kind == "loop":
            body += [line, "END_FOR"]
        else:
            body.append(line)
        group.lines += lines
        group.body += ["  " + b for b in body]
        group.fields += [(n, k, state[n]) for n, k, _ in fields]
        # What must not be reached any more.
        group.body.append(f"  {name}x := -1;")
        return text, None if column is None else (f"  {line}", column + 3)

    def failing(self, count):
        """The text of a project that fails at run time, what it prints, the message and line and column"""
        group = Group("Group0")
        self.pou("Fun0", True)
        self.pou("Block0", False)
        for i in range(count):
            self.section(i, group)
        message, at = self.fault(count, group)
        text, expected = self.finish([group])
        if at:
            return text, expected, message, (text.index(at[0]) + 1, at[1])
        line = next(i for i, t in enumerate(text) if t == "  Quotient := a / b;")
        return text, expected, message, (line + 1, 17)

    def program(self, groups, count):
        """The text of a project of groups × count programs, and (path, type, value) of what it must print"""
        rng = self.rng
        for i in range(8):
            self.pou(f"Fun{i}", True)
            if i % 3 == 1:
                bases = [b for b in self.blocks if not b.base]
                self.pou(f"Block{i}", False, rng.choice(bases) if bases and METHODS and rng.random() < 0.7 else None)
        made = []
        for g in range(groups):
            made.append(Group(f"Group{g}"))
            for i in range(count):
                self.section(g * count + i, made[-1])
        return self.finish(made)

    def finish(self, made):
        text = list(self.text)
        for group in made:
            text += [f"FUNCTION_BLOCK {group.name}", "VAR", *group.lines, "END_VAR", *group.body, "END_FUNCTION_BLOCK"]
        text += ["PROGRAM PLC_PRG", "VAR", *(f"  g{i} : {g.name};" for i, g in enumerate(made)), "END_VAR",
                 *(f"  g{i}();" for i in range(len(made))), "END_PROGRAM", ""]
        expected = []
        for i, group in enumerate(made):
            for name, kind, value in group.fields:
                expected += kind.flat(f"PLC_PRG.g{i}.{name}", value)
        for v in self.shared:
            expected += v.kind.flat(v.name, self.globals[v.name])
        return text, expected


class Group:
    def __init__(self, name):
        self.name, self.lines, self.body, self.fields = name, [], [], []


class BlockArray:
    def __init__(self, block, low, count):
        self.name, self.block, self.low, self.count = f"ARRAY[{low}..{low + count - 1}] OF {block.name}", block, low, count

    def new(self):
        return [self.block.new() for _ in range(self.count)]

    def flat(self, path, value):
        for i, instance in enumerate(value):
            yield from self.block.flat(f"{path}[{self.low + i}]", instance)


class Holder:
    def __init__(self, name, block):
        self.name, self.block = name, block

    def new(self):
        return {"n": 3, "b": self.block.new()}

    def flat(self, path, value):
        yield f"{path}.n", ELEMENTARY["INT"], value["n"]
        yield from self.block.flat(f"{path}.b", value["b"])


__all__ = ["COMPARE", "Generator", "MAX_STEPS", "Pou"]
