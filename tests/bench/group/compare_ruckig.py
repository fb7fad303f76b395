#!/usr/bin/env python3
"""compare_ruckig.py --peer DIR [--build DIR] [--moves N]: movements of seven axes beside those of Ruckig.

DIR is a checkout of https://github.com/pantor/ruckig at the commit below, which is no part of Stride: it is only built here, into a
temporary folder, to be measured. Prints a table of quotients of durations (ours over Ruckig's); what plans cost goes to the other
stream. Not part of the tests. The build folder needs the target group_bench.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

COMMIT = "53f42b3e0a67384dc8192057f82fe37e36c7512d"
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
LIBRARIES = ["numeric_group", "numeric_kinematics", "numeric_path", "numeric_profile", "runtime_iec"]
OURS = ["-ffp-contract=off", "-DEIGEN_DONT_VECTORIZE", "-DEIGEN_NO_MALLOC", "-DEIGEN_NO_IO", "-DEIGEN_NO_DEBUG",
        "-isystem", "/usr/include/eigen3"]


def run(*command):
    return subprocess.run([str(word) for word in command], check=True)


def commit_of(peer):
    text = subprocess.run(["git", "-C", str(peer), "rev-parse", "HEAD"], check=True, capture_output=True, text=True)
    return text.stdout.strip()


def build(peer, libraries, folder):
    """Ruckig as its own build makes it by default (-O3), without what asks a server."""
    objects = []
    for source in sorted((peer / "src/ruckig").glob("*.cpp")):
        if source.name == "cloud_client.cpp":
            continue
        objects.append(folder / (source.stem + ".o"))
        run("g++", "-std=c++20", "-O3", "-DNDEBUG", "-I", peer / "include", "-c", source, "-o", objects[-1])
    program = folder / "compare_ruckig"
    run("g++", "-std=c++20", "-O2", "-DNDEBUG", *OURS, "-I", ROOT, "-isystem", peer / "include", HERE / "compare_ruckig.cpp", *objects,
        *[libraries / f"libstride_{name}.a" for name in LIBRARIES], "-o", program)
    return program


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peer", type=pathlib.Path, required=True, help="a checkout of Ruckig")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where Stride has been built")
    parser.add_argument("--moves", type=int, default=100000)
    options = parser.parse_args()
    if commit_of(options.peer) != COMMIT:
        sys.exit(f"compare_ruckig.py: {options.peer} is not at {COMMIT}: git -C {options.peer} checkout {COMMIT}")
    libraries = options.build / "lib"
    missing = [name for name in LIBRARIES if not (libraries / f"libstride_{name}.a").exists()]
    if missing:
        sys.exit(f"compare_ruckig.py: {libraries} lacks {', '.join(missing)}: cmake --build {options.build} --target group_bench")
    with tempfile.TemporaryDirectory() as folder:
        run(build(options.peer.resolve(), libraries, pathlib.Path(folder)), options.moves)


if __name__ == "__main__":
    main()
