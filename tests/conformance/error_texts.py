#!/usr/bin/env python3
"""Every member of SMC_ERROR has an English and a German text and an explanation, and nothing else has.

usage: error_texts.py
"""
import pathlib
import re
import sys

LIBRARY = pathlib.Path(__file__).parent.parent.parent / "stdlib" / "SM_Error"


def main():
    declared = {}
    doc = []
    for line in (LIBRARY / "SMC_ERROR.st").read_text(encoding="utf-8").splitlines():
        text = line.strip()
        if text.startswith("///"):
            doc.append(text[3:].strip())
            continue
        member = re.match(r"(SMC_\w+) := (\d+)", text)
        if member:
            declared[member[1]] = doc
        doc = []
    errors = [f"SMC_ERROR.{name}: after the first line of its description and an empty one, say what it means"
              " and what to do" for name, doc in declared.items() if name != "SMC_NO_ERROR" and "" not in doc]
    for file in ("SMC_ErrorTextEnglish.st", "SMC_ErrorTextGerman.st"):
        texts = dict(re.findall(r"SMC_ERROR\.(\w+):\n  \w+ := '([^']*)';", (LIBRARY / file).read_text(encoding="utf-8")))
        errors += [f"{file}: no text for {name}" for name in declared if not texts.get(name)]
        errors += [f"{file}: {name} is no member of SMC_ERROR" for name in texts if name not in declared]
        errors += [f"{file}: the text of {name} has more than 100 characters" for name, t in texts.items() if len(t) > 100]
    print("\n".join(errors))
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
