"""Random projects with moving axes, whose text can be edited at random without a change of what the axes do.

Each axis has a mover, a function block that commands it with random numbers of its own, and that keeps the largest steps of
its set values. All of it counts in cycles: the course of an axis is a function of the project and the cycle alone.
"""
import dataclasses

KINDS = ("absolute", "relative", "velocity", "rotary", "gear", "stopping")
PERIOD = 360.0


@dataclasses.dataclass
class Axis:
    name: str
    kind: str
    velocity: float
    acceleration: float
    reach: float
    seed: int
    master: str = ""
    ratio: tuple = (1, 1)
    ramp: str = "trapezoid"
    physics: str = ""

    @property
    def rotary(self):
        return self.kind in ("rotary", "velocity")


@dataclasses.dataclass
class Kept:
    """A global variable that the program never writes: its value must survive what changes around it."""
    name: str
    kind: str
    literal: str
    renamed_from: str = ""


# Values as `read` with literals shows them, by type
LITERALS = {
    "INT": lambda rng: str(rng.randint(-32768, 32767)),
    "DINT": lambda rng: str(rng.randint(-2**31, 2**31 - 1)),
    "UDINT": lambda rng: str(rng.randint(0, 2**32 - 1)),
    "LINT": lambda rng: str(rng.randint(-2**63, 2**63 - 1)),
    "BOOL": lambda rng: rng.choice(["TRUE", "FALSE"]),
    "STRING(30)": lambda rng: "'" + "".join(rng.choice("abcxyz 0189_") for _ in range(rng.randint(0, 30))) + "'",
}
WIDER = {"INT": "DINT", "DINT": "LINT", "STRING(30)": "STRING(40)", "STRING(40)": "STRING(60)"}
PLAIN = ("BOOL", "INT", "DINT", "LREAL", "REAL", "STRING(20)", "TIME", "ARRAY[0..9] OF INT", "ARRAY[-3..3] OF LREAL", "TON", "Pair", "Extra")

MOVER = """FUNCTION_BLOCK {name}
VAR_INPUT
  state : DWORD;
  velocity, acceleration, reach : LREAL;
END_VAR
VAR_IN_OUT
  Axis : AXIS_REF;{master_pin}
END_VAR
VAR_OUTPUT
  moves, errors : UDINT;
  maxStep, maxVelocity, maxChange : LREAL;
END_VAR
VAR
  power : MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
{blocks}
  second, running : BOOL;
  wait : DINT;
  lastPosition, lastVelocity, step, r : LREAL;{variables}
END_VAR

{comments}power(Axis := Axis);
IF power.Status THEN
  wait := wait - 1;
  IF wait <= 0 THEN
    second := NOT second;
    moves := moves + 1;
    state := state * 1664525 + 1013904223;
    wait := 20 + DWORD_TO_DINT(SHR(state, 8) MOD {pause});
    state := state * 1664525 + 1013904223;
    r := DWORD_TO_LREAL(SHR(state, 8)) / 16777216;
{choose}  END_IF
END_IF
{calls}IF running THEN
  step := Axis.fSetPosition - lastPosition;{wrap}
  maxStep := MAX(maxStep, ABS(step));
  maxVelocity := MAX(maxVelocity, ABS(Axis.fSetVelocity));
  maxChange := MAX(maxChange, ABS(Axis.fSetVelocity - lastVelocity));
END_IF
running := power.Status;
lastPosition := Axis.fSetPosition;
lastVelocity := Axis.fSetVelocity;
{statements}END_FUNCTION_BLOCK
"""
WRAP = """
  IF step > {half} THEN step := step - {period}; ELSIF step < -{half} THEN step := step + {period}; END_IF"""

# Per kind: the type of the two blocks, what they get before an edge
BLOCKS = {
    "absolute": ("MC_MoveAbsolute", "MC_MoveAbsolute", "Position := (2 * r - 1) * reach, "),
    "relative": ("MC_MoveRelative", "MC_MoveRelative", "Distance := (2 * r - 1) * reach, "),
    "velocity": ("MC_MoveVelocity", "MC_MoveVelocity", ""),
    "rotary": ("MC_MoveAbsolute", "MC_MoveAbsolute", "Position := r * 360, "),
    "stopping": ("MC_MoveRelative", "MC_Halt", "Distance := (2 * r - 1) * reach, "),
}


