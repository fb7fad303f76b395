"""How an axis of a TSX CSY 85 may move: manual mode, bounds of speed and acceleration, ends of moves (see csy_model.py)."""
from csy_sequences import CYCLE_S, REMOTE


class Motion:
    """The part of the model that looks at positions, and their differences by the cycle time"""

    def near_limit(self, cycle):
        slack = abs(self.v[cycle]) * CYCLE_S * 2 + self.braking(abs(self.v[cycle])) + 1e-6
        return self.p[cycle] > self.module["POSITION_MAX"] - slack or self.p[cycle] < self.module["POSITION_MIN"] + slack

    def lowest(self):
        return min(self.module[name] for name in ("ACCEL", "DECEL", "DECEL_MAX") if self.module[name] > 0)

    def braking(self, speed):
        """An upper bound of the way to rest"""
        return speed * self.stop_time(speed)

    def stop_time(self, speed):
        return 2 * max(speed, self.top) / self.lowest() + 6 * CYCLE_S

    def manual(self, cycle, rising):
        out, on = self.out, self.seen(cycle, "AXIS_MANUAL_MODE")
        at_rest = self.quiet > 3
        steady = cycle - self.since["OPERATION_MODE_1"] > 2
        if not out["OPERATION_MODE_1"]:
            self.bit(cycle, "AXIS_MANUAL_MODE", False if steady and at_rest else None)
        elif steady and at_rest and self.acquired and self.seen(cycle, "DRIVE_ENABLED") and self.fault is False:
            self.bit(cycle, "AXIS_MANUAL_MODE", True)
        if self.move and (on or out["OPERATION_MODE_1"]):
            self.move["clean"], self.move["stopped"], self.move["manual"] = False, True, True
            taken = any(out[name] for name in ("CONTROL_JOG_POS", "CONTROL_JOG_NEG", "CONTROL_INC_POS", "CONTROL_INC_NEG"))
            if taken:  # a jog or increment may have taken over
                self.resumed, self.move["taken"] = False, True
        jog = out["CONTROL_JOG_POS"] - out["CONTROL_JOG_NEG"]
        able = on and steady and cycle - self.last_stop > 2 and self.acquired and self.seen(cycle, "DRIVE_ENABLED")
        speed = self.sequence.manual_speed
        if on and jog:
            self.cause, self.inc = cycle, None
            held = cycle - max(self.since["CONTROL_JOG_POS"], self.since["CONTROL_JOG_NEG"])
            bound = 2 * speed / self.lowest() / CYCLE_S + 6
            limited = self.module["FUNCTION_VALIDATION"] & 1 and self.near_limit(cycle)
            if able and held > bound and self.jog_began_able and not limited and not self.move:
                if abs(self.v[cycle] - jog * min(speed, self.module["SPEED_MAX"] or speed)) > 1e-6:
                    self.say(cycle, "speed of a jog", jog * speed, self.v[cycle])
            if held == 0:
                self.jog_began_able = able and at_rest
        edges = {"CONTROL_INC_POS", "CONTROL_INC_NEG"} & rising
        if self.move and "manual" in self.move and at_rest and not self.held and cycle - self.move["begin"] > 20:
            self.end_move(cycle)
        if edges and on:
            sign = 1 if "CONTROL_INC_POS" in edges else -1
            clean = able and at_rest and not jog and not self.move
            way = self.asked[REMOTE] + (self.inc["way"] if self.inc and not at_rest else 0)
            self.inc = {"way": way, "begin": cycle, "target": self.p[cycle - 1] + sign * self.asked[REMOTE], "clean": clean}
            self.cause = cycle
        if self.inc:
            self.increment(cycle, speed)
            self.inc["clean"] = self.inc["clean"] and out["OPERATION_MODE_1"] and on

    def increment(self, cycle, speed):
        inc, limits = self.inc, self.module
        bound = (inc["way"] / speed + 4 * speed / self.lowest()) / CYCLE_S + 8
        outside = limits["FUNCTION_VALIDATION"] & 1 and not limits["POSITION_MIN"] <= inc["target"] <= limits["POSITION_MAX"]
        if cycle - inc["begin"] < bound:
            self.cause = cycle
        elif inc["clean"] and not outside and abs(self.p[cycle] - inc["target"]) > 1e-5:
            self.say(cycle, "position after an increment", inc["target"], self.p[cycle])
            inc["clean"] = False

    def motion(self, cycle):
        p, v, a, limits = self.p[cycle], self.v[cycle], self.a[cycle], self.module
        if v == 0:
            self.quiet += 1
        else:
            self.quiet = 0
        if self.quiet > 2:
            self.top = 0.0
        allowed = 0.0
        if self.manual_resumed and (self.quiet <= 3 or cycle - self.manual_resumed < 6):
            self.cause, allowed = cycle, self.sequence.manual_speed
        else:
            self.manual_resumed = 0
        if self.move and not self.held:
            allowed = self.move["speed"]
            self.cause = cycle
        if self.seen(cycle, "AXIS_MANUAL_MODE") or self.inc:
            allowed = max(allowed, self.sequence.manual_speed)
        self.top = max(self.top, allowed)
        before = abs(self.v[cycle - 1]) if cycle else 0.0
        if abs(v) > max(self.top, before) * (1 + 1e-9) + 1e-7:
            self.say(cycle, "speed", f"at most {self.top}", v)
        self.acceleration(cycle, before)
        grace = self.stop_time(self.top) / CYCLE_S + 2
        if cycle - self.cause > grace and v != 0:
            self.say(cycle, "at rest without a cause to move", 0, v)
        if not self.move and self.cause < self.last_stop == cycle and cycle - self.cause > grace and v != 0:
            self.say(cycle, "at rest by a stop", 0, v)
        if limits["FUNCTION_VALIDATION"] & 1 and cycle:
            over = max(p - limits["POSITION_MAX"], limits["POSITION_MIN"] - p)
            if not self.checked or self.quiet > 3:
                self.outside = max(over, 0.0)  # switched on out there, or cleared
            outwards = v > 0 and p > limits["POSITION_MAX"] or v < 0 and p < limits["POSITION_MIN"]
            if outwards and over > self.outside + self.braking(self.top) + self.top * CYCLE_S:
                self.say(cycle, "position within its limits and the way to brake", "inside", p)
        self.checked = limits["FUNCTION_VALIDATION"] & 1

    def acceleration(self, cycle, before):
        v, a, limits = self.v[cycle], self.a[cycle], self.module
        rates = [limits[name] * limits["ACCEL_TYPE"] / 100 for name in ("ACCEL", "DECEL", "DECEL_MAX")]
        if self.quiet <= 2:  # a move keeps the parameters with which it began
            rates = [max(pair) for pair in zip(rates, self.rates)]
        self.rates = rates
        up, down = rates[:2]
        if cycle - self.last_stop < 400:
            down = max(down, rates[2])
        if v * self.v[cycle - 1] < 0 or abs(v) < max(up, down) * CYCLE_S or cycle - self.since_adjust(cycle) < 3:
            up = down = max(up, down)
        bound = up if abs(v) > before else down
        # After it has turned around an acceleration with a limited jerk can only fall.
        turned = v * self.v[cycle - 1] < 0
        self.falls = turned or self.falls and a * self.a[cycle - 1] > 0 and abs(a) < abs(self.a[cycle - 1])
        if self.falls and limits["ACCEL_TYPE"] > 100:
            bound = max(up, down)
        if v == 0 and not self.seen(cycle, "DRIVE_ENABLED"):
            return
        if abs(a) > bound * (1 + 1e-6) + 1e-5:
            self.say(cycle, "acceleration", f"at most {bound}", a)

    def since_adjust(self, cycle):
        if self.pending and self.pending[0][0] in (3, 5):
            self.adjusted = cycle
        return getattr(self, "adjusted", -10)

    def arrival(self, cycle):
        move, limits = self.move, self.module
        if not move or self.held or move["stopped"] or move["outside"]:
            return
        accel, decel = limits["ACCEL"], limits["DECEL"]
        way = move.get("way", abs(move["target"] - move["start"]))
        age = (cycle - move["begin"]) * CYCLE_S
        longest = way / move["speed"] + 2 * (self.top + move["speed"]) * (1 / accel + 1 / decel) + 10 * CYCLE_S
        if age > longest and abs(self.p[cycle] - move["target"]) > 1e-5 and not move.get("told"):
            self.say(cycle, "position at the end of the move", move["target"], self.p[cycle])
            move["told"] = True
        if not move["clean"] or self.fault:
            return
        low, high = sorted((move["start"], move["target"]))
        if not low - 1e-6 <= self.p[cycle] <= high + 1e-6:
            self.say(cycle, "position between start and target", (low, high), self.p[cycle])
        ramps = move["speed"] / 2 * (move["speed"] / accel + move["speed"] / decel)
        if accel == decel or limits["ACCEL_TYPE"] == 100:
            exact = self.duration(move["speed"], way, accel, decel, ramps)
            if exact is not None and abs(self.p[cycle] - move["target"]) < 1e-5 and "end" not in move:
                move["end"] = cycle
                if abs(age - exact) > 3 * CYCLE_S and way > 0.01:
                    self.say(cycle, "duration of the move", exact, age)
                if accel == decel and way >= ramps:
                    self.ramp(cycle, move, accel)

    def ramp(self, cycle, move, accel):
        """Peak and jerk of the ramps of a whole move from rest to rest"""
        peak = accel * self.module["ACCEL_TYPE"] / 100
        a = self.a[move["begin"]:cycle + 1]
        span = (1 - accel / peak) * move["speed"] / accel  # in which the acceleration grows
        jerk = peak / span if span else peak / CYCLE_S
        got = max(map(abs, a))
        if not peak - 2 * jerk * CYCLE_S <= got <= peak * (1 + 1e-6) + 1e-5 or not span and abs(got - peak) > 1e-5:
            self.say(cycle, "peak acceleration of the move", peak, got)
        steepest = max(abs(b - c) / CYCLE_S for b, c in zip(a, a[1:]))
        if span and steepest > jerk * (1 + 1e-6) + 1e-3:
            self.say(cycle, "jerk of the move", f"at most {jerk}", steepest)

    def duration(self, speed, way, accel, decel, ramps):
        if way >= ramps:
            return way / speed + (speed / accel + speed / decel) / 2
        if self.module["ACCEL_TYPE"] == 100:
            peak = (2 * way * accel * decel / (accel + decel)) ** 0.5
            return peak / accel + peak / decel
        return None
