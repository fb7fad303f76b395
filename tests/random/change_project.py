"""A random project for random_changes.py: its declarations, the same with random changes, and both as sources."""
import copy

from change_model import BITS, SIMPLE, Array, Enum, Member, Record, Simple, Text, literal


class Watch:
    """An address that is kept: a POINTER, REFERENCE, VAR_IN_OUT or interface variable that leads to a variable."""

    def __init__(self, name, form, root, steps, pointee):
        self.name, self.form, self.root, self.steps, self.pointee = name, form, root, steps, pointee


def path_of(root, steps):
    return root + "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps)


class Project:
    """Types, lists of global variables and programs; a list or a program is a Record of its own."""

    def __init__(self, rng):
        self.rng, self.count = rng, 0
        self.enums = [self.enum() for _ in range(3)]
        self.structs, self.blocks = [], []
        for _ in range(4):
            self.structs.append(self.record("S", False, self.structs))
        for _ in range(5):
            self.blocks.append(self.record("FB", True, self.blocks))
        self.lists = [Record(f"G{i}", False, None, [self.member() for _ in range(rng.randint(3, 9))]) for i in range(3)]
        self.programs = [Record(name, True, None, [self.member() for _ in range(rng.randint(3, 9))]) for name in ("Main", "Second")]

        self.watches = [self.watch(f"w{i}") for i in range(10)]

    def watch(self, name):
        rng = self.rng
        while True:
            root = rng.choice([*self.lists, *self.programs])
            steps, kind = [], root
            while isinstance(kind, Record) and kind.members or isinstance(kind, Array):
                if steps and rng.random() < 0.4:
                    break
                if isinstance(kind, Array):
                    steps.append(rng.randint(kind.low, kind.high))
                    kind = kind.element
                else:
                    member = rng.choice(kind.all())
                    steps.append(member.name)
                    member.watched = True
                    kind = member.type
            if not steps:
                continue
            block = isinstance(kind, Record) and kind.is_block
            form = rng.choice(["pointer", "reference", "in_out", *(["interface"] * 6 if block else [])])
            return Watch(name, form, root.name, steps, kind)

    def fresh(self, prefix):
        self.count += 1
        return f"{prefix}{self.count}"

    def enum(self):
        names = [self.fresh("e") for _ in range(self.rng.randint(2, 5))]
        numbers = sorted(self.rng.sample(range(-3, 9), len(names)))
        return Enum(self.fresh("E"), list(zip(names, numbers)))

    def record(self, prefix, is_block, others):
        base = self.rng.choice([None, *others]) if others else None
        return Record(self.fresh(prefix), is_block, base, [self.member(fields=True) for _ in range(self.rng.randint(1, 5))])

    def simple(self):
        kind = self.rng.choice(SIMPLE)
        if kind in BITS and self.rng.random() < 0.25:
            low = self.rng.randint(0 if not BITS[kind][0] else -9, 5)
            return Simple(kind, low, low + self.rng.randint(0, 20))
        return Simple(kind)

    def type(self, fields=False):
        choice = self.rng.random()
        if choice < 0.45:
            return self.simple()
        if choice < 0.55:
            return Text(self.rng.randint(1, 12))
        if choice < 0.65:
            return self.rng.choice(self.enums)
        if choice < 0.8:
            low = self.rng.randint(-2, 3)
            element = self.type(True) if choice < 0.7 else self.simple()
            return Array(low, low + self.rng.randint(0, 3), element)
        if choice < 0.9 and self.structs and not fields:
            return self.rng.choice(self.structs)
        if self.blocks and not fields:
            return self.rng.choice(self.blocks)
        return self.simple()

    def member(self, fields=False):
        kind = self.type(fields)
        init = self.value(kind) if isinstance(kind, (Simple, Text, Enum)) and self.rng.random() < 0.5 else None
        return Member(self.fresh("n"), kind, init)

    def value(self, kind):
        """Any value of an elementary type."""
        rng = self.rng
        if isinstance(kind, Text):
            return "".join(rng.choice("abcdefgh") for _ in range(rng.randint(0, kind.length)))
        if isinstance(kind, Enum):
            return rng.choice(kind.names)[1]
        if kind.low is not None:
            return rng.randint(kind.low, kind.high)
        if kind.kind in BITS:
            signed, bits = BITS[kind.kind]
            low = -(1 << (bits - 1)) if signed else 0
            return rng.choice([low + (low == -(1 << 63)), low + (1 << bits) - 1, rng.randint(1, 100)])
        if kind.kind == "BOOL":
            return rng.randrange(2)
        if kind.kind in ("TIME", "LTIME"):
            return rng.randint(0, 99999)
        return rng.randint(-999, 999) / 4

    def containers(self):
        return [*self.structs, *self.blocks, *self.lists, *self.programs]

    # what is changed

    def changed(self):
        other = copy.deepcopy(self)
        for container in other.containers():
            container.renamed = None
            for member in container.members:
                member.renamed = None
        for enum in other.enums:
            enum.renamed = None
        for _ in range(self.rng.randint(1, 12)):
            self.rng.choice([other.reorder, other.add, other.add, other.remove, other.rename, other.rename, other.exchange,
                             other.retype, other.retype, other.initial, other.enumerators, other.rename_type, other.rebase,
                             other.move_to_base, other.qualify, other.relative, other.rename_owner])()
        return other

    def some(self):
        return self.rng.choice([c for c in self.containers() if c.members])

    def reorder(self):
        self.rng.shuffle(self.some().members)

    def add(self):
        container = self.some()
        member = self.member(container in self.structs or container in self.blocks)
        container.members.insert(self.rng.randint(0, len(container.members)), member)

    def remove(self):
        container = self.some()
        if len(container.members) > 1:
            container.members.remove(self.rng.choice(container.members))

    def rename(self):
        member = self.rng.choice(self.some().members)
        old, member.name = member.name, self.fresh("m")
        if self.rng.random() < 0.7 and member.renamed is None:
            member.renamed = old

    def exchange(self):
        members = self.some().members
        if len(members) > 1:
            a, b = self.rng.sample(members, 2)
            if a.renamed is None and b.renamed is None:
                a.name, b.name = b.name, a.name
                a.renamed, b.renamed = b.name, a.name

    def retype(self):
        container = self.some()
        member = self.rng.choice(container.members)
        kind = member.type
        if isinstance(kind, Array) and self.rng.random() < 0.7:
            kind.low += self.rng.randint(-2, 2)
            kind.high = kind.low + self.rng.randint(0, 4)
        elif isinstance(kind, Text):
            member.type = Text(self.rng.randint(1, 12))
        elif isinstance(kind, Simple) and kind.low is not None and self.rng.random() < 0.7:
            low = max(kind.low + self.rng.randint(-5, 5), 0 if not BITS[kind.kind][0] else -100)
            member.type = Simple(kind.kind, low, low + self.rng.randint(0, 20))
        elif isinstance(kind, Simple) and self.rng.random() < 0.8:
            member.type = self.simple()
        else:
            member.type = self.type(container in self.structs or container in self.blocks)
        member.init = None
        if member.constant:
            member.constant = isinstance(member.type, (Simple, Text))
            member.init = self.value(member.type) if member.constant else None

    def initial(self):
        member = self.rng.choice(self.some().members)
        if isinstance(member.type, (Simple, Text, Enum)):
            member.init = self.value(member.type)

    def enumerators(self):
        enum = self.rng.choice(self.enums)
        choice = self.rng.randrange(4)
        names = dict(enum.names)
        free = [n for n in range(-3, 12) if n not in names.values()]
        name = self.rng.choice(list(names))
        if choice == 0 and free:
            names[self.fresh("e")] = self.rng.choice(free)
        elif choice == 1 and len(names) > 1:
            del names[name]
        elif choice == 2:
            names = {self.fresh("e") if n == name else n: v for n, v in names.items()}
        elif free:
            names[name] = self.rng.choice(free)
        enum.names = list(names.items())
        self.forget_enumerators(enum)

    def forget_enumerators(self, enum):
        for container in self.containers():
            for member in container.members:
                if member.type is enum and member.init is not None and member.init not in dict(enum.names).values():
                    member.init = None

    def rename_type(self):
        kind = self.rng.choice([*self.enums, *self.structs, *self.blocks])
        old, kind.name = kind.name, self.fresh("T")
        if self.rng.random() < 0.6 and kind.renamed is None:
            kind.renamed = old

    def rename_owner(self):
        owner = self.rng.choice(self.programs)
        if owner.renamed is None:
            owner.renamed, owner.name = owner.name, self.fresh("P")

    def rebase(self):
        others = self.rng.choice([self.structs, self.blocks])
        index = self.rng.randrange(len(others))
        others[index].base = self.rng.choice([None, *others[:index]])

    def move_to_base(self):
        record = self.rng.choice([*self.structs, *self.blocks])
        if record.base and record.members and (len(record.members) > 1 or record.is_block):
            member = self.rng.choice(record.members)
            record.members.remove(member)
            record.base.members.append(member)

    def qualify(self):
        container = self.rng.choice([*self.lists, *self.programs, *self.blocks])
        member = self.rng.choice(container.members)
        if self.rng.random() < 0.5:
            member.reset = not member.reset
        elif isinstance(member.type, (Simple, Text)) and not member.watched:
            member.constant = True
            member.init = self.value(member.type) if member.init is None else member.init

    def relative(self):
        """A variable of a block becomes one of its base, or of one that extends it."""
        for container in [*self.lists, *self.programs]:
            for member in container.members:
                if isinstance(member.type, Record) and member.type.is_block and self.rng.random() < 0.3:
                    member.type = self.rng.choice(self.blocks)

    # sources

    def attribute(self, thing, indent=""):
        lines = []
        if thing.renamed:
            lines.append(f"{indent}{{attribute 'renamed_from' := '{thing.renamed}'}}")
        if getattr(thing, "reset", False):
            lines.append(f"{indent}{{attribute 'init_on_onlchange'}}")
        return lines

    def declarations(self, record, keyword):
        lines = []
        for constant in (False, True):
            members = [m for m in record.members if m.constant == constant]
            if not members:
                continue
            if keyword:
                lines.append("VAR CONSTANT" if constant and keyword == "VAR_INPUT" else f"{keyword}{' CONSTANT' * constant}")
            for member in members:
                lines += self.attribute(member, "  ")
                init = "" if member.init is None else f" := {literal(member.type, member.init)}"
                if isinstance(member.type, Enum) and member.init is not None:
                    init = f" := {member.type.name}.{literal(member.type, member.init)}"
                lines.append(f"  {member.name} : {member.type.text()}{init};")
            if keyword:
                lines.append("END_VAR")
        return lines

    def types(self):
        lines = ["INTERFACE INumber", "METHOD Number : INT", "END_METHOD", "END_INTERFACE"]
        for enum in self.enums:
            names = ", ".join(f"{name} := {number}" for name, number in enum.names)
            lines += [*self.attribute(enum), f"TYPE {enum.name} : ({names}); END_TYPE"]
        for struct in self.structs:
            extends = f" EXTENDS {struct.base.name}" if struct.base else ""
            lines += [*self.attribute(struct), f"TYPE {struct.name}{extends} :", "STRUCT", *self.declarations(struct, None),
                      "END_STRUCT", "END_TYPE"]
        for block in self.blocks:
            extends = f" EXTENDS {block.base.name}" if block.base else ""
            lines += [*self.attribute(block), f"FUNCTION_BLOCK {block.name}{extends}{'' if block.base else ' IMPLEMENTS INumber'}",
                      *self.declarations(block, "VAR_INPUT"), "METHOD Number : INT", f"Number := {self.blocks.index(block) + 1};",
                      "END_METHOD", "END_FUNCTION_BLOCK"]
        return "\n".join(lines) + "\n"

    def watch_program(self, places):
        """`places`: by watch where its variable is, None if there is none. Sets addresses once, then looks where they lead."""
        types, declared, once, always = [], ["bSet : BOOL;"], [], []
        for watch in self.watches:
            name, form, place, kind = watch.name, watch.form, places[watch.name], watch.pointee.text()
            keyword = {"pointer": f"POINTER TO {kind}", "reference": f"REFERENCE TO {kind}", "interface": "INumber",
                       "in_out": f"Watch_{name}"}[form]
            declared.append(f"{name} : {keyword}; {name}State : INT;")
            if form == "in_out":
                types += [f"FUNCTION_BLOCK Watch_{name}", f"VAR_IN_OUT io : {kind}; END_VAR", "METHOD Here : __UXINT",
                          "Here := ADR(io);", "END_METHOD", "END_FUNCTION_BLOCK"]
            if place:
                once.append({"pointer": f"{name} := ADR({place});", "reference": f"{name} REF= {place};",
                             "in_out": f"{name}(io := {place});", "interface": f"{name} := {place};"}[form])
            always.append(f"{name}State := 0;")
            if form == "interface":
                always.append(f"IF {name} <> 0 THEN {name}State := {name}.Number(); END_IF")
                continue
            here = {"pointer": name, "reference": f"ADR({name})", "in_out": f"{name}.Here()"}[form]
            there = {"pointer": f"{name} <> 0", "reference": f"__ISVALIDREF({name})"}.get(form, "TRUE" if place else "FALSE")
            found = f"{name}State := SEL({here} = ADR({place}), 2, 1);" if place else f"{name}State := 2;"
            always.append(f"IF {there} THEN {found} END_IF")
        return "\n".join([*types, "PROGRAM WatchAll", "VAR", *declared, "END_VAR", "IF NOT bSet THEN", *once, "bSet := TRUE;",
                          "END_IF", *always, "END_PROGRAM", ""])

    def write(self, folder, places):
        folder.mkdir(parents=True, exist_ok=True)
        names = ", ".join(f'"{program.name}"' for program in self.programs)
        (folder / "WatchAll.st").write_text(self.watch_program(places))
        (folder / "stride.toml").write_text('[project]\nname = "Changes"\n\n[[task]]\nname = "Task"\ninterval = "T#10ms"\n'
                                            f'programs = [{names}, "WatchAll"]\n')
        (folder / "Types.st").write_text(self.types())
        for record in self.lists:
            (folder / f"{record.name}.st").write_text(
                "{attribute 'qualified_only'}\n" + "\n".join(self.declarations(record, "VAR_GLOBAL")) + "\n")
        for record in self.programs:
            lines = [*self.attribute(record), f"PROGRAM {record.name}", *self.declarations(record, "VAR")]
            for member in record.members:
                if isinstance(member.type, Record) and member.type.is_block:
                    lines.append(f"{member.name}();")
            (folder / f"{record.name}.st").write_text("\n".join([*lines, "END_PROGRAM", ""]))