def mover_parts(kind):
    """The parts of the mover's text that depend on the kind"""
    if kind == "gear":
        return {
            "master_pin": "\n  Master : AXIS_REF;",
            "blocks": "  gear : MC_GearIn;\n  halt : MC_Halt;\n  numerator : DINT := 1;\n  denominator : UDINT := 1;",
            "choose": "",
            "calls": "gear(Execute := power.Status AND second, RatioNumerator := numerator, RatioDenominator := denominator,\n"
                     "     Acceleration := acceleration, Deceleration := acceleration, Master := Master, Slave := Axis);\n"
                     "halt(Execute := power.Status AND NOT second AND moves > 1, Deceleration := acceleration, Axis := Axis);\n"
                     "IF gear.Error OR halt.Error THEN errors := errors + 1; END_IF\n",
        }
    first, second, target = BLOCKS[kind]
    choose = ""
    if kind == "velocity":
        choose = ("    IF r > 0.5 THEN one.Direction := positive; two.Direction := negative;\n"
                  "    ELSE one.Direction := negative; two.Direction := positive; END_IF\n")
    speed = "Velocity := (0.1 + 0.9 * r) * velocity, Acceleration := acceleration, Deceleration := acceleration, "
    halt = "Deceleration := acceleration, "
    if kind == "rotary":
        choose = "    IF r > 0.5 THEN one.Direction := positive; ELSE one.Direction := shortest; END_IF\n"
    return {
        "master_pin": "",
        "blocks": f"  one : {first};\n  two : {second};",
        "choose": choose,
        "calls": f"one(Execute := power.Status AND second, {target}{speed}Axis := Axis);\n"
                 f"two(Execute := power.Status AND NOT second AND moves > 1, {halt if second == 'MC_Halt' else target + speed}Axis := Axis);\n"
                 "IF one.Error OR two.Error THEN errors := errors + 1; END_IF\n",
    }


