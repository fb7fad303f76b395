#!/usr/bin/env python3
"""Chooses a part of a build's tests: every N-th, and those of what was changed last.

usage: part.py BUILD K/N|none [--changed COMMIT [--most N]]
       part.py BUILD K/N|none --turns [--changed COMMIT]

The tests of a build are dealt to N parts. From four parts on each has tests of one kind only, so that it does not build
what others need: those of the runtime, those that link parts of the compiler, those that start `stride`. Within a kind
executables are dealt by the number of their sources, so that the parts take the same time, other tests by a hash of
their names. `none` is no part, for what --changed adds alone. Prints the targets that part K (0 ..) needs, one a line,
and writes BUILD/part.txt, which `ctest -I` reads. With --changed there are also, from other parts of the same kind: the
executables whose own sources differ from COMMIT, and for each library with such sources the smallest executable that
links it; with --most no more of them than that, the last changed first.
With --turns it is all tests, only that those with the label `turns` are dealt to N parts (`none`: no part of them), without
those whose executable or golden program differs from COMMIT: they are in every part.
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
PROGRAMS = "stride_programs"
GOLDEN = ["golden_runner", PROGRAMS]
KINDS = {"runtime": 4, "compiler": 2, PROGRAMS: 3}  # of nine parts


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
    """The names of the libraries that each executable below tests/ links, and PROGRAMS if it starts them."""
    text = (build / "build.ninja").read_text(encoding="utf-8").replace("$\n", "")
    links = {}
    for name, inputs in re.findall(r"^build tests/(\S+): CXX_EXECUTABLE_LINKER\S* (.*)$", text, flags=re.M):
        links[name] = set(re.findall(r"lib/lib(\w+)\.a", inputs)) | {PROGRAMS}.intersection(inputs.split())
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


INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)


def includes_changed(name, headers, seen):
    """Whether a source includes one of the headers, itself or by headers of the same folder."""
    seen.add(name)
    path = pathlib.Path(ROOT) / name
    included = set(INCLUDE.findall(path.read_text(encoding="utf-8"))) if path.exists() else set()
    near = {header for header in included - seen if folder_of(header) == folder_of(name)}
    return bool(included & headers) or any(includes_changed(header, headers, seen) for header in sorted(near))


def touched_by(name, sources, executables):
    """The targets that a changed file belongs to: its own, or a header's, if their sources lie in its folder and, in executables, include it."""
    if not name.endswith((".hpp", ".h", ".def")):
        return {target for target, own in sources.items() if name in own}
    return {target for target, own in sources.items()
            if any(folder_of(source) == folder_of(name)
                   and (target not in executables or includes_changed(source, {name}, set())) for source in own)}


def changed_last(build, commit, executables, sources, most):
    """Executables of changed sources, and the smallest one of each library with changed sources; what was changed last first,
    no more than so many."""
    links = archives(build)
    chosen = {}
    for name in names_since(commit):
        for target in sorted(touched_by(name, sources, executables)):
            linking = [each for each in executables if target in links.get(each, ())]
            if target in executables:
                chosen[target] = None
            elif linking and not chosen.keys() & set(linking):
                chosen[min(linking, key=lambda each: (len(links[each]), len(sources.get(each, ())), each))] = None
    return set(list(chosen)[:most])


def deal(executables, sources, parts):
    """The part of each executable: in turn, those with most sources first, there and back again."""
    order = sorted(executables, key=lambda name: (-len(sources.get(name, ())), name))
    turn = [*range(parts), *reversed(range(parts))]
    return {name: turn[place % len(turn)] for place, name in enumerate(order)}


def kinds_of(links, sources):
    """The kind of each executable."""
    compiler = {target for target, own in sources.items() if any(name.startswith(("compiler/", "grammar/")) for name in own)}
    return {name: PROGRAMS if PROGRAMS in linked else "compiler" if linked & compiler else "runtime"
            for name, linked in links.items()}


