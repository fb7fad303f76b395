"""Online changes under motion: builds of the same moving project with random edits take over, in simulation and by the real
clock. The axes must do what they do without a change, bit for bit; values survive; every change is answered."""
import random
import shutil
import signal
import time

import client
import invariants
import motion
from frame import wait_until


def play(round_):
    rng = round_.rng
    project = motion.MotionProject(rng, interval_ms=rng.choice([2, 4, 5, 10]))
    round_.choose("axes", [a.kind for a in project.axes])
    round_.choose("interval_ms", project.interval_ms)
    {"virtual": simulated, "real": by_the_clock, "to and fro": to_and_fro}[round_.choose("how", rng.choice(["virtual", "real", "real", "to and fro"]))](round_, project)


def reference(round_, project, app, cycles):
    """The trace of the first build, without any change"""
    out = round_.folder / "reference.csv"
    ran = round_.host("sim", app, "--for", f"{cycles * project.interval_ms}ms", "--quiet", "--trace", ",".join(project.columns()), "--out", out)
    round_.demand(ran.code == 0, f"the simulation fails: {ran.err[-800:]}")
    round_.counts["cycles_simulated"] += cycles
    return invariants.read_trace(out)


def simulated(round_, project):
    rng = round_.rng
    seconds = 2 if round_.quick else round_.choose("seconds", rng.randint(5, 60))
    changes = 1 if round_.quick else round_.choose("changes", rng.randint(1, 5))
    folder = round_.folder / "project"
    builds = []
    for number in range(changes + 1):
        round_.build(project.write(folder), *(["--debug"] if rng.random() < 0.3 else []))
        builds.append(round_.folder / f"app{number}.so")
        shutil.copy(folder / "build" / "app.so", builds[-1])
        project.settled()
        for _ in range(rng.randint(1, 4)):
            round_.note(f"edit: {project.edit()}")
    times = sorted(rng.sample(range(1, seconds * 1000), changes))
    # Changes in the same cycle would skip a build, and with it a renaming.
    times = [t - t % project.interval_ms + i * project.interval_ms for i, t in enumerate(times)]
    options = []
    for at, app in zip(times, builds[1:]):
        options += ["--change", f"{at}ms,{app}"]
    out = round_.folder / "changed.csv"
    movers = ",".join(f"PLC_PRG.m{a.name}" for a in project.axes)
    ran = round_.host("sim", builds[0], "--for", f"{seconds * 1000}ms", "--quiet", "--trace", ",".join(project.columns()), "--out", out,
                      "--print", f"{movers},GVL.cycles,GVL.triple", *options)
    round_.demand(ran.code == 0, f"the simulation with changes fails (exit code {ran.code}): {ran.err[-1500:]}")
    round_.counts["changes"] += changes
    cycles = seconds * 1000 // project.interval_ms
    changed = invariants.read_trace(out)
    same = invariants.same_course(round_, changed, reference(round_, project, builds[0], cycles), "simulated change")
    round_.expect(same >= cycles - 1, f"only {same} of {cycles} cycles are in both traces")
    values = invariants.printed(ran.out)
    round_.expect(int(values["GVL.triple"]) == 3 * int(values["GVL.cycles"]), f"counters do not agree: {values['GVL.cycles']}, {values['GVL.triple']}")
    invariants.movers_within_limits(round_, project, values, "simulated change")
    round_.counts["cycles_simulated"] += cycles


