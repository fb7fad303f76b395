"""What the compiler makes of a golden program or project: C++ and messages, in hundredths of a second.

A mutant of the compiler shows in a golden program only where it makes something else of it. That is found out without g++,
so that a mutant meets hundreds of programs, and only those are compiled and run that differ.
"""

import hashlib
import shutil
import subprocess
import tomllib
from pathlib import Path

MODES = {"": [[]], "checked": [[], ["--debug"]], "all": [[], ["--debug"], ["--unchecked"], ["--debug", "--unchecked"]]}
WITH_VALUE = {"-W", "-D", "--define", "--loop-budget"}  # options that `build` has, too
ALONE = {"--unchecked", "--debug"}


def directive(source, name):
    """What a `// NAME: …` line among the comments at the top says"""
    for line in source.splitlines():
        if not line.startswith("//"):
            break
        if line.startswith(f"// {name}:"):
            return line.partition(":")[2].strip()
    return ""


def source_of(case):
    """Without the block of what is expected"""
    lines = case.read_text(errors="surrogateescape").rstrip("\n").split("\n")
    while lines and lines[-1].startswith("//!"):
        lines.pop()
    return "\n".join(lines).rstrip("\n") + "\n"


def options_of(source):
    words, out = directive(source, "RUN").split(), []
    for i, word in enumerate(words):
        if word in ALONE:
            out.append(word)
        elif word in WITH_VALUE:
            out += words[i:i + 2]
    return out if "-W" in out else [*out, "-W", "off=lints"]


def project_of(case, top):
    """The project of a golden test that only simulates it: what the compiler makes of it says all. Else None"""
    manifest = case / "golden.toml"
    if not manifest.exists():
        return None
    told = tomllib.loads(manifest.read_text())
    if any(run["args"][0] != "sim" or ALONE & set(run["args"]) for run in told.get("run", [told])):
        return None
    return top / told["project"] if "project" in told else case


def commands(case, folder, top):
    """Puts the program or project into the folder; what makes C++ of it below `out`, in every mode"""
    if case.is_file():
        source = source_of(case)
        (folder / case.name).write_text(source, errors="surrogateescape")
        return [["build", case.name, "--emit", "cpp", "-o", "out", *options_of(source), *mode] for mode in MODES[directive(source, "MODES")]]
    shutil.copytree(project_of(case, top), folder / "project", ignore=shutil.ignore_patterns(".*", "build", "golden.toml"))
    return [["build", "project", "--emit", "cpp", "-o", "out"]]


def emitted(stride, case, folder, top, environment, limit=60):
    """A hash of it; "" when it takes longer than `limit` seconds"""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    digest = hashlib.sha256()
    for command in commands(case, folder, top):
        try:
            done = subprocess.run([*stride, *command], cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, timeout=limit)
        except subprocess.TimeoutExpired:
            return ""
        digest.update(f"{done.returncode}\n".encode() + done.stdout + done.stderr)
        for file in sorted((folder / "out").rglob("*")):
            if file.is_file():
                digest.update(str(file.relative_to(folder)).encode() + b"\n" + file.read_bytes())
        shutil.rmtree(folder / "out", ignore_errors=True)
    shutil.rmtree(folder)
    return digest.hexdigest()
