#!/usr/bin/env python3
"""clang-tidy over the sources that a build compiles, by .clang-tidy.

usage: tidy.py BUILD [--jobs N] [--changed COMMIT [--most N]]

Takes the commands of BUILD (several sources at once, where the build does so), without the precompiled headers of
another compiler. With --changed only sources that differ from COMMIT, and for each such header one source that includes
it: of each unit these, the last changed unit first; with --most no more than N units. Each finding is shown once.
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
OURS = tuple(str(ROOT / folder) + "/" for folder in ("compiler", "runtime", "drivers", "tests", "examples"))


def without_precompiled(command):
    """The words of a compiler's command that clang-tidy understands."""
    words, kept = shlex.split(command), []
    while words and not words[0].endswith("g++") and "c++" not in words[0]:
        words.pop(0)  # the compiler's launcher
    i = 0
    while i < len(words):
        if words[i] == "-include" and "cmake_pch" in words[i + 1]:
            i += 2
            continue
        if words[i] != "-Winvalid-pch" and not words[i].startswith("--param="):
            kept.append(words[i])
        i += 1
    return kept


def sources_of(unit):
    """The sources that a unit consists of: itself, or what a unity source includes."""
    path = pathlib.Path(unit["file"])
    if "Unity" not in path.parts:
        return [str(path)]
    return re.findall(r'#include "([^"]+)"', path.read_text(encoding="utf-8"))


def names_since(commit):
    """The files that differ from the commit, the last changed first."""
    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=True).stdout.split()
    differ = set(git("diff", "--name-only", commit))
    return [name for name in dict.fromkeys(git("diff", "--name-only", "HEAD")
                                           + git("log", "--format=", "--name-only", f"{commit}..HEAD"))
            if name in differ]


def choose(units, commit):
    """The units with sources that differ from the commit, and with one for each such header: each with these sources only."""
    texts = {source: pathlib.Path(source).read_text(encoding="utf-8") for unit in units for source in sources_of(unit)}
    unit_of = {source: unit for unit in reversed(units) for source in sources_of(unit)}
    chosen = {}
    for name in names_since(commit):
        if str(ROOT / name) in texts:
            chosen[str(ROOT / name)] = None
        if name.endswith((".hpp", ".h", ".def")):
            including = [source for source, text in texts.items() if f'#include "{name}"' in text]
            if including and not any(source in chosen for source in including):
                chosen[including[0]] = None
    parts = {}
    for source in chosen:
        parts.setdefault(unit_of[source]["file"], (unit_of[source], []))[1].append(source)
    return list(parts.values())


def reduced(unit, sources, folder, number):
    """The unit with some of its sources only, in a file of that folder; itself where these are all."""
    if len(sources) == len(sources_of(unit)):
        return unit
    path = pathlib.Path(folder) / f"part_{number}.cxx"
    path.write_text("".join(f'#include "{source}"\n' for source in sources), encoding="utf-8")
    words = [str(path) if word == unit["file"] else word for word in unit["arguments"]]
    return dict(unit, file=str(path), arguments=words)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--changed")
    parser.add_argument("--most", type=int)
    options = parser.parse_args()
    units = json.loads((options.build / "compile_commands.json").read_text(encoding="utf-8"))
    units = [dict(unit, arguments=without_precompiled(unit["command"])) for unit in units
             if all(source.startswith(OURS) for source in sources_of(unit))]
    for unit in units:
        del unit["command"]
    with tempfile.TemporaryDirectory() as folder:
        chosen = units
        if options.changed:
            chosen = [reduced(unit, sources, folder, number)
                      for number, (unit, sources) in enumerate(choose(units, options.changed)[:options.most])]
        (pathlib.Path(folder) / "compile_commands.json").write_text(json.dumps(chosen), encoding="utf-8")

        def tidy(unit):
            return subprocess.run(["clang-tidy", "-p", folder, "--quiet", unit["file"]], capture_output=True, text=True,
                                  check=False, cwd=unit["directory"]).stdout

        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            findings = "".join(pool.map(tidy, chosen))
    # A header's findings come once with each unit that includes it; those of other people's headers are not ours.
    blocks = dict.fromkeys(re.split(r"^(?=/\S+:\d+:\d+: (?:warning|error): )", findings, flags=re.M))
    ours = [block for block in blocks if block.startswith(OURS)]
    print("".join(ours), end="")
    print(f"{len(chosen)} of {len(units)} units, {len(ours)} findings")
    return 1 if ours else 0


if __name__ == "__main__":
    sys.exit(main())