class MotionProject:
    """`text()` is what `write` writes; `edit` changes it. `version` is a constant in the program, the number of edits."""

    def __init__(self, rng, axes=None, interval_ms=None, extra=""):
        self.rng, self.extra, self.version = rng, extra, 0
        self.interval_ms = interval_ms or rng.choice([1, 2, 4, 5, 10])
        self.axes = []
        for i in range(axes or rng.randint(1, 6)):
            self.axes.append(self.some_axis(i))
        self.kept = [Kept(f"kept{i}", kind, LITERALS[kind](rng)) for i in range(rng.randint(2, 8)) for kind in [rng.choice(list(LITERALS))]]
        self.extras, self.globals, self.statements, self.comments = {}, [], [], {}
        self.blocks = ["FUNCTION_BLOCK Extra\nVAR n : DINT; END_VAR\nn := n + 1;\nEND_FUNCTION_BLOCK\n"]
        self.count = 0

    def some_axis(self, i):
        rng = self.rng
        linear = [a for a in self.axes if not a.rotary and a.kind != "gear"]
        kind = rng.choice([k for k in KINDS if k != "gear" or linear])
        axis = Axis(f"X{i}", kind, rng.choice([10.0, 100.0, 333.0]), rng.choice([50.0, 1000.0, 5000.0]), rng.choice([1.0, 50.0, 1000.0]), rng.getrandbits(32))
        if kind == "gear":
            master = rng.choice(linear)
            axis.master, axis.ratio = master.name, (rng.choice([-3, -1, 1, 2, 5]), rng.choice([1, 2, 3]))
            axis.velocity, axis.acceleration = master.velocity, master.acceleration * 2
        axis.physics = rng.choice(["", "", 'model = "lag"\n      time_constant = "T#20ms"', "dead_time = 2"])
        return axis

    # What is known of the set values

    def bounds(self, axis):
        """The largest velocity and acceleration that the set values of an axis may have"""
        if axis.kind != "gear":
            return axis.velocity, axis.acceleration
        ratio = abs(axis.ratio[0] / axis.ratio[1])
        return axis.velocity * ratio, axis.acceleration + 2 * ratio * axis.acceleration

    def limits(self, axis):
        """The largest steps of position and velocity within one cycle"""
        velocity, acceleration = self.bounds(axis)
        dt = self.interval_ms / 1000
        return velocity * dt * (1 + 1e-9) + 1e-6, acceleration * dt * (1 + 1e-9) + 1e-6

    def columns(self):
        return ["GVL.cycles", *(f"{a.name}.{v}" for a in self.axes for v in ("fSetPosition", "fSetVelocity"))]

    # Edits that leave the axes alone

    def edit(self, both_ways=False):
        """One random edit; what it was. `both_ways`: also the change back keeps all values."""
        self.version += 1
        edits = [self.add_variable, self.add_variable, self.remove_variable, self.add_statement, self.add_comment, self.add_global, self.remove_global,
                 self.shuffle, self.add_block]
        return self.rng.choice(edits if both_ways else [*edits, self.widen, self.rename])()

    def fresh(self, prefix):
        self.count += 1
        return f"{prefix}{self.count}"

    def owners(self):
        return ["PLC_PRG", *sorted({a.kind for a in self.axes})]

    def add_variable(self):
        owner, name, kind = self.rng.choice(self.owners()), self.fresh("v"), self.rng.choice(PLAIN)
        self.extras.setdefault(owner, []).append((name, kind))
        return f"add {name} : {kind} to {owner}"

    def remove_variable(self):
        owners = [o for o, v in self.extras.items() if v]
        if not owners:
            return self.add_variable()
        owner = self.rng.choice(owners)
        name, _ = self.extras[owner].pop(self.rng.randrange(len(self.extras[owner])))
        self.statements = [s for s in self.statements if s[1] != name]
        return f"remove {name} from {owner}"

    def add_statement(self):
        places = [(o, n, k) for o, v in self.extras.items() for n, k in v if k in ("INT", "DINT", "LREAL", "REAL", "Extra", "TON")]
        if not places:
            return self.add_variable()
        owner, name, kind = self.rng.choice(places)
        call = {"Extra": f"{name}();", "TON": f"{name}(IN := NOT {name}.Q, PT := T#{self.rng.randint(1, 500)}ms);"}
        self.statements.append((owner, name, call.get(kind, f"{name} := {name} + {self.rng.randint(1, 9)};")))
        return f"add {self.statements[-1][2]} to {owner}"

    def add_comment(self):
        owner = self.rng.choice(self.owners())
        self.comments[owner] = self.comments.get(owner, 0) + self.rng.randint(1, 5)
        return f"add comments to {owner}"

    def add_global(self):
        self.globals.append((self.fresh("g"), self.rng.choice(PLAIN)))
        return f"add {self.globals[-1][0]}"

    def remove_global(self):
        if not self.globals:
            return self.add_global()
        return f"remove {self.globals.pop(self.rng.randrange(len(self.globals)))[0]}"

    def shuffle(self):
        self.rng.shuffle(self.kept)
        self.rng.shuffle(self.globals)
        for variables in self.extras.values():
            self.rng.shuffle(variables)
        return "shuffle"

    def widen(self):
        fit = [k for k in self.kept if k.kind in WIDER]
        if not fit:
            return self.add_global()
        kept = self.rng.choice(fit)
        kept.kind = WIDER[kept.kind]
        return f"widen {kept.name} to {kept.kind}"

    def rename(self):
        kept = self.rng.choice(self.kept)
        kept.renamed_from = kept.renamed_from or kept.name  # as the running build knows it
        kept.name = self.fresh("renamed")
        return f"rename {kept.renamed_from} to {kept.name}"

    def add_block(self):
        name = self.fresh("Block")
        self.blocks.append(f"FUNCTION_BLOCK {name}\nVAR_INPUT a : LREAL; END_VAR\nVAR n : DINT; t : TON; END_VAR\nn := n + 1;\nt(IN := n > 5, PT := T#1s);\nEND_FUNCTION_BLOCK\n")
        self.globals.append((self.fresh("g"), name))
        return f"add {name}"

    def settled(self):
        """After a change has been carried: a name that was is no longer known to the running build"""
        for kept in self.kept:
            kept.renamed_from = ""

    # The text

    def declarations(self, owner):
        return "".join(f"\n  {name} : {kind};" for name, kind in self.extras.get(owner, []))

    def body(self, owner):
        return "".join(f"{text}\n" for o, _, text in self.statements if o == owner)

    def mover(self, kind):
        longest = max(200, 2000 // self.interval_ms)
        wrap = WRAP.format(half=PERIOD / 2, period=PERIOD) if kind in ("rotary", "velocity") else ""
        return MOVER.format(name=f"Mover_{kind}", pause=longest, wrap=wrap, variables=self.declarations(kind), statements=self.body(kind),
                            comments="// nothing\n" * self.comments.get(kind, 0), **mover_parts(kind))

    def program(self):
        lines = ["TYPE Pair : STRUCT a, b : LREAL; c : STRING(10); END_STRUCT END_TYPE", *self.blocks, "PROGRAM PLC_PRG", "VAR"]
        for axis in self.axes:
            ratio = f", numerator := {axis.ratio[0]}, denominator := {axis.ratio[1]}" if axis.kind == "gear" else ""
            lines.append(f"  m{axis.name} : Mover_{axis.kind} := (state := {axis.seed}, velocity := {axis.velocity}, "
                         f"acceleration := {axis.acceleration}, reach := {axis.reach}{ratio});")
        lines += [self.declarations("PLC_PRG").lstrip("\n"), "END_VAR", "// nothing\n" * self.comments.get("PLC_PRG", 0), "GVL.cycles := GVL.cycles + 1;",
                  "GVL.triple := GVL.cycles * 3;"]
        for axis in self.axes:
            lines.append(f"m{axis.name}(Axis := {axis.name}{', Master := ' + axis.master if axis.master else ''});")
        return "\n".join([*lines, self.body("PLC_PRG"), "END_PROGRAM", ""])

    def variables(self):
        lines = ["VAR_GLOBAL", "  cycles, triple : LINT;"]
        for kept in self.kept:
            if kept.renamed_from:
                lines.append(f"  {{attribute 'renamed_from' := '{kept.renamed_from}'}}")
            lines.append(f"  {kept.name} : {kept.kind};")
        lines += [f"  {name} : {kind};" for name, kind in self.globals]
        lines += ["END_VAR", "VAR_GLOBAL CONSTANT", f"  version : UDINT := {self.version};", "END_VAR", ""]
        return "\n".join(lines)

    def manifest(self, name="Soak", more=""):
        text = [f'[project]\nname = "{name}"\n\n[[task]]\nname = "Bus"\ninterval = "T#{self.interval_ms}ms"\npriority = 1\nprograms = ["PLC_PRG"]\n{more}\n'
                '[[bus]]\nname = "Bus"\nInterfaceType = "Dummy (simulated drives)"\n\n  [[bus.axis_group]]\n  name = "Group"\n  sTask = "Bus"\n']
        for i, axis in enumerate(self.axes):
            kind = f'iMovementType = "rotary"\n    fPositionPeriod = {PERIOD}' if axis.rotary else 'iMovementType = "linear"'
            text.append(f'\n    [[bus.axis_group.drive]]\n    name = "{axis.name}"\n    wDriveId = {i + 1}\n    {kind}\n    dwRatioTechUnitsDenom = 1000\n')
            if axis.physics:
                text.append(f"\n      [bus.axis_group.drive.physics]\n      {axis.physics}\n")
        return "".join(text)

    def files(self, more=""):
        """Names and texts"""
        made = {"stride.toml": self.manifest(more=more), "PLC_PRG.st": self.program(), "GVL.st": self.variables()}
        for kind in sorted({a.kind for a in self.axes}):
            made[f"Mover_{kind}.st"] = self.mover(kind)
        if self.extra:
            made["Other.st"] = self.extra
        return made

    def write(self, folder, more=""):
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in self.files(more).items():
            place = folder / name
            if not place.exists() or place.read_text(encoding="utf-8") != text:
                place.write_text(text, encoding="utf-8")
        return folder
