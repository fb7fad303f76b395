"""A small file system that fills up and gets room again at random, below everything that a run or a build writes: retained data,
trace, recording, statistics, the program's files, the project itself. Runs go on; what is written is whole or is not there; with
room again all is as if nothing had been. Mounting needs root; a limit of the size of the run's files comes and goes without."""
import json
import os
import resource
import subprocess
import time

import client
import invariants
import motion
import retained
from frame import wait_until
from scenarios.kills import version_of

WRITER = """PROGRAM Writer
VAR h : DWORD; state : DINT; lines, failed : UDINT; text : STRING(40); name : STRING(20) := 'lines.txt'; END_VAR
CASE state OF
  0:
    h := SysFileOpen(name, 'w');
    IF h <> 0 THEN state := 1; ELSIF SysFileGetError() <> SYSFILE_ERROR.PENDING THEN failed := failed + 1; END_IF
  1:
    text := CONCAT(UDINT_TO_STRING(lines), '$N');
    IF SysFileWrite(h, ADR(text), INT_TO_DINT(LEN(text))) <> 0 THEN lines := lines + 1; ELSE failed := failed + 1; state := 2; END_IF
    IF lines MOD 50 = 0 THEN state := 2; END_IF
  2:
    IF SysFileClose(h) THEN state := 0; ELSIF SysFileGetError() <> SYSFILE_ERROR.PENDING THEN failed := failed + 1; state := 0; END_IF
END_CASE
END_PROGRAM
"""


class Disk:
    """A file system of `kib` KiB in the round's folder"""

    def __init__(self, round_, kib):
        self.round, self.folder = round_, round_.folder / "disk"
        self.folder.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kib}k", "soak", self.folder], check=True)
        round_.at_end(self.remove)
        self.filler = self.folder / "filler"

    def remove(self):
        keep = self.round.folder / "disk-copy"
        self.empty()
        if self.round.violations:
            subprocess.run(["cp", "-a", self.folder, keep], check=False)
        subprocess.run(["umount", "-l", self.folder], check=True)

    def free(self):
        """Bytes"""
        size = os.statvfs(self.folder)
        return size.f_bavail * size.f_frsize

    def fill(self, leave=0):
        """Until so many bytes are left"""
        with open(self.filler, "ab") as file:
            try:
                while (left := self.free() - leave) > 0:
                    os.write(file.fileno(), bytes(min(left, 1 << 16)))
            except OSError:
                pass
        self.round.counts["fills"] += 1

    def empty(self):
        self.filler.unlink(missing_ok=True)

    def below(self, run):
        """`run` works on it."""


