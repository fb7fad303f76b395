#!/usr/bin/env python3
"""`stride run` on emulated CAN controllers and on wires that take their time.

usage: can_wire.py KERNELS BINARIES FAULTS GANTRY

BINARIES: folder of stride, stride-host and stride-can. FAULTS, GANTRY: the projects can_faults and examples/CanGantry.

Three guests, each in its own time: two SJA1000 controllers on one bus, one for the PLC and one for the drives; virtual buses, on which
the first drive or node 127 gives SYNC or cycles wait for actual values, and a gantry with I/O on a second channel; and a bus with the bit rate of a wire, once enough and
once too slow.
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import can_guest
from can_run import TURNING, at, check, rows

TRACE = "X.nAxisState,Y.nAxisState,X.fActPosition,Y.fActPosition"
CYCLE = 0.002  # of can_faults. [s]
MIDDLE = 2.7  # When axes turn, whatever has to start; all runs are longer. [s]


def run_line(name, seconds, more=""):
    return (f"stride-host run /app/{name}.so --for {seconds}s --quiet --out /out/{name}.csv {more} "
            f"> /out/{name}.text 2>&1")


CONTROLLERS = f"""
stride-can simulate /app/plain.so --interface can1 > /dev/null & drives=$!
sleep 0.1
stride-can scan can0 --timeout 5 --to 5 > /out/scan 2>&1
candump -t z -L can0,080:7FF > /out/syncs & dump=$!
{run_line("plain", 3, f"--trace {TRACE}")}
kill $dump
/bin/ip -details link show can0 > /out/link
# Another bit rate than the project's: nothing starts.
/bin/ip link set can0 down; /bin/ip link set can0 type can bitrate 500000; /bin/ip link set can0 up
cp /app/plain.so /app/slower.so
{run_line("slower", 1, f"--trace {TRACE}")}
kill $drives; wait
true
"""

BUSES = f"""
for i in 0 1; do /bin/ip link add can$i type vcan; /bin/ip link set can$i txqueuelen 128 up; done
for sync in first device wait; do
  stride-can simulate /app/$sync.so > /dev/null & drives=$!
  sleep 0.1
  stride-host run /app/$sync.so --for 3s --quiet --trace {TRACE},X.fSetPosition,Axes_Can.udiReadsLate --out /out/$sync.csv > /out/$sync.text 2>&1
  kill $drives; wait
