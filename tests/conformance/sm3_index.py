#!/usr/bin/env python3
"""Compares public indices of libraries, SoftMotion 3's (sm3_index.txt) and CODESYS V3's (v3_index.txt), with what stdlib/ holds.

    python3 tests/conformance/sm3_index.py
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLES = [pathlib.Path(__file__).with_name(name) for name in ("sm3_index.txt", "v3_index.txt")]


def errors_of(table):
    errors = []
    seen = set()
    library = None
    for number, line in enumerate(table.read_text(encoding="utf-8").splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("#"):
            continue
        heading = re.fullmatch(r"\[(\w+)\]", line)
        if heading:
            library = heading[1]
            continue
        name, _, state = line.partition(" ")
        state = state.strip()
        if not state:
            errors.append(f"{table.name}:{number}: {name} is neither done nor left out for a reason")
        if (library, name) in seen:
            errors.append(f"{table.name}:{number}: {name} stands here twice")
        seen.add((library, name))
        exists = (ROOT / "stdlib" / library / f"{name}.st").exists()
        if exists and state != "done":
            errors.append(f"{table.name}:{number}: {name} exists; it is done")
        if not exists and state == "done":
            errors.append(f"{table.name}:{number}: stdlib/{library}/{name}.st does not exist")
    return errors


def main():
    errors = [error for table in TABLES for error in errors_of(table)]
    print("\n".join(errors))
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
