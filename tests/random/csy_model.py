"""What the manual and docs/csy.md say that an axis of a TSX CSY 85 does, as expectations of each cycle.

A bit is expected TRUE, FALSE or, where the specification leaves it open, either. What the module may answer in two ways (accept
a command or not, keep the power during a fault or not) is read off the trace, and what follows from it is judged.

Readings that are accepted, because neither manual nor docs/csy.md decides:
- AXIS_IN_CMD and DRIVE_ENABLED may stay until the axis is at rest, when their permission goes away.
- A fault, and the loss of AXIS_IN_CMD, may take the power away or not.
- CONTROL_CLEAR_FLT and ALLOW_NOT_FLT may need AXIS_IN_CMD or not; CONTROL_ENABLE during a fault may act or not.
- AXIS_READY during a stop, in hold and in manual mode.
- 513 beyond a limit, faster than SPEED_MAX, in hold, during a halt and in manual mode: an error, or bounded motion.
- AXIS_HALT and AXIS_FASTSTOP after the permission is back, until the next move.
- IN_POSITION while moving: around the set position or around the target.
- RAMPING while STOPPING; STOPPING from the stop's beginning, while the jerk still lets the axis gain speed.
- CH_ERROR after a refused command or parameter (APPLI_FLT), until the next good one.
- Power that goes away in motion: the axis is at rest at once, or by a ramp.
- A move of 513 goes on in manual mode or not, and lets jogs and increments take over or not; what took over is not RESUMING.
- A move keeps the parameters with which it began, or not; so does the stop of it.
- An increment or jog goes on when manual mode ends, or stops; hold keeps it for CONTROL_RESUME, or ends it.
- Beyond a limit, after the fault is cleared, AXIS_POS_LIMIT and AXIS_NEG_LIMIT are TRUE or not; a jog outwards stops at once.
- PROFILE_END in manual mode. Input bits one cycle after the set position, or with it.
"""
import struct

from csy_motion import Motion
from csy_sequences import (ACTION, ASK, CYCLE_S, INPUTS, INTEGERS, OUT, OUTPUTS, P1, P3, P4, PARAMETERS, REMOTE, SET)

POWER_CYCLES = 6  # in which a drive is switched
ADJUST = (2, 3, 4, 5)


def single(value):
    return struct.unpack("f", struct.pack("f", value))[0]


def wrong_parameter(values):
    """The first register that no reading allows, or None"""
    for name, register in PARAMETERS.items():
        value = values[name]
        if (name in ("ACCEL", "DECEL") and value <= 0 or name == "SCALE_DENOMINATOR" and value == 0
                or name == "ACCEL_TYPE" and not 100 <= value <= 200 or name == "POSITION_UNIT" and not 0 <= value < 40):
            return register
    return None


