#!/usr/bin/env python3
"""Random sequential function charts against an interpreter of the rules of IEC 61131-3 that is written here.

usage: random_charts.py STRIDE [--seeds FIRST..LAST] [--keep FOLDER]

A seed is a project of ten charts, which `stride sim` runs for 200 cycles. Some are made of sequences, alternatives, parallel
branches and loops; others are wild: transitions between any steps. Conditions are random bits, times and states of steps;
actions have all qualifiers and are variables or statements; some charts are not called in each cycle, and some have the
flags SFCInit, SFCReset, SFCPause, SFCTipMode and SFCTip, or watch the times of steps. Each chart folds the states and times of its steps, its actions and
the order in which their statements run into one number, cycle by cycle, which must be the one that the interpreter finds.
"""
import argparse
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

CHARTS, CYCLES, CYCLE_MS, MODULUS = 10, 200, 10, 1_000_000_007
TIMED = ("L", "D", "SD", "DS", "SL")


class Chart:
    """What is written into the project: steps, transitions, actions"""

    def __init__(self, chance, number):
        self.chance, self.number = chance, number
        self.steps, self.transitions, self.blocks = [], [], {}
        if chance.random() < 0.6:
            self.steps = [self.step()]
            self.link([self.block(0, 0)], [0])
        else:
            self.wild()
        self.initial = 0
        self.actions = [(kind, chance.choice([0, 10, 20, 30, 45])) for kind in
                        chance.choices(["variable", "statements"], k=chance.randint(1, 5))]
        for step in self.steps:
            for _ in range(chance.choice([0, 1, 1, 2, 3])):
                qualifier = chance.choice(["N", "N", "R", "S", "L", "D", "P", "SD", "DS", "SL", "P1", "P0"])
                step.append((chance.randrange(len(self.actions)), qualifier))
        self.flags = chance.random() < 0.3
        # Of each step the least and the greatest time, in ms; None: not written.
        self.watched = chance.random() < 0.4
        self.limits = [(chance.choice([None, 0, 10, 20]), chance.choice([None, None, 0, 20, 35])) if self.watched else (None, None)
                       for _ in self.steps]
        self.skips = chance.random() < 0.3

    def step(self):
        return []

    def add(self):
        self.steps.append(self.step())
        return len(self.steps) - 1

    def link(self, source, target):
        chance = self.chance
        kind = chance.choice(["bit", "bit", "true", "time", "state"])
        if kind == "bit":
            condition = ("bit", chance.randrange(12))
        elif kind == "true":
            condition = ("true",)
        elif kind == "time":
            condition = ("time", source[0], chance.choice([10, 20, 25, 40]))
        else:
            condition = ("state", chance.randrange(len(self.steps)), chance.randrange(12))
        priority = chance.choice([None, None, None, 1, 2, 3])
        self.transitions.append((source, target, priority, condition))

    def block(self, entry, depth):
        """Steps after `entry`; gives the last one"""
        chance = self.chance
        for _ in range(chance.randint(1, 3)):
            kind = chance.choice(["step", "alternative", "parallel", "loop"]) if depth < 2 else "step"
            if kind == "step":
                follower = self.add()
                self.link([entry], [follower])
            elif kind == "loop":
                follower = self.block(entry, depth + 1)
                self.link([follower], [entry])
            elif kind == "alternative":
                heads = [self.add() for _ in range(chance.randint(2, 3))]
                for head in heads:
                    self.link([entry], [head])
                ends = [self.block(head, depth + 1) for head in heads]
                follower = self.add()
                for end in ends:
                    self.link([end], [follower])
            else:
                heads = [self.add() for _ in range(chance.randint(2, 3))]
                self.link([entry], heads)
                ends = [self.block(head, depth + 1) for head in heads]
                follower = self.add()
                self.link(ends, [follower])
            entry = follower
        return entry

    def wild(self):
        chance = self.chance
        self.steps = [self.step() for _ in range(chance.randint(2, 6))]
        names = range(len(self.steps))
        for _ in range(chance.randint(2, 9)):
            sides = [chance.sample(names, min(len(names), chance.choice([1, 1, 2]))) for _ in range(2)]
            self.link(*sides)

    # ------------------------------------------------------------------------------------------
    # the text

    def condition(self, condition):
        kind = condition[0]
        if kind == "bit":
            return f"bits.{condition[1]}"
        if kind == "true":
            return "TRUE"
        if kind == "time":
            return f"s{condition[1]}.t >= T#{condition[2]}ms"
        return f"s{condition[1]}.x OR bits.{condition[2]}"

    def transition(self, index):
        source, target, priority, condition = self.transitions[index]
        name = self.chance.choice(["", f" t{index}"])
        if priority is not None:
            name += f" (PRIORITY := {priority})"
        text = f"TRANSITION{name} FROM {names(source)} TO {names(target)}"
        if condition[0] == "bit" and self.chance.random() < 0.5:
            return f"{text}:\n  LD bits.{condition[1]}\nEND_TRANSITION"
        return f"{text} := {self.condition(condition)};\nEND_TRANSITION"

    def times(self, step):
        written = [f"{word} := T#{time}ms" for word, time in zip(("MIN_TIME", "MAX_TIME"), self.limits[step]) if time is not None]
        return f" ({', '.join(written)})" if written else ""

    def text(self):
        flags = "SFCInit, SFCReset, SFCPause, SFCTipMode, SFCTip : BOOL; " if self.flags else ""
        if self.watched:
            flags += "SFCEnableLimit, SFCQuitError, SFCError : BOOL; SFCErrorStep, SFCErrorPOU : STRING; "
        out = [f"FUNCTION_BLOCK Chart{self.number}", f"VAR_INPUT hash : ULINT; bits : WORD; {flags}END_VAR", "VAR"]
        out += [f"  a{i} : BOOL;" for i, (kind, _) in enumerate(self.actions) if kind == "variable"]
        out.append("END_VAR")
        parts = [f"{'INITIAL_STEP' if i == self.initial else 'STEP'} s{i}{self.times(i)}:\n" + "".join(
            f"  a{action}({qualifier}{f', T#{self.actions[action][1]}ms' if qualifier in TIMED else ''});\n"
            for action, qualifier in step) + "END_STEP" for i, step in enumerate(self.steps)]
        order = [self.transition(i) for i in range(len(self.transitions))]
        # Steps may stand anywhere between the transitions, whose order matters.
        places = sorted(self.chance.choices(range(len(order) + 1), k=len(parts)))
        for place, part in reversed(list(zip(places, parts))):
            order.insert(place, part)
        out += order
        for i, (kind, _) in enumerate(self.actions):
            if kind == "statements" and any(i == action for step in self.steps for action, _ in step):
                value = f"{2 * i} + SEL(_a{i}._x, ULINT#0, ULINT#1)"
                out.append(f"ACTION a{i}:\n  hash := (hash * 31 + {value}) MOD {MODULUS};\nEND_ACTION")
        out += ["END_FUNCTION_BLOCK"]
        return out

    def call(self):
        """Statements of the program that calls the chart and folds what is seen of it"""
        name = f"c{self.number}"
        out = [f"{name}.bits := bits;"]
        if self.flags:
            out += [f"{name}.SFCInit := bits.12 AND bits.13 AND bits.3;", f"{name}.SFCReset := bits.13 AND bits.14 AND bits.2;",
                    f"{name}.SFCPause := bits.14 AND bits.15;", f"{name}.SFCTipMode := bits.10;", f"{name}.SFCTip := bits.9;"]
        if self.watched:
            out += [f"{name}.SFCEnableLimit := bits.7 OR bits.8;", f"{name}.SFCQuitError := bits.5 AND bits.6 AND bits.4;",
                    f"IF bits.1 AND bits.2 THEN {name}.SFCError := FALSE; END_IF;"]
        call = f"{name}();"
        out.append(f"IF bits.11 THEN {call} END_IF;" if self.skips else call)
        seen = [f"SEL({name}.s{i}.x, ULINT#0, ULINT#1) + TIME_TO_ULINT({name}.s{i}.t) * 2" for i in range(len(self.steps))]
        seen += [f"SEL({name}.a{i}, ULINT#0, ULINT#1)" for i, (kind, _) in enumerate(self.actions) if kind == "variable"]
        if self.watched:
            number = f"STRING_TO_ULINT(DELETE({name}.SFCErrorStep, 1, 1))"
            seen += [f"SEL({name}.SFCError, ULINT#0, ULINT#1)", f"SEL({name}.SFCErrorStep = '', {number}, ULINT#777)",
                     f"SEL({name}.SFCErrorPOU = 'Chart{self.number}', ULINT#0, ULINT#1)"]
        out += [f"{name}.hash := ({name}.hash * 31 + {one}) MOD {MODULUS};" for one in seen]
        return out


