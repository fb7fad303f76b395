"""Jumps of the wall clock and freezes of the whole process (SIGSTOP) during a run: TIME(), timers and axes go on as planned,
cycles that a freeze has cost are counted, and the axes do not make up for them by a leap."""
import mmap
import os
import signal
import struct
import subprocess
import time

import client
import invariants
import motion
from replay import replays

WATCH = """PROGRAM Watch
VAR
  now, last, begin, pt : TIME;
  cycles, backwards, uneven, wrong, fired : UDINT;
  state : DWORD := 12345;
  running : BOOL;
  ton : TON;
  wall : CurTime;
  wallTime : SysTime64;
  i : DINT;
  sum : LREAL;
END_VAR
FOR i := 1 TO {work} DO sum := sum + i; END_FOR
now := TIME();
IF cycles > 0 THEN
  IF now <= last THEN backwards := backwards + 1; END_IF
  IF TIME_TO_UDINT(now - last) MOD {interval} <> 0 THEN uneven := uneven + 1; END_IF
END_IF
IF running THEN
  ton(IN := TRUE, PT := pt);
  IF ton.Q <> (now - begin >= pt) THEN wrong := wrong + 1; END_IF
  IF ton.Q THEN running := FALSE; fired := fired + 1; END_IF
ELSE
  state := state * 1664525 + 1013904223;
  pt := UDINT_TO_TIME(DWORD_TO_UDINT(SHR(state, 8)) MOD 1000 + 1);
  ton(IN := FALSE);
  ton(IN := TRUE, PT := pt);
  begin := now;
  running := TRUE;
END_IF
wall(SystemTime := wallTime);
last := now;
cycles := cycles + 1;
END_PROGRAM
"""
PRINTED = "Watch.now,Watch.cycles,Watch.wallTime"
WRONG = ("Watch.backwards", "Watch.uneven", "Watch.wrong")


def interposer(round_):
    """The library that lets the wall clock jump, built once per run of the soak"""
    library = round_.settings.tools / "clock_jumps.so"
    if not library.exists():
        source = round_.settings.source / "tests" / "soak" / "clock_jumps.cpp"
        fresh = library.with_suffix(f".{os.getpid()}")
        subprocess.run([os.environ.get("STRIDE_CXX", "g++"), "-std=c++20", "-O1", "-shared", "-fPIC", "-o", fresh, source, "-ldl"], check=True)
        fresh.rename(library)
    return library


class WallClock:
    """The clock of a run that is started with `environment`"""

    def __init__(self, round_):
        path = round_.folder / "clock"
        path.write_bytes(bytes(24))
        with open(path, "r+b") as file:
            self.memory = mmap.mmap(file.fileno(), 24)
        self.environment = {"LD_PRELOAD": str(interposer(round_)), "SOAK_CLOCK": str(path)}

    def jump(self, seconds):
        self.memory[:8] = struct.pack("<q", int(seconds * 1e9))

    @property
    def asked(self):
        return struct.unpack("<q", self.memory[8:16])[0]

    @property
    def waited(self):
        return struct.unpack("<q", self.memory[16:])[0]