class Limit:
    """A folder like any other; the files of the run there may not grow while it is "full"."""

    def __init__(self, round_):
        self.round, self.folder, self.run, self.full = round_, round_.folder / "disk", None, False
        self.folder.mkdir()

    def below(self, run):
        self.run = run

    def set(self, size):
        _, largest = resource.prlimit(self.run.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(self.run.pid, resource.RLIMIT_FSIZE, (largest if size is None else size, largest))
        self.full = size is not None

    def free(self):
        return 0 if self.full else 1 << 30

    def fill(self, leave=0):
        self.set(leave)
        self.round.counts["limits"] += 1

    def empty(self):
        self.set(None)


def play(round_):
    what = round_.choose("what", round_.rng.choice(["run", "run", "build", "limit"]))
    if what == "limit":
        during_a_run(round_, Limit(round_))
    elif not round_.settings.can_mount:
        round_.counts["skipped"] += 1
    elif what == "run":
        during_a_run(round_, Disk(round_, round_.choose("kib", round_.rng.choice([300, 1000, 3000]))))
    else:
        during_builds(round_)


def project_of(round_):
    rng = round_.rng
    project = motion.MotionProject(rng, axes=rng.randint(1, 3), interval_ms=rng.choice([2, 5, 10]))
    rows = round_.choose("rows", rng.choice([1, 100, 2000]))
    project.extra = WRITER + retained.GLOBALS.replace("n : LINT", "number : LINT") + retained.PROGRAM.format(last=rows - 1).replace("GVL.n", "Other.number")
    more = '\n[[task]]\nname = "Slow"\ninterval = "T#20ms"\npriority = 10\nprograms = ["Keeper", "Writer"]\n\n[retain]\nperiod = "T#100ms"\n'
    return project, more


def during_a_run(round_, disk):
    rng = round_.rng
    project, more = project_of(round_)
    folder = project.write(round_.folder / "project", more=more)
    round_.build(folder)
    app = folder / "build" / "app.so"
    for name in ("retain", "files"):
        (disk.folder / name).mkdir()
    retain, trace = disk.folder / "retain" / "Kept", disk.folder / "run.csv"
    what = round_.choose("written", rng.choice(["trace", "recording", "messages"]))
    options = {"trace": ["--trace", ",".join(project.columns()), "--out", trace], "recording": ["--record", disk.folder / "run.rec"], "messages": []}[what]
    run = round_.start(round_.settings.product.host, "run", app, "--retain", retain, "--files", disk.folder / "files", "--listen", "unix:plc.sock", "--statistics",
                       disk.folder / "statistics.json", *options, name="run", place=disk.folder if what == "messages" else None)
    disk.below(run)
    with client.connect(round_.folder / "plc.sock", run) as asking:
        for _ in range(2 if round_.quick else round_.choose("fillings", rng.randint(2, 8))):
            full_for_a_while(round_, disk, run, asking)
        disk.empty()
        saved = recovers(round_, disk, asking, project, traced=what != "messages")
    room = disk.free() > 100_000
    run.stop()
    statistics = disk.folder / "statistics.json"
    if room and round_.expect(statistics.exists(), "with room on the disk the statistics were not written"):
        json.loads(statistics.read_text())
    # 4: all went well, but not everything was written, which the messages say if there was room for them.
    told = "cannot write" in run.err or "could not be written" in run.err or what == "messages"
    round_.expect(run.code == 0 or (run.code == 4 and told), f"the run ends with exit code {run.code}: {run.err[-1500:]}")
    kept = retained.look(round_, app, retain, "after a full disk")
    round_.expect(not saved or (kept or 0) >= saved, f"with room on the disk the retained data were not saved: {kept}, it should be {saved} at least")
    at_the_end(round_, project, disk, app, run, what)


def full_for_a_while(round_, disk, run, asking):
    rng = round_.rng
    disk.fill(leave=rng.choice([0, 0, 1000, 10000]))
    before = asking.read("GVL.cycles")["GVL.cycles"]
    time.sleep(rng.uniform(0.1, 1.0))
    round_.demand(run.alive(), f"the run has ended on a full disk, exit code {run.code}: {run.err[-1500:]}")
    going = wait_until(lambda: asking.read("GVL.cycles")["GVL.cycles"] > before, 30)
    round_.expect(going, "the program's cycles stand still on a full disk")
    if rng.random() < 0.7:
        disk.empty()
        time.sleep(rng.uniform(0, 0.5))


def recovers(round_, disk, asking, project, traced):
    """With room again, retained data and the program's files are written. A trace may have taken the room itself. The number that
    must be saved at least."""
    number = asking.read("Other.number")["Other.number"]
    lines = asking.read("Writer.lines")["Writer.lines"]
    wait_until(lambda: asking.read("Other.number")["Other.number"] > number + 50, 30)
    room = disk.free() > 100_000
    if room and not traced:
        round_.expect(wait_until(lambda: asking.read("Writer.lines")["Writer.lines"] > lines, 30), "the program's file is not written again with room on the disk")
    names = [f"PLC_PRG.m{a.name}.{v}" for a in project.axes for v in ("maxStep", "maxChange", "errors", "moves")]
    values = asking.read(*names)
    invariants.movers_within_limits(round_, project, values, "on a full disk")
    return number if room else 0


def at_the_end(round_, project, disk, app, run, what):
    """What was written of the trace or the recording is whole and right."""
    if what == "trace":
        trace = disk.folder / "run.csv"
        columns, rows = invariants.read_trace(trace)
        torn = [number for number, row in enumerate(rows) if len(row) != len(columns)]
        if round_.expect(columns and not torn, f"rows {torn[:5]} of the trace are torn: {[rows[t] for t in torn[:2]]}") and rows:
            reference = round_.folder / "reference.csv"
            last = max(int(row[1]) for row in rows)
            round_.host("sim", app, "--for", f"{(last + 1) * project.interval_ms}ms", "--quiet", "--files", round_.folder / "other", "--trace",
                        ",".join(project.columns()), "--out", reference)
            invariants.same_course(round_, (columns, rows), invariants.read_trace(reference), "on a full disk")
            invariants.steps_within_limits(round_, project, (columns, rows), "on a full disk")
            round_.counts["cycles_run"] += last
    if what == "recording" and (disk.folder / "run.rec").stat().st_size > 0:
        replay = round_.host("sim", app, "--replay", disk.folder / "run.rec", "--quiet", "--print", "GVL.cycles")
        # One that has not even got the state of the start says so.
        empty = "is cut off before its first cycle" in replay.err and "could not be written" in run.err
        round_.expect(replay.code in (0, 1) and ("GVL.cycles" in replay.out or empty), f"the recording cannot be replayed: exit code {replay.code}, {replay.err[-800:]}")


def during_builds(round_):
    """Every build ends well, or with a message and the application that was there before."""
    rng = round_.rng
    disk = Disk(round_, 20_000)
    if round_.choose("cache", rng.random() < 0.5):
        round_.scratch = disk.folder
    project = motion.MotionProject(rng, axes=rng.randint(1, 3))
    folder = project.write(disk.folder / "project")
    round_.build(folder)
    good = project.version
    for _ in range(1 if round_.quick else round_.choose("builds", rng.randint(3, 10))):
        for _ in range(rng.randint(1, 3)):
            project.edit()
        project.write(folder)
        disk.fill(leave=rng.choice([0, 4096, 20_000, 100_000, 300_000, 600_000, 1_000_000, 2_000_000]))
        options = rng.choice([[], ["--debug"], ["--unchecked"]])
        made = round_.stride("build", folder, "-W", "off=lints", *options)
        round_.counts["builds"] += 1
        if made.code == 0:
            good = project.version
        else:
            round_.counts["failed_builds"] += 1
            round_.expect(made.code == 1 and "error" in made.err, f"a build on a full disk: exit code {made.code}, it says {made.err[-800:]!r}")
        round_.expect(version_of(round_, folder) == good, f"on a full disk (exit code {made.code}) build/app.so is {version_of(round_, folder)}, not version {good}: {made.err[-800:]}")
        if rng.random() < 0.5:
            disk.empty()
            round_.build(folder, *options)
            good = project.version
            round_.expect(version_of(round_, folder) == good, f"with room again build/app.so is {version_of(round_, folder)}, not version {good}")

