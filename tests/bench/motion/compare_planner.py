#!/usr/bin/env python3
"""compare_planner.py --peer DIR [--build DIR] [--moves N]: plans of single axes beside those of Ruckig.

DIR is a checkout of https://github.com/pantor/ruckig at the commit below, which is no part of Stride: it is only built here, into a
temporary folder, to be measured. Prints a table: quotients of durations (ours over Ruckig's), and what plans cost in the same run. The
first tasks in which ours takes longer go to the other stream, and make the program fail. Not part of the tests. The build folder
needs the target stride_numeric_profile.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(HERE.parent / "group"))
import compare_ruckig  # noqa: E402: builds the peer, and knows its commit

LIBRARIES = ["numeric_profile", "runtime_iec"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peer", type=pathlib.Path, required=True, help="a checkout of Ruckig")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where Stride has been built")
    parser.add_argument("--moves", type=int, default=100000, help="of each kind")
    options = parser.parse_args()
    compare_ruckig.check_commit(options.peer)
    libraries = compare_ruckig.libraries_in(options.build, LIBRARIES, "stride_numeric_profile")
    with tempfile.TemporaryDirectory() as folder:
        program = compare_ruckig.build(options.peer.resolve(), HERE / "compare_planner.cpp", libraries, pathlib.Path(folder))
        sys.exit(subprocess.run([program, str(options.moves)]).returncode)


if __name__ == "__main__":
    main()
