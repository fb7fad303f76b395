#!/usr/bin/env python3
"""`stride run` on SocketCAN, with simulated drives in a process of their own.

usage: can_run.py KERNELS BINARIES SINGLE FAULTS

BINARIES: folder of stride, stride-host and stride-can. SINGLE, FAULTS: the projects examples/CanSingle and can_faults.

In one guest, in its own time: tools talk to the drives; CanSingle runs, and its set positions are those of a simulation to the
bit; can_faults runs again and again, and each time something else happens to the bus.
"""

import argparse
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import can_guest

STANDSTILL, ERRORSTOP, TURNING = 3, 1, 5
# Seconds. The run begins some tenths after the shell has started it, so that the fault comes between BEFORE and AFTER of its time.
FAULT, BEFORE, AFTER, RESTART, ACKNOWLEDGE, END = 2.0, 1.3, 2.4, 3.0, 4.0, 5.5
TRACE = "X.nAxisState,Y.nAxisState,X.bCommunication,Y.bCommunication,X.fActVelocity,Y.fActVelocity"

# What happens FAULT seconds after the start in the guest's shell; "$drives" are the simulated ones.
FAULTS = {
    "nothing": ":",
    "reset_of_node_2": "cansend can0 000#8102",
    "interface_down": "/bin/ip link set can0 down; sleep 0.4; /bin/ip link set can0 up",
    "drives_gone": "kill $drives; sleep 0.4; stride-can simulate /app/faults.so > /dev/null & drives=$!",
    # What a controller says by error frames: it is off the bus, and takes part again.
    "bus_off": "cansend can0 20000040#0000000000000000; sleep 0.4; cansend can0 20000100#0000000000000000",
    "babbling": "cangen can0 -g 0 -I 7F0 -L 8 -n 3000",
    "wrong_lengths": "for i in 1 2 3 4 5 6 7 8; do cansend can0 182#0000; done",
}


def script():
    lines = [
        "/bin/ip link add can0 type vcan; /bin/ip link set can0 txqueuelen 128 up",
        # Tools, while nobody controls the drive.
        "stride-can simulate /app/single.so > /out/simulated & drives=$!",
        "sleep 0.1",
        "(stride-can scan can0 --timeout 5 --to 20; stride-can sdo read can0 1 1008h --type string",
        " stride-can sdo read can0 1 1234h; stride-can sdo write can0 1 6083h 4711",
        " stride-can sdo write can0 1 6083h 4711 --write; stride-can sdo read can0 1 6083h) > /out/tools 2>&1",
        # A run.
        "stride-can monitor can0 --app /app/single.so --count 2000 > /out/monitor &",
        "stride-host run /app/single.so --for 4s --trace Drive.fSetPosition,Drive.fActPosition,Drive.nAxisState "
        "--out /out/single.csv --statistics /out/statistics.json > /out/run 2>&1 || exit 3",
        "kill $drives; wait",
    ]
    for name, happens in FAULTS.items():
        lines += [
            "stride-can simulate /app/faults.so > /dev/null & drives=$!",
            "sleep 0.1",
            f"stride-host run /app/faults.so --for {END}s --quiet --script /app/restart.script --trace {TRACE} "
            f"--out /out/{name}.csv > /out/{name}.text 2>&1 & run=$!",
            f"sleep {FAULT}; {happens}",
            "wait $run; kill $drives; wait",
            "/bin/ip link set can0 up",
        ]
    return "\n".join(lines) + "\n"


def rows(path):
    with open(path, newline="") as file:
        lines = list(csv.reader(file))
    return [dict(zip(lines[0], map(float, line))) for line in lines[1:]]


def first(trace, condition):
    return next(i for i, row in enumerate(trace) if condition(row))


def at(trace, seconds):
    """The row of that time after the start of the run."""
    return min(trace, key=lambda row: abs(row["t"] - seconds))


def check(good, *what):
    if not good:
        raise SystemExit("FAILED: " + " ".join(map(str, what)))


