"""What the blocks of the libraries Standard and Util do, written from their documentation.

A model has `step(t, inputs)`: t is the time of the call in milliseconds (it never wraps here), inputs the values of the
pins by name; it returns the outputs. Numbers are exact: REAL pins are Fractions, or floats for what is no number.
"""
import math
from fractions import Fraction

LARGEST_REAL = Fraction(2**24 - 1) * Fraction(2) ** 104
LIMITS = {"INT": (-(2**15), 2**15 - 1), "DINT": (-(2**31), 2**31 - 1), "LINT": (-(2**63), 2**63 - 1),
          "UDINT": (0, 2**32 - 1), "ULINT": (0, 2**64 - 1), "WORD": (0, 2**16 - 1)}


def half_away(x):
    """The nearest integer, halves away from 0."""
    return math.floor(abs(x) + Fraction(1, 2)) * (1 if x >= 0 else -1)


def finite(x):
    return isinstance(x, (int, Fraction))


# ---- bistables, edges, semaphores, counters

class R_TRIG:
    def __init__(self):
        self.last = False

    def step(self, t, p):
        edge, self.last = p["CLK"] and not self.last, p["CLK"]
        return {"Q": edge}


class F_TRIG:
    def __init__(self):
        self.last = True

    def step(self, t, p):
        edge, self.last = self.last and not p["CLK"], p["CLK"]
        return {"Q": edge}


class SR:
    q = False

    def step(self, t, p):
        if p["SET1"]:
            self.q = True
        elif p["RESET"]:
            self.q = False
        return {"Q1": self.q}


class RS:
    q = False

    def step(self, t, p):
        if p["RESET1"]:
            self.q = False
        elif p["SET"]:
            self.q = True
        return {"Q1": self.q}


class SEMA:
    taken = False

    def step(self, t, p):
        busy = self.taken
        if p["CLAIM"]:
            self.taken = True
        elif p["RELEASE"]:
            self.taken = busy = False
        return {"BUSY": busy}


class Counter:
    """All counters: `up`, `down`, `reset`, `load` name the pins, or None."""

    def __init__(self, kind, up, down, reset, load):
        self.low, self.high = LIMITS[kind]
        self.up, self.down, self.reset, self.load = up, down, reset, load
        self.count, self.last, self.written = 0, {}, 0

    def edge(self, p, pin):
        if pin is None:
            return False
        was, self.last[pin] = self.last.get(pin, False), p[pin]
        return p[pin] and not was

    def step(self, t, p):
        if p.get("tested.CV", self.written) != self.written: # its output, written from outside
            self.count = self.written = p["tested.CV"]
        by = self.edge(p, self.up) - self.edge(p, self.down)
        if self.reset and p[self.reset]:
            self.count = 0
        elif self.load and p[self.load]:
            self.count = p["PV"]
        else:
            self.count = min(max(self.count + by, self.low), self.high)
        out = {"CV": self.count}
        if self.up:
            out["QU" if self.down else "Q"] = self.count >= p["PV"]
        if self.down:
            out["QD" if self.up else "Q"] = self.count <= 0
        return out


# ---- timers and clocks

class TON:
    began = over = None

    def step(self, t, p):
        if not p["IN"]:
            self.began = self.over = None
            return {"Q": False, "ET": 0}
        if self.began is None:
            self.began = t
        if self.over is None and t - self.began >= p["PT"]:
            self.over = p["PT"]
        return {"Q": self.over is not None, "ET": t - self.began if self.over is None else self.over}


class TOF:
    def __init__(self):
        self.q, self.began, self.et = False, None, 0

    def step(self, t, p):
        if p["IN"]:
            self.q, self.began, self.et = True, None, 0
        elif self.q:
            if self.began is None:
                self.began = t
            self.et = t - self.began
            if self.et >= p["PT"]:
                self.q, self.began, self.et = False, None, p["PT"]
        return {"Q": self.q, "ET": self.et}


class TP:
    def __init__(self):
        self.began, self.et, self.last = None, 0, False

    def step(self, t, p):
        if self.began is None and p["IN"] and not self.last:
            self.began = t
        self.last = p["IN"]
        if self.began is not None:
            self.et = t - self.began
            if self.et >= p["PT"]:
                self.began, self.et = None, p["PT"]
        if self.began is None and not p["IN"]:
            self.et = 0
        return {"Q": self.began is not None, "ET": self.et}