class Judge(Motion):
    """Walks over the rows of an axis; `found` are the differences (cycle, what, expected, got)"""

    def __init__(self, sequence, channel, rows):
        self.sequence, self.channel, self.rows, self.found = sequence, channel, rows, []
        self.out = dict.fromkeys(OUTPUTS, False)
        self.module, self.saved = dict(sequence.parameters), dict(sequence.parameters)
        self.words = dict(sequence.parameters)
        self.asked = {ACTION: 0, P1: 0, P3: 0.0, P4: 0.0, REMOTE: 0}
        self.pending = []  # exchanges of the last cycle: (number, taken)
        self.acquired, self.fault = False, True
        self.edge_enable = -10**6
        self.since = dict.fromkeys(OUTPUTS, 0)  # cycle of the last change
        self.move = None  # dict: target, speed, start, begin, clean
        self.held = self.resumed = self.manual_held = self.jog_began_able = self.edge_ok = False
        self.manual_resumed = 0  # the cycle
        self.late_refusal = -1  # the cycle of a command that was accepted, and yet a fault
        self.top = 0.0  # greatest speed that was allowed since the axis was last at rest
        self.quiet = 0  # cycles at rest
        self.falls = False  # an acceleration after the axis has turned around
        self.rates = [0.0] * 3  # greatest ACCEL, DECEL and DECEL_MAX at their peaks since it was last at rest
        self.last_stop = -10**6
        self.inc, self.checked, self.outside = None, False, 0.0
        self.cause = 0  # the last cycle with a cause to move
        position = [row["set"] for row in rows]
        self.p = position
        self.v = [0.0] + [(b - a) / CYCLE_S for a, b in zip(position, position[1:])]
        self.a = [0.0] + [(b - a) / CYCLE_S for a, b in zip(self.v, self.v[1:])]

    def say(self, cycle, what, expected, got):
        self.found.append((cycle, what, expected, got))

    def bit(self, cycle, name, expected):
        got = self.rows[cycle]["bits"] >> INPUTS.index(name) & 1
        if expected is not None and got != expected:
            self.say(cycle, name, bool(expected), bool(got))
        return bool(got)

    def seen(self, cycle, name):
        return bool(self.rows[cycle]["bits"] >> INPUTS.index(name) & 1)

    def run(self):
        events = list(self.sequence.events)
        for cycle in range(len(self.rows)):
            self.step(cycle)
            self.asks = []
            while events and events[0][0] <= cycle:
                self.carry_out(cycle, *events.pop(0)[1:])
            self.exchange(cycle)
        return self.found

    # ------------------------------------------------------------------------------------------
    # what the program does

    def carry_out(self, cycle, kind, number, value):
        if kind == OUT:
            self.new_out = {name: bool(number >> i & 1) for i, name in enumerate(OUTPUTS)}
        elif kind == SET:
            name = next(one for one, register in PARAMETERS.items() if register == number)
            self.words[name] = int(value) if name in INTEGERS else value
        elif kind == ASK:
            self.asks.append(number)
        elif kind in (P3, P4):
            self.asked[kind] = single(value)
        else:
            self.asked[kind] = number

    def exchange(self, cycle):
        """The calls of this cycle: the first one is taken, others find it in progress"""
        given, taken = 0, None
        for number in self.asks:
            given = given * 4 + 2 + (taken is None)
            taken = number if taken is None else taken
        row = self.rows[cycle]
        if row["given"] != given:
            self.say(cycle, "results of exchanges", given, row["given"])
        expected = 0 if taken is None else 1 << {0: 0, 1: 1}.get(taken, 2)
        if row["after"] != expected:
            self.say(cycle, "EXCH_STS after the call", expected, row["after"])
        self.pending = [] if taken is None else [(taken, dict(self.asked), dict(self.words))]

    def answers(self, cycle):
        """Results of the exchange of the last cycle"""
        row = self.rows[cycle]
        if row["before"]:
            self.say(cycle, "EXCH_STS a cycle later", 0, row["before"])
        for number, asked, words in self.pending:
            if number == 1:
                self.command(cycle, row, asked)
            elif number == 0 and row["report"] & 1:
                self.say(cycle, "STS_ERR", 0, 1)
            elif number in ADJUST:
                self.parameters(cycle, row, number, words)

    def parameters(self, cycle, row, number, words):
        wrong = wrong_parameter(words) if number == 3 else None
        failed = row["report"] >> 2 & 1
        if failed != (wrong is not None):
            self.say(cycle, f"ADJ_ERR of exchange {number}", wrong is not None, failed)
        report = row["parameter"] & 0xffff
        if wrong is None and report or wrong is not None and (report >> 8 != wrong or not report & 255):
            self.say(cycle, "PARAM_RPT", f"{wrong or 0} in its high byte", f"{report:#06x}")
        if number == 3 and not failed:
            self.module = dict(words)
        elif number == 4:
            self.saved = dict(self.module)
        elif number == 5:
            self.module = dict(self.saved)
        elif number == 2:
            self.words = dict(self.module)
        for name in PARAMETERS:
            got, possible = row[name], [single(self.words[name])]
            if number == 5:
                possible.append(single(self.module[name]))  # the words follow, or wait for READ_PARAM
            if all(abs(got - one) > 1e-6 * max(1, abs(one)) for one in possible):
                self.say(cycle, f"word {name} after exchange {number}", possible, got)
            self.words[name] = int(got) if name in INTEGERS else got

    def command(self, cycle, row, asked):
        error, failed, action = row["error"], row["report"] >> 1 & 1, asked[ACTION]
        if failed != (error != 0):
            self.say(cycle, "CMD_ERR against ERROR_CMD", error != 0, failed)
        if action == 523:
            if error or row["returned"] != 100 + self.channel:
                self.say(cycle, "GetAxisID", 100 + self.channel, (error, row["returned"]))
        elif action != 513:
            if error != 9015:
                self.say(cycle, "ERROR_CMD of an unknown action", 9015, error)
        else:
            self.ask_move(cycle, error, asked)

    def ask_move(self, cycle, error, asked):
        limits, out = self.module, self.out
        must_fail = (asked[P1] != 0 or not self.acquired or self.fault is True or not self.seen(cycle - 1, "DRIVE_ENABLED")
                     and not self.seen(cycle, "DRIVE_ENABLED"))
        outside = limits["FUNCTION_VALIDATION"] & 1 and not limits["POSITION_MIN"] <= asked[P3] <= limits["POSITION_MAX"]
        fast = 0 < limits["SPEED_MAX"] < asked[P4]
        stopped = not (out["ALLOW_MOVE"] and out["ALLOW_NOT_FASTSTOP"] and out["ALLOW_RESUME"])
        manual = out["OPERATION_MODE_1"] or self.seen(cycle, "AXIS_MANUAL_MODE")
        recent = any(cycle - self.since[name] < 3 for name in OUTPUTS)
        open_answer = outside or fast or stopped or manual or recent or self.held or not self.seen(cycle - 1, "AXIS_READY")
        if must_fail and not error and not recent:
            self.say(cycle, "ERROR_CMD of 513 that must fail", "not 0", error)
        if not must_fail and error and not open_answer:
            self.say(cycle, "ERROR_CMD of 513", 0, error)
        if self.late_refusal != cycle:
            self.late_refusal = -1
        if error or self.late_refusal == cycle:
            return
        speed = min(asked[P4], limits["SPEED_MAX"] or asked[P4])
        rest = self.v[cycle - 1] == 0 and self.v[cycle - 2] == 0
        self.move = {"target": asked[P3], "speed": speed, "start": self.p[cycle - 1], "begin": cycle, "rest": rest,
                     "clean": rest and not outside and not stopped and not self.held, "stopped": stopped, "outside": outside}
        self.held, self.resumed, self.manual_held = not out["ALLOW_RESUME"], False, False
        self.inc = None
        self.cause = cycle

    # ------------------------------------------------------------------------------------------
    # a cycle of the module

    def step(self, cycle):
        old = self.out
        self.out = getattr(self, "new_out", self.out)
        rising = {name for name in OUTPUTS if self.out[name] and not old[name]}
        for name in OUTPUTS:
            if self.out[name] != old[name]:
                self.since[name] = cycle
        self.permissions(cycle, rising)
        self.answers(cycle)
        self.stops(cycle, rising)
        self.manual(cycle, rising)
        self.motion(cycle)
        self.arrival(cycle)
        self.bits(cycle)

    def permissions(self, cycle, rising):
        out = self.out
        if not out["ALLOW_ACQUIRE"]:
            self.acquired = False
        elif "CONTROL_ACQUIRE" in rising:
            self.acquired = True
        before = self.fault
        if not out["ALLOW_NOT_FLT"]:
            self.fault = True if self.acquired or before is True else None
        elif "CONTROL_CLEAR_FLT" in rising:
            self.fault = False if self.acquired or before is False else None
        elif self.module["FUNCTION_VALIDATION"] & 1 and before is False and self.near_limit(cycle):
            self.fault = None
        if "CONTROL_ENABLE" in rising and out["ALLOW_ENABLE"]:
            self.edge_enable = cycle
        row = self.rows[cycle]
        refused = row["report"] & 6 or row["parameter"] or self.rows[cycle - 1]["report"] & 6
        asked_in_stop = any(one[0] == 1 and one[1][ACTION] == 513 for one in self.pending) and (
            self.v[cycle - 1] != 0 and cycle - self.last_stop < 400)
        if asked_in_stop and not refused and self.fault is False and self.seen(cycle, "CH_ERROR"):
            self.say(cycle, "fault by 513 during a stop", "ERROR_CMD, or a move", "accepted, and CH_ERROR")
            self.late_refusal = cycle
        refused = refused or self.late_refusal >= 0
        got = self.bit(cycle, "CH_ERROR", None if refused and not self.fault else self.fault)
        if self.fault is None and not (got and refused):
            if before is False and got and out["ALLOW_NOT_FLT"]:  # only a limit can have done this
                middle = (self.module["POSITION_MAX"] + self.module["POSITION_MIN"]) / 2
                self.bit(cycle, "AXIS_POS_LIMIT" if self.p[cycle] > middle else "AXIS_NEG_LIMIT", True)
            self.fault = got

    def stops(self, cycle, rising):
        out = self.out
        halt = not out["ALLOW_MOVE"] or not out["ALLOW_NOT_FASTSTOP"]
        over = halt or not out["ALLOW_ENABLE"] or not self.acquired or self.fault
        if halt or not out["ALLOW_RESUME"] or over:
            self.last_stop = cycle
        if over and self.move and cycle > self.move["begin"]:
            self.end_move(cycle)
        if self.move and not out["ALLOW_RESUME"]:
            self.held, self.resumed, self.move["clean"] = True, False, False
            self.move["begin"] = cycle
        elif not self.move and not out["ALLOW_RESUME"] and self.quiet <= 3:
            self.manual_held = True
        elif self.manual_held and out["ALLOW_RESUME"] and "CONTROL_RESUME" in rising:
            self.manual_held, self.manual_resumed = False, cycle
        elif self.move and self.held and "CONTROL_RESUME" in rising:
            self.held, self.resumed = False, True
            self.move["begin"], self.move["way"] = cycle, abs(self.p[cycle - 1] - self.move["target"])
        if over:
            self.held = self.resumed = self.manual_held = False
            self.inc, self.manual_resumed = None, 0

    def end_move(self, cycle):
        self.move, self.held, self.resumed = None, False, False

    # ------------------------------------------------------------------------------------------
    # bits

    def bits(self, cycle):
        for name in ("AXIS_HOMING", "DRIVE_DIAG", "DRIVE_WARNING", "AXIS_IS_LINKED", "BIAS_REMAIN", "DRIVE_REALTIME_BIT1",
                     "DRIVE_REALTIME_BIT2"):
            self.bit(cycle, name, False)
        self.bit(cycle, "CONF_OK", True)
        self.bit(cycle, "AXIS_COM_OK", True)
        at_rest = self.quiet > 3
        releasing = not self.acquired and not at_rest
        self.bit(cycle, "AXIS_IN_CMD", None if releasing else self.acquired)
        self.power_bits(cycle, at_rest)
        self.motion_bits(cycle)
        self.stop_bits(cycle, at_rest)
        pos, neg = self.module["POSITION_MAX"], self.module["POSITION_MIN"]
        slack = self.top * CYCLE_S * 2 + 1e-5
        checked = self.module["FUNCTION_VALIDATION"] & 1
        self.bit(cycle, "AXIS_POS_LIMIT", False if self.p[cycle] < pos - slack - self.braking(self.top) or not checked else None)
        self.bit(cycle, "AXIS_NEG_LIMIT", False if self.p[cycle] > neg + slack + self.braking(self.top) or not checked else None)
        if abs(self.rows[cycle]["position"] - self.p[cycle]) > abs(self.v[cycle]) * CYCLE_S + self.top * CYCLE_S + 1e-5:
            self.say(cycle, "POSITION", self.p[cycle], self.rows[cycle]["position"])

    def power_bits(self, cycle, at_rest):
        out, enabled = self.out, self.seen(cycle, "DRIVE_ENABLED")
        self.bit(cycle, "DRIVE_DISABLED", not enabled)
        before = cycle > 0 and self.seen(cycle - 1, "DRIVE_ENABLED")
        if enabled and not before and not 0 <= cycle - self.edge_enable <= POWER_CYCLES:
            self.say(cycle, "DRIVE_ENABLED without an edge", False, True)
        age = cycle - self.edge_enable
        if not (out["ALLOW_ENABLE"] and self.acquired and self.fault is False):
            self.edge_ok = False
        elif age == 0:
            self.edge_ok = True
        if age > POWER_CYCLES and self.edge_ok:
            self.bit(cycle, "DRIVE_ENABLED", True)
        if not out["ALLOW_ENABLE"] and cycle - self.since["ALLOW_ENABLE"] > POWER_CYCLES and self.quiet > POWER_CYCLES:
            self.bit(cycle, "DRIVE_ENABLED", False)
        if self.fault is False:
            self.bit(cycle, "DRIVE_FLT", False)
            self.bit(cycle, "AXIS_SUMMARY_FLT", False)
        able = self.acquired and enabled and self.fault is False
        allowed = out["ALLOW_ENABLE"] and out["ALLOW_MOVE"] and out["ALLOW_NOT_FASTSTOP"] and out["ALLOW_RESUME"]
        if not able and self.fault is not None and cycle - max(self.since.values()) > 2:
            self.bit(cycle, "AXIS_READY", False)
        elif able and allowed and before and not out["OPERATION_MODE_1"] and cycle - self.last_stop > 2 and at_rest and (
                not self.held and not self.manual_held and cycle - self.since["OPERATION_MODE_1"] > 2):
            self.bit(cycle, "AXIS_READY", True)

    def motion_bits(self, cycle):
        """From three cycles that agree, because bits may be those of the cycle before"""
        if cycle < 4 or cycle + 1 >= len(self.rows):
            return
        near = range(cycle - 2, cycle + 2)
        speeds, accelerations = [self.v[i] for i in near], [self.a[i] for i in near]
        if all(v == 0 for v in speeds) and self.quiet > 4:
            for name in ("RAMPING", "STEADY", "STOPPING", "RESUMING"):
                self.bit(cycle, name, False)
        elif all(abs(v) > 1e-6 for v in speeds):
            if all(abs(a) < 1e-6 for a in accelerations):
                for name, expected in (("RAMPING", False), ("STEADY", True), ("STOPPING", False)):
                    self.bit(cycle, name, expected)
            elif all(v * a > 0.3 * abs(v) * self.module["ACCEL"] for v, a in zip(speeds, accelerations)):
                stopped = cycle - self.last_stop < 400 or self.held or self.seen(cycle, "AXIS_MANUAL_MODE")
                for name, expected in (("RAMPING", True), ("STEADY", False), ("STOPPING", None if stopped else False)):
                    self.bit(cycle, name, expected)
            elif all(v * a < -1e-3 for v, a in zip(speeds, accelerations)):
                if all(-v * a > 0.3 * abs(v) * self.lowest() for v, a in zip(speeds, accelerations)):
                    self.bit(cycle, "STEADY", False)  # not where it only passes the end of a ramp
                    if not self.seen(cycle, "RAMPING") and not self.seen(cycle, "STOPPING"):
                        self.say(cycle, "RAMPING or STOPPING", True, False)
                if self.move and not self.move["stopped"] and not self.held and self.ends_here(cycle):
                    self.bit(cycle, "STOPPING", True)

    def ends_here(self, cycle):
        """The axis loses speed until it is at rest at the target, without another move"""
        for i in range(cycle, len(self.rows) - 1):
            if abs(self.v[i + 1]) >= abs(self.v[i]):
                return self.v[i] == 0 and abs(self.p[i] - self.move["target"]) < 1e-5
        return False

    def stop_bits(self, cycle, at_rest):
        out, able = self.out, self.acquired and self.seen(cycle, "DRIVE_ENABLED") and self.fault is False
        following = min(cycle + 1, len(self.v) - 1)
        moving = self.quiet == 0 and self.v[following] != 0
        calm = lambda name: cycle - self.since[name] > 2
        for name, permission in (("AXIS_HALT", "ALLOW_MOVE"), ("AXIS_FASTSTOP", "ALLOW_NOT_FASTSTOP"),
                                 ("AXIS_HOLD", "ALLOW_RESUME")):
            if moving and self.v[cycle - 1] != 0 and self.v[cycle - 2] != 0:
                self.bit(cycle, name, False)
            elif able and at_rest and not out[permission] and calm(permission):
                self.bit(cycle, name, True)
            elif name != "AXIS_HOLD" and out[permission] and self.move and not self.move["stopped"] and calm(permission) and able:
                self.bit(cycle, name, False)
        move = self.move
        holding = None
        if moving and self.v[cycle - 2] != 0 or not move and out["ALLOW_RESUME"] and at_rest and not self.manual_held:
            holding = False
        elif move and self.held and at_rest and able and not out["ALLOW_RESUME"] and calm("ALLOW_RESUME") and (
                abs(self.p[cycle] - move["target"]) > 1e-3):
            holding = True
        self.bit(cycle, "HOLDING", holding)
        if move and self.resumed and able and moving and self.v[cycle - 2] != 0:
            self.bit(cycle, "RESUMING", True)
        elif not self.resumed and cycle - self.since["CONTROL_RESUME"] > 2 and at_rest:
            self.bit(cycle, "RESUMING", False)
        if not able or self.seen(cycle, "AXIS_MANUAL_MODE") or out["OPERATION_MODE_1"]:
            return
        if not move:
            if at_rest and cycle - max(self.since.values()) > 3 and not self.manual_held:
                self.bit(cycle, "PROFILE_END", True)
            return
        gaps = [abs(self.p[i] - move["target"]) for i in (cycle - 1, cycle)]
        gap = min(gaps)
        band = self.module["IN_POSITION_BAND"] + 1e-5 + self.top * CYCLE_S
        if cycle - move["begin"] <= 2 or move["outside"] or "taken" in move:
            return
        if gap > band:
            self.bit(cycle, "AXIS_AT_TARGET", False)
        if gap > 1e-3 and not move["stopped"]:
            self.bit(cycle, "PROFILE_END", False)
        elif at_rest and max(gaps) < 1e-6 and not self.held:
            for name in ("PROFILE_END", "AXIS_AT_TARGET", "IN_POSITION"):
                self.bit(cycle, name, True)