def check_tools(out):
    text = (out / "tools").read_text()
    for expected in ("  1  drive (CiA 402)", "Stride simulated node", "there is no such object (06020000h)",
                     "add --write if that is wanted", "4711 (00001267h)"):
        check(expected in text, "tools say", repr(text), "and not", expected)
    monitor = (out / "monitor").read_text()
    check(monitor.count("\n") == 2000, "the monitor shows 2000 frames")
    for expected in ("SYNC", "NMT node 1: reset communication", "SDO to node 1", "TPDO1 of Drive: position "):
        check(expected in monitor, "the monitor shows", expected)


def check_single(out, simulated):
    """Set positions of the run are those of the simulation, from where the drive is ready; actual ones come 3 cycles later."""
    run, simulation = rows(out / "single.csv"), rows(simulated)
    begin = first(run, lambda row: row["Drive.nAxisState"] == STANDSTILL)
    other = first(simulation, lambda row: row["Drive.nAxisState"] == STANDSTILL)
    count = min(len(run) - begin, len(simulation) - other) - 40  # the end brakes
    check(count > 800, "there are", count, "cycles to compare")
    for i in range(count):
        check(run[begin + i]["Drive.fSetPosition"] == simulation[other + i]["Drive.fSetPosition"], "set position in cycle", i)
    late = [i for i in range(count - 3)
            if abs(run[begin + i]["Drive.fSetPosition"] - run[begin + i + 3]["Drive.fActPosition"]) > 1e-4]
    check(not late, "actual positions differ in cycles", late[:5])
    check(abs(run[begin + count]["Drive.fSetPosition"] - 100) < 1e-9, "the drive has arrived")


def states(row):
    return int(row["X.nAxisState"]), int(row["Y.nAxisState"])


def check_faults(out):
    expected = {  # a moment after the fault; after the restart of the group
        "nothing": ((TURNING, TURNING), (TURNING, TURNING)),
        "reset_of_node_2": ((TURNING, ERRORSTOP), (TURNING, TURNING)),
        "interface_down": ((ERRORSTOP, ERRORSTOP), (TURNING, TURNING)),
        "drives_gone": ((ERRORSTOP, ERRORSTOP), (TURNING, TURNING)),
        "bus_off": ((ERRORSTOP, ERRORSTOP), (TURNING, TURNING)),
        "babbling": ((TURNING, TURNING), (TURNING, TURNING)),
        "wrong_lengths": ((TURNING, TURNING), (TURNING, TURNING)),
    }
    for name, (after, restarted) in expected.items():
        trace = rows(out / f"{name}.csv")
        text = (out / f"{name}.text").read_text()
        check(states(at(trace, BEFORE)) == (TURNING, TURNING), name, "before:", states(at(trace, BEFORE)), text)
        check(states(at(trace, AFTER)) == after, name, "after:", states(at(trace, AFTER)), text)
        check(states(at(trace, END - 0.1)) == restarted, name, "at the end:", states(at(trace, END - 0.1)), text)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    for name in ("kernels", "binaries", "single", "faults"):
        parser.add_argument(name, type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        stride = str(options.binaries / "stride")
        files = [f"{options.binaries / name}:/bin/{name}" for name in ("stride-host", "stride-can")]
        for name, project in (("single", options.single), ("faults", options.faults)):
            shutil.copytree(project, scratch / name, ignore=shutil.ignore_patterns("build"))
            subprocess.run([stride, "build", str(scratch / name), "--out", str(scratch / f"{name}.so")], check=True)
            files.append(f"{scratch / name}.so:/app/{name}.so")
        subprocess.run([stride, "sim", str(scratch / "single"), "--for", "T#5s", "--quiet", "--out", str(scratch / "single.csv"),
                        "--trace", "Drive.fSetPosition,Drive.nAxisState"], check=True)
        (scratch / "restart.script").write_text(
            f"at T#{int(RESTART * 1000)}ms: Main.Restart := TRUE\n"
            f"at T#{int(ACKNOWLEDGE * 1000)}ms: Main.Acknowledge := TRUE\n")
        files.append(f"{scratch}/restart.script:/app/restart.script")
        out = scratch / "out"
        text, status = can_guest.run(argparse.Namespace(
            kernels=str(options.kernels), vcan=0, wire=0, can=0, out=str(out), timeout=170, script=script(), files=files))
        check(status == 0, "the guest ends with", status, text)
        check_tools(out)
        check_single(out, scratch / "single.csv")
        check_faults(out)
    print("all good")


if __name__ == "__main__":
    main()
