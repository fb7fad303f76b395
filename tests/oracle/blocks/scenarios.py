"""The sequences of inputs of the timing tables, by hand and at random (with fixed seeds)."""
import dataclasses
import math
import random
import struct
from fractions import Fraction

import models as m

WRAP = 2**32  # ms: TIME() is back at 0
DAY = 86_400_000


@dataclasses.dataclass
class Block:
    name: str
    about: list
    inputs: list
    outputs: list
    model: object
    scenarios: list
    call: str = "block"
    local: list = dataclasses.field(default_factory=list)
    tolerance: dict = dataclasses.field(default_factory=dict)


def pins(text):
    return [tuple(pin.split(":")) for pin in text.split()]


def single(x):
    """The REAL nearest to a number."""
    x = float(x)
    return Fraction(struct.unpack("<f", struct.pack("<f", x))[0]) if math.isfinite(x) else x


def steps(times, **columns):
    """Rows at these times: a column is a constant, a list, a text of `.` and `#`, or a function of the row's number."""
    rows = []
    for i, t in enumerate(times):
        row = {}
        for name, value in columns.items():
            name = name.replace("__", "].").replace("_at_", "[")
            if isinstance(value, str):
                value = value.replace(" ", "")[i] == "#"
            elif isinstance(value, (list, tuple)):
                value = value[i]
            elif callable(value):
                value = value(i)
            row[name] = single(value) if isinstance(value, float) else value
        rows.append((t, row))
    return rows


def every(ms, count, start=0):
    return [start + ms * i for i in range(count)]


def irregular(rng, count, longest, start=0):
    t, times = start, []
    for _ in range(count):
        times.append(t)
        t += rng.choice([1, rng.randint(1, longest), rng.randint(1, longest)])
    return times


def held(rng, count, make, mean=6):
    """Values that stay for a while."""
    values, value = [], make()
    for _ in range(count):
        if rng.random() < 1 / mean:
            value = make()
        values.append(value)
    return values


def flags(rng, count, mean=4):
    return held(rng, count, lambda: rng.random() < 0.5, mean)


# ---- Standard

def edges():
    rng = random.Random(1)
    for name, about in (("R_TRIG", "One call at each rising edge; TRUE at first is one."),
                        ("F_TRIG", "One call at each falling edge; FALSE at first is one.")):
        yield Block(name, [f"{name}: {about}"], pins("CLK:BOOL"), pins("Q:BOOL"), getattr(m, name),
                    [("TRUE from the beginning", steps(every(10, 8), CLK="###..#.#")),
                     ("FALSE at the beginning", steps(every(10, 8), CLK="..##.#..")),
                     ("at random", steps(every(1, 80), CLK=flags(rng, 80, 2)))])
    for name, strong, weak in (("SR", "SET1", "RESET"), ("RS", "RESET1", "SET")):
        yield Block(name, [f"{name}: {strong} is stronger than {weak}."], pins(f"{strong}:BOOL {weak}:BOOL"), pins("Q1:BOOL"),
                    getattr(m, name),
                    [("all combinations", steps(every(10, 10), **{strong: ".#..#.##..", weak: "...##.#.#."})),
                     ("at random", steps(every(1, 80), **{strong: flags(rng, 80), weak: flags(rng, 80)}))])
    yield Block("SEMA", ["SEMA: BUSY is what it was before the call, unless it is released."], pins("CLAIM:BOOL RELEASE:BOOL"),
                pins("BUSY:BOOL"), m.SEMA,
                [("claimed, released, both", steps(every(10, 10), CLAIM=".#..#.##..", RELEASE="...#..#.#.")),
                 ("at random", steps(every(1, 80), CLAIM=flags(rng, 80), RELEASE=flags(rng, 80)))])


def counters():
    rng = random.Random(2)
    for suffix, kind in [("", "WORD")] + [(f"_{k}", k) for k in ("INT", "DINT", "LINT", "UDINT", "ULINT")]:
        low, high = m.LIMITS[kind]
        reset, load = ("R", "LD") if suffix else ("RESET", "LOAD")
        odd = lambda: rng.choice([0, 1, 2, 3, low, low + 1, high, high - 1, rng.randint(low, high)])
        pulses = lambda n: [rng.random() < 0.5 for _ in range(n)]
        rare = lambda n: [rng.random() < 0.08 for _ in range(n)]
        yield Block(f"CTU{suffix}", [f"CTU{suffix}: up to {high}."], pins(f"CU:BOOL {reset}:BOOL PV:{kind} tested.CV:{kind}"),
                    pins(f"Q:BOOL CV:{kind}"),
                    lambda kind=kind, reset=reset: m.Counter(kind, "CU", None, reset, None),
                    [("to 3, reset while CU stays", steps(every(10, 12), CU="#.##.#.#####", PV=3, **{reset: "........##..", "tested.CV": 0})),
                     ("at the upper end", steps(every(10, 12), CU=".#.#.#.#.#.#", PV=high,
                                                **{reset: ".........#..", "tested.CV": [0, 0] + [high - 2] * 10})),
                     ("at random", steps(every(1, 120), CU=pulses(120), PV=held(rng, 120, odd),
                                         **{reset: rare(120), "tested.CV": 0}))])
        yield Block(f"CTD{suffix}", [f"CTD{suffix}: down to {low}."], pins(f"CD:BOOL {load}:BOOL PV:{kind}"), pins(f"Q:BOOL CV:{kind}"),
                    lambda kind=kind, load=load: m.Counter(kind, None, "CD", None, load),
                    [("from 2 down, beyond 0", steps(every(10, 12), CD=".#.#.#.#.###", PV=2, **{load: "#.........#."})),
                     ("at the upper end", steps(every(10, 8), CD=".#.#.#.#", PV=high, **{load: "#......."})),
                     ("at the lower end", steps(every(10, 8), CD=".#.#.#.#", PV=low + 2, **{load: "#......."})),
                     ("at random", steps(every(1, 120), CD=pulses(120), PV=held(rng, 120, odd), **{load: rare(120)}))])
        yield Block(f"CTUD{suffix}", [f"CTUD{suffix}: between {low} and {high}."],
                    pins(f"CU:BOOL CD:BOOL {reset}:BOOL {load}:BOOL PV:{kind}"), pins(f"QU:BOOL QD:BOOL CV:{kind}"),
                    lambda kind=kind, reset=reset, load=load: m.Counter(kind, "CU", "CD", reset, load),
                    [("at the upper end, both at once", steps(every(10, 10), CU=".#.#.#.#..", CD=".....#...#", PV=high - 1,
                                                            **{reset: ".........#", load: "#........."})),
                     ("at random", steps(every(1, 160), CU=pulses(160), CD=pulses(160), PV=held(rng, 160, odd),
                                         **{reset: rare(160), load: rare(160)}))])


