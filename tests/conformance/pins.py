#!/usr/bin/env python3
"""Compares the pins of the motion blocks with the table pins.tsv, and with what SoftMotion 3 has (sm3_pins.txt).

    python3 tests/conformance/pins.py             # fails where a declaration and a table differ
    python3 tests/conformance/pins.py --update    # writes pins.tsv anew from the declarations; look at the diff afterwards

Each line of the table is a pin: block, section (in_out, input, output), name, type, default, other default with
softmotion = "3", second name. What a program can name must not vanish: a pin that is renamed keeps its old name as a
second one (attribute 'alias')."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = pathlib.Path(__file__).with_name("pins.tsv")
SOFTMOTION3 = pathlib.Path(__file__).with_name("sm3_pins.txt")
LIBRARIES = ("SM_DriveBasic", "SM_PLCopen", "SM_FileFBs", "SM_CNC", "SM_Trafo", "SM3_Transformation")
SECTIONS = {"VAR_IN_OUT": "in_out", "VAR_INPUT": "input", "VAR_OUTPUT": "output"}
HEAD = ("block", "section", "pin", "type", "default", "default_3", "second_name")

DECLARATION = re.compile(r"^(\w+(?:\s*,\s*\w+)*)\s*:\s*([^:;]+?)\s*(?::=\s*(.*?))?\s*;$")
ATTRIBUTE = re.compile(r"\{attribute\s+'([^']*)'(?:\s*:=\s*'([^']*)')?\}")


def without_comments(text):
    text = re.sub(r"\(\*.*?\*\)", " ", text, flags=re.S)
    return re.sub(r"//[^\n]*", "", text)


def statements(section):
    """The declarations of a section with the attributes before them."""
    attributes = {}
    for part in re.split(r"(\{attribute[^}]*\})|(?<=;)", section):
        part = (part or "").strip()
        if not part:
            continue
        found = ATTRIBUTE.match(part)
        if found:
            attributes[found.group(1)] = found.group(2) or ""
            continue
        yield " ".join(part.split()), attributes
        attributes = {}


def pins_of(path):
    """The rows of a source: none where it is no FUNCTION_BLOCK."""
    text = without_comments(path.read_text(encoding="utf-8"))
    if not re.search(r"^FUNCTION_BLOCK\b", text, flags=re.M):
        return []
    rows = []
    for found in re.finditer(r"^(VAR_IN_OUT|VAR_INPUT|VAR_OUTPUT)\b(?: CONSTANT)?(.*?)^END_VAR", text, flags=re.M | re.S):
        section = SECTIONS[found.group(1)]
        for statement, attributes in statements(found.group(2)):
            declaration = DECLARATION.match(statement)
            if declaration is None:
                sys.exit(f"{path}: cannot read `{statement}`")
            names, kind, default = declaration.groups()
            if "hide" in attributes:
                continue
            for name in re.split(r"\s*,\s*", names):
                rows.append((path.stem, section, name, " ".join(kind.split()), default or "",
                             attributes.get("softmotion3", ""), attributes.get("alias", "")))
    return rows


def declared():
    rows = []
    for library in LIBRARIES:
        for path in sorted((ROOT / "stdlib" / library).glob("*.st")):
            text = path.read_text(encoding="utf-8")
            block = text.find("FUNCTION_BLOCK")
            if "{attribute 'hide'}" in text[: max(block, 0)]:
                continue  # private to Stride
            rows += pins_of(path)
    return rows


def table():
    lines = TABLE.read_text(encoding="utf-8").splitlines()
    rows = [tuple(line.split("\t")) for line in lines if line and not line.startswith("#")]
    if rows[0] != HEAD:
        sys.exit(f"{TABLE}: the first line must name the columns")
    return rows[1:]


def differences(expected, found):
    """What is wrong, a line each."""
    by_pin = {(row[0], row[2]): row for row in found}
    known = {(row[0], row[2]) for row in expected}
    for row in expected:
        now = by_pin.get((row[0], row[2]))
        if now is None:
            yield f"{row[0]}.{row[2]} is gone: {row[1]} {row[3]}"
        else:
            for column, was, has in zip(HEAD, row, now):
                if was != has:
                    yield f"{row[0]}.{row[2]}: {column} is `{has}`, the table has `{was}`"
    for row in found:
        if (row[0], row[2]) not in known:
            yield f"{row[0]}.{row[2]} is not in the table: --update"
    # The order counts: calls by position, and the boxes of other tools.
    for block in dict.fromkeys(row[0] for row in expected):
        was = [row[2] for row in expected if row[0] == block]
        now = [row[2] for row in found if row[0] == block]
        if set(was) == set(now) and was != now:
            yield f"{block}: the order of the pins is {', '.join(now)}"


def self_test(expected):
    """The comparison notices what it is for."""
    first = expected[0]
    renamed = first[:2] + (first[2] + "X",) + first[3:]
    retyped = first[:3] + ("WSTRING",) + first[4:]
    for wrong, problems in (
            (expected[1:], 1),
            ([renamed] + expected[1:], 2),
            ([retyped] + expected[1:], 1),
            ([expected[1], first] + expected[2:] if expected[1][0] == first[0] else [retyped] + expected[1:], 1)):
        if len(list(differences(expected, wrong))) != problems:
            sys.exit("pins.py does not notice a changed pin")


def softmotion3():
    """(missing, block, section, pin, type, default) of SoftMotion 3, default None where it is not known."""
    for line in SOFTMOTION3.read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        words = line.split()
        missing = words[0] == "!"
        block, section, *pins = words[1:] if missing else words
        for pin in pins:
            name, rest = pin.split(":", 1)
            kind, equals, default = rest.partition("=")
            yield missing, block, section, name, kind, default if equals else None


def same_default(declared, known):
    zero = ("", "0", "FALSE", "SMC_ERROR.SMC_NO_ERROR")
    return declared == known or declared in zero and known in zero


def against_softmotion3(found):
    """What is wrong, a line each."""
    pins = {}
    for row in found:
        pins[row[0], row[2]] = row
        if row[6]:
            pins[row[0], row[6]] = row
    for missing, block, section, name, kind, default in softmotion3():
        row = pins.get((block, name))
        if missing:
            if row is not None and row[3] == kind:
                yield f"{block}.{name} is there now: take the ! away"
        elif row is None:
            yield f"{block}.{name} of SoftMotion 3 is missing"
        elif row[1] != section:
            yield f"{block}.{name} is {row[1]}, in SoftMotion 3 {section}"
        elif kind not in ("?", row[3]):
            yield f"{block}.{name} is {row[3]}, in SoftMotion 3 {kind}"
        elif default is not None and not same_default(row[5] or row[4], default):
            yield f"{block}.{name} is {row[5] or row[4] or 0} by default, in SoftMotion 3 {default}"


def main():
    found = declared()
    if "--update" in sys.argv[1:]:
        TABLE.write_text("\t".join(HEAD) + "\n" + "".join("\t".join(row) + "\n" for row in found), encoding="utf-8")
        return 0
    expected = table()
    self_test(expected)
    problems = [*differences(expected, found), *against_softmotion3(found)]
    for problem in problems:
        print(problem)
    print(f"{len(found)} pins of {len({row[0] for row in found})} blocks, {len(problems)} differences")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
