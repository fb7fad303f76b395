"""Random sequences of what a program does with an axis of a TSX CSY 85, and the project that does it.

A sequence is a list of events (cycle, kind, number, value): the program carries them out, the model in csy_model.py judges what
comes of them. Kinds: see PROGRAM.
"""

CYCLES, CYCLE_S = 900, 0.004
# Bits in a mask of outputs, from bit 0 on.
OUTPUTS = ("ALLOW_ACQUIRE", "CONTROL_ACQUIRE", "ALLOW_ENABLE", "CONTROL_ENABLE", "ALLOW_RESUME", "CONTROL_RESUME", "ALLOW_MOVE",
           "ALLOW_NOT_FASTSTOP", "ALLOW_NOT_FLT", "CONTROL_CLEAR_FLT", "OPERATION_MODE_1", "CONTROL_JOG_POS",
           "CONTROL_JOG_NEG", "CONTROL_INC_POS", "CONTROL_INC_NEG")
INPUTS = ("CH_ERROR", "RAMPING", "STEADY", "STOPPING", "PROFILE_END", "IN_POSITION", "AXIS_HOMING", "HOLDING", "RESUMING",
          "DRIVE_ENABLED", "DRIVE_DIAG", "DRIVE_WARNING", "DRIVE_FLT", "DRIVE_DISABLED", "AXIS_SUMMARY_FLT", "AXIS_COM_OK",
          "AXIS_IS_LINKED", "AXIS_IN_CMD", "AXIS_AT_TARGET", "AXIS_POS_LIMIT", "AXIS_NEG_LIMIT", "BIAS_REMAIN",
          "AXIS_MANUAL_MODE", "DRIVE_REALTIME_BIT1", "DRIVE_REALTIME_BIT2", "AXIS_HOLD", "AXIS_HALT", "AXIS_FASTSTOP",
          "AXIS_READY", "CONF_OK")
# Parameters with the numbers of their registers, and the exchanges.
PARAMETERS = {"FUNCTION_VALIDATION": 35, "ACCEL": 36, "DECEL": 38, "ACCEL_TYPE": 40, "IN_POSITION_BAND": 41, "DECEL_MAX": 51,
              "SPEED_MAX": 53, "POSITION_MAX": 55, "POSITION_MIN": 57, "SCALE_DENOMINATOR": 61, "POSITION_UNIT": 65}
INTEGERS = ("FUNCTION_VALIDATION", "ACCEL_TYPE", "POSITION_UNIT")
EXCHANGES = ("READ_STS", "WRITE_CMD", "READ_PARAM", "WRITE_PARAM", "SAVE_PARAM", "RESTORE_PARAM")
OUT, SET, ASK, ACTION, P1, P3, P4, REMOTE = range(8)
WORDS = ("bits", "given", "before", "after", "report", "error", "returned", "parameter") + tuple(PARAMETERS)
ALLOWED = sum(1 << i for i, name in enumerate(OUTPUTS) if name.startswith("ALLOW"))