class Wide:
    """A timer that counts nanoseconds; a negative PT is 0."""

    def __init__(self, timer):
        self.timer = timer()

    def step(self, t, p):
        return self.timer.step(int(t * 1_000_000), {**p, "PT": max(p["PT"], 0)})


class RTC:
    began = None

    def step(self, t, p):
        if not p["EN"]:
            self.began = None
            return {"Q": False, "CDT": 0}
        if self.began is None:
            self.began, self.preset = t, p["PDT"]
        return {"Q": True, "CDT": (self.preset + (t - self.began) // 1000) % 2**32}


class BLINK:
    def __init__(self):
        self.out, self.began, self.enabled = False, 0, False

    def step(self, t, p):
        if p["ENABLE"]:
            if not self.enabled:
                self.out, self.began = True, t
            both = p["TIMEHIGH"] + p["TIMELOW"]
            if both == 0:
                self.out, self.began = False, t
            else:
                length = lambda: p["TIMEHIGH"] if self.out else p["TIMELOW"]
                if t - self.began >= length():  # whole periods lead back to the same phase
                    self.began += (t - self.began - length()) // both * both
                while t - self.began >= length():
                    self.began += length()
                    self.out = not self.out
        elif self.enabled:
            self.rest = t
        if not p["ENABLE"]:
            self.began = t
        self.enabled = p["ENABLE"]
        return {"OUT": self.out}


class FREQ_MEASURE:
    def __init__(self):
        self.edges, self.out, self.valid, self.last = [], Fraction(0), False, True

    def step(self, t, p):
        if p["RESET"]:
            self.edges, self.out, self.valid = [], Fraction(0), False
        else:
            if self.valid and t - self.edges[-1] > 3000 / self.out:
                self.edges, self.valid = [], False
            if p["IN"] and not self.last:
                self.edges.append(t)
                periods = p["PERIODS"]
                if len(self.edges) > periods and t > self.edges[-1 - periods]:
                    self.out = Fraction(1000 * periods, t - self.edges[-1 - periods])
                    self.valid = True
        self.last = p["IN"]
        return {"OUT": self.out, "VALID": self.valid}


class GEN:
    def __init__(self):
        self.last, self.time, self.calls = None, 0, 0

    def step(self, t, p):
        if p["RESET"]:
            self.last = None
            return {"OUT": 0}
        if self.last is None:
            self.time = self.calls = 0
        else:
            self.time, self.calls = self.time + t - self.last, self.calls + 1
        self.last = t
        self.time %= p["PERIOD"] or math.inf
        if p["CYCLES"] > 0:
            self.calls %= p["CYCLES"]
        length, at = (p["PERIOD"], int(self.time)) if p["BASE"] else (p["CYCLES"], self.calls)
        if length <= 0:
            return {"OUT": 0}
        x = Fraction(at, length)
        up = min(2 * x, 2 - 2 * x)
        mode = p["MODE"]
        if mode in (5, 7):
            share = Fraction(self.sine(x))
        elif mode in (6, 8):
            share = Fraction(self.sine(x + Fraction(1, 4)))
        else:
            share = {0: 2 * up - 1, 1: up, 2: 2 * x - 1, 3: 1 - 2 * x, 4: Fraction(1 if x >= Fraction(1, 2) else -1)}[mode]
        return {"OUT": min(half_away(share * p["AMPLITUDE"]), 32767)}

    @staticmethod
    def sine(turns):
        exact = {0: 0, Fraction(1, 12): Fraction(1, 2), Fraction(1, 4): 1, Fraction(5, 12): Fraction(1, 2), Fraction(1, 2): 0,
                 Fraction(7, 12): Fraction(-1, 2), Fraction(3, 4): -1, Fraction(11, 12): Fraction(-1, 2)}
        turns %= 1
        return exact.get(turns, math.sin(2 * math.pi * turns))


# ---- curves and ramps

class CHARCURVE:
    out = 0

    def step(self, t, p):
        n = p["N"]
        if not 2 <= n <= 11:
            return {"OUT": self.out, "ERR": 4}
        points = [(p[f"P[{i}].X"], p[f"P[{i}].Y"]) for i in range(n)]
        if any(a[0] >= b[0] for a, b in zip(points, points[1:])):
            return {"OUT": self.out, "ERR": 1}
        x = p["IN"]
        if not points[0][0] <= x <= points[-1][0]:
            self.out = points[0][1] if x < points[0][0] else points[-1][1]
            return {"OUT": self.out, "ERR": 2}
        for (x0, y0), (x1, y1) in zip(points, points[1:]):
            if x0 <= x <= x1:
                self.out = half_away(y0 + Fraction((y1 - y0) * (x - x0), x1 - x0))
                break
        return {"OUT": self.out, "ERR": 0}


class RAMP_INT:
    def __init__(self):
        self.out, self.rest, self.way, self.base, self.last = 0, Fraction(0), 0, 0, None

    def step(self, t, p):
        passed = 0 if self.last is None else t - self.last
        self.last = t
        if p["RESET"]:
            self.rest = Fraction(0)
            return {"OUT": self.out}
        way = (p["IN"] > self.out) - (p["IN"] < self.out)
        if way != self.way or p["TIMEBASE"] != self.base:
            self.rest = Fraction(0)
        self.way, self.base = way, p["TIMEBASE"]
        slope = max(p["ASCEND"] if way > 0 else p["DESCEND"], 0)
        if self.base:
            self.rest += Fraction(slope * passed, self.base)
            steps = math.floor(self.rest)
            self.rest -= steps
        else:
            steps = slope
        self.out += way * min(steps, abs(p["IN"] - self.out))
        if self.out == p["IN"]:
            self.rest, self.way = Fraction(0), 0
        return {"OUT": self.out}


class RAMP_REAL:
    def __init__(self):
        self.out, self.last = Fraction(0), None

    def step(self, t, p):
        passed = 0 if self.last is None else t - self.last
        self.last = t
        goal = p["IN"]
        if not finite(goal):
            if math.isnan(goal):
                goal = self.out
            else:
                goal = LARGEST_REAL if goal > 0 else -LARGEST_REAL
        if not p["RESET"]:
            share = Fraction(passed, p["TIMEBASE"]) if p["TIMEBASE"] else 1
            up, down = (p[x] if finite(p[x]) else 0 for x in ("ASCEND", "DESCEND"))
            if goal > self.out:
                self.out = min(self.out + max(up, 0) * share, goal)
            else:
                self.out = max(self.out - max(down, 0) * share, goal)
        return {"OUT": self.out}


# ---- monitors, mathematics

class HYSTERESIS:
    out = False

    def step(self, t, p):
        if p["IN"] < p["LOW"]:
            self.out = True
        if p["IN"] > p["HIGH"]:
            self.out = False
        return {"OUT": self.out}


class LIMITALARM:
    def step(self, t, p):
        over, under = p["IN"] > p["HIGH"], p["IN"] < p["LOW"]
        return {"O": over, "U": under, "IL": not over and not under}


class LIN_TRAFO:
    def step(self, t, p):
        x, low, high = p["IN"], p["IN_MIN"], p["IN_MAX"]
        if not all(map(finite, (x, low, high))) or low >= high or not low <= x <= high:
            return {"OUT": Fraction(0), "ERROR": True}
        return {"OUT": p["OUT_MIN"] + (p["OUT_MAX"] - p["OUT_MIN"]) * (x - low) / (high - low), "ERROR": False}


class DERIVATIVE:
    samples = None

    def __init__(self):
        self.out = Fraction(0)

    def step(self, t, p):
        if p["RESET"] or self.samples is None:
            self.samples, self.times, self.out = [p["IN"]] * 4, [0, 0, 0], Fraction(0)
        elif p["TM"] > 0:
            self.samples = [p["IN"]] + self.samples[:3]
            self.times = [p["TM"]] + self.times[:2]
            x, w = self.samples, self.times
            if all(map(finite, x)):
                self.out = (3 * (x[0] - x[3]) + x[1] - x[2]) / Fraction(3 * w[0] + 4 * w[1] + 3 * w[2], 1000)
            else:
                self.out = math.nan
        return {"OUT": self.out}


class INTEGRAL:
    last = None

    def __init__(self):
        self.sum, self.over = Fraction(0), False

    def step(self, t, p):
        if p["RESET"]:
            self.sum, self.over, self.last = Fraction(0), False, p["IN"]
        elif not self.over:
            if self.last is None:
                self.last = p["IN"]
            if finite(self.last) and finite(p["IN"]):
                total = self.sum + (self.last + p["IN"]) / 2 * Fraction(p["TM"], 1000)
                self.over = abs(total) > LARGEST_REAL
            else:
                self.over = True
            if not self.over:
                self.sum, self.last = total, p["IN"]
        return {"OUT": self.sum, "OVERFLOW": self.over}


class Statistics:
    def __init__(self, integers):
        self.integers, self.values = integers, []

    def step(self, t, p):
        self.values = [] if p["RESET"] else self.values + [p["IN"]]
        usable = [v for v in self.values if finite(v)]
        top = 32767 if self.integers else Fraction(340282346638528859811704183484516925440)
        out = {"MN": min(usable + [top]), "MX": max(usable + [-32768 if self.integers else -top])}
        if len(usable) < len(self.values):
            out["AVG"] = math.nan
        else:
            out["AVG"] = Fraction(sum(usable), max(len(usable), 1))
            if self.integers:
                out["AVG"] = math.trunc(out["AVG"])
        return out


class VARIANCE:
    def __init__(self):
        self.values = []

    def step(self, t, p):
        self.values = [] if p["RESET"] else self.values + [p["IN"]]
        if not all(map(finite, self.values)):
            return {"OUT": math.nan}
        n = max(len(self.values), 1)
        mean = Fraction(sum(self.values), n)
        return {"OUT": sum((v - mean) ** 2 for v in self.values) / n}


# ---- controllers

class Controller:
    """PD, PID and PID_FIXCYCLE."""

    def __init__(self, integral, cycle):
        self.integral, self.cycle = integral, cycle
        self.y, self.limited, self.over = Fraction(0), False, False
        self.sum, self.slope, self.before, self.when = Fraction(0), Fraction(0), None, None

    def outputs(self):
        out = {"Y": self.y, "LIMITS_ACTIVE": self.limited}
        if self.integral:
            out["OVERFLOW"] = self.over
        return out

    def step(self, t, p):
        usable = finite(p["SET_POINT"]) and finite(p["ACTUAL"])
        error = p["SET_POINT"] - p["ACTUAL"] if usable else None
        tn = p.get("TN", 0)
        if p["RESET"]:
            self.sum, self.over = Fraction(0), False
        if p["RESET"] or p["MANUAL"]:
            self.limited = False
            self.y = p["Y_MANUAL"] if p["MANUAL"] else p["Y_OFFSET"]
            if usable and p["MANUAL"] and p["KP"] != 0 and tn > 0:
                self.sum = ((p["Y_MANUAL"] - p["Y_OFFSET"]) / p["KP"] - error) * tn
            self.before, self.slope, self.when = error, Fraction(0), t
            return self.outputs()
        if not usable or self.over:
            return self.outputs()
        if self.before is None:
            self.before, self.slope, self.when, passed = error, Fraction(0), t, 0
        elif self.cycle:
            passed = max(p["CYCLE"], 0)
        else:
            passed = Fraction(t - self.when, 1000)
        if passed > 0:
            self.slope = (error - self.before) / passed
        step = (self.before + error) / 2 * passed if self.integral and tn > 0 else Fraction(0)
        y = p["KP"] * (error + p["TV"] * self.slope + (((self.sum + step) / tn) if tn > 0 else 0)) + p["Y_OFFSET"]
        if passed > 0:
            self.before, self.when = error, t
        low, high = p["Y_MIN"], p["Y_MAX"]
        self.limited = low < high and not low <= y <= high
        if self.limited:
            drives = p["KP"] * step
            if (y > high and drives > 0) or (y < low and drives <= 0):
                step = 0
            y = high if y > high else low
        if abs(y) > LARGEST_REAL or abs(self.sum + step) > LARGEST_REAL:
            self.over = self.integral
            return self.outputs()
        self.sum += step
        self.y = y
        return self.outputs()


# ---- bits, codes: functions and blocks without a memory

def bit(x, n, width):
    return n < width and x >> n & 1 == 1


def bcd(digits, count, bad):
    text = f"{digits:0{count}x}"
    return int(text) if text.isdecimal() else bad


def to_bcd(number, count, bad):
    return int(str(number), 16) if 0 <= number < 10**count else bad


def from_gray(code, width):
    return next(n for n in range(1 << width) if n ^ n >> 1 == code) if width == 8 else \
        int("".join(str(f"{code:0{width}b}"[: i + 1].count("1") % 2) for i in range(width)), 2)


def hexadecimal(word):
    digits = "0123456789ABCDEFabcdef"
    pair = chr(word >> 8) + chr(word & 255)
    return int(pair, 16) if all(c in digits for c in pair) else 0


def text_of(word, swapped):
    pair = [word & 255, word >> 8]
    return bytes(reversed(pair) if swapped else pair).split(b"\0")[0].decode("latin-1")


class Pure:
    """A block or function whose outputs follow from its inputs only."""

    def __init__(self, function):
        self.function = function

    def step(self, t, p):
        return self.function(p)
