"""Programs: sections of the body of a group, each with variables of its own."""
import copy

from model import Array, Ref, Skip, StringType, Struct
from nodes import ELEMENTARY, Variable
from overlays import Union
from pous import BlockArray, Holder, Owner

MAX_STEPS = 1500


class Sections:
    prefix = ""

    # Programs: sections of the body of a group, each with variables of its own

    def section(self, number, group):
        """Adds a program that runs without an error to group."""
        rng = self.rng
        while True:
            self.prefix = f"p{number}_"
            variables, lines, fields, instances = [], [], [], []
            for i in range(rng.randint(6, 8)):
                kind, name = self.scalar() if i < 5 else self.arrays[0] if i == 5 and rng.random() < 0.5 else self.some_type(2), f"p{number}_v{i}"
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
            bound = self.interface_variables(number, lines)
            self.in_section = True
            parts = [part for part in (starts, bound) if part]
            parts += [self.some_statement(rng.choice([0, 1, 1, 2, 2])) for _ in range(rng.randint(2, 4))]
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
                self.readable(fields, state)
            except (Skip, OverflowError):
                self.globals.clear()
                self.globals.update(before)
                continue
            group.lines += lines
            group.body += [f"  // program {number}", *("  " + line for text, _ in parts for line in text)]
            group.fields += [(n, k, state[n]) for n, k, _ in fields]
            return

    def readable(self, fields, state):
        """Fails when bytes of a union or of the image are no number."""
        for name, kind, _ in fields:
            for _ in kind.flat(name, state[name]):
                pass
        for v in self.shared:
            for _ in v.kind.flat(v.name, v.place({}).get()):
                pass

    def pointers(self, number, variables, lines):
        """Pointers and references to variables and parts of them, bound by the first statements of a program"""
        rng = self.rng
        bound, known = [], list(variables)
        self.in_call = 9  # constant indices
        for i in range(rng.choice([0, 0, 1, 2])):
            v = rng.choice(known)
            name, is_pointer = f"p{number}_q{i}", rng.random() < 0.5
            text, kind, place, row = v.name, v.kind, v.place, None
            while isinstance(kind, (Array, Struct, Union)) and rng.random() < 0.6:
                if isinstance(kind, Array):
                    row = kind if len(kind.bounds) == 1 else None
                    text, kind, place = self.element(text, kind, place)
                else:
                    row, part = None, rng.choice(list(kind.fields))
                    text, kind, place = f"{text}.{part}", kind.fields[part], self.field(place, part)
            lines.append(f"  {name} : {'POINTER' if is_pointer else 'REFERENCE'} TO {kind.name};")
            bound.append((f"{name} := ADR({text});" if is_pointer else f"{name} REF= {text};", name, place))
            variables.append(Variable(f"{name}^" if is_pointer else name, kind, self.in_out_place(name), shared=True))
            if row and is_pointer and not isinstance(kind, StringType):  # an index of a pointer to a text is a character
                # Elements beside the one that it points to
                index = int(text[text.rindex("[") + 1:-1])
                for other in rng.sample(range(row.count), min(2, row.count)):
                    step = other + row.bounds[0][0] - index
                    variables.append(Variable(f"{name}[{step}]", kind, self.near(name, step), shared=True))
        self.in_call = 0

        def run(f):
            for _, name, place in bound:
                f[name] = place(f)

        return ([text for text, _, _ in bound], run) if bound else None

    @staticmethod
    def near(name, step):
        return lambda f: Ref(f[name].box, f[name].key + step)

    def interface_variables(self, number, lines):
        """Variables of interface types, bound before the other statements"""
        bound = []
        for i in range(min(2, len(self.implementers))):
            _, _, interface = self.rng.choice(self.implementers)
            value, name = self.implementer(interface), f"p{number}_i{i}"
            lines.append(f"  {name} : {interface.name};")
            bound.append((f"{name} := {value.text};", name, value.fn))
            self.objects.append(Owner(name, self.local_place(name), list(interface.methods.values())))
            self.implementers.append((name, self.local_place(name), interface))
            self.faces.add(name)

        def run(f):
            for _, name, fn in bound:
                f[name] = fn(f)

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
