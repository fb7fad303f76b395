#!/usr/bin/env python3
"""Stride as master of a device with CANopenNode, from checkouts: a part of `./dev peers FOLDER`.

usage: can_node_peer.py KERNELS BINARIES TERMINAL FOLDER

FOLDER/CANopenNode and FOLDER/CANopenLinux: github.com/CANopenNode. TERMINAL: the project can_terminal. NMT, SDO, PDOs at SYNC and
heartbeats of both sides; then the device goes away and the run notices it.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import can_guest
import canopennode_od
from can_run import at, check, rows

GONE, END = 4.0, 6.0  # When the device is killed, about, and the run ends. [s]

SCRIPT = f"""
/bin/ip link add can0 type vcan; /bin/ip link set can0 txqueuelen 128 up
cd /tmp; for i in od_comm mainline; do echo - > $i.persist; done  # a new memory: without it the stack reports a fault and stays pre-operational
canopennode can0 -i 10 > /out/node 2>&1 & node=$!
sleep 0.5
(stride-can scan can0 --timeout 50 --from 9 --to 11; stride-can sdo read can0 10 1018h:4; stride-can sdo read can0 10 2000h
 stride-can sdo read can0 10 6200h:1 --type u8) > /out/tools 2>&1
stride-host run /app/terminal.so --for {END}s --quiet --can-log /out/frames --trace Main.udiRight,Main.udiWrong,Terminal.bLost \\
  --out /out/run.csv > /out/run 2>&1 & run=$!
sleep {GONE}; kill -9 $node
wait $run
true
"""


def check_frames(text):
    """What has gone over the bus, in candump's format."""
    frames = re.findall(r"\((\d+\.\d+)\) \S+ ([0-9A-F]+)#([0-9A-F]*)", text)
    times = lambda identifier, data="": [float(t) for t, i, d in frames if i == identifier and d.startswith(data)]
    check(times("000", "820A") and times("000", "010A"), "NMT resets and starts the node")
    check(times("70A", "00"), "the node says that it has booted")
    beats = times("70A", "05")
    check(len(beats) > 20, "there are", len(beats), "heartbeats of the operational node")
    gaps = [b - a for a, b in zip(beats, beats[1:])]
    check(0.05 < sum(gaps) / len(gaps) < 0.15, "heartbeats come every", sum(gaps) / len(gaps), "s")
    syncs, inputs = times("080"), times("18A")
    check(len(inputs) > 500, "there are", len(inputs), "TPDOs at SYNC")
    during = [one for one in syncs if inputs[0] <= one <= inputs[-1]]
    check(abs(len(during) - len(inputs)) < 10, len(during), "SYNCs and", len(inputs), "TPDOs")
    check(len(times("20A")) > 500, "RPDOs go out")
    print(f"CANopenNode: {len(beats)} heartbeats, {len(inputs)} TPDOs at {len(during)} SYNCs, {len(times('60A'))} SDO requests, "
          f"{len(times('58A', '80'))} of them refused")


def run(options):
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        program = canopennode_od.build(options.folder, scratch / "node")
        subprocess.run([str(options.binaries / "stride"), "build", "-W", "off=lints", str(options.terminal), "--out",
                        str(scratch / "terminal.so")], check=True)
        files = [f"{options.binaries / name}:/bin/{name}" for name in ("stride-host", "stride-can")]
        files += [f"{program}:/bin/canopennode", f"{scratch}/terminal.so:/app/terminal.so"]
        out = scratch / "out"
        text, status = can_guest.run(argparse.Namespace(
            kernels=str(options.kernels), vcan=0, wire=0, can=0, out=str(out), timeout=240, script=SCRIPT, files=files))
        check(status == 0, "the guest ends with", status, text)
        tools, said = (out / "tools").read_text(), (out / "run").read_text()
        for expected in (" 10  inputs and outputs (CiA 401)", "4713", "there is no such object"):
            check(expected in tools, "tools do not say", expected, "but", tools, (out / "node").read_text())
        trace = rows(out / "run.csv")
        before, last = at(trace, GONE - 1.0), trace[-1]
        check(before["Terminal.bLost"] == 0, "the device is not there:", said, (out / "node").read_text())
        check(before["Main.udiRight"] > 10, before["Main.udiRight"], "values came back:", said)
        check(last["Main.udiWrong"] <= 1, last["Main.udiWrong"], "values did not come back:", said)
        check(last["Terminal.bLost"] == 1, "nobody notices that the device is gone:", said)
        print(f"CANopenNode: {before['Main.udiRight']:.0f} values came back by then, {last['Main.udiWrong']:.0f} did not")
        check_frames((out / "frames").read_text())


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    for name in ("kernels", "binaries", "terminal", "folder"):
        parser.add_argument(name, type=pathlib.Path)
    options = parser.parse_args()
    run(options)
    print("all good")


if __name__ == "__main__":
    main()