class Live:
    """A run by the real clock that is changed again and again."""

    def __init__(self, round_, project):
        self.round, self.project = round_, project
        self.folder = round_.folder / "project"
        round_.build(project.write(self.folder))
        self.first = round_.folder / "first.so"
        shutil.copy(self.folder / "build" / "app.so", self.first)
        self.trace = round_.folder / "run.csv"
        self.process = round_.start(round_.settings.product.host, "run", self.folder / "build" / "app.so", "--listen", "unix:plc.sock", "--trace",
                                    ",".join(project.columns()), "--out", self.trace, name="run")
        self.client = client.connect(round_.folder / "plc.sock", self.process)
        self.client.write(**{f"GVL.{k.name}": k.literal for k in project.kept})
        self.cycles = 0

    def version(self):
        return self.client.read("GVL.version")["GVL.version"]

    def build(self):
        """Of the sources as they are; signals to change may come at any moment of it."""
        options = ["--debug"] if self.round.rng.random() < 0.3 else []
        self.project.write(self.folder)
        if self.round.rng.random() < 0.7:
            self.round.build(self.folder, *options)
            return
        building = self.round.start(self.round.settings.product.stride, "build", self.folder, "-W", "off=lints", *options)
        pauses = random.Random(self.round.rng.getrandbits(64))  # how many are needed depends on the time
        while building.alive():
            time.sleep(pauses.uniform(0, 0.05))
            self.process.signal(signal.SIGHUP)
        building.finish(1)
        self.round.demand(building.code == 0, f"a build beside a run fails: {building.err[-1500:]}")

    def refused(self):
        """A build that cannot take over: the old one goes on."""
        manifest = self.project.write(self.folder) / "stride.toml"
        text = manifest.read_text(encoding="utf-8")
        manifest.write_text(text.replace("priority = 1", "priority = 2"), encoding="utf-8")
        self.round.build(self.folder)
        before = self.version()
        answer = self.client.ask("online_change")["applications"]
        self.round.expect(answer[0]["result"] == "refused", f"a change of the tasks was not refused: {answer}")
        self.round.expect(self.version() == before, "a refused change has taken over")
        self.round.counts["refused_changes"] += 1
        self.check_values()

    def change(self):
        """Some edits, a build, and one way to make the run look at it."""
        rng = self.round.rng
        for _ in range(rng.randint(1, 4)):
            self.round.note(f"edit: {self.project.edit()}")
        self.build()
        how = rng.choice(["SIGHUP", "storm", "request", "ctl"])
        self.round.note(f"change by {how}")
        if how == "request":
            answer = self.client.ask("online_change")["applications"]
            self.round.expect(answer[0]["result"] == "done", f"the change was refused: {answer[0]['report']}")
        elif how == "ctl":
            asked = self.round.stride("ctl", "unix:plc.sock", "change", timeout=120)
            self.round.expect(asked.code == 0, f"`stride ctl change` fails: {asked.out} {asked.err}")
        else:
            for _ in range(1 if how == "SIGHUP" else rng.randint(2, 30)):
                self.process.signal(signal.SIGHUP)
        taken = wait_until(lambda: not self.process.alive() or self.version() == self.project.version, 120)
        self.round.demand(taken and self.process.alive(), f"the change by {how} did not happen: {self.process.err[-1500:]}")
        self.project.settled()
        self.round.counts["changes"] += 1
        self.check_values()

    def check_values(self):
        names = [f"GVL.{k.name}" for k in self.project.kept]
        values = self.client.read(*names, "GVL.cycles", "GVL.triple", literals=True)
        for kept in self.project.kept:
            self.round.expect(values[f"GVL.{kept.name}"] == kept.literal, f"GVL.{kept.name} was {kept.literal} and is {values[f'GVL.{kept.name}']}")
        cycles = int(values["GVL.cycles"])
        self.round.expect(cycles > self.cycles and int(values["GVL.triple"]) == 3 * cycles,
                          f"counters do not agree: {cycles} after {self.cycles}, {values['GVL.triple']}")
        self.cycles = cycles


def by_the_clock(round_, project):
    live = Live(round_, project)
    refused = False
    for _ in range(1 if round_.quick else round_.choose("changes", round_.rng.randint(1, 8))):
        live.change()
        if round_.rng.random() < 0.2:
            live.refused()
            refused = True
    finish(round_, project, live, refused)


def to_and_fro(round_, project):
    """Two builds that take over from each other many times: nothing grows."""
    live = Live(round_, project)
    builds = [live.first]
    for _ in range(5):
        round_.note(f"edit: {project.edit(both_ways=True)}")
    round_.build(project.write(live.folder))
    builds.append(round_.folder / "second.so")
    shutil.copy(live.folder / "build" / "app.so", builds[1])
    count = 4 if round_.quick else round_.choose("changes", round_.rng.choice([50, 100, 300]))
    sizes = []
    for number in range(count):
        fresh = live.folder / "build" / "fresh.so"
        shutil.copy(builds[(number + 1) % 2], fresh)
        fresh.replace(live.folder / "build" / "app.so")
        answer = live.client.ask("online_change")["applications"][0]
        round_.demand(answer["result"] == "done", f"change {number} was refused: {answer['report']}")
        if number % 10 == 9:
            live.check_values()
            sizes.append((invariants.resident_kib(live.process.pid), invariants.mappings(live.process.pid), invariants.descriptors(live.process.pid)))
    round_.counts["changes"] += count
    if len(sizes) > 4:
        began, ended = sizes[1], sizes[-1]
        round_.expect(ended[0] - began[0] < 20_000 and ended[1] - began[1] < 20 and ended[2] == began[2],
                      f"after 20 changes {began} KiB, mappings, descriptors; after {count} {ended}")
    finish(round_, project, live)


def finish(round_, project, live, refused=False):
    live.client.close()
    live.process.stop()
    said = live.process.err
    round_.demand(live.process.code == 0, f"the run ends with exit code {live.process.code}: {said[-1500:]}")
    refusal = "error: online change refused, the application must be started anew"
    unexpected = [line for line in said.splitlines() if line.startswith("error") and not (refused and line == refusal)]
    round_.expect(not unexpected, f"the run says {unexpected[:5]}")
    traced = invariants.read_trace(live.trace)
    last = int(traced[1][-1][1])
    same = invariants.same_course(round_, traced, reference(round_, project, live.first, last + 1), "change by the real clock")
    round_.expect(same > 0, "no cycle was traced")
    invariants.steps_within_limits(round_, project, traced, "change by the real clock")
    round_.counts["cycles_run"] += last
