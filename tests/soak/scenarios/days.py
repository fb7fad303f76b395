"""Hours of virtual time with random motion: two runs, and builds with and without checks and optimisation, end in the same state,
and no set value ever went further than it may."""
import shutil

import invariants
import motion


def play(round_):
    rng = round_.rng
    project = motion.MotionProject(rng, interval_ms=rng.choice([2, 4, 10]))
    round_.choose("axes", [a.kind for a in project.axes])
    cycles = 5000 if round_.quick else round_.choose("cycles", rng.randint(200_000, 2_000_000))
    seconds = cycles * project.interval_ms // 1000
    folder = project.write(round_.folder / "project")
    modes = [[], ["--unchecked"], ["--debug"]]
    ends = {}
    for mode in [[], *rng.sample(modes, 1 if round_.quick else 2)]:
        round_.build(folder, *mode)
        app = round_.folder / f"app{len(ends)}.so"
        shutil.copy(folder / "build" / "app.so", app)
        ran = round_.host("sim", app, "--for", f"{seconds}s", "--quiet", "--state-hash", "--print", "GVL.cycles," + ",".join(f"PLC_PRG.m{a.name}" for a in project.axes))
        round_.demand(ran.code == 0, f"the simulation fails: {ran.err[-1500:]}")
        round_.counts["cycles_simulated"] += cycles
        ends[f"{len(ends)}: {' '.join(mode) or 'plain'}"] = ran.out
        values = invariants.printed(ran.out)
        invariants.movers_within_limits(round_, project, values, "a long simulation")
        for axis in project.axes:
            round_.expect(int(values[f"PLC_PRG.m{axis.name}.moves"]) > seconds // 10, f"{axis.name} hardly moves: {values[f'PLC_PRG.m{axis.name}.moves']} in {seconds} s")
    first = next(iter(ends.values()))
    for name, out in ends.items():
        round_.expect(out == first, f"{name} ends in another state than plain:\n{difference(first, out)}")
    round_.counts["virtual_hours"] += seconds * len(ends) / 3600


def difference(one, other):
    return "\n".join(f"  {a} | {b}" for a, b in zip(one.splitlines(), other.splitlines()) if a != b)[:1500]
