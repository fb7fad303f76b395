#!/usr/bin/env python3
"""Stride on CAN with programs of others, from checkouts: `./dev peers FOLDER`.

usage: can_peers.py KERNELS BINARIES FAULTS FOLDER

FOLDER/canopen: the Python package canopen (github.com/christiansandberg/canopen), as master of simulated drives and as a node for
`stride can`. FAULTS: the project can_faults. BINARIES as of can_run.py. Needs /usr/bin/python3 of this machine for the guest.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import can_guest
from can_run import check

SCRIPT = """
/bin/ip link add can0 type vcan; /bin/ip link set can0 txqueuelen 128 up
export PYTHONPATH=/peer PYTHONDONTWRITEBYTECODE=1
python=/usr/bin/python3
stride-can simulate /app/plain.so > /dev/null & drives=$!
sleep 0.2
$python -S /peer/canopen_peer.py can0 master > /out/master 2>&1; echo "exit $?" >> /out/master
kill $drives; wait
$python -S /peer/canopen_peer.py can0 slave > /out/slave 2>&1 & peer=$!
for i in 1 2 3 4 5 6 7 8 9 10; do grep -q ready /out/slave && break; sleep 0.5; done
(stride-can scan can0 --timeout 50 --from 9 --to 11
 stride-can sdo read can0 10 1008h --type string
 stride-can sdo read can0 10 2000h --type i16
 stride-can sdo read can0 10 3000h
 stride-can sdo write can0 10 2000h 99 --type i16 --write --force) > /out/tools 2>&1
wait $peer
true
"""
SKIPPED = shutil.ignore_patterns("test", "tests", "__pycache__", "idlelib", "lib2to3", "ensurepip", "config-*", "tkinter", "turtledemo",
                                 "pydoc_data", "dist-packages", "distutils", "unittest", "xml", "xmlrpc", "sqlite3", "curses")


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    for name in ("kernels", "binaries", "faults", "folder"):
        parser.add_argument(name, type=pathlib.Path)
    options = parser.parse_args()
    package = options.folder / "canopen" / "canopen"
    check(package.is_dir(), f"there is no {package}: clone github.com/christiansandberg/canopen there")
    python = pathlib.Path("/usr/bin/python3").resolve()
    library = pathlib.Path("/usr/lib") / python.name
    check(library.is_dir(), f"{python} has no library {library}")
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        shutil.copytree(library, scratch / "python", ignore=SKIPPED)
        subprocess.run([str(options.binaries / "stride"), "build", "-W", "off=lints", str(options.faults), "--out",
                        str(scratch / "plain.so")], check=True)
        files = [f"{options.binaries / name}:/bin/{name}" for name in ("stride-host", "stride-can")]
        files += [f"{scratch}/plain.so:/app/plain.so", f"{python}:/usr/bin/python3", f"{scratch}/python:{library}",
                  f"{package}:/peer/canopen", f"{pathlib.Path(__file__).parent}/canopen_peer.py:/peer/canopen_peer.py"]
        out = scratch / "out"
        text, status = can_guest.run(argparse.Namespace(
            kernels=str(options.kernels), vcan=0, wire=0, can=0, out=str(out), timeout=280, script=SCRIPT, files=files))
        check(status == 0, "the guest ends with", status, text)
        master, tools, slave = ((out / name).read_text() for name in ("master", "tools", "slave"))
        print(master + tools)
        check("exit 0" in master, "the master of the package finds something wrong")
        for expected in (" 10  drive (CiA 402)  vendor 000001ABh", "A node that is not Stride's, with a name of more than a segment",
                         "-5", "there is no such object"):
            check(expected in tools, "tools do not say", expected, "but", tools, slave)
    print("all good")


if __name__ == "__main__":
    main()
