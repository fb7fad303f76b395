"""What calls move: references, pointers, indices and interfaces that lead elsewhere after a function, method or block has
run. They are globals, so that any expression may move what an assignment or a call around it has to find first."""
from model import NUMBERS, Array, Ref, wrap
from nodes import ELEMENTARY, Variable
from pous import BlockArray, Instance, Owner, Parameter, Pou

SIZE = 4


class Track:
    """A pool of values of one type, and what leads to one of them"""

    def __init__(self, name, kind):
        self.name, self.kind = name, kind


class Movers:
    def make_movers(self):
        rng = self.rng
        self.movable, self.movable_objects, self.movable_instances, self.led = [], [], [], []
        self.moving = set()  # the functions and methods that lead something elsewhere
        kinds = [ELEMENTARY[rng.choice(list(NUMBERS))], self.scalar(), rng.choice([*self.structs, *self.unions])]
        self.tracks = [Track(f"t{i}", kind) for i, kind in enumerate(kinds)]
        starts = [line for track in self.tracks for line in self.track(track)]
        self.cell = self.make_cells()
        self.text += ["FUNCTION Start", *starts, *self.lead_cells("0")[0], "END_FUNCTION"]
        self.lead_cells("0")[1]({"n": 0})
        for i, track in enumerate(self.tracks):
            for k in range(2):
                self.mover(f"Move{i}{'ab'[k]}", track)

    # Tracks

    def track(self, track):
        """Declares the globals of a track; the statements that bind them"""
        name, kind = track.name, track.kind
        pool = f"{name}pool"
        line, self.globals[pool] = self.declare(pool, Array(kind, [(0, SIZE - 1)]))
        self.text += ["VAR_GLOBAL", line, f"  {name}ref : REFERENCE TO {kind.name};", f"  {name}ptr : POINTER TO {kind.name};",
                      f"  {name}refs : ARRAY[0..1] OF REFERENCE TO {kind.name};", f"  {name}idx : INT;", f"  {name}side : INT;", "END_VAR"]
        self.shared.append(Variable(pool, Array(kind, [(0, SIZE - 1)]), self.global_place(pool), shared=True))
        self.globals |= {f"{name}idx": 0, f"{name}side": 0, f"{name}refs": [Ref(self.globals[pool], k) for k in range(2)],
                         f"{name}ref": Ref(self.globals[pool], 0), f"{name}ptr": Ref(self.globals[pool], 0)}
        self.led += [(f"{name}idx", ELEMENTARY["INT"]), (f"{name}side", ELEMENTARY["INT"])]
        for text, place in ((f"{name}ref", lambda f: self.globals[f"{name}ref"]), (f"{name}ptr^", lambda f: self.globals[f"{name}ptr"]),
                            (f"{pool}[{name}idx]", lambda f: Ref(self.globals[pool], self.globals[f"{name}idx"])),
                            (f"{name}refs[{name}side]", lambda f: self.globals[f"{name}refs"][self.globals[f"{name}side"]])):
            self.movable.append(Variable(text, kind, place, shared=True))
        return [f"  {name}ref REF= {pool}[0]; {name}ptr := ADR({pool}[0]); {name}refs[0] REF= {pool}[0]; {name}refs[1] REF= {pool}[1];"]

    def leading(self, track):
        """Statements that lead some of a track's ways elsewhere, by an input n; the function that does it"""
        name, pool = track.name, f"{track.name}pool"
        lines, steps = [], []

        def step(line, fn):
            lines.append("  " + line)
            steps.append(fn)

        def target(a):
            return f"{pool}[(n + {a}) MOD {SIZE}]", lambda f: Ref(self.globals[pool], (f["n"] + a) % SIZE)

        def bind(slot, line, place):
            step(line, lambda f: self.globals.__setitem__(slot, place(f)))

        for way in self.rng.sample(["ref", "ptr", "idx", "side", "refs"], self.rng.randint(2, 5)):
            text, place = target(self.rng.randrange(SIZE))
            if way == "ref":
                bind(f"{name}ref", f"{name}ref REF= {text};", place)
            elif way == "ptr":
                bind(f"{name}ptr", f"{name}ptr := ADR({text});", place)
            elif way == "refs":
                step(f"{name}refs[n MOD 2] REF= {text};",
                     lambda f, place=place: self.globals[f"{name}refs"].__setitem__(f["n"] % 2, place(f)))
            else:
                count, a = (SIZE if way == "idx" else 2), self.rng.randrange(SIZE)
                step(f"{name}{way} := TO_INT((n + {a}) MOD {count});",
                     lambda f, way=way, count=count, a=a: self.globals.__setitem__(f"{name}{way}", (f["n"] + a) % count))
        return lines, steps

    def mover(self, name, track):
        """A function that leads a track elsewhere and gives the value that it was given"""
        rng, kind = self.rng, track.kind
        n, v = Parameter("n", ELEMENTARY["UINT"], 0, True), Parameter("v", kind, kind.default(), True)
        outputs = [Parameter("o", kind)] if rng.random() < 0.4 else []
        in_outs = [Parameter("io", kind)] if rng.random() < 0.4 else []
        pou = Pou(name, kind, [n, v] if rng.random() < 0.5 else [v, n], outputs, in_outs)
        pou.budget = self.budget
        lines, steps = self.leading(track)
        if rng.random() < 0.5 or in_outs:
            more, others = self.lead_cells("n")
            lines, steps = lines + more, [*steps, others]
        before, after = [], []
        if outputs:
            before.append((f"  o := {track.name}ref;", lambda f: f.__setitem__("o", kind.copy(self.globals[f"{track.name}ref"].get()))))
        if in_outs:
            after.append(("  io := v;", lambda f: f["io"].set(kind.copy(f["v"]))))
        after.append((f"  {name} := v;", lambda f: f.__setitem__(name, kind.copy(f["v"]))))

        def body(f):
            for _, run in before:
                run(f)
            for run in steps:
                run(f)
            for _, run in after:
                run(f)

        pou.body = body
        self.text += [f"FUNCTION {name} : {kind.name}", "VAR_INPUT", *(f"  {p.name} : {p.kind.name};" for p in pou.inputs), "END_VAR"]
        for word, parameters in (("VAR_OUTPUT", outputs), ("VAR_IN_OUT", in_outs)):
            if parameters:
                self.text += [word, *(f"  {p.name} : {p.kind.name};" for p in parameters), "END_VAR"]
        self.text += [*(t for t, _ in before), *lines, *(t for t, _ in after), "END_FUNCTION"]
        self.functions.append(pou)
        self.moving.add(pou)

    # Instances behind an interface, a reference, a pointer, an index

    def lead_cells(self, n):
        lines = [f"  slot := cells[({n} + 1) MOD 3]; cellref REF= cells[({n} + 2) MOD 3]; cellptr := ADR(cells[({n} + 1) MOD 3]);",
                 f"  cellidx := TO_INT({n} MOD 3);"]

        def run(f):
            value, cells = f["n"], self.globals["cells"]
            self.globals |= {"slot": cells[(value + 1) % 3], "cellref": Ref(cells, (value + 2) % 3),
                             "cellptr": Ref(cells, (value + 1) % 3), "cellidx": value % 3}

        return lines, run

    def make_cells(self):
        kind = self.plain()
        k, unsigned = kind.name, ELEMENTARY["UINT"]
        cell = Pou("Cell", None, [Parameter("n", unsigned, 0), Parameter("a", kind, kind.default())],
                   [Parameter("o", kind), Parameter("c", unsigned)], [])
        cell.budget = self.budget
        cell.locals.append(("v", kind, kind.default()))
        lead, run = self.lead_cells("n")

        def body(f):
            f["o"], f["v"], f["c"] = f["v"], f["a"], (f["c"] + 1) & 0xFFFF
            run(f)

        def go(f):
            f["Go"], f["this"]["v"] = f["this"]["v"], f["a"]
            run(f)

        def put(f):
            f["this"]["v"], f["this"]["c"] = f["Val"], (f["this"]["c"] + 1) & 0xFFFF

        cell.body = body
        inputs = [Parameter("n", unsigned, 0, True), Parameter("a", kind, kind.default(), True)]
        for key, name, result, inputs, action in (
                ("Go", "Go", kind, inputs, go), ("Val.get", "Val", kind, [], lambda f: f.__setitem__("Val", f["this"]["v"])),
                ("Val.set", "Val", None, [Parameter("Val", kind, kind.default(), True)], put)):
            cell.methods[key] = self.ranked(Pou(name, result, inputs, [], []), key, 0)
            cell.methods[key].body = action
        self.moving.add(cell.methods["Go"])
        head = [f"METHOD Go : {k}", f"VAR_INPUT n : UINT; a : {k}; END_VAR"]
        self.text += ["INTERFACE Storing", *head, "END_METHOD", f"PROPERTY Val : {k} GET END_GET SET END_SET END_PROPERTY", "END_INTERFACE",
                      "FUNCTION_BLOCK Cell IMPLEMENTS Storing", f"VAR_INPUT n : UINT; a : {k}; END_VAR", f"VAR_OUTPUT o : {k}; c : UINT; END_VAR",
                      f"VAR v : {k}; END_VAR", "  o := v; v := a; c := c + 1;", *lead,
                      *head, "  Go := v; v := a;", *lead, "END_METHOD",
                      f"PROPERTY Val : {k}", "GET Val := v; END_GET", "SET v := Val; c := c + 1; END_SET", "END_PROPERTY", "END_FUNCTION_BLOCK",
                      "VAR_GLOBAL", "  cells : ARRAY[0..2] OF Cell;", "  slot : Storing;", "  cellref : REFERENCE TO Cell;",
                      "  cellptr : POINTER TO Cell;", "  cellidx : INT;", "END_VAR"]
        self.globals["cells"] = [cell.new() for _ in range(3)]
        self.led += [("cells", BlockArray(cell, 0, 3)), ("cellidx", ELEMENTARY["INT"])]
        places = {"slot": self.global_place("slot"), "cellref": lambda f: self.globals["cellref"],
                  "cellptr^": lambda f: self.globals["cellptr"],
                  "cells[cellidx]": lambda f: Ref(self.globals["cells"], self.globals["cellidx"])}
        for text, place in places.items():
            self.movable_objects.append(Owner(text, place, list(cell.methods.values())))
            if text != "slot":
                self.movable_instances.append(Instance(text, cell, place))
                self.movable.append(Variable(f"{text}.o", kind, self.member(place, "o"), writable=False, shared=True))
        return cell

    # Statements

    def rather_movable(self, variables):
        """Those of the variables that can be led elsewhere, mostly, where there are some"""
        movable = [v for v in variables if v in self.movable]
        return movable if movable and self.rng.random() < 0.4 else variables

    def rebinding(self):
        """A reference or pointer is led elsewhere, by an index that may be moved meanwhile"""
        track = self.rng.choice(self.tracks)
        name, pool = track.name, f"{track.name}pool"
        index, fn = self.index(0, SIZE - 1)
        way = self.rng.choice(["ref", "ptr", "refs"])

        def run(f):
            side = self.globals[f"{name}side"]
            place = Ref(self.globals[pool], fn(f))
            if way == "refs":
                self.globals[f"{name}refs"][side] = place
            else:
                self.globals[f"{name}{way}"] = place

        text = {"ref": f"{name}ref REF= {pool}[{index}];", "ptr": f"{name}ptr := ADR({pool}[{index}]);",
                "refs": f"{name}refs[{name}side] REF= {pool}[{index}];"}[way]
        return [text], run

    def counting_elsewhere(self):
        """FOR with a counter that is found once, before its bounds are computed"""
        track = self.tracks[0]
        counters = [v for v in self.movable if v.kind is track.kind and v.writable]
        v = self.rng.choice(counters)
        first = self.rng.randint(0, 9)
        bound = self.any(ELEMENTARY["USINT"], 2)
        lines, step = self.rebinding()
        kind = track.kind.name

        def run(f):
            ref = v.place(f)
            ref.set(first)
            limit = first + (bound.fn(f) & 3)
            more = True
            while more:
                self.budget.tick()
                step(f)
                i = ref.get()
                more = i < limit
                ref.set(wrap(kind, i + 1))

        return [f"FOR {v.name} := {first} TO TO_{kind}({first} + (TO_INT({bound.text}) AND 3)) DO", *("  " + line for line in lines), "END_FOR"], run
