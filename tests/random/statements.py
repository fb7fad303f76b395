"""Random statements: lines together with a function that executes them."""
from model import INTS, NUMBERS, Array, OpenArray, Ref, Skip, Struct, limits, wrap
from nodes import ELEMENTARY
from overlays import Union
from pous import ContinueLoop, ExitLoop, ReturnNow


class Statements:
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
            return self.over_array(depth) if rng.random() < 0.6 else self.over_open()
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
        if choice < 0.34:
            return self.part_assignment()
        if choice < 0.38:
            return self.property_assignment()
        if choice < 0.4:
            return self.binding()
        if choice < 0.43:
            return self.rebinding()
        if choice < 0.45:
            return self.counting_elsewhere()
        return self.assignment()

    def any_target(self, shared=True):
        """(text, type, place) of anything that can be assigned"""
        rng = self.rng
        choices = [v for v in self.scope.variables if v.writable and v.name not in self.scope.busy and
                   (shared or not v.shared)]
        v = rng.choice(self.rather_movable(choices))
        text, kind, place = v.name, v.kind, v.place
        while isinstance(kind, OpenArray) or isinstance(kind, (Array, Struct, Union)) and rng.random() < 0.85:
            if isinstance(kind, (Array, OpenArray)):
                text, kind, place = self.element(text, kind, place)
            else:
                name = rng.choice(list(kind.fields))
                text, kind, place = f"{text}.{name}", kind.fields[name], self.field(place, name)
        return text, kind, place

    def assignment(self):
        text, kind, place = self.any_target()
        value = self.any(kind, self.rng.randint(1, 4))
        if self.rng.random() < 0.06 and not isinstance(kind, (Array, Struct, Union)):
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

    def part_assignment(self):
        kind = self.rng.choice([n for n in NUMBERS if NUMBERS[n][1] > 8])
        text, _, place = self.place(kind, write=True)
        letter, name, number = self.some_part(kind)
        bits = NUMBERS[name][1]
        value, shift = self.any(ELEMENTARY[name], 2), number * bits

        def run(f):
            ref = place(f)
            part = value.fn(f)
            ref.set(wrap(kind, ref.get() & ~((1 << bits) - 1 << shift) | part << shift))

        return [f"{text}.%{letter}{number} := {value.text};"], run

    def property_assignment(self):
        setters = [(o, m) for o in self.objects for m in o.methods if m.key.endswith(".set")]
        if not setters:
            raise Skip
        owner, setter = self.rng.choice(setters)
        parameter = setter.inputs[0]
        value = self.any(parameter.kind, 2)

        def run(f):
            this = owner.place(f).get()
            setter.run(this, [(parameter, value.fn(f))])

        return [f"{owner.text}{'.' if owner.text else ''}{setter.name} := {value.text};"], run

    def binding(self):
        """An interface variable takes another instance."""
        names = [(text, known) for text, _, known in self.implementers if text in self.faces]
        if not names:
            raise Skip
        name, interface = self.rng.choice(names)
        value = self.implementer(interface)

        def run(f):
            f[name] = value.fn(f)

        return [f"{name} := {value.text};"], run

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
        wanted = [p for p in block.all_outputs() if rng.random() < 0.3]
        parameters += wanted
        rng.shuffle(parameters)
        texts, steps = [], []
        self.in_call += 1
        for p in parameters:
            if p in in_outs or p in wanted:
                text, step = self.target(p.kind)
            else:
                value = self.any(p.kind, 2)
                text, step = value.text, value.fn
            texts.append(f"{p.name} {'=>' if p in wanted else ':='} {text}")
            steps.append((p, step))
        self.in_call -= 1

        def run(f):
            self.budget.tick()
            instance = target.place(f).get()
            results = []
            for p, step in steps:
                if p in wanted:
                    results.append((p, step(f)))
                else:
                    instance[p.name] = step(f)
            block.execute(instance)
            for p in in_outs:
                del instance[p.name]
            for p, place in results:
                place.set(p.kind.copy(instance[p.name]))

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

    def over_open(self):
        """A loop over an ARRAY[*]"""
        rng = self.rng
        arrays = [v for v in self.scope.variables if isinstance(v.kind, OpenArray) and v.name not in self.scope.busy]
        counters = [v for v in self.scope.variables if v.kind.name in ("DINT", "LINT") and v.writable and not v.shared and
                    v.name not in self.scope.busy and "." not in v.name]
        if not arrays or not counters:
            raise Skip
        array, v = rng.choice(arrays), rng.choice(counters)
        d, element = rng.randint(1, array.kind.dimensions), array.kind.element
        self.scope.busy |= {v.name, array.name}
        value = self.any(element, 2)
        self.scope.busy -= {v.name, array.name}

        def run(f):
            ref = v.place(f)
            low, last = array.place(f).bounds[d - 1]
            ref.set(low)
            more = low <= last
            while more:
                self.budget.tick()
                place, offset = array.place(f), 0
                for k, (first, end) in enumerate(place.bounds, 1):
                    i = ref.get() if k == d else first
                    if not first <= i <= end:
                        raise Skip
                    offset = offset * (end - first + 1) + i - first
                Ref(place.get(), offset).set(element.copy(value.fn(f)))
                i = ref.get()
                more = i < last
                ref.set(wrap(v.kind.name, i + 1))

        index = ", ".join(v.name if k == d else f"LOWER_BOUND({array.name}, {k})" for k in range(1, array.kind.dimensions + 1))
        return [f"FOR {v.name} := LOWER_BOUND({array.name}, {d}) TO UPPER_BOUND({array.name}, {d}) DO",
                f"  {array.name}[{index}] := {value.text};", "END_FOR"], run

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