done
stride-can simulate /app/gantry.so --group Beam > /dev/null & beam=$!
stride-can simulate /app/gantry.so --group Terminals > /dev/null & terminals=$!
sleep 0.1
stride-can monitor can1 --app /app/gantry.so --count 2000 > /out/monitor & sleep 0.1
{run_line("gantry", 6, "--trace Gantry.udiParts,Gantry.rSkew,Gantry.iStep,Clamp.bLost,Left.fActPosition")}
kill $beam $terminals; wait
true
"""

WIRE = f"""
stride-can simulate /app/wire.so > /dev/null & drives=$!
sleep 0.1
stride-host run /app/wire.so --for 4s --quiet --trace {TRACE},Axes_Can.udiSetValuesLate,Axes_Can.udiSendQueueFull,Axes_Can.udiFramesSent --out /out/$1.csv > /out/$1.text 2>&1
kill $drives; wait
true
"""


def states(row):
    return int(row["X.nAxisState"]), int(row["Y.nAxisState"])


def check_turns(out, name):
    trace, text = rows(out / f"{name}.csv"), (out / f"{name}.text").read_text()
    check(len(trace) > 1000, name, "has", len(trace), "cycles:", text)
    row, later = at(trace, MIDDLE), at(trace, MIDDLE + 0.1)
    check(states(row) == states(later) == (TURNING, TURNING), name, "at the end:", states(row), text)
    check(row["X.fActPosition"] != later["X.fActPosition"], name, "does not move")


def lag(trace):
    """Cycles from a set position to the same actual one, while the axis turns evenly."""
    i = next(i for i, row in enumerate(trace) if row["t"] > 2)
    return min(range(8), key=lambda n: abs(trace[i]["X.fSetPosition"] - trace[i + n]["X.fActPosition"]))


def check_controllers(out):
    check("drive (CiA 402)" in (out / "scan").read_text(), "scan says", (out / "scan").read_text())
    check_turns(out, "plain")
    link = (out / "link").read_text()
    check("ERROR-ACTIVE" in link and "bitrate 1000000" in link, "the controller is", link)
    said = (out / "slower.text").read_text()
    check("500" in said and "1000" in said, "with another bit rate the run says", said)
    check(not any(row["X.nAxisState"] == TURNING for row in rows(out / "slower.csv")), "nothing moves at another bit rate")
    times = [float(one) for one in re.findall(r"\((\d+\.\d+)\) can0 080#", (out / "syncs").read_text())]
    gaps = [b - a for a, b in zip(times[50:-50], times[51:-50])]
    check(len(gaps) > 1000, "there are", len(gaps), "SYNCs")
    print(f"SJA1000: SYNC every {min(gaps) * 1e3:.3f} to {max(gaps) * 1e3:.3f} ms of {CYCLE * 1e3} ms")
    check(abs(sum(gaps) / len(gaps) - CYCLE) < 2e-5, "SYNC comes every", sum(gaps) / len(gaps), "s")


def check_buses(out):
    for name in ("first", "device", "wait"):
        check_turns(out, name)
    lags = {name: lag(rows(out / f"{name}.csv")) for name in ("first", "wait")}
    print("actual positions are", lags["first"], "cycles behind, with read_wait", lags["wait"])
    check(lags == {"first": 3, "wait": 2}, "actual positions are behind", lags)
    check(rows(out / "wait.csv")[-1]["Axes_Can.udiReadsLate"] < 5, "cycles wait in vain")
    trace, text = rows(out / "gantry.csv"), (out / "gantry.text").read_text()
    last = at(trace, 5.9)
    check(last["Gantry.udiParts"] >= 1, "the gantry has carried", last, text)
    check(last["Gantry.rSkew"] < 1e-3, "the beam is skew:", last, text)
    check(last["Clamp.bLost"] == 0, "the clamp is lost:", text)
    monitor = (out / "monitor").read_text()
    for expected in ("TPDO1 of Clamp: 6000h:1 ", "RPDO2 of Clamp: 6411h:1 "):
        check(expected in monitor, "the monitor shows", expected, "in", monitor[:2000])


def check_wire(out, fits):
    name = "fits" if fits else "slow"
    text = (out / f"{name}.text").read_text()
    trace = rows(out / f"{name}.csv")
    late = trace[-1]["Axes_Can.udiSetValuesLate"] + trace[-1]["Axes_Can.udiSendQueueFull"]
    frames = trace[-1]["Axes_Can.udiFramesSent"]
    print(f"wire, {name}: {frames:.0f} frames sent in {len(trace)} cycles, {late:.0f} late or refused")
    if fits:
        check_turns(out, name)
        check(late == 0, "set values were late", late, "times:", text)
    else:
        check(late > 10, "a slow wire is not noticed:", text)
        check(states(at(trace, MIDDLE)) != (TURNING, TURNING), "axes turn on a wire that is too slow")


class Guests:
    def __init__(self, options, scratch):
        self.options = options
        self.scratch = scratch
        self.files = [f"{options.binaries / name}:/bin/{name}" for name in ("stride-host", "stride-can")]

    def build(self, name, project, change=lambda text: text):
        folder = self.scratch / name
        shutil.copytree(project, folder, ignore=shutil.ignore_patterns("build"))
        toml = folder / "stride.toml"
        toml.write_text(change(toml.read_text()))
        subprocess.run([str(self.options.binaries / "stride"), "build", "-W", "off=lints", str(folder), "--out",
                        str(self.scratch / f"{name}.so")], check=True)
        self.files.append(f"{self.scratch / name}.so:/app/{name}.so")

    def run(self, script, **buses):
        out = self.scratch / f"out{len(list(self.scratch.iterdir()))}"
        settings = {"vcan": 0, "wire": 0, "can": 0, **buses}
        text, status = can_guest.run(argparse.Namespace(
            kernels=str(self.options.kernels), out=str(out), timeout=170, script=script, files=self.files, **settings))
        check(status == 0, "the guest ends with", status, text)
        return out


def with_sync(producer):
    """The task waits for the SYNC that somebody else gives."""
    return lambda text: text.replace('interval = "T#2ms"', 'kind = "event"\nevent = "Axes.bSync"').replace(
        "BaudRate = 1000", f'BaudRate = 1000\n  dwCycle = 2000\n  SyncProducer = "{producer}"')


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    for name in ("kernels", "binaries", "faults", "gantry"):
        parser.add_argument(name, type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        guests = Guests(options, pathlib.Path(scratch))
        guests.build("plain", options.faults)
        guests.build("first", options.faults, with_sync("1.Drive"))
        guests.build("device", options.faults, with_sync("SYNC device"))
        guests.build("wait", options.faults, lambda text: text.replace(
            'InterfaceType = "CAN (SocketCAN)"', 'InterfaceType = "CAN (SocketCAN)"\nread_wait = "T#500us"'))
        guests.build("gantry", options.gantry)
        guests.build("wire", options.faults, lambda text: text.replace(
            'InterfaceType = "CAN (SocketCAN)"', 'InterfaceType = "CAN (SocketCAN)"\ninterface = "vcan0"'))
        check_controllers(guests.run(CONTROLLERS, can=2))
        check_buses(guests.run(BUSES))
        check_wire(guests.run("set fits\n" + WIRE, vcan=1, wire=1000000), True)
        check_wire(guests.run("set slow\n" + WIRE, vcan=1, wire=250000), False)
    print("all good")


if __name__ == "__main__":
    main()