def play(round_):
    rng = round_.rng
    project = motion.MotionProject(rng, axes=rng.randint(1, 4), interval_ms=rng.choice([2, 4, 5, 10]))
    watchdog = round_.choose("watchdog", rng.choice([None, None, 30]))
    # So that a freeze is within a cycle now and then; only there the watchdog sees it.
    project.extra = WATCH.format(interval=project.interval_ms, work=500_000 if watchdog else 0)
    text = project.write(round_.folder / "project", more=f'watchdog = "T#{watchdog}ms"\n' if watchdog else "")
    manifest = text / "stride.toml"
    manifest.write_text(manifest.read_text().replace('programs = ["PLC_PRG"]', 'programs = ["PLC_PRG", "Watch"]'))
    round_.build(text)
    clock = WallClock(round_)
    trace, recording = round_.folder / "run.csv", round_.folder / "run.rec"
    recorded = ["--record", recording] if round_.choose("recorded", rng.random() < 0.5) else []
    run = round_.start(round_.settings.product.host, "run", text / "build" / "app.so", "--listen", "unix:plc.sock", "--trace", ",".join(project.columns()), "--out", trace,
                       "--print", PRINTED, *recorded, env=clock.environment, name="run")
    began = time.monotonic()
    asking = client.connect(round_.folder / "plc.sock", run)
    offset = 0.0
    for _ in range(3 if round_.quick else round_.choose("events", rng.randint(10, 60))):
        time.sleep(rng.uniform(0, 0.3))
        if rng.random() < 0.7:
            offset = rng.choice([0, 1, -1, 3600, -3600, 86400 * 366, -86400 * 3650, offset + rng.uniform(-5, 5)])
            clock.jump(offset)
            round_.counts["jumps"] += 1
        else:
            pause = rng.choice([0.001, 0.02, 0.3, rng.uniform(0, 2)])
            run.signal(signal.SIGSTOP)
            time.sleep(pause)
            run.signal(signal.SIGCONT)
            round_.counts["freezes"] += 1
        if watchdog and not run.alive():
            break
        look(round_, asking, clock, began, watchdog)
    asking.close()
    finish(round_, project, text / "build" / "app.so", run, trace, clock, watchdog)
    if recorded:
        replays(round_, text / "build" / "app.so", run, recording, PRINTED, (project.columns(), trace))


def look(round_, asking, clock, began, watchdog):
    """While it runs: nothing wrong was counted, and the time of the program is that of the monotonic clock."""
    before = time.monotonic() - began
    try:
        values = asking.read("Watch.now", "Watch.wallTime", *WRONG, literals=True)
        state = asking.ask("state")
        after = time.monotonic() - began
    except (client.Gone, client.Refused):
        if watchdog:
            return
        raise
    round_.expect(all(values[name] == "0" for name in WRONG), f"the program saw a wrong time: {values}")
    # The start took a while; a cycle that waits for the processor answers late.
    round_.expect(before - 30 < state["time"] < after + 0.5, f"the program's time is {state['time']} s between {before} s and {after} s of the run")
    round_.expect(clock.asked > 0, "the wall clock was never read: the interposer does not work")


def finish(round_, project, app, run, trace, clock, watchdog):
    if run.alive():
        run.stop()
    else:
        run.finish(1)
    said = run.err
    bitten = watchdog and run.code == 2
    round_.expect(run.code == 0 or (bitten and "watchdog" in said), f"the run ends with exit code {run.code}: {said[-1500:]}")
    round_.counts["watchdog_stops"] += 1 if bitten else 0
    round_.expect(clock.waited == 0, f"{clock.waited} waits for a time of the wall clock")
    traced = invariants.read_trace(trace)
    last = int(traced[1][-1][1])
    reference = round_.folder / "reference.csv"
    round_.host("sim", app, "--for", f"{(last + 1) * project.interval_ms}ms", "--quiet", "--trace", ",".join(project.columns()), "--out", reference)
    rows = traced[1]
    if bitten:  # the cycle in which the watchdog bites, and what follows, is another course
        rows = [row for row in rows if int(row[1]) < last]
    invariants.same_course(round_, (traced[0], rows), invariants.read_trace(reference), "jumps and freezes")
    invariants.steps_within_limits(round_, project, (traced[0], rows), "jumps and freezes")
    if bitten:
        final = dict(zip(traced[0], traced[1][-1]))
        moving = [a.name for a in project.axes if abs(float(final[f"{a.name}.fSetVelocity"])) > 1e-9]
        round_.expect(not moving, f"after the watchdog these axes still move: {moving}")
    figures = invariants.statistics(said, "Bus")
    round_.demand(figures, f"there are no statistics: {said[-1500:]}")
    cycles, overruns, _ = figures
    round_.counts["cycles_run"] += cycles
    round_.counts["overruns"] += overruns
    now = float(traced[1][-1][0])
    round_.expect((cycles + overruns) * project.interval_ms / 1000 >= now - 1, f"{cycles} cycles and {overruns} overruns of {project.interval_ms} ms in {now} s")
