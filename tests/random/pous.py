"""Functions, function blocks and their instances while they run."""
from model import Skip, Type
from nodes import ELEMENTARY


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
    """Whose methods and properties can be used: the text before the dot, the place of the instance, the methods"""

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


class Interface(Type):
    """Its values are instances."""

    def __init__(self, name, methods):
        super().__init__(name)
        self.methods = methods  # key: signature

    def default(self):
        return None


class Pou:
    """A function, a method, an accessor of a property or the type of a function block."""

    def __init__(self, name, result, inputs, outputs, in_outs):
        self.name, self.result, self.inputs, self.outputs, self.in_outs = name, result, inputs, outputs, in_outs
        self.locals, self.instances, self.methods = [], [], {}
        self.body, self.budget = None, None
        self.key, self.rank = name, 0  # what finds a method; a method uses those of lower rank only

    def __deepcopy__(self, memo):
        return self  # what instances are of, not what they hold

    def run(self, this, arguments):
        """A call of a function, or of a method of instance this. Arguments: parameter with a value, or with a place."""
        if this and self.virtual:
            method = this["type"].find(self.key)
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

    base, virtual, interface = None, True, None

    def new(self):
        instance = self.base.new() if self.base else {}
        instance["type"] = self
        instance |= {p.name: p.kind.copy(p.default) for p in self.inputs}
        instance |= {p.name: p.kind.default() for p in self.outputs}
        instance |= {n: k.copy(v) for n, k, v in self.locals}
        instance |= {n: block.new() for n, block in self.instances}
        return instance

    def find(self, key):
        """The method of this key that an instance of this block has"""
        return self.methods[key] if key in self.methods or not self.base else self.base.find(key)

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