def names(steps):
    return f"s{steps[0]}" if len(steps) == 1 else "(" + ", ".join(f"s{one}" for one in steps) + ")"


# ----------------------------------------------------------------------------------------------
# the rules

class Timer:
    """An on-delay timer"""

    def __init__(self):
        self.begin = None

    def __call__(self, on, time, now):
        if not on:
            self.begin = None
            return False
        if self.begin is None:
            self.begin = now
        return now - self.begin >= time


class Control:
    """The action control block of the standard, out of flip-flops, timers and edges"""

    def __init__(self):
        self.flops = dict.fromkeys(("S", "SD", "DS", "SL"), False)
        self.timers = {name: Timer() for name in TIMED}
        self.last = {"P": False, "P1": False, "P0": False}
        self.active = self.run = self.before = False

    def flop(self, name, on, reset):
        self.flops[name] = (self.flops[name] or on) and not reset
        return self.flops[name]

    def __call__(self, on, time, now):
        reset = "R" in on
        steady = "N" in on
        steady |= self.flop("S", "S" in on, reset)
        steady |= "L" in on and not self.timers["L"]("L" in on, time, now)
        if "L" not in on:
            self.timers["L"](False, time, now)
        steady |= self.timers["D"]("D" in on, time, now)
        steady |= "P" in on and not self.last["P"]
        steady |= self.timers["SD"](self.flop("SD", "SD" in on, reset), time, now)
        steady |= self.flop("DS", self.timers["DS"]("DS" in on, time, now), reset)
        limited = self.flop("SL", "SL" in on, reset)
        steady |= limited and not self.timers["SL"](limited, time, now)
        if not limited:
            self.timers["SL"](False, time, now)
        pulse = ("P1" in on and not self.last["P1"]) or ("P0" not in on and self.last["P0"])
        steady, pulse = steady and not reset, pulse and not reset
        self.active, self.run = steady or pulse, steady or pulse or self.before
        self.before = steady
        self.last = {name: name in on for name in self.last}