class Sequence:
    """Events of one axis"""

    def __init__(self, chance):
        self.chance, self.events, self.now, self.mask = chance, [], 1, 0
        accel = chance.choice([150.0, 200.0, 410.0])
        self.parameters = {
            "FUNCTION_VALIDATION": chance.choice([0, 0, 1, 1]), "ACCEL": accel,
            "DECEL": chance.choice([accel, accel, 120.0, 630.0]), "ACCEL_TYPE": chance.choice([100, 100, 125, 150, 175, 200]),
            "IN_POSITION_BAND": chance.choice([0.0, 0.05, 0.7]), "DECEL_MAX": chance.choice([0.0, 0.0, 900.0]),
            "SPEED_MAX": chance.choice([0.0, 0.0, 45.0]), "POSITION_MAX": 37.5, "POSITION_MIN": -22.25,
            "SCALE_DENOMINATOR": 1.0, "POSITION_UNIT": 11}
        self.manual_speed = chance.choice([7.5, 16.0])
        self.power()
        while self.now < CYCLES - 160:
            chance.choices((self.move, self.stop, self.hold, self.fault, self.power, self.manual, self.adjust, self.query,
                            self.clash), weights=(6, 4, 4, 2, 2, 3, 3, 2, 1))[0]()

    def add(self, kind, number=0, value=0.0):
        self.events.append((self.now, kind, number, value))

    def wait(self, *choices):
        self.now += self.chance.choice(choices)

    def bits(self, **names):
        for name, on in names.items():
            bit = 1 << OUTPUTS.index(name)
            self.mask = self.mask | bit if on else self.mask & ~bit
        self.add(OUT, self.mask)

    def pulse(self, name):
        self.bits(**{name: True})
        self.wait(1, 1, 2, 5)
        self.bits(**{name: False})
        self.wait(1, 2)

    def power(self):
        """Permissions and edges, sometimes in a wrong order or without the permission, and at last rightly"""
        for _ in range(self.chance.choice([0, 1, 2])):
            self.pulse(self.chance.choice(["CONTROL_ACQUIRE", "CONTROL_ENABLE", "CONTROL_CLEAR_FLT", "CONTROL_RESUME"]))
        if self.chance.random() < 0.5 and self.mask:
            self.bits(**{self.chance.choice(["ALLOW_ACQUIRE", "ALLOW_ENABLE"]): False})
            self.wait(1, 3, 40, 100)
        self.mask |= ALLOWED
        self.mask &= ~(1 << OUTPUTS.index("OPERATION_MODE_1"))
        self.add(OUT, self.mask)
        self.wait(1, 3)
        for name in ("CONTROL_ACQUIRE", "CONTROL_CLEAR_FLT", "CONTROL_ENABLE"):
            self.pulse(name)
        self.wait(6, 9)

    def move(self):
        chance = self.chance
        self.add(P1, chance.choice([0] * 9 + [3]))
        self.add(P3, 0, chance.choice([0.0, 12.5, 37.5, -22.25, 55.0, -45.0, chance.randint(-200, 300) / 8]))
        self.add(P4, 0, chance.choice([10.0, 22.5, 40.0, 40.0, 60.0]))
        self.add(ACTION, 513)
        self.add(ASK, 1)
        self.wait(2, 10, 40, 120, 120, 300)

    def stop(self):
        name = self.chance.choice(["ALLOW_MOVE", "ALLOW_NOT_FASTSTOP"])
        self.bits(**{name: False})
        self.wait(1, 10, 90)
        if self.chance.random() < 0.2:
            self.move()
        self.bits(**{name: True})
        self.wait(4, 20)

    def hold(self):
        self.bits(ALLOW_RESUME=False)
        self.wait(1, 12, 100, 100)
        if self.chance.random() < 0.3:
            self.pulse("CONTROL_RESUME")
        self.bits(ALLOW_RESUME=True)
        self.wait(0, 3, 60)
        self.pulse("CONTROL_RESUME")
        self.wait(3, 50, 200)

    def fault(self):
        self.bits(ALLOW_NOT_FLT=False)
        self.wait(1, 30, 90)
        if self.chance.random() < 0.4:
            self.pulse("CONTROL_CLEAR_FLT")
        self.bits(ALLOW_NOT_FLT=True)
        self.wait(3, 5)
        if self.chance.random() < 0.7:
            self.pulse("CONTROL_CLEAR_FLT")
        self.pulse("CONTROL_ENABLE")
        self.wait(6, 9)

    def manual(self):
        chance = self.chance
        self.bits(OPERATION_MODE_1=True)
        self.wait(3, 100, 100)
        for _ in range(chance.randint(1, 3)):
            sign = chance.choice(["POS", "NEG"])
            if chance.random() < 0.5:
                self.bits(**{f"CONTROL_JOG_{sign}": True})
                self.wait(5, 50, 80)
                self.bits(**{f"CONTROL_JOG_{sign}": False})
                self.wait(4, 60)
            else:
                self.add(REMOTE, chance.randint(1, 4))
                self.pulse(f"CONTROL_INC_{sign}")
                self.wait(10, 170, 170)
        self.bits(OPERATION_MODE_1=False)
        self.wait(5, 60)
        if chance.random() < 0.3:
            self.pulse("CONTROL_INC_POS")

    def adjust(self):
        """Parameters, mostly at rest, right ones and wrong ones"""
        chance = self.chance
        if chance.random() < 0.8:
            self.bits(ALLOW_MOVE=False)
            self.wait(120)
            self.bits(ALLOW_MOVE=True)
        name, value = chance.choice([
            ("ACCEL", 260.0), ("DECEL", 310.0), ("ACCEL_TYPE", 150), ("ACCEL_TYPE", 200), ("IN_POSITION_BAND", 0.3),
            ("SPEED_MAX", 33.0), ("DECEL_MAX", 700.0), ("FUNCTION_VALIDATION", 0), ("ACCEL_TYPE", 99), ("ACCEL_TYPE", 201),
            ("SCALE_DENOMINATOR", 0.0), ("POSITION_UNIT", 99), ("ACCEL", -5.0), ("DECEL", -5.0)])
        self.add(SET, PARAMETERS[name], value)
        self.add(ASK, chance.choice([3, 3, 3, 2]))
        self.wait(2, 3)
        for exchange in chance.sample([2, 4, 5], chance.randint(0, 3)):
            self.add(ASK, exchange)
            self.wait(1, 2)
        self.add(ASK, 2)
        self.wait(2, 4)

    def query(self):
        self.add(ACTION, self.chance.choice([523, 523, 1, 512, 514, 9999, -7]))
        self.add(ASK, 1)
        self.wait(1, 2, 4)

    def clash(self):
        """Two exchanges in one cycle"""
        self.add(ACTION, 523)
        self.add(ASK, 1)
        self.add(ASK, self.chance.choice([0, 1, 2]))
        self.wait(1, 3)