def parts_of(parts):
    """The parts of each kind; where they are too few for that, all kinds are in all of them."""
    if parts < 4:
        return {kind: range(parts) for kind in KINDS}
    ends = [0]
    for share in KINDS.values():
        ends.append(ends[-1] + share)
    places = [round(end * parts / ends[-1]) for end in ends]
    return {kind: range(*places[number:number + 2]) for number, kind in enumerate(KINDS)}


def deal_kinds(kinds, sources, parts):
    """The part of each executable."""
    dealt = {}
    for kind, places in parts_of(parts).items():
        own = [name for name, each in kinds.items() if each == kind]
        dealt.update({name: places[part] for name, part in deal(own, sources, len(places)).items()})
    return dealt


def in_turns(build, part, parts, commit):
    """All tests, of those with the label `turns` one part and what was changed."""
    listing = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True,
                                        text=True, check=True).stdout)
    labelled = {test["name"] for test in listing["tests"] for each in test.get("properties", ())
                if each["name"] == "LABELS" and "turns" in each["value"]}
    all_tests, sources = tests(build), own_sources(build)
    executables = {target for _, _, target in all_tests if target}
    names = names_since(commit) if commit else []
    changed = {pathlib.PurePosixPath(name).parts[3].removesuffix(".st") for name in names
               if name.startswith(("tests/golden/programs/", "tests/golden/projects/"))}
    touched = set().union(*(touched_by(name, sources, executables) for name in names)) if names else set()
    turn = {name: zlib.crc32(("docs" if name.startswith("docs.") else name).encode()) % parts  # these need each other
            for name in labelled}
    return [(number, name, target) for number, name, target in all_tests
            if name not in labelled or turn[name] == part or target in touched
            or name.startswith("golden.") and name.rpartition(".")[2] in changed], len(all_tests)


def write_part(build, chosen):
    """Writes what `ctest -I` reads: beginning, end and step of a range, which is nothing here, then the numbers."""
    (build / "part.txt").write_text(",".join(["0", "0", "0", *(str(number) for number, _, _ in chosen)]) + "\n",
                                    encoding="utf-8")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("part", type=lambda text: (-1, 1) if text == "none" else tuple(map(int, text.split("/"))))
    parser.add_argument("--changed")
    parser.add_argument("--most", type=int)
    parser.add_argument("--turns", action="store_true")
    options = parser.parse_args()
    part, parts = options.part
    if options.part != (-1, 1) and not 0 <= part < parts:
        parser.error(f"there are the parts 0/{parts} to {parts - 1}/{parts}")
    if options.turns:
        chosen, count = in_turns(options.build, part, parts, options.changed)
        write_part(options.build, chosen)
        print(f"{len(chosen)} of {count} tests", file=sys.stderr)
        return 0
    all_tests = tests(options.build)
    executables = {target for _, _, target in all_tests if target}
    sources = own_sources(options.build)
    kinds = kinds_of({name: linked for name, linked in archives(options.build).items() if name in executables}, sources)
    dealt = deal_kinds(kinds, sources, parts)
    places = parts_of(parts)
    near = [name for name, kind in kinds.items() if part < 0 or part in places[kind]]
    lately = changed_last(options.build, options.changed, near, sources, options.most) if options.changed else set()
    others = places[PROGRAMS]
    chosen = [(number, name, target) for number, name, target in all_tests
              if target in lately or (dealt[target] if target else others[zlib.crc32(name.encode()) % len(others)]) == part]
    if not chosen:
        sys.exit("part.py: there are no tests in this part")
    write_part(options.build, chosen)
    targets = {target for _, _, target in chosen if target}
    if any(target is None for _, _, target in chosen):
        targets.update(GOLDEN)
    print("\n".join(sorted(targets)))
    print(f"{len(chosen)} of {len(all_tests)} tests, {len(targets & executables)} of {len(executables)} executables", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