class Interpreter:
    def __init__(self, chart):
        self.chart = chart
        self.active, self.entered = set(), {}
        self.times = [0] * len(chart.steps)
        self.variables = [False] * len(chart.actions)
        self.hash = 0
        self.tip = self.quit = False  # at the last call
        self.error, self.wrong = False, None  # SFCError, and the step that it is about
        self.clear()

    def clear(self):
        self.controls = [Control() for _ in self.chart.actions]
        self.variables = [False] * len(self.chart.actions)

    def fold(self, value):
        self.hash = (self.hash * 31 + value) % MODULUS

    def holds(self, condition, bits, tipped):
        if tipped is not None:
            return tipped
        kind = condition[0]
        if kind == "bit":
            return bool(bits >> condition[1] & 1)
        if kind == "time":
            return self.times[condition[1]] >= condition[2]
        return kind == "true" or condition[1] in self.active or bool(bits >> condition[2] & 1)

    def fire(self, bits, tipped):
        """The steps that are left, and those that are entered"""
        left, entered = set(), set()
        ranked = sorted(self.chart.transitions, key=lambda one: float("inf") if one[2] is None else one[2])
        for source, target, _, condition in ranked:
            if self.active.issuperset(source) and left.isdisjoint(source) and self.holds(condition, bits, tipped):
                left.update(source)
                entered.update(target)
        return left, entered

    def change(self, left, entered, now):
        self.active = (self.active - left) | entered
        for step in entered:
            self.entered[step], self.times[step] = now, 0

    def watch(self, left):
        for step in sorted(self.active):
            least, greatest = self.chart.limits[step]
            late = greatest and self.times[step] > greatest
            if (late or (step in left and least is not None and self.times[step] < least)) and not self.error:
                self.error, self.wrong = True, step

    def quits(self, bits, now):
        """SFCQuitError, which is also given back"""
        if not self.chart.watched:
            return False
        stop = bool(bits >> 5 & bits >> 6 & bits >> 4 & 1)
        if stop:
            self.error, self.wrong = False, None
        elif self.quit:
            self.change(set(), set(self.active), now)
        self.quit = stop
        return stop

    def call(self, bits, now):
        flags = self.chart.flags
        init, reset, pause = (flags and bool(bits >> a & bits >> b & (bits >> c) & 1)
                              for a, b, c in ((12, 13, 3), (13, 14, 2), (14, 15, 15)))
        tip = bool(bits >> 9 & 1)
        tipped = tip and not self.tip if flags and bits >> 10 & 1 else None
        self.tip = tip
        stop = self.quits(bits, now)
        pause = pause or stop
        again = not self.active or init or reset
        if again or not pause:
            for step in self.active:
                self.times[step] = now - self.entered[step]
        if again:
            if init or reset:
                pause = False  # the flags themselves become FALSE
                self.error, self.wrong = False, None
            self.change(set(self.active), {self.chart.initial}, now)
            self.clear()
        elif not pause:
            left, entered = self.fire(bits, tipped)
            if self.chart.watched and bits & 0x180:
                self.watch(left)
            self.change(left, entered, now)
        if not init and not pause:
            self.act(now)

    def act(self, now):
        used = list(dict.fromkeys(action for step in self.chart.steps for action, _ in step))
        for action in used:
            on = {qualifier for i in self.active for one, qualifier in self.chart.steps[i] if one == action}
            self.controls[action](on, self.chart.actions[action][1], now)
        for final in (True, False):
            for action in used:
                control = self.controls[action]
                if self.chart.actions[action][0] == "variable":
                    self.variables[action] = control.active
                elif control.run and control.active != final:
                    self.fold(2 * action + (not final))

    def see(self):
        for step in range(len(self.chart.steps)):
            self.fold((step in self.active) + self.times[step] * 2)
        for action, (kind, _) in enumerate(self.chart.actions):
            if kind == "variable":
                self.fold(self.variables[action])
        if self.chart.watched:
            self.fold(self.error)
            self.fold(777 if self.wrong is None else self.wrong)
            self.fold(self.wrong is not None)


