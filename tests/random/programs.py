"""Random projects: functions, function blocks and programs."""
import copy

from declarations import Declarations
from expressions import Expressions
from model import Array, OpenArray, Ref
from movers import Movers
from nodes import ELEMENTARY, Scope, Variable
from pous import Budget, Group, Instance, Interface, Member, Owner, Parameter, Pou
from sections import Sections
from statements import Statements


class Generator(Declarations, Statements, Sections, Expressions, Movers):
    """Everything of one project; `globals` are the values while it runs."""

    def __init__(self, rng):
        self.budget = Budget()
        super().__init__(rng, self.budget)
        self.text, self.blocks, self.globals, self.holders = [], [], {}, {}
        self.guard_count = 0  # of the project: an inherited name must not come again
        self.in_loop, self.guards, self.in_section = 0, [], False
        self.structs, self.unions, self.subs, self.arrays, self.instances = [], [], [], [], []
        self.interfaces, self.implementers = [], []
        self.make_types()
        self.make_globals()
        self.make_movers()

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
        user = rng.choice(self.interfaces) if is_function and self.interfaces and rng.random() < 0.4 else None
        if user:
            inputs.append(Parameter("any", user, None, True))
            lines.append(f"  any : {user.name};")
        outputs = [Parameter(f"{tag}out{i}", self.some_type(1)) for i in range(rng.choice([0, 0, 1, 2] if is_function else [1, 2, 3]))]
        # Formals and actuals are of one and the same type, so it has a name.
        in_outs = [Parameter(f"io{i}", rng.choice([self.plain(), *(self.open_array() for _ in range(4)), *self.structs, *self.unions, *self.arrays]))
                   for i in range(0 if base else rng.choice([0, 0, 1, 2]))]
        pou = Pou(name, result, inputs, outputs, in_outs)
        pou.budget = self.budget
        variables = [Variable(p.name, p.kind, self.local_place(p.name)) for p in inputs + outputs if p.kind is not user]
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
            if self.interfaces and not base and rng.random() < 0.8:
                pou.interface = rng.choice(self.interfaces)
            elif base:
                pou.interface = base.interface
            members = [Member(v.name, v.kind) for v in variables if not v.shared and "." not in v.name]
            pou.members = [*(base.members if base else []), *members]
            if base:
                variables += [Variable(m.name, m.kind, self.local_place(m.name)) for m in base.members]
            for i in range(2):
                method_lines += self.method(pou, f"Meth{i}", i)
            method_lines += self.property(pou, "Prop0", 2)
        methods = list(pou.all_methods().values())
        objects = [] if is_function else [Owner("", self.itself, methods), Owner("THIS^", self.itself, methods)]
        if user:
            objects.append(Owner("any", self.local_place("any"), list(user.methods.values())))
        self.enter(variables, instances, objects)
        body, pou.body = self.block(2)
        if base and rng.random() < 0.6 and not base.all_in_outs():
            inner = pou.body

            def with_base(f):
                base.execute(f)
                inner(f)

            body, pou.body = ["  SUPER^();", *body], with_base
        pou.locals += [(g, ELEMENTARY["DINT"], 0) for g in self.guards]
        local_lines += [f"  {g} : DINT;" for g in self.guards]
        head = f"FUNCTION {name}{' : ' + result.name if result else ''}" if is_function else f"FUNCTION_BLOCK {name}"
        head += f" EXTENDS {base.name}" if base else f" IMPLEMENTS {pou.interface.name}" if pou.interface else ""
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

    def open_array(self):
        element, dimensions = self.plain(), self.rng.choice([1, 1, 2])
        known = [a for a in self.arrays if a.element.name in ELEMENTARY]
        if known and self.rng.random() < 0.7:
            array = self.rng.choice(known)
            element, dimensions = array.element, len(array.bounds)
        return OpenArray(element, dimensions)

    def make_interfaces(self):
        """Interfaces with a method and a property each"""
        for i in range(2):
            methods = [self.signature("Meth0", 0), *self.accessors("Prop0", self.plain(), 2)]
            interface = Interface(f"Face{i}", {m.key: m for m in methods})
            self.interfaces.append(interface)
            self.text += [f"INTERFACE {interface.name}", *self.head(methods[0]), "END_METHOD",
                          f"PROPERTY Prop0 : {methods[1].result.name} GET END_GET SET END_SET END_PROPERTY", "END_INTERFACE"]

    def signature(self, name, rank):
        rng = self.rng
        result = rng.choice([self.scalar(), self.scalar(), rng.choice(self.structs)])
        inputs = [Parameter(f"a{i}", self.some_type(0), None, True) for i in range(rng.randint(0, 2))]
        for p in inputs:
            p.default = p.kind.default()
        in_outs = [Parameter(f"io{i}", rng.choice([self.plain(), self.plain(), self.open_array()])) for i in range(rng.choice([0, 0, 1]))]
        return self.ranked(Pou(name, result, inputs, [], in_outs), name, rank)

    def accessors(self, name, kind, rank):
        getter = self.ranked(Pou(name, kind, [], [], []), f"{name}.get", rank)
        return getter, self.ranked(Pou(name, None, [Parameter(name, kind, kind.default(), True)], [], []), f"{name}.set", rank)

    def ranked(self, method, key, rank):
        method.key, method.rank, method.budget = key, rank, self.budget
        return method

    def again(self, method):
        """A method with the same parameters"""
        made = Pou(method.name, method.result, method.inputs, method.outputs, method.in_outs)
        return self.ranked(made, method.key, method.rank)

    @staticmethod
    def head(method):
        lines = [f"METHOD {method.name} : {method.result.name}"]
        for section, parameters in (("VAR_INPUT", method.inputs), ("VAR_IN_OUT", method.in_outs)):
            if parameters:
                lines += [section, *(f"  {p.name} : {p.kind.name};" for p in parameters), "END_VAR"]
        return lines

    def replaced(self, block, key):
        """What the base has under this key, and what block must have"""
        old = block.base.all_methods().get(key) if block.base else None
        return old, old or (block.interface.methods.get(key) if block.interface else None)

    def method(self, block, name, rank):
        """A method of a block (with body); one of the base's is overridden with the same parameters"""
        old, wanted = self.replaced(block, name)
        if old and self.rng.random() < 0.4:
            return []
        method = self.again(wanted) if wanted else self.signature(name, rank)
        return [*self.head(method), *self.body_of(block, method, old), "END_METHOD"]

    def property(self, block, name, rank):
        old, wanted = self.replaced(block, f"{name}.get")
        if old and self.rng.random() < 0.4:
            return []
        getter, setter = self.accessors(name, wanted.result if wanted else self.plain(), rank)
        lines = [f"PROPERTY {name} : {getter.result.name}", "GET", *self.body_of(block, getter, old), "END_GET"]
        return [*lines, "SET", *self.body_of(block, setter, old), "END_SET", "END_PROPERTY"]

    def body_of(self, block, method, old):
        variables = [Variable(p.name, p.kind, self.local_place(p.name)) for p in method.inputs]
        variables += [Variable(p.name, p.kind, self.in_out_place(p.name), shared=True) for p in method.in_outs]
        if method.result:
            variables.append(Variable(method.name, method.result, self.local_place(method.name)))
        variables += [Variable(m.name, m.kind, self.this_place(m.name), shared=True) for m in block.members]
        local_lines = []
        for i in range(2):
            kind = self.scalar()
            line, value = self.declare(f"l{i}", kind)
            local_lines.append(line)
            method.locals.append((f"l{i}", kind, value))
            variables.append(Variable(f"l{i}", kind, self.local_place(f"l{i}")))
        lower = [m for m in block.all_methods().values() if m.rank < method.rank]
        objects = [Owner("", self.itself, lower), Owner("THIS^", self.itself, lower)]
        if old:
            super_of = copy.copy(block.base.find(method.key))
            super_of.virtual = False  # SUPER^ means the base's own
            objects += [Owner("SUPER^", self.itself, [super_of])] * 2
        self.enter(variables, [], objects)
        body, method.body = self.block(1)
        method.locals += [(g, ELEMENTARY["DINT"], 0) for g in self.guards]
        block.methods[method.key] = method
        return ["VAR", *local_lines, *(f"  {g} : DINT;" for g in self.guards), "END_VAR", *body]

    @staticmethod
    def this_place(name):
        return lambda f: Ref(f["this"], name)

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
        self.scope = Scope(variables + self.shared + self.movable)
        self.objects = [*objects, *(Owner(i.text, i.place, list(i.block.all_methods().values())) for i in instances),
                        *self.movable_objects]
        self.implementers = [(i.text, i.place, i.block.interface) for i in instances if i.block.interface]
        self.instances = [*instances, *self.movable_instances]
        self.in_loop, self.guards, self.faces = 0, [], set()

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

    def program(self, groups, count, pous):
        """The text of a project of groups × count programs with so many functions, and (path, type, value) of what it must print"""
        rng = self.rng
        self.make_interfaces()
        for i in range(pous):
            self.pou(f"Fun{i}", True)
            if i in (1, 3, 4, 6):
                self.pou(f"Block{i}", False, rng.choice(self.blocks) if i > 3 and rng.random() < 0.7 else None)
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
                 "  Start();", *(f"  g{i}();" for i in range(len(made))), "END_PROGRAM", ""]
        expected = []
        for i, group in enumerate(made):
            for name, kind, value in group.fields:
                expected += kind.flat(f"PLC_PRG.g{i}.{name}", value)
        for v in self.shared:
            expected += v.kind.flat(v.name, v.place({}).get())
        for name, kind in self.led:
            expected += kind.flat(name, self.globals[name])
        return text, expected
