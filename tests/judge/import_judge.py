#!/usr/bin/env python3
"""Imports checkouts of other people's projects, and says how far that went.

usage: import_judge.py STRIDE FOLDER [--encoding NAME]

FOLDER holds a checkout in each of its subfolders; nothing is fetched. Each is imported as a whole and checked. The table is Markdown: files that were
read, objects in them (POUs, types, lists of variables), how many of these were imported, and how many of those have no error in the check; then what
was left out, by kind. A crash or an internal error ends with 1: an import may find losses, but never that.
"""
import argparse
import collections
import json
import pathlib
import re
import subprocess
import sys
import tempfile

COUNTS = re.compile(r"Imported (\d+) objects? from (\d+) files? into .*: (\d+) left out, (\d+) changed, (\d+) to look at, (\d+) errors? in the check")


def run(arguments, seconds=900):
    """(exit code, output, errors) of a command; a timeout is a crash."""
    try:
        done = subprocess.run(arguments, capture_output=True, text=True, errors="replace", timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return -1, "", f"no end after {seconds} s"
    return done.returncode, done.stdout, done.stderr


def section(report, title):
    """The entries of a section of the report."""
    found = re.search(rf"^## {title}: \d+\n\n(.*?)(?=^## |\Z)", report, re.S | re.M)
    return [line[2:] for line in found.group(1).splitlines() if line.startswith("- ")] if found else []


def kind(entry):
    """What sort of loss an entry is: `VISUALISATION`, `body (_CFC_BODY)`, `library`."""
    drawn = re.search(r"its body is drawn \((\w+)\)", entry)
    if drawn:
        return f"body {drawn.group(1)}"
    what = re.sub(r"^.*?:\d+: ", "", entry)
    if what.startswith("%"):
        return "address"
    word = re.match(r"[\w@]+", what)
    return word.group(0) if word else "other"


def files_with_errors(stride, project):
    """Sources in which the check finds errors."""
    _, out, _ = run([stride, "check", str(project), "--format", "json", "--max-errors", "0"])
    files = set()
    for line in out.splitlines():
        diagnostic = json.loads(line)
        if diagnostic.get("severity") == "error":
            labels = diagnostic.get("labels") or [{}]
            files.add(labels[0].get("file", "stride.toml"))
    return files


def judge(stride, checkout, encoding):
    """(row of the table, what went wrong) of a checkout."""
    with tempfile.TemporaryDirectory() as folder:
        project = pathlib.Path(folder) / "project"
        options = ["--encoding", encoding] if encoding else []
        code, out, errors = run([stride, "import", str(checkout), "-o", str(project), *options])
        found = COUNTS.search(out)
        if code not in (0, 1, 2) or "internal error" in errors or (found is None and code != 2):
            return f"| {checkout.name} | | | | | crashed |", f"{checkout}: exit code {code}: {errors.strip()[-400:]}"
        if found is None:
            return f"| {checkout.name} | 0 | 0 | 0 | 0 | nothing that is imported |", None
        report = (project / "import-report.md").read_text(encoding="utf-8", errors="replace")
        objects, files, _, _, _, _ = map(int, found.groups())
        lost = collections.Counter(kind(entry) for entry in section(report, "Left out"))
        lost.update("file" for _ in section(report, "Files that could not be read"))
        broken = files_with_errors(stride, project)
        written = [entry.rsplit(": ", 1)[1] for entry in section(report, "Converted") if entry.endswith(".st")]
        clean = sum(1 for path in written if path not in broken)
        left = ", ".join(f"{count} {name}" for name, count in lost.most_common()) or "nothing"
        # Each object that did not come is one of the losses; others are no objects.
        missing = sum(count for name, count in lost.items() if name in ("POU", "type", "global"))
        return f"| {checkout.name} | {files} | {objects + missing} | {objects} | {clean} | {left} |", None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("stride")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--encoding")
    arguments = parser.parse_args()
    checkouts = sorted(path for path in arguments.folder.iterdir() if path.is_dir() and not path.name.startswith("."))
    if not checkouts:
        sys.exit(f"import-judge: there is no checkout in {arguments.folder}")
    print("| checkout | files | objects | imported | without errors | left out |")
    print("|---|---|---|---|---|---|")
    problems = []
    for checkout in checkouts:
        row, problem = judge(arguments.stride, checkout, arguments.encoding)
        print(row, flush=True)
        if problem:
            problems.append(problem)
    for problem in problems:
        print(problem, file=sys.stderr)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
