"""kill -9 at random times. While retained data are saved: the next start finds the values of one moment, never older ones than
the start before, never none once there were some. During builds: the application is the one that was there before or the new
one, and the next build is right, whatever the killed ones have left."""
import os
import signal
import time

import client
import invariants
import motion
import retained


def play(round_):
    if round_.choose("what", round_.rng.choice(["run", "run", "build"])) == "run":
        killed_runs(round_)
    else:
        killed_builds(round_)


def killed_builds(round_):
    rng = round_.rng
    project = motion.MotionProject(rng, axes=rng.randint(1, 4))
    folder = project.write(round_.folder / "project")
    round_.build(folder)
    good = project.version
    for _ in range(2 if round_.quick else round_.choose("kills", rng.randint(5, 20))):
        for _ in range(rng.randint(1, 3)):
            project.edit()
        project.write(folder)
        options = rng.choice([[], ["--debug"], ["--unchecked"]])
        pause, alone, again = rng.choice([rng.uniform(0, 0.1), rng.uniform(0, 1), rng.uniform(0, 3)]), rng.random() < 0.5, rng.random() < 0.7
        building = round_.start(round_.settings.product.stride, "build", folder, "-W", "off=lints", *options)
        time.sleep(pause)
        if not building.alive():
            good = project.version
        elif alone:
            building.kill()  # its compilers go on for a while
        else:
            os.killpg(building.pid, signal.SIGKILL)
            building.kill()
        round_.counts["kills"] += 1
        found = version_of(round_, folder)
        round_.expect(found in (good, project.version), f"after a killed build build/app.so is {found}, not version {good} or {project.version}")
        if again:
            round_.build(folder, *options)
            good = project.version
            found = version_of(round_, folder)
            round_.expect(found == good, f"after killed builds and a whole one build/app.so is {found}, not version {good}")
        else:
            good = found


def version_of(round_, folder):
    ran = round_.host("sim", folder / "build" / "app.so", "--for", "20ms", "--quiet", "--print", "GVL.version")
    return int(invariants.printed(ran.out).get("GVL.version", -1)) if ran.code == 0 else f"unusable: {ran.err[-300:]}"


def killed_runs(round_):
    rng = round_.rng
    folder = retained.write_project(round_.folder / "project", round_.choose("interval_ms", rng.choice([1, 2, 5])),
                                    round_.choose("rows", rng.choice([1, 10, 1000, 8000])))
    round_.build(folder)
    app, retain = folder / "build" / "app.so", round_.folder / "kept" / "Kept"
    retain.parent.mkdir()
    last = 0
    for _ in range(2 if round_.quick else round_.choose("kills", rng.randint(5, 25))):
        last = one_life(round_, app, retain, last)
        if rng.random() < 0.2:
            last = orderly(round_, app, retain, last)


def start(round_, app, retain, last, *options):
    """A run, and what it says that it found"""
    run = round_.start(round_.settings.product.host, "run", app, "--retain", retain, "--listen", "unix:plc.sock", *options)
    asking = client.connect(round_.folder / "plc.sock", run)
    while not (values := asking.read("Keeper.began", "Keeper.agreed", "Keeper.start"))["Keeper.began"]:
        time.sleep(0.01)
    round_.expect(values["Keeper.agreed"] is True, f"a start found torn values: {values}, {run.err}")
    round_.expect(values["Keeper.start"] >= last, f"a start found {values['Keeper.start']} after {last} had been there")
    round_.expect("retained" not in run.err, f"a start says: {run.err}")
    return run, asking, values["Keeper.start"]


def one_life(round_, app, retain, last):
    run, asking, began = start(round_, app, retain, last)
    time.sleep(round_.rng.choice([0.0, round_.rng.uniform(0, 0.3), round_.rng.uniform(0, 1.5)]))
    now = asking.read("GVL.n")["GVL.n"]
    asking.close()
    run.kill()
    round_.counts["kills"] += 1
    kept = retained.look(round_, app, retain, "after kill -9")
    if kept is None:
        round_.expect(began == 0, f"there are no files any more, the start had found {began}")
        return 0
    round_.expect(kept >= began, f"{kept} is in the files, the start had found {began}")
    round_.note(f"began with {began}, killed after {now}, kept {kept}")
    return kept


def orderly(round_, app, retain, last):
    """A stop saves the last moment exactly."""
    run, asking, _ = start(round_, app, retain, last, "--print", "GVL.n")
    asking.close()
    run.stop()
    round_.demand(run.code == 0, f"a run ends with exit code {run.code}: {run.err}")
    kept = retained.look(round_, app, retain, "after a stop")
    round_.expect(f"GVL.n = {kept}\n" in run.out, f"{kept} is in the files after a stop with {run.out}")
    return kept