def driver():
    """The function block that carries the events out, and records"""
    out = ["FUNCTION_BLOCK Driver", "VAR_IN_OUT ch : T_CSY_IND; END_VAR", "VAR_INPUT at, last : DINT; cycle : DINT; END_VAR",
           "VAR bits, given : DWORD; before, after, report, error, parameter : INT; returned : DINT; position : REAL;",
           "  m : DWORD; n : DINT; v : REAL; ok : BOOL; i : DINT := -1;"]
    out += [f"  {name} : {'INT' if name in INTEGERS else 'REAL'};" for name in PARAMETERS]
    out += ["END_VAR", "IF i < 0 THEN i := at; END_IF", "bits := 0; given := 0;"]
    out += [f"IF ch.{name} THEN bits := bits OR {1 << i}; END_IF" for i, name in enumerate(INPUTS)]
    out += ["before := ch.EXCH_STS; report := ch.EXCH_RPT; error := ch.ERROR_CMD; returned := ch.RETURN_CMD_1;",
            "parameter := ch.PARAM_RPT; position := ch.POSITION;"]
    out += [f"{name} := ch.{name};" for name in PARAMETERS]
    out += ["WHILE i < last AND_THEN when[i] <= cycle DO", "n := number[i]; v := value[i];", "CASE kind[i] OF",
            f"{OUT}: m := DINT_TO_DWORD(n);"]
    out += [f"  ch.{name} := m.{i};" for i, name in enumerate(OUTPUTS)]
    out += [f"{SET}: CASE n OF"]
    out += [f"  {register}: ch.{name} := {'REAL_TO_INT(v)' if name in INTEGERS else 'v'};"
            for name, register in PARAMETERS.items()]
    out += ["  END_CASE", f"{ASK}: CASE n OF"]
    out += [f"  {i}: ok := {name}(ch);" for i, name in enumerate(EXCHANGES)]
    out += ["  END_CASE", "  given := given * 4 + 2; IF ok THEN given := given + 1; END_IF",
            f"{ACTION}: ch.ACTION_CMD := DINT_TO_INT(n);", f"{P1}: ch.PARAM_CMD_1 := n;", f"{P3}: ch.PARAM_CMD_3 := v;",
            f"{P4}: ch.PARAM_CMD_4 := v;", f"{REMOTE}: ch.REMOTE_POSITION := n;", "END_CASE", "i := i + 1;", "END_WHILE",
            "after := ch.EXCH_STS;", "END_FUNCTION_BLOCK"]
    return out


def table(name, kind, values):
    lines, values = [], [str(one) for one in values]
    for first in range(0, len(values), 24):
        lines.append("    " + ", ".join(values[first:first + 24]))
    return [f"  {name} : ARRAY[0..{len(values) - 1}] OF {kind} := [", ",\n".join(lines), "  ];"]


def program(sequences):
    events = [event for one in sequences for event in one.events]
    out = ["VAR_GLOBAL CONSTANT"]
    for place, (name, kind) in enumerate((("when", "DINT"), ("kind", "INT"), ("number", "DINT"), ("value", "REAL"))):
        out += table(name, kind, [float(event[3]) if place == 3 else event[place] for event in events])
    out += ["END_VAR"] + driver() + ["PROGRAM PLC_PRG", "VAR", "  cycle : DINT;"]
    for i in range(len(sequences)):
        out += [f"  ch{i} AT %CH0.{i // 4}.{9 + i % 4} : T_CSY_IND;", f"  d{i} : Driver;"]
    out.append("END_VAR")
    first = 0
    for i, one in enumerate(sequences):
        out.append(f"d{i}(ch := ch{i}, at := {first}, last := {first + len(one.events)}, cycle := cycle);")
        first += len(one.events)
    return out + ["cycle := cycle + 1;", "END_PROGRAM"]


def project(sequences):
    out = ['[project]', 'name = "CsyStates"', '[[task]]', 'name = "Motion"', 'interval = "T#4ms"', 'programs = ["PLC_PRG"]']
    for i in range(len(sequences)):
        out += ['[[axis]]', f'name = "X{i}"', 'kind = "virtual"']
    for i, one in enumerate(sequences):
        if i % 4 == 0:
            out += ['[[csy]]', 'rack = 0', f'slot = {i // 4}']
        out += ['[[csy.axis]]', f'channel = {9 + i % 4}', f'axis = "X{i}"', f'manual_speed = {one.manual_speed}',
                '[csy.axis.parameters]']
        for name, value in one.parameters.items():
            if name == "FUNCTION_VALIDATION":
                out.append(f"position_check = {'true' if value & 1 else 'false'}")
            elif name != "POSITION_UNIT":
                out.append(f"{name} = {value}")
    return out


def write(folder, sequences):
    """Writes the project; gives the names to trace"""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "stride.toml").write_text("\n".join(project(sequences)) + "\n", encoding="utf-8")
    (folder / "PLC_PRG.st").write_text("\n".join(program(sequences)) + "\n", encoding="utf-8")
    return [name for i in range(len(sequences)) for name in
            [f"PLC_PRG.d{i}.{word}" for word in WORDS + ("position",)] + [f"X{i}.fSetPosition"]]
