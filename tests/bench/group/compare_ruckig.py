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


def check_commit(peer):
    if commit_of(peer) != COMMIT:
        sys.exit(f"{peer} is not at {COMMIT}: git -C {peer} checkout {COMMIT}")


def libraries_in(build_folder, names, target):
    """The paths of Stride's libraries; says how to build them if they are not there."""
    folder = build_folder / "lib"
    missing = [name for name in names if not (folder / f"libstride_{name}.a").exists()]
    if missing:
        sys.exit(f"{folder} lacks {', '.join(missing)}: cmake --build {build_folder} --target {target}")
    return [folder / f"libstride_{name}.a" for name in names]


def build(peer, source, libraries, folder):
    """The program of `source` with Ruckig as its own build makes it by default (-O3), without what asks a server."""
    objects = []
    for part in sorted((peer / "src/ruckig").glob("*.cpp")):
        if part.name == "cloud_client.cpp":
            continue
        objects.append(folder / (part.stem + ".o"))
        run("g++", "-std=c++20", "-O3", "-DNDEBUG", "-I", peer / "include", "-c", part, "-o", objects[-1])
    program = folder / source.stem
    run("g++", "-std=c++20", "-O2", "-DNDEBUG", *OURS, "-I", ROOT, "-isystem", peer / "include", source, *objects, *libraries, "-o",
        program)
    return program


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peer", type=pathlib.Path, required=True, help="a checkout of Ruckig")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="where Stride has been built")
    parser.add_argument("--moves", type=int, default=100000)
    options = parser.parse_args()
    check_commit(options.peer)
    libraries = libraries_in(options.build, LIBRARIES, "group_bench")
    with tempfile.TemporaryDirectory() as folder:
        run(build(options.peer.resolve(), HERE / "compare_ruckig.cpp", libraries, pathlib.Path(folder)), options.moves)


if __name__ == "__main__":
    main()
