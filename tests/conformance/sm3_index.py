#!/usr/bin/env python3
"""Compares the public indices of SoftMotion 3's libraries (sm3_index.txt) with what stdlib/ holds.

    python3 tests/conformance/sm3_index.py
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = pathlib.Path(__file__).with_name("sm3_index.txt")


def main():
    errors = []
    seen = set()
    library = None
    for number, line in enumerate(TABLE.read_text(encoding="utf-8").splitlines(), 1):
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
            errors.append(f"{TABLE.name}:{number}: {name} is neither done nor left out for a reason")
        if (library, name) in seen:
            errors.append(f"{TABLE.name}:{number}: {name} stands here twice")
        seen.add((library, name))
        exists = (ROOT / "stdlib" / library / f"{name}.st").exists()
        if exists and state != "done":
            errors.append(f"{TABLE.name}:{number}: {name} exists; it is done")
        if not exists and state == "done":
            errors.append(f"{TABLE.name}:{number}: stdlib/{library}/{name}.st does not exist")
    print("\n".join(errors))
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
