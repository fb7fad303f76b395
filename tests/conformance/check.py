#!/usr/bin/env python3
"""Keeps README.md and the golden tests together.

usage: check.py [--update]

Every test that a table of README.md names (`name` or `name_*`, in the last but one column) must exist, and every golden
program must be listed. The list at the end is written by --update: each program with the first line of its description.
"""
import fnmatch
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).parent
GOLDEN = HERE.parent / "golden"
MARK = "<!-- written by check.py --update -->"


def first_comment(file):
    for line in file.read_bytes().decode("utf-8", "replace").splitlines():
        if not line.startswith(("//", "(*", "{", " ", "\ufeff")):
            return ""
        text = line.lstrip("\ufeff").strip("/(* )\t")
        if text and line.lstrip("\ufeff").startswith(("//", "(*")) and not text.startswith("RUN:"):
            return text
    return ""


def main():
    names = {"programs": sorted(f.stem for f in (GOLDEN / "programs").glob("*.st")),
             "diagnostics": sorted(f.stem for f in (GOLDEN / "diagnostics").glob("*.st")),
             "projects": sorted(f.name for f in (GOLDEN / "projects").iterdir() if f.is_dir())}
    every = [n for group in names.values() for n in group]
    readme = HERE / "README.md"
    head, _, listed = readme.read_text(encoding="utf-8").partition(MARK)
    errors = []
    for line in head.splitlines():
        cells = [c.strip() for c in line.split("|")]
        if len(cells) != 6 or cells[1] in ("feature", "---"):
            continue
        patterns = re.findall(r"`([A-Za-z0-9_*]+)`", cells[3])
        if not patterns and not cells[2].startswith("no"):
            errors.append(f"no test is named for: {cells[1]}")
        errors += [f"there is no golden test `{p}`" for p in patterns if not fnmatch.filter(every, p)]
    must_fail = sum(n.startswith("fail_") for n in every)
    runs = [n for n in names["programs"] if not n.startswith("fail_")]
    lines = ["", f"{len(names['programs'])} programs are run and their values compared, {must_fail} cases must fail with the",
             f"right code at the right place ({len(names['programs']) - len(runs)} of them at run time).", "",
             "| program | shows |", "|---|---|"]
    for name in names["programs"]:
        text = first_comment(GOLDEN / "programs" / f"{name}.st").replace("|", "\\|")
        lines.append(f"| [`{name}`](../golden/programs/{name}.st) | {text} |")
    text = "\n".join(lines) + "\n"
    if "--update" in sys.argv:
        readme.write_text(head + MARK + "\n" + text, encoding="utf-8")
    else:
        errors += [f"the golden program `{n}` is not listed; run check.py --update"
                   for n in names["programs"] if f"[`{n}`]" not in listed]
        errors += [f"`{n}` is listed and does not exist; run check.py --update"
                   for n in re.findall(r"\[`(\w+)`\]", listed) if n not in names["programs"]]
    print("\n".join(errors) or "ok")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