def timers():
    about = {"TON": "Q is TRUE when IN has been TRUE for PT.", "TOF": "Q stays TRUE for PT behind IN.",
             "TP": "A rising edge of IN gives a pulse of PT."}
    for base, suffix in [(base, suffix) for suffix in ("", "_TIME") for base in about]:
        if base == "TON":
            rng = random.Random(3)  # the same inputs under both names
        name, text = base + suffix, about[base]
        yield Block(name, [f"{name}: {text} TIMEs in ms."], pins("IN:BOOL PT:TIME"), pins("Q:BOOL ET:TIME"), getattr(m, base), [
            ("PT of 30 ms, and an interruption", steps(every(10, 20), IN=".#####..##.###.#.#..", PT=30)),
            ("PT of 25 ms lies between two calls", steps(every(10, 12), IN="######......", PT=25)),
            ("PT = 0", steps(every(10, 8), IN=".##..#..", PT=0)),
            ("PT changes while the time runs, and afterwards",
             steps(every(10, 14), IN=".######.......", PT=[50, 50, 50, 20, 20, 90, 90, 60, 60, 15, 15, 15, 100, 100])),
            ("the millisecond clock wraps meanwhile", steps(every(10, 16, WRAP - 65), IN="..#########.....", PT=50)),
            ("a day between two calls", steps([0, 5, 5 + DAY, 10 + 2 * DAY, 20 + 2 * DAY], IN=".###.", PT=2 * DAY)),
            ("the longest PT", steps([0, 10, 10 + 40 * DAY, WRAP + 5, WRAP + 9, WRAP + 20], IN="#####.", PT=WRAP - 1)),
            ("at random", steps(irregular(rng, 200, 20), IN=flags(rng, 200, 5), PT=held(rng, 200, lambda: rng.choice([0, 1, rng.randint(0, 60)]), 9))),
            ("at random around the wrap", steps(irregular(rng, 120, 30, WRAP - 900), IN=flags(rng, 120, 7), PT=held(rng, 120, lambda: rng.randint(0, 100), 20))),
        ])
    ms = 1_000_000
    for base in about:
        for name in (f"L{base}", f"{base}_LTIME"):
            yield Block(name, [f"{name}: as {base}; LTIMEs in ns."], pins("IN:BOOL PT:LTIME"), pins("Q:BOOL ET:LTIME"), lambda base=base: m.Wide(getattr(m, base)), [
                ("PT of 30.5 ms, and an interruption", steps(every(10, 20), IN=".#####..##.###.#.#..", PT=30_500_000)),
                ("calls every quarter of a millisecond, PT of 0.6 ms",
                 steps(every(Fraction(1, 4), 18), IN=".####...#.#.######", PT=600_000)),
                ("calls a nanosecond apart", steps(every(Fraction(1, 10**6), 12), IN=".#####.....#", PT=3)),
                ("PT is 0, or negative", steps(every(10, 12), IN=".##..#.##..#", PT=[0] * 6 + [-5] * 6)),
                ("TIME would have wrapped", steps([0, 10, 40 * DAY, 80 * DAY, 100 * DAY + 9, 100 * DAY + 10, 100 * DAY + 20], IN=".#####.", PT=100 * DAY * ms)),
                ("at random", steps(irregular(rng, 120, 20), IN=flags(rng, 120, 5), PT=held(rng, 120, lambda: rng.choice([0, 1, rng.randint(0, 60 * ms)]), 9))),
            ])
    when = 1_000_000_000
    yield Block("RTC", ["RTC: seconds since the rising edge of EN, on top of PDT. DT as seconds since 1970."], pins("EN:BOOL PDT:DT"),
                pins("Q:BOOL CDT:DT"), m.RTC, [
        ("seconds pass between the calls", steps(every(400, 10, 3), EN=".########.", PDT=when)),
        ("PDT counts at the edge only", steps(every(1000, 8), EN="##.###.#", PDT=[5, 6, 7, 8, 9, 10, 11, 12])),
        ("DT wraps in 2106, the clock in between", steps(every(700, 12, WRAP - 4000), EN=True, PDT=2**32 - 3)),
        ("months", steps([0, 40 * DAY, 80 * DAY + 999, 120 * DAY], EN=True, PDT=0)),
        ("at random", steps(irregular(rng, 120, 900), EN=flags(rng, 120, 12), PDT=held(rng, 120, lambda: rng.randint(0, 2**32 - 1)))),
    ])


