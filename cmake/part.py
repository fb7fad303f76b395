#!/usr/bin/env python3
"""Chooses a part of a build's tests: every N-th, and those of what was changed last.

usage: part.py BUILD K/N [--changed COMMIT]

The tests of a build are dealt to N parts: executables by the number of their sources, so that the parts take the same
time, other tests by a hash of their names. Prints the targets that part K (0 ..) needs, one a line, and writes BUILD/part.txt, which
`ctest -I` reads. With --changed there are also, from whatever part: the executables whose own sources differ from
COMMIT, and for each library with such sources the smallest executable that links it.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import zlib

from tidy import ROOT, names_since, sources_of

OBJECT = re.compile(r"-o (\S+?)/CMakeFiles/([^/]+)\.dir/")
GOLDEN = ["golden_runner", "stride_programs"]


def own_sources(build):
    """The sources of each target, as paths in the repository."""
    sources = {}
    for unit in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        name = OBJECT.search(unit["command"]).group(2)
        for source in sources_of(unit):
            if source.startswith(f"{ROOT}/"):
                sources.setdefault(name, set()).add(source.removeprefix(f"{ROOT}/"))
    return sources


def archives(build):
    """The names of the libraries that each executable below tests/ links."""
    text = (build / "build.ninja").read_text(encoding="utf-8").replace("$\n", "")
    links = {}
    for name, inputs in re.findall(r"^build tests/(\S+): CXX_EXECUTABLE_LINKER\S* (.*)$", text, flags=re.M):
        links[name] = set(re.findall(r"lib/lib(\w+)\.a", inputs))
    return links


def tests(build):
    """The tests, each with its number and the target of its executable, or with none."""
    listing = subprocess.run(["ctest", "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
    found = re.findall(r"^ *Test +#(\d+): (.+?)(?: \(Disabled\))?$", listing, flags=re.M)
    executables = archives(build)
    return [(int(number), name, base if (base := re.sub(r"\.\d+$", "", name)) in executables else None)
            for number, name in found]


def folder_of(name):
    """The folder of a source or a header."""
    return str(pathlib.PurePosixPath(name).parent)


def changed_last(build, commit, executables, sources):
    """Executables of changed sources, and the smallest one of each library with changed sources."""
    changed = names_since(commit)
    headers = {folder_of(name) for name in changed if name.endswith((".hpp", ".h", ".def"))}
    links = archives(build)
    touched = {name for name, own in sources.items()
               if own.intersection(changed) or headers.intersection(map(folder_of, own))}
    chosen = touched & executables
    for library in sorted(touched - executables):
        linking = [name for name in executables if library in links.get(name, ())]
        if linking and not chosen.intersection(linking):
            chosen.add(min(linking, key=lambda name: (len(links[name]), len(sources.get(name, ())), name)))
    return chosen


def deal(executables, sources, parts):
    """The part of each executable: in turn, those with most sources first, there and back again."""
    order = sorted(executables, key=lambda name: (-len(sources.get(name, ())), name))
    turn = [*range(parts), *reversed(range(parts))]
    return {name: turn[place % len(turn)] for place, name in enumerate(order)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("part", type=lambda text: tuple(map(int, text.split("/"))))
    parser.add_argument("--changed")
    options = parser.parse_args()
    part, parts = options.part
    if not 0 <= part < parts:
        parser.error(f"there are the parts 0/{parts} to {parts - 1}/{parts}")
    all_tests = tests(options.build)
    executables = {target for _, _, target in all_tests if target}
    sources = own_sources(options.build)
    lately = changed_last(options.build, options.changed, executables, sources) if options.changed else set()
    dealt = deal(executables, sources, parts)
    chosen = [(number, name, target) for number, name, target in all_tests
              if target in lately or (dealt[target] if target else zlib.crc32(name.encode()) % parts) == part]
    if not chosen:
        sys.exit("part.py: there are no tests in this part")
    # Beginning, end and step of a range, which is nothing here, then the numbers.
    (options.build / "part.txt").write_text(",".join(["0", "0", "0", *(str(number) for number, _, _ in chosen)]) + "\n",
                                            encoding="utf-8")
    targets = {target for _, _, target in chosen if target}
    if any(target is None for _, _, target in chosen):
        targets.update(GOLDEN)
    print("\n".join(sorted(targets)))
    print(f"{len(chosen)} of {len(all_tests)} tests, {len(targets & executables)} of {len(executables)} executables", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