def program(charts, seed):
    out = ["PROGRAM PLC_PRG", "VAR", f"  seed : ULINT := {seed}; bits : WORD;"]
    out += [f"  c{chart.number} : Chart{chart.number};" for chart in charts]
    out += ["END_VAR", "seed := (seed * 1103515245 + 12345) MOD 2147483648;", "bits := ULINT_TO_WORD((seed / 4096) MOD 65536);"]
    for chart in charts:
        out += chart.call()
    return out + ["END_PROGRAM"]


def expected(charts, seed):
    found = [Interpreter(chart) for chart in charts]
    for cycle in range(CYCLES):
        seed = (seed * 1103515245 + 12345) % 2147483648
        bits = seed // 4096 % 65536
        for one in found:
            if bits >> 1 & bits >> 2 & 1:
                one.error = False  # by the program
            if not one.chart.skips or bits >> 11 & 1:
                one.call(bits, cycle * CYCLE_MS)
            one.see()
    return [one.hash for one in found]


def through_plcopen(options, source):
    """The project that the program becomes as PLCopen XML and back, or None with what went wrong."""
    xml, project = source.with_suffix(".xml"), source.with_suffix("")
    for arguments in (["export", "plcopen", source.name, "-o", xml.name, "-W", "off=all-warnings"],
                      ["import", xml.name, "-o", project.name, "--force"]):
        done = subprocess.run([options.stride, *arguments], capture_output=True, text=True, check=False, cwd=source.parent)
        if done.returncode != 0:
            print(f"{source}: {' '.join(arguments)}\n{done.stdout}{errors(done.stderr)}")
            return None
    if "INITIAL_STEP" in xml.read_text(encoding="utf-8"):
        print(f"{xml}: a chart is text")
        return None
    xml.unlink()
    return project


def check(options, number):
    chance = random.Random(number)
    charts = [Chart(chance, i) for i in range(CHARTS)]
    seed = chance.randrange(1, 2**31)
    lines = [line for chart in charts for line in chart.text()] + program(charts, seed)
    source = options.keep / f"charts{number}.st"
    source.write_text("\n".join(lines) + "\n", encoding="utf-8")
    simulated = through_plcopen(options, source) if options.plcopen else source
    if simulated is None:
        return False
    shown = ",".join(f"PLC_PRG.c{i}.hash" for i in range(CHARTS))
    result = subprocess.run([options.stride, "sim", simulated.name, "--for", f"T#{CYCLES * CYCLE_MS}ms", "--print", shown,
                             "-W", "off=lints"], capture_output=True, text=True, check=False, cwd=source.parent)
    found = dict(line.split(" = ", 1) for line in result.stdout.splitlines() if " = " in line)
    wrong = [i for i, value in enumerate(expected(charts, seed)) if found.get(f"PLC_PRG.c{i}.hash") != str(value)]
    if result.returncode == 0 and not wrong:
        source.unlink()
        if options.plcopen:
            shutil.rmtree(simulated)
        return True
    print(f"{source}: the charts {wrong} disagree\n{errors(result.stderr)}")
    return False


def errors(text):
    """The errors among all that was printed"""
    return "\n".join(part for part in text.split("\n\n") if part.startswith(("error", "stride")))[:2000]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stride", type=lambda text: str(pathlib.Path(text).resolve()))
    parser.add_argument("--seeds", default="1..3")
    parser.add_argument("--plcopen", action="store_true", help="run what comes back of an export to PLCopen XML")
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path(tempfile.gettempdir()))
    options = parser.parse_args()
    first, _, last = options.seeds.partition("..")
    seeds = range(int(first), int(last or first) + 1)
    good = [check(options, seed) for seed in seeds]
    print(f"{sum(good) * CHARTS} charts agree")
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