# ---- Util: signals

def signals():
    rng = random.Random(4)
    yield Block("BLINK", ["BLINK: TRUE for TIMEHIGH, FALSE for TIMELOW, from the edge of ENABLE on. TIMEs in ms."],
                pins("ENABLE:BOOL TIMELOW:TIME TIMEHIGH:TIME"), pins("OUT:BOOL"), m.BLINK, [
        ("30 ms TRUE, 20 ms FALSE; frozen while not enabled", steps(every(10, 20), ENABLE=".##########...######", TIMELOW=20, TIMEHIGH=30)),
        ("the calls do not meet the changes", steps(every(10, 20), ENABLE=True, TIMELOW=25, TIMEHIGH=25)),
        ("one time is 0", steps(every(10, 12), ENABLE=True, TIMELOW=[0] * 6 + [20] * 6, TIMEHIGH=[20] * 6 + [0] * 6)),
        ("both are 0", steps(every(10, 4), ENABLE=True, TIMELOW=0, TIMEHIGH=0)),
        ("the times change", steps(every(10, 14), ENABLE=True, TIMELOW=[30] * 7 + [10] * 7, TIMEHIGH=[40, 40, 40, 15, 15, 15, 15] + [20] * 7)),
        ("the clock wraps", steps(every(10, 16, WRAP - 75), ENABLE=True, TIMELOW=30, TIMEHIGH=20)),
        ("the longest times", steps([0, 40 * DAY, WRAP - 2, WRAP - 1, WRAP + 40 * DAY, 2 * WRAP - 3, 2 * WRAP - 2], ENABLE=True, TIMELOW=WRAP - 1, TIMEHIGH=WRAP - 1)),
        ("at random", steps(irregular(rng, 200, 40), ENABLE=flags(rng, 200, 25), TIMELOW=held(rng, 200, lambda: rng.randint(0, 50), 15),
                            TIMEHIGH=held(rng, 200, lambda: rng.randint(0, 50), 15))),
        ("at random, days apart", steps(irregular(rng, 60, 10 * DAY), ENABLE=flags(rng, 60, 25), TIMELOW=held(rng, 60, lambda: rng.randint(1, WRAP - 1), 15),
                                        TIMEHIGH=held(rng, 60, lambda: rng.randint(1, WRAP - 1), 15))),
    ])
    yield Block("FREQ_MEASURE", ["FREQ_MEASURE: mean of the last PERIODS periods."], pins("IN:BOOL PERIODS:INT RESET:BOOL"),
                pins("OUT:REAL VALID:BOOL"), m.FREQ_MEASURE, [
        ("periods of 20 ms, then 40 ms", steps(every(10, 20), IN="#.#.#.#.##..##..##..", PERIODS=1, RESET=False)),
        ("mean of three", steps(every(10, 24), IN=".#.#.#..#...#.#.#.#.#.#.", PERIODS=3, RESET=False)),
        ("no edge for more than three periods", steps(every(10, 22), IN=".#.#............#..#..#.", PERIODS=1, RESET=False)),
        ("reset", steps(every(10, 14), IN=".#.#.#.##.#.#.", PERIODS=1, RESET="......##......")),
        ("the clock wraps", steps(every(10, 14, WRAP - 65), IN=".#.#.#.#.#.#.#", PERIODS=2, RESET=False)),
        ("PERIODS changes", steps(every(10, 30), IN=lambda i: i % 2 == 1, PERIODS=lambda i: i // 6 + 1, RESET=False)),
        ("at random", steps(irregular(rng, 250, 25), IN=flags(rng, 250, 2), PERIODS=held(rng, 250, lambda: rng.randint(1, 10), 40),
                            RESET=[rng.random() < 0.02 for _ in range(250)])),
    ], tolerance={"OUT": (2e-7, 0)})
    modes = []
    for mode, name in enumerate(("TRIANGLE", "TRIANGLE_POS", "SAWTOOTH_RISE", "SAWTOOTH_FALL", "RECTANGLE", "SINUS", "COSINUS", "SINE", "COSINE")):
        modes.append((f"{name}, 12 calls", steps(every(10, 15), MODE=mode, BASE=False, PERIOD=1000, CYCLES=12, AMPLITUDE=100, RESET=False)))
        modes.append((f"{name}, 70 ms", steps(every(10, 10), MODE=mode, BASE=True, PERIOD=70, CYCLES=1000, AMPLITUDE=-1234, RESET=False)))
    count = 220
    yield Block("GEN", ["GEN: MODE is the number of the enumerator of GEN_MODE; PERIOD in ms."],
                pins("MODE:GEN_MODE BASE:BOOL PERIOD:TIME CYCLES:INT AMPLITUDE:INT RESET:BOOL"), pins("OUT:INT"), m.GEN, modes + [
        ("reset, and periods of nothing", steps(every(10, 12), MODE=2, BASE="......######", PERIOD=[40] * 9 + [0] * 3, CYCLES=[5] * 4 + [0, -3] + [5] * 6, AMPLITUDE=10, RESET="..#.....#...")),
        ("the largest amplitudes", steps(every(10, 8), MODE=[0, 3, 4, 2, 0, 3, 4, 2], BASE=False, PERIOD=1000, CYCLES=4, AMPLITUDE=[32767] * 4 + [-32768] * 4, RESET=False)),
        ("the clock wraps", steps(every(10, 14, WRAP - 65), MODE=2, BASE=True, PERIOD=60, CYCLES=1, AMPLITUDE=60, RESET=False)),
        ("at random", steps(irregular(rng, count, 30), MODE=held(rng, count, lambda: rng.randint(0, 4)), BASE=flags(rng, count, 20), PERIOD=held(rng, count, lambda: rng.randint(1, 300), 30),
                            CYCLES=held(rng, count, lambda: rng.randint(1, 40), 30), AMPLITUDE=held(rng, count, lambda: rng.randint(-32768, 32767), 9), RESET=[rng.random() < 0.02 for _ in range(count)])),
    ])


# ---- Util: curves, ramps

def curves():
    rng = random.Random(5)
    names = [f"P[{i}].{c}" for i in range(11) for c in "XY"]
    def curve(points, **more):
        flat = dict(zip(names, [0] * 22))
        for i, (x, y) in enumerate(points):
            flat[f"P[{i}].X"], flat[f"P[{i}].Y"] = x, y
        return flat
    def rows(points, values, n):
        return [(10 * i, {"IN": v, "N": n[i] if isinstance(n, list) else n, **curve(points)}) for i, v in enumerate(values)]
    manual = [(0, 0), (250, 50), (500, 150), (750, 400), (1000, 1000)]
    wide = [(-32768, 32767), (0, -32768), (32767, 32767)]
    scenarios = [
        ("five points", rows(manual, [-1, 0, 1, 2, 3, 125, 250, 251, 499, 500, 875, 999, 1000, 1001], 5)),
        ("over all of INT", rows(wide, [-32768, -32767, -16384, -1, 0, 1, 16383, 32766, 32767], 3)),
        ("wrong numbers of points", rows(manual, [125] * 6, [5, 1, 0, 12, 255, 2])),
        ("X not ascending", rows([(0, 0), (10, 100), (10, 50), (20, 0)], [5, 5, 15, 15], [2, 3, 4, 2])),
    ]
    for number in range(6):
        n = rng.randint(2, 11)
        xs = sorted(rng.sample(range(-32768, 32768), n))
        points = [(x, rng.randint(-32768, 32767)) for x in xs]
        values = [rng.choice(xs) + rng.choice([-1, 0, 1]) if rng.random() < 0.4 else rng.randint(-32768, 32767) for _ in range(30)]
        scenarios.append((f"at random, {number + 1}", rows(points, [min(max(v, -32768), 32767) for v in values], n)))
    yield Block("CHARCURVE", ["CHARCURVE: straight lines between N points."], [("IN", "INT"), ("N", "BYTE")] + [(n, "INT") for n in names],
                pins("OUT:INT ERR:BYTE"), m.CHARCURVE, scenarios, call="block P", local=[("P", "ARRAY[0..10] OF POINT")])
    n = 200
    yield Block("RAMP_INT", ["RAMP_INT: follows IN with limited slopes. TIMEBASE in ms; 0: per call."],
                pins("IN:INT ASCEND:INT DESCEND:INT TIMEBASE:TIME RESET:BOOL"), pins("OUT:INT"), m.RAMP_INT, [
        ("per call", steps(every(10, 14), IN=[25] * 6 + [-8] * 8, ASCEND=10, DESCEND=7, TIMEBASE=0, RESET="..##..........")),
        ("25 in 100 ms up, 10 down", steps(every(10, 30), IN=[12] * 12 + [-3] * 18, ASCEND=25, DESCEND=10, TIMEBASE=100, RESET=False)),
        ("slow: 1 in 70 ms", steps(every(30, 12), IN=100, ASCEND=1, DESCEND=1, TIMEBASE=70, RESET=False)),
        ("reset takes no time", steps(every(10, 12), IN=100, ASCEND=50, DESCEND=50, TIMEBASE=100, RESET="....####....")),
        ("the ends of INT", steps(every(10, 10), IN=[32767] * 4 + [-32768] * 6, ASCEND=32767, DESCEND=32767, TIMEBASE=0, RESET=False)),
        ("slopes that are not positive", steps(every(10, 8), IN=[9] * 4 + [-9] * 4, ASCEND=[5, 0, -5, -32768] * 2, DESCEND=[5, 5, 5, 5, 5, 0, -5, -32768], TIMEBASE=0, RESET=False)),
        ("the clock wraps; a late call", steps([WRAP - 20, WRAP - 10, WRAP, WRAP + 10, WRAP + 30 * DAY], IN=32767, ASCEND=100, DESCEND=1, TIMEBASE=100, RESET=False)),
        ("at random", steps(irregular(rng, n, 40), IN=held(rng, n, lambda: rng.randint(-300, 300), 12), ASCEND=held(rng, n, lambda: rng.randint(-3, 60), 20), DESCEND=held(rng, n, lambda: rng.randint(-3, 60), 20),
                            TIMEBASE=held(rng, n, lambda: rng.choice([0, 7, 100, 333]), 25), RESET=[rng.random() < 0.04 for _ in range(n)])),
    ])
    yield Block("RAMP_REAL", ["RAMP_REAL: follows IN with limited slopes. TIMEBASE in ms; 0: per call."],
                pins("IN:REAL ASCEND:REAL DESCEND:REAL TIMEBASE:TIME RESET:BOOL"), pins("OUT:REAL"), m.RAMP_REAL, [
        ("per call", steps(every(10, 14), IN=[2.5] * 6 + [-0.75] * 8, ASCEND=1.0, DESCEND=0.5, TIMEBASE=0, RESET="..##..........")),
        ("10 u/s up, 20 u/s down", steps(every(15, 20), IN=[1.0] * 9 + [-1.0] * 11, ASCEND=10.0, DESCEND=20.0, TIMEBASE=1000, RESET=False)),
        ("steps below the resolution of REAL add up", steps(every(10, 40), IN=[2e7] * 2 + [3e7] * 38, ASCEND=[2e7] * 2 + [0.3] * 38, DESCEND=1.0, TIMEBASE=0, RESET=False)),
        ("no number, infinity", steps(every(10, 9), IN=[1.0, math.nan, math.nan, math.inf, math.inf, -1.0, -1.0, -math.inf, 0.0], ASCEND=2.0, DESCEND=1.5, TIMEBASE=0, RESET=False)),
        ("infinity at once, and back", steps(every(10, 5), IN=[math.inf, math.inf, 1.0, -math.inf, 5.0], ASCEND=3e38, DESCEND=3e38, TIMEBASE=0, RESET=False)),
        ("the clock wraps", steps(every(10, 8, WRAP - 35), IN=5.0, ASCEND=10.0, DESCEND=1.0, TIMEBASE=100, RESET=False)),
        ("at random", steps(irregular(rng, n, 40), IN=held(rng, n, lambda: rng.uniform(-30, 30), 12), ASCEND=held(rng, n, lambda: rng.uniform(-1, 6), 20), DESCEND=held(rng, n, lambda: rng.uniform(-1, 6), 20),
                            TIMEBASE=held(rng, n, lambda: rng.choice([0, 7, 100, 333]), 25), RESET=[rng.random() < 0.04 for _ in range(n)])),
    ], tolerance={"OUT": (2e-7, 1e-6)})


# ---- Util: monitors, mathematics

def mathematics():
    rng = random.Random(6)
    inputs = pins("IN:INT HIGH:INT LOW:INT")
    near = lambda: rng.randint(-6, 6)
    for name, outputs in (("HYSTERESIS", "OUT:BOOL"), ("LIMITALARM", "O:BOOL U:BOOL IL:BOOL")):
        yield Block(name, [f"{name}: at the limits themselves nothing switches."], inputs, pins(outputs), getattr(m, name), [
            ("up and down through both limits", steps(every(10, 16), IN=[0, 4, 5, 6, 10, 11, 9, 6, 5, 4, 5, 9, 10, 11, 10, 5], HIGH=10, LOW=5)),
            ("the ends of INT", steps(every(10, 5), IN=[-32768, 32767, -32768, 0, 32767], HIGH=32766, LOW=-32767)),
            ("LOW above HIGH", steps(every(10, 6), IN=[0, 5, 10, 3, 12, 7], HIGH=4, LOW=8)),
            ("at random", steps(every(1, 120), IN=[near() for _ in range(120)], HIGH=held(rng, 120, near, 20), LOW=held(rng, 120, near, 20)))])
    u = lambda k: rng.uniform(-k, k)
    nan, inf = math.nan, math.inf
    yield Block("LIN_TRAFO", ["LIN_TRAFO: IN_MIN … IN_MAX becomes OUT_MIN … OUT_MAX."], pins("IN:REAL IN_MIN:REAL IN_MAX:REAL OUT_MIN:REAL OUT_MAX:REAL"),
                pins("OUT:REAL ERROR:BOOL"), m.LIN_TRAFO, [
        ("volts to degrees", steps(every(10, 7), IN=[-0.001, 0.0, 2.5, 5.0, 10.0, 10.001, nan], IN_MIN=0.0, IN_MAX=10.0, OUT_MIN=-20.0, OUT_MAX=40.0)),
        ("falling; empty and reversed ranges", steps(every(10, 5), IN=[1.0, 3.0, 2.0, 2.0, 2.0], IN_MIN=[1.0, 1.0, 1.0, 2.0, 3.0], IN_MAX=[3.0, 3.0, 3.0, 2.0, 1.0], OUT_MIN=100.0, OUT_MAX=-100.0)),
        ("the largest numbers", steps(every(10, 4), IN=[-3e38, 0.0, 3e38, inf], IN_MIN=-3e38, IN_MAX=3e38, OUT_MIN=3e38, OUT_MAX=-3e38)),
        ("at random", steps(every(1, 100), IN=[u(10) for _ in range(100)], IN_MIN=held(rng, 100, lambda: u(10) - 5), IN_MAX=held(rng, 100, lambda: u(10) + 5), OUT_MIN=held(rng, 100, lambda: u(1000)), OUT_MAX=held(rng, 100, lambda: u(1000)))),
    ], tolerance={"OUT": (2e-7, 1e-4)})
    n = 120
    yield Block("DERIVATIVE", ["DERIVATIVE: per second, from four values. TM in ms."], pins("IN:REAL TM:DWORD RESET:BOOL"), pins("OUT:REAL"), m.DERIVATIVE, [
        ("a straight line is exact from the second call on", steps(every(10, 8), IN=lambda i: 3.0 + 0.5 * i, TM=10, RESET=False)),
        ("a parabola; uneven times", steps([0, 10, 30, 40, 70, 80, 100], IN=[0.0, 1.0, 9.0, 16.0, 49.0, 64.0, 100.0], TM=[0, 10, 20, 10, 30, 10, 20], RESET=False)),
        ("a jump passes in four calls; reset", steps(every(10, 12), IN=[0.0] * 2 + [1.0] * 6 + [5.0] * 4, TM=10, RESET="........#...")),
        ("TM = 0, and the longest", steps(every(10, 5), IN=[1.0, 2.0, 3.0, 4.0, 5.0], TM=[0, 0, 1000, 2**32 - 1, 2**32 - 1], RESET=False)),
        ("no number passes in four calls", steps(every(10, 9), IN=[1.0, 2.0, nan, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0], TM=10, RESET=False)),
        ("at random", steps(every(1, n), IN=[u(100) for _ in range(n)], TM=[rng.randint(0, 50) for _ in range(n)], RESET=[rng.random() < 0.03 for _ in range(n)])),
    ], tolerance={"OUT": (1e-6, 1e-6)})
    yield Block("INTEGRAL", ["INTEGRAL: over seconds, by trapezoids. TM in ms."], pins("IN:REAL TM:DWORD RESET:BOOL"), pins("OUT:REAL OVERFLOW:BOOL"), m.INTEGRAL, [
        ("a constant, a line", steps(every(10, 10), IN=[2.0] * 4 + [3.0, 4.0, 5.0, 5.0, 0.0, 0.0], TM=100, RESET=False)),
        ("reset begins with IN", steps(every(10, 6), IN=[1.0, 1.0, 4.0, 4.0, 4.0, 2.0], TM=1000, RESET="..#...")),
        ("overflow stays until reset", steps(every(10, 7), IN=[3e38, 3e38, 3e38, 1.0, 1.0, 1.0, 1.0], TM=[0, 1000, 1000, 1000, 1000, 1000, 1000], RESET=".....#.")),
        ("no number is an overflow", steps(every(10, 6), IN=[1.0, nan, 1.0, 1.0, 2.0, inf], TM=1000, RESET="...#..")),
        ("small parts add up", steps(every(10, 40), IN=[1e7] + [0.5] * 39, TM=[0, 1000] + [100] * 38, RESET=False)),
        ("at random", steps(every(1, n), IN=[u(100) for _ in range(n)], TM=[rng.randint(0, 5000) for _ in range(n)], RESET=[rng.random() < 0.03 for _ in range(n)])),
    ], tolerance={"OUT": (2e-7, 1e-6)})
    i16 = lambda: rng.choice([rng.randint(-32768, 32767), rng.randint(-9, 9), 32767, -32768])
    yield Block("STATISTICS_INT", ["STATISTICS_INT: AVG is cut towards 0."], pins("IN:INT RESET:BOOL"), pins("MN:INT MX:INT AVG:INT"), lambda: m.Statistics(True), [
        ("some values, reset, others", steps(every(10, 9), IN=[3, 4, 4, -9, 7, 7, -1, -2, -2], RESET="....##...")),
        ("reset at first; the ends of INT", steps(every(10, 7), IN=[5, 32767, 32767, 32767, -32768, -32768, -32768], RESET="#......")),
        ("at random", steps(every(1, n), IN=[i16() for _ in range(n)], RESET=[rng.random() < 0.03 for _ in range(n)]))])
    yield Block("STATISTICS_REAL", ["STATISTICS_REAL: what is no number spoils AVG only."], pins("IN:REAL RESET:BOOL"), pins("MN:REAL MX:REAL AVG:REAL"), lambda: m.Statistics(False), [
        ("some values, reset, others", steps(every(10, 9), IN=[3.0, 4.0, 4.5, -9.0, 7.0, 7.0, -1.0, -2.0, -2.5], RESET="....##...")),
        ("the largest numbers; no number until reset", steps(every(10, 8), IN=[3.4e38, 3.4e38, -3.4e38, nan, 1.0, 1.0, 1.0, 2.0], RESET=".....#..")),
        ("at random", steps(every(1, n), IN=[u(1e4) for _ in range(n)], RESET=[rng.random() < 0.03 for _ in range(n)]))],
        tolerance={"AVG": (1e-6, 1e-6)})
    yield Block("VARIANCE", ["VARIANCE: mean squared distance from the mean."], pins("IN:REAL RESET:BOOL"), pins("OUT:REAL"), m.VARIANCE, [
        ("some values, reset, others", steps(every(10, 9), IN=[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0, 1.0], RESET="........#")),
        ("large values near to each other", steps(every(10, 8), IN=[1.6e7, 1.6e7 + 2, 1.6e7 + 4, 1.6e7 + 2, 1.6e7, 1.6e7 + 6, 1.6e7 + 2, 1.6e7], RESET=False)),
        ("no number until reset", steps(every(10, 6), IN=[1.0, nan, 2.0, 3.0, 4.0, 6.0], RESET="...#..")),
        ("at random", steps(every(1, n), IN=[u(100) for _ in range(n)], RESET=[rng.random() < 0.03 for _ in range(n)]))],
        tolerance={"OUT": (1e-6, 1e-9)})


# ---- Util: controllers

def controllers():
    rng = random.Random(7)
    nan = math.nan
    for name in ("PD", "PID", "PID_FIXCYCLE"):
        integral, cycle = name != "PD", name == "PID_FIXCYCLE"
        inputs = "ACTUAL:REAL SET_POINT:REAL KP:REAL " + ("TN:REAL " if integral else "") + \
            "TV:REAL Y_MANUAL:REAL Y_OFFSET:REAL Y_MIN:REAL Y_MAX:REAL MANUAL:BOOL RESET:BOOL" + (" CYCLE:REAL" if cycle else "")
        outputs = "Y:REAL LIMITS_ACTIVE:BOOL" + (" OVERFLOW:BOOL" if integral else "")
        def rows(times, TN=0.5, TV=0.0, CYCLE=0.01, KP=2.0, ACTUAL=0.0, SET_POINT=1.0, Y_MANUAL=0.0, Y_OFFSET=0.0, Y_MIN=0.0, Y_MAX=0.0,
                 MANUAL=False, RESET=False, integral=integral, cycle=cycle):
            more = {"TN": TN} if integral else {}
            if cycle:
                more["CYCLE"] = CYCLE
            return steps(times, TV=TV, KP=KP, ACTUAL=ACTUAL, SET_POINT=SET_POINT, Y_MANUAL=Y_MANUAL, Y_OFFSET=Y_OFFSET, Y_MIN=Y_MIN, Y_MAX=Y_MAX,
                         MANUAL=MANUAL, RESET=RESET, **more)
        n = 160
        u = lambda k: rng.uniform(-k, k)
        scenarios = [
            ("a jump of the set point", rows(every(10, 10), SET_POINT=[0.0] * 3 + [1.0] * 7, Y_OFFSET=0.5)),
            ("the same with TV", rows(every(10, 10), SET_POINT=[0.0] * 3 + [1.0] * 7, TV=0.02)),
            ("a ramp", rows(every(10, 10), ACTUAL=lambda i: 0.25 * i, SET_POINT=0.5, TV=0.1, KP=-3.0)),
            ("limits: up, and back at once", rows(every(10, 20), SET_POINT=[1.0] * 10 + [-0.5] * 10, KP=4.0, TN=0.05, Y_MIN=-3.0, Y_MAX=5.0)),
            ("Y_MIN = Y_MAX: no limits", rows(every(10, 4), KP=100.0, Y_MIN=1.0, Y_MAX=1.0)),
            ("manual, and on from there", rows(every(10, 12), SET_POINT=0.25, Y_MANUAL=7.0, MANUAL="...####.....", Y_MIN=-5.0, Y_MAX=8.0)),
            ("reset; manual and reset", rows(every(10, 14), Y_OFFSET=3.0, Y_MANUAL=-2.0, RESET="....##...#....", MANUAL=".........#....", TV=0.01)),
            ("an actual value that is no number", rows(every(10, 10), ACTUAL=[0.0, 0.25, nan, nan, 0.75, 1.0, math.inf, 0.5, 0.5, 0.5], TV=0.01)),
            ("no number at first and while reset", rows(every(10, 8), ACTUAL=[nan, nan, 0.5, 0.5, nan, 0.25, 0.5, 0.5], RESET="....#...")),
            ("KP = 0", rows(every(10, 4), KP=0.0, Y_OFFSET=4.0, Y_MANUAL=9.0, MANUAL=".#..")),
        ]
        if integral:
            scenarios += [
                ("without an integral part", rows(every(10, 6), TN=[0.0, 0.0, -1.0, -1.0, 0.5, 0.5])),
                ("overflow until reset", rows(every(1000, 8), SET_POINT=[3e38] * 4 + [1.0] * 4, TN=1.0, KP=1e-3, CYCLE=1.0, RESET="......#.")),
                ("Y overflows", rows(every(10, 5), SET_POINT=[1.0, 1e30, 1.0, 1.0, 1.0], KP=1e10, RESET="...#.")),
            ]
        if cycle:
            scenarios += [("CYCLE of nothing", rows(every(10, 5), CYCLE=[0.01, 0.0, -1.0, 0.01, 0.02], TV=0.01))]
        else:
            scenarios += [("two calls in one millisecond; late calls", rows([0, 10, 10, 11, 200, 5000], TV=0.01, ACTUAL=[0.0, 0.1, 0.2, 0.3, 0.4, 0.5])),
                          ("the clock wraps", rows(every(10, 8, WRAP - 35), ACTUAL=lambda i: 0.1 * i, TV=0.01))]
        scenarios += [("at random", rows(irregular(rng, n, 30), ACTUAL=[u(2) for _ in range(n)], SET_POINT=held(rng, n, lambda: u(3), 15), KP=held(rng, n, lambda: u(3), 40),
                                         TN=held(rng, n, lambda: rng.uniform(0.05, 3), 40), TV=held(rng, n, lambda: rng.uniform(0, 0.05), 40), Y_MANUAL=held(rng, n, lambda: u(4), 10),
                                         Y_OFFSET=held(rng, n, lambda: u(1), 60), Y_MIN=held(rng, n, lambda: u(8) - 3, 30), Y_MAX=held(rng, n, lambda: u(8) + 3, 30),
                                         MANUAL=[rng.random() < 0.05 for _ in range(n)], RESET=[rng.random() < 0.02 for _ in range(n)], CYCLE=0.0625))]
        yield Block(name, [f"{name}: Y = KP (e + {'1/TN ∫e dt + ' if integral else ''}TV de/dt) + Y_OFFSET within Y_MIN … Y_MAX."], pins(inputs), pins(outputs),
                    lambda integral=integral, cycle=cycle: m.Controller(integral, cycle), scenarios, tolerance={"Y": (2e-6, 2e-6)})


# ---- Util: bits and codes

def codes():
    rng = random.Random(8)
    def pure(name, inputs, outputs, function, rows, about, call="function"):
        ins = pins(inputs)
        count = len(rows)
        return Block(name, [f"{name}: {about}"], ins, pins(outputs), lambda: m.Pure(function),
                     [(f"{count} values", [(i, dict(zip([n for n, _ in ins], row if isinstance(row, tuple) else (row,)))) for i, row in enumerate(rows)])], call=call)
    out = lambda f: lambda p: {"result": f(*p.values())}
    some = {8: list(range(256))}
    for w in (16, 32, 64):
        some[w] = [0, 1, 2, 3, (1 << w) - 1, (1 << w) - 2, 1 << w - 1, (1 << w - 1) - 1] + [rng.getrandbits(w) for _ in range(60)] + [1 << i for i in range(w)]
    for width, kind, pin, digits in ((8, "BYTE", "B", 2), (16, "WORD", "W", 4), (32, "DWORD", "X", 8)):
        bad = (1 << width) - 1
        yield pure(f"{kind}_TO_GRAY", f"{pin}:{kind}", f"result:{kind}", out(lambda x: x ^ x >> 1), some[width], "Gray code.")
        yield pure(f"GRAY_TO_{kind}", f"{pin}:{kind}", f"result:{kind}", out(lambda x, w=width: m.from_gray(x, w)), some[width], "the way back.")
        good = [int(str(rng.randrange(10**digits)), 16) for _ in range(40)]
        yield pure(f"BCD_TO_{kind}", f"{pin}:{kind}", f"result:{kind}", out(lambda x, d=digits, b=bad: m.bcd(x, d, b)), some[width] + good, "BCD digits; all bits set where one is none.")
        yield pure(f"{kind}_TO_BCD", f"{pin}:{kind}", f"result:{kind}", out(lambda x, d=digits, b=bad: m.to_bcd(x, d, b)),
                   some[width] + [10**digits - 1, 10**digits] + [rng.randrange(10**digits) for _ in range(40)], "as BCD digits; all bits set where there are too few.")
        names = [f"B{i}" if width == 8 else f"B{i:02}" for i in range(width)]
        values = [x for x in some[width] if width > 8 or x % 5 < 2][:100]
        bits = [tuple(m.bit(x, i, width) for i in range(width)) for x in values]
        yield pure(f"BIT_AS_{kind}", " ".join(f"{n}:BOOL" for n in names), f"{pin}:{kind}",
                   lambda p, pin=pin: {pin: sum(b << i for i, b in enumerate(p.values()))}, bits, "bits together, the lowest first.", "block")
        split = lambda p, names=names, pin=pin, w=width: {n: m.bit(p[pin], i, w) for i, n in enumerate(names)}
        yield pure(f"{kind}_AS_BIT", f"{pin}:{kind}", " ".join(f"{n}:BOOL" for n in names), split, values, "each bit by itself, the lowest first.", "block")
        if width == 8:
            yield pure("UNPACK", "B:BYTE", " ".join(f"{n}:BOOL" for n in names), split, values, "each bit by itself, the lowest first.", "block")
            yield pure("PACK", " ".join(f"{n}:BOOL" for n in names), "result:BYTE", lambda p: {"result": sum(b << i for i, b in enumerate(p.values()))}, bits, "bits together, the lowest first.")
    yield pure("BCD_TO_INT", "B:BYTE", "result:INT", out(lambda x: m.bcd(x, 2, -1)), some[8], "two BCD digits; -1 where one is none.")
    yield pure("INT_TO_BCD", "I:INT", "result:BYTE", out(lambda x: m.to_bcd(x, 2, 255)), list(range(-3, 103)) + [-32768, 32767], "two BCD digits; 255 where two are too few.")
    where = list(range(34)) + [63, 64, 65, 127, 128, 255]
    pairs = [(x, n) for x in (0, 2**32 - 1, rng.getrandbits(32)) for n in where]
    yield pure("EXTRACT", "X:DWORD N:BYTE", "result:BOOL", out(lambda x, n: m.bit(x, n, 32)), pairs, "bit N; FALSE where there is none.")
    yield pure("GETBIT", "X:LWORD N:BYTE", "result:BOOL", out(lambda x, n: m.bit(x, n, 64)), [(x, n) for x in (2**64 - 1, rng.getrandbits(64)) for n in list(range(34)) + list(range(50, 68)) + [255]], "bit N; FALSE where there is none.")
    yield pure("SWITCHBIT", "X:DWORD N:BYTE", "result:DWORD", out(lambda x, n: x ^ (1 << n if n < 32 else 0)), pairs, "bit N inverted.")
    yield pure("PUTBIT", "X:DWORD N:BYTE B:BOOL", "result:DWORD", out(lambda x, n, b: x if n > 31 else x | 1 << n if b else x & ~(1 << n)), [(x, n, b) for x, n in pairs for b in (False, True)], "bit N set to B.")
    yield pure("BYTE_TO_HEXinASCII", "B:BYTE", "result:WORD", out(lambda x: int.from_bytes(f"{x:02X}".encode(), "big")), some[8], "two hexadecimal digits.")
    hexes = [int.from_bytes(f"{x:02{c}}".encode(), "big") for x in range(0, 256, 5) for c in "xX"]
    odd = [int.from_bytes(a + b, "big") for a in (b"/", b":", b"@", b"G", b"`", b"g", b"\0", b"\xff", b"0", b"F") for b in (b"7", b"a", b" ")]
    yield pure("HEXinASCII_TO_BYTE", "W:WORD", "result:BYTE", out(m.hexadecimal), hexes + odd, "the way back; 0 with other characters.")
    yield pure("WORD_AS_STRING", "W:WORD ORDER:BOOL", "result:STRING(2)", out(m.text_of), [(w, o) for w in (0x4846, 0x4100, 0x0041, 0, 0x2724, 0x6162, 0x7E21) for o in (False, True)], "two characters, the lower byte first.")


def blocks():
    for group in (edges, counters, timers, signals, curves, mathematics, controllers, codes):
        yield from group()
