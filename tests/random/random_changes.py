#!/usr/bin/env python3
"""Random online changes of whole projects, against the rules of docs/online-change.md as change_model.py has them.

usage: random_changes.py STRIDE [--seeds FIRST..LAST] [--keep FOLDER]

A project of enumerations, structures, blocks, lists and programs is built, and the same with some random changes: members
added, removed, renamed, exchanged, moved to bases, of other types and bounds; types and programs renamed; other bases,
enumerators, initial values, constants. All variables get random values, the second build takes over, then the first one
again; each time all values are what the model says. An online change to the same build changes nothing. Pointers,
references, in-outs and interface variables that were set before lead to the same variables afterwards, or nowhere.
"""
import pathlib
import random
import re
import shutil
import subprocess
import sys

from change_model import Enum, Record, Text, carry_members, follow_member, leaves, literal, reaches, related
from change_project import Project, path_of
from seeds import try_seeds

UNITS = {"d": 86400000, "h": 3600000, "m": 60000, "s": 1000, "ms": 1}


def read(kind, text):
    """What is printed as a value that can be compared; None where it cannot be read."""
    if isinstance(kind, (Text, Enum)) or kind.kind == "BOOL":
        return text
    if kind.kind in ("TIME", "LTIME"):
        return sum(float(n) * UNITS[u] for n, u in re.findall(r"([\d.]+)(ms|[dhms])", text.split("#")[-1]))
    if kind.kind in ("REAL", "LREAL"):
        return float(text)
    return int(text)


class State:
    """The values of a project's variables."""

    def __init__(self, project, values=None):
        self.project = project
        self.values = values or [record.default() for record in self.records()]

    def records(self):
        return [*self.project.lists, *self.project.programs]

    def leaves(self):
        for record, values in zip(self.records(), self.values):
            for path, kind, value in leaves(record, values, record.name):
                yield path, kind, value

    def fill(self, rng):
        """Random values; the options that write them."""
        settings = []

        def filled(kind, value, path, constant):
            if isinstance(kind, Record):
                return {m.name: filled(m.type, value[m.name], f"{path}.{m.name}", constant or m.constant) for m in kind.all()}
            if isinstance(value, list):
                return [filled(kind.element, v, f"{path}[{kind.low + i}]", constant) for i, v in enumerate(value)]
            if constant or rng.random() < 0.1:
                return value
            value = self.project.value(kind)
            settings.extend(["--set", f"{path}={literal(kind, value)}"])
            return value

        self.values = [filled(r, v, r.name, False) for r, v in zip(self.records(), self.values)]
        return settings

    def carried(self, project):
        """The values of another build after it has taken over."""
        new = State(project)
        before = {record.name: (record, value) for record, value in zip(self.records(), self.values)}
        for i, record in enumerate(new.records()):
            found = before.get(record.renamed) or before.get(record.name)
            if found:
                new.values[i] = carry_members(found[0].all(), found[1], record.all(), new.values[i])
        return new


def own_places(project):
    return {w.name: path_of(w.root, w.steps) for w in project.watches}


def places_after(first, second):
    """By watch: where its variable is in the second build, None where it is not; and its number in what is printed: 0 for no
    address, 1 for the right one, the block's number for an interface; None where either is allowed."""
    places, states = {}, {}
    roots = {}
    for record in [*second.lists, *second.programs]:
        names = [r.name for r in [*first.lists, *first.programs]]
        roots[record.renamed if record.renamed in names else record.name] = record
    for watch, new in zip(first.watches, second.watches):
        root = next(r for r in [*first.lists, *first.programs] if r.name == watch.root)
        own = roots.get(watch.root)
        found = own and follow_member(root.all(), own.all(), watch.steps[0], watch.steps[1:])
        place = path_of(own.name, found[0]) if found else None
        places[watch.name], states[watch.name] = place, 0
        if not found:
            continue
        if watch.form == "interface":
            block = found[1]
            keeps = isinstance(block, Record) and block.is_block and related(watch.pointee, block)
            states[watch.name] = second.blocks.index(block) + 1 if keeps else 0
            if not isinstance(block, Record) or not block.is_block:
                places[watch.name] = None
        else:
            allowed = reaches(new.pointee, found[1])
            if watch.form != "pointer" and allowed and new.pointee.text() != found[1].text():
                allowed = None  # the compiler refuses it
            states[watch.name] = None if allowed is None else int(allowed)
            if not allowed:
                places[watch.name] = None
    return places, states


def run(options, *arguments):
    return subprocess.run([options.stride, *arguments], capture_output=True, text=True, check=False)


def differences(state, states, result):
    found = dict(line.split(" = ", 1) for line in result.stdout.splitlines() if " = " in line)
    wrong = []
    for path, kind, value in state.leaves():
        shown = found.get(path)
        if shown is None or read(kind, shown) != read(kind, literal(kind, value)):
            wrong.append(f"  {path} : {kind.text()}: expected {literal(kind, value)}, found {shown}")
    for name, expected in states.items():
        shown = found.get(f"WatchAll.{name}State")
        if expected is not None and shown != str(expected):
            wrong.append(f"  {name}: expected {expected}, found {shown}")
    return wrong


def compare(options, path, settings, state, states, builds):
    """Runs the first build and the changes to others; None if the variables are as in `state`."""
    arguments = ["sim", path / "a", "--for", "T#100ms", "--quiet", *settings]
    for number, build in enumerate(builds):
        arguments += ["--change", f"T#{30 + 20 * number}ms,{path / build}.so"]
    leaf_names = [leaf for leaf, _, _ in state.leaves()] + [f"WatchAll.{name}State" for name in states]
    result = run(options, *arguments, "--print", ",".join(leaf_names))
    wrong = differences(state, states, result)
    if result.returncode == 0 and not wrong:
        return None
    return "\n".join([f"{path} a{builds}: exit code {result.returncode}", *wrong[:8], result.stderr[-1500:]])


def check(options, seed):
    rng = random.Random(seed)
    first = Project(rng)
    second = first.changed()
    path = options.keep / f"random_change{seed}"
    problem = None
    places, states = places_after(first, second)
    own = {w.name: first.blocks.index(w.pointee) + 1 if w.form == "interface" else 1 for w in first.watches}
    for name, project, where in (("a", first, own_places(first)), ("b", second, places)):
        project.write(path / name, where)
        result = run(options, "build", path / name, "-o", path / f"{name}.so")
        if result.returncode != 0:
            problem = problem or f"{path}: build of {name}\n{result.stderr[:1500]}{result.stdout[:1500]}"
    if problem is None:
        state = State(first)
        settings = state.fill(rng)
        changed = state.carried(second)
        back = changed.carried(first)
        for after, leads, builds in ((state, own, ""), (state, own, "a"), (changed, states, "b"), (changed, states, "bb"),
                                     (back, {}, "ba")):
            problem = problem or compare(options, path, settings, after, leads, builds)
    if problem is None:
        shutil.rmtree(path)
        return sum(1 for _ in changed.leaves())
    print(problem)
    return None


if __name__ == "__main__":
    sys.exit(try_seeds(check, "1..20", "variables", lambda parser: None))
