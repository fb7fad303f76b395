#!/usr/bin/env python3
"""Stride as master of a drive with the stack lely-core, from a checkout: a part of `./dev peers FOLDER`.

usage: can_lely_peer.py KERNELS BINARIES DRIVE FOLDER

FOLDER/lely-core: github.com/lely-industries/lely-core, built and installed in its folder `install`. DRIVE: the project
can_foreign_drive. The stack is a drive of CiA 402 that Stride gives its node id, moves, sees in fault and loses.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import can_guest
import lely_drive
from can_run import ERRORSTOP, at, check, rows

FAULT, SCAN, ACKNOWLEDGE, GONE, END = 4.0, 4.4, 5.5, 9.0, 10.5  # Of the run, about. [s]

SCRIPT = f"""
/bin/ip link add can0 type vcan; /bin/ip link set can0 txqueuelen 128 up
lely-drive can0 /app/drive.dcf > /out/drive 2>&1 & drive=$!
sleep 0.5
(stride-can scan can0 --timeout 20 --to 20; stride-can lss can0) > /out/before 2>&1
stride-host run /app/drive.so --for {END}s --quiet --can-log /out/frames --script /app/acknowledge.script \\
  --trace X.nAxisState,X.fSetPosition,X.fActPosition,X.bCommunication,X.wErrorID,Main.udiReached --out /out/run.csv > /out/run 2>&1 & run=$!
sleep {FAULT}
stride-can sdo write can0 5 2000h 12816 --type u16 --write --force > /out/write 2>&1
sleep {SCAN - FAULT:.1f}
(stride-can scan can0 --timeout 50 --from 5 --to 5; stride-can sdo read can0 5 1008h --type string
 stride-can sdo read can0 5 2001h --type i16; stride-can sdo read can0 5 3000h) > /out/tools 2>&1
sleep {GONE - SCAN:.1f}; kill -9 $drive
wait $run
true
"""


def check_drive(out):
    said, trace = (out / "run").read_text(), rows(out / "run.csv")
    before, tools = (out / "before").read_text(), (out / "tools").read_text()
    check("no node has answered" in before, "a node without a node id answers:", before)
    for number in (lely_drive.VENDOR, lely_drive.PRODUCT, lely_drive.SERIAL):
        check(f"{number:08X}" in before.upper(), "LSS does not find", number, before)
    check("has got its number by LSS" in said, "it got no node id:", said)
    ready = at(trace, FAULT - 1.5)
    check(ready["X.bCommunication"] == 1, "the drive is not there:", said, (out / "drive").read_text())
    moving = at(trace, FAULT - 0.8)
    check(moving["Main.udiReached"] >= 2, moving["Main.udiReached"], "targets were reached:", said)
    lag = max(abs(row["X.fSetPosition"] - row["X.fActPosition"]) for row in trace if row["X.nAxisState"] in (3, 4))
    check(lag <= 50 * 0.004 * 5, "it is", lag, "away from where it should be")
    faulty = at(trace, SCAN + 0.6)
    check(faulty["X.nAxisState"] == ERRORSTOP, "state after a fault:", faulty, said)
    check(faulty["X.wErrorID"] == 0x3210, "wErrorID:", faulty["X.wErrorID"], said)
    check("overvoltage of the DC link" in said, "the fault is not said:", said)
    for expected in ("1003h:1  3210h  overvoltage of the DC link", lely_drive.NAME, "-321", "there is no such object"):
        check(expected in tools, "tools do not say", expected, "but", tools)
    again, last = at(trace, GONE - 1.0), trace[-1]
    check(again["Main.udiReached"] > faulty["Main.udiReached"], "it does not move after MC_Reset:", again, said)
    check(last["X.bCommunication"] == 0 and last["X.nAxisState"] == ERRORSTOP, "nobody notices that it is gone:", last, said)
    print(f"lely-core as drive: {again['Main.udiReached']:.0f} targets reached, at most {lag:.3f} mm behind")


def check_frames(text):
    frames = re.findall(r"\((\d+\.\d+)\) \S+ ([0-9A-F]+)#([0-9A-F]*)", text)
    times = lambda identifier, data="": [float(t) for t, i, d in frames if i == identifier and d.startswith(data)]
    check(times("7E4", "44") and times("7E4", "1100"), "LSS selects it and gives it its node id")
    beats, syncs, positions = times("705", "05"), times("080"), times("185")
    gaps = [b - a for a, b in zip(beats, beats[1:])]
    check(len(beats) > 40 and 0.05 < sum(gaps) / len(gaps) < 0.15, len(beats), "heartbeats")
    during = [one for one in syncs if positions[0] <= one <= positions[-1]]
    check(len(positions) > 1000 and abs(len(during) - len(positions)) < 10, len(during), "SYNCs and", len(positions), "TPDOs")
    check(times("085", "1032"), "an EMCY")
    print(f"lely-core: {len(beats)} heartbeats, {len(positions)} TPDOs at {len(during)} SYNCs, {len(times('605'))} SDO requests, "
          f"{len(times('585', '80'))} of them refused")


def run(options):
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        program = lely_drive.build(options.folder, scratch / "lely")
        subprocess.run([str(options.binaries / "stride"), "build", "-W", "off=lints", str(options.drive), "--out", str(scratch / "drive.so")],
                       check=True)
        (scratch / "drive.dcf").write_text(lely_drive.dictionary(255))
        (scratch / "acknowledge.script").write_text(
            f"at T#{int(ACKNOWLEDGE * 1000)}ms: Main.Acknowledge := TRUE\nat T#{int(ACKNOWLEDGE * 1000) + 500}ms: Main.Acknowledge := FALSE\n")
        files = [f"{options.binaries / name}:/bin/{name}" for name in ("stride-host", "stride-can")]
        files += [f"{program}:/bin/lely-drive"]
        files += [f"{scratch}/{name}:/app/{name}" for name in ("drive.dcf", "drive.so", "acknowledge.script")]
        out = scratch / "out"
        text, status = can_guest.run(argparse.Namespace(
            kernels=str(options.kernels), vcan=0, wire=0, can=0, out=str(out), timeout=280, script=SCRIPT, files=files))
        check(status == 0, "the guest ends with", status, text)
        check_drive(out)
        check_frames((out / "frames").read_text())


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    for name in ("kernels", "binaries", "drive", "folder"):
        parser.add_argument(name, type=pathlib.Path)
    options = parser.parse_args()
    run(options)
    print("all good")


if __name__ == "__main__":
    main()
