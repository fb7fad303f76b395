#!/usr/bin/env python3
"""highlighting.py EDITORS [VIM]: whether the TextMate grammar, and the syntax file in a Vim that is
there, colour a sample as it is meant. The grammar is read by a small tokenizer of our own."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

# Lines, and what must be coloured in them: the text, its scope in TextMate, its group in Vim; None:
# neither may colour it. What stands twice in a line is looked at where it stands first.
SAMPLE = [
    ("/// Says what it does.", [("what it", "comment.line.documentation.st", "stDoc")]),
    ("FUNCTION_BLOCK FINAL Feeder EXTENDS Base", [
        ("FUNCTION_BLOCK", "keyword.declaration.st", "stDeclaration"), ("FINAL", "storage.modifier.st", "stModifier"),
        ("Feeder", "entity.name.type.st", None), ("EXTENDS", "storage.modifier.st", "stModifier"), ("Base", None, None)]),
    ("VAR_INPUT CONSTANT", [("VAR_INPUT", "keyword.declaration.st", "stDeclaration"),
                            ("CONSTANT", "storage.modifier.st", "stModifier")]),
    ("  method : INT := 16#FF_00; // a name here", [
        ("method", None, None), ("INT", "support.type.st", "stType"), (":=", "keyword.operator.assignment.st", "stOperator"),
        ("16#FF_00", "constant.numeric.st", "stNumber"), ("a name", "comment.line.double-slash.st", "stComment")]),
    ("  t : TIME := TIME#1m2.5s; d : DATE := D#2024-02-29;", [
        ("TIME", "support.type.st", "stType"), ("TIME#1m2.5s", "constant.numeric.time.st", "stNumber"),
        ("D#2024-02-29", "constant.numeric.time.st", "stNumber")]),
    ("  at_start AT %IX0.3 : ARRAY[1..10] OF REAL; T : BOOL;", [
        ("at_start", None, None), ("AT", "storage.modifier.st", "stModifier"),
        ("%IX0.3", "variable.other.address.st", "stAddress"), ("1", "constant.numeric.st", "stNumber"),
        ("10", "constant.numeric.st", "stNumber"), ("OF", "keyword.control.st", "stControl"), ("T ", None, None)]),
    ("end_var", [("end_var", "keyword.declaration.st", "stDeclaration")]),
    ("(* outer (* inner *) still; IF *) IF x THEN", [
        ("still; IF", "comment.block.st", "stComment"), ("THEN", "keyword.control.st", "stControl")]),
    ("/* one (* of those */ y := 1.5E-3;", [("of those", "comment.block.st", "stComment"),
                                            ("1.5E-3", "constant.numeric.st", "stNumber"), ("y", None, None)]),
    ("IF a AND_THEN NOT b OR S = 1 THEN", [("AND_THEN", "keyword.operator.word.st", "stOperatorWord"),
                                           ("NOT", "keyword.operator.word.st", "stOperatorWord"),
                                           ("S ", None, None), ("1", "constant.numeric.st", "stNumber")]),
    ("  lamp S= TRUE; text := 'it$'s FALSE'; w := \"wide\";", [
        ("S=", "keyword.operator.assignment.st", "stOperator"), ("TRUE", "constant.language.st", "stConstant"),
        ("s FALSE", "string.quoted.single.st", "stString"), ("wide", "string.quoted.double.st", "stString")]),
    ("  n := LIMIT(0, REAL_TO_INT(r), 7) + limit;", [
        ("LIMIT", "support.function.st", "stFunction"), ("REAL_TO_INT", "support.function.conversion.st", "stFunction"),
        ("limit;", None, None)]),
    ("END_IF", [("END_IF", "keyword.control.st", "stControl")]),
    ("  METHOD PUBLIC Stop : BOOL", [("METHOD", "keyword.declaration.st", "stDeclaration"),
                                     ("PUBLIC", "storage.modifier.st", "stModifier"),
                                     ("Stop", "entity.name.type.st", None)]),
    ("{attribute 'hide' := 'x'} action := 5;", [("attribute", "keyword.control.directive.st", "stPragma"),
                                                 ("hide", "string.quoted.single.st", "stString"), ("action", None, None)]),
    ("TASK := Class.Step; set(1);", [("TASK", None, None), ("Class", None, None), ("set", None, None)]),
    ("word.w := wordy;", [("wordy", None, None)]),
]


class Grammar:
    """As much of TextMate's rules as the grammar uses: match, begin and end, include, captures."""

    def __init__(self, data):
        self.data = data
        self.compiled = {}

    def regex(self, text):
        if text not in self.compiled:
            self.compiled[text] = re.compile(text)
        return self.compiled[text]

    def rules(self, patterns):
        for rule in patterns:
            if "include" in rule:
                target = self.data["repository"][rule["include"][1:]]
                yield from [target] if "begin" in target else self.rules(target["patterns"])
            else:
                yield rule

    def line(self, text, stack):
        """The scope of each character; `stack` holds the open rules, and is changed."""
        scopes = [stack[-1]["name"] if stack else None] * len(text)

        def paint(begin, end, scope):
            if scope:
                scopes[begin:end] = [scope] * (end - begin)

        at = 0
        while at <= len(text):
            rules = list(self.rules(stack[-1].get("patterns", []) if stack else self.data["patterns"]))
            found = [(match.start(), order, rule, match) for order, rule in enumerate(rules)
                     if (match := self.regex(rule.get("match") or rule["begin"]).search(text, at))]
            best = min(found, key=lambda one: one[:2], default=None)
            end = self.regex(stack[-1]["end"]).search(text, at) if stack else None
            if best is None and end is None:
                break
            if end and (best is None or end.start() <= best[0]):
                paint(at, end.end(), stack.pop()["name"])
                at = end.end()
                paint(at, len(text), stack[-1]["name"] if stack else None)
                if not stack:
                    scopes[at:] = [None] * (len(text) - at)
                continue
            rule, match = best[2], best[3]
            if "begin" in rule:
                stack.append(rule)
                paint(match.start(), len(text), rule["name"])
            else:
                paint(match.start(), match.end(), rule.get("name"))
            for number, capture in (rule.get("captures") or rule.get("beginCaptures") or {}).items():
                if match.group(int(number)):
                    paint(match.start(int(number)), match.end(int(number)), capture["name"])
            if match.end() == match.start() and "begin" not in rule:
                raise SystemExit(f"a rule matches nothing: {rule}")
            at = match.end()
        return scopes


def places():
    """Each expectation with its line and where it stands."""
    for number, (line, expected) in enumerate(SAMPLE):
        for text, scope, group in expected:
            at = line.find(text)
            if re.match(r"\w", text):
                at = re.search(r"(?<!\w)" + re.escape(text), line).start()
            yield number, at, text, scope, group


def check_textmate(editors):
    package = json.loads((editors / "vscode/package.json").read_text(encoding="utf-8"))
    contributed = package["contributes"]
    json.loads((editors / "vscode" / contributed["languages"][0]["configuration"]).read_text(encoding="utf-8"))
    path = editors / "vscode" / contributed["grammars"][0]["path"]
    grammar = Grammar(json.loads(path.read_text(encoding="utf-8")))
    stack, lines = [], []
    for line, _ in SAMPLE:
        lines.append(grammar.line(line, stack))
    problems = ["something is still open at the end"] if stack else []
    for number, at, text, scope, _ in places():
        seen = set(lines[number][at:at + len(text.rstrip())])
        if seen != {scope}:
            problems.append(f"TextMate, line {number + 1}: '{text}' is {seen}, not {scope}")
    return problems


VIM_SCRIPT = """
set nocompatible
exec 'set runtimepath^=' . $EDITORS . '/vim'
syntax on
exec 'edit ' . $SAMPLE
let out = [&filetype]
for place in readfile($PLACES)
  let at = split(place)
  call add(out, synIDattr(synID(str2nr(at[0]), str2nr(at[1]), 1), 'name'))
endfor
call writefile(out, $OUT)
qall!
"""


def check_vim(editors, vim):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        files = {"SAMPLE": folder / "sample.st", "PLACES": folder / "places", "OUT": folder / "out"}
        files["SAMPLE"].write_text("".join(line + "\n" for line, _ in SAMPLE), encoding="utf-8")
        asked = [(number, column, text, group) for number, at, text, _, group in places()
                 for column in (at, at + len(text.rstrip()) - 1)]
        files["PLACES"].write_text("".join(f"{line + 1} {column + 1}\n" for line, column, _, _ in asked))
        (folder / "script.vim").write_text(VIM_SCRIPT)
        environment = {"EDITORS": str(editors), "HOME": str(folder), "PATH": "/usr/bin:/bin", "TERM": "dumb",
                       **{name: str(path) for name, path in files.items()}}
        subprocess.run([vim, "-e", "-s", "-u", "NONE", "-S", str(folder / "script.vim")], env=environment, timeout=30,
                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=False)
        filetype, *groups = files["OUT"].read_text().split("\n")[:-1]
    problems = [] if filetype == "st" else [f"Vim: the file's type is '{filetype}'"]
    for (line, column, text, group), seen in zip(asked, groups, strict=True):
        if seen != (group or ""):
            problems.append(f"Vim, line {line + 1}, column {column + 1}: '{text}' is {seen or None}, not {group}")
    return problems


def main():
    editors = pathlib.Path(sys.argv[1])
    if sys.argv[2] == "textmate":
        problems = check_textmate(editors)
    elif pathlib.Path(sys.argv[3]).exists():
        problems = check_vim(editors, sys.argv[3])
    else:
        print("skipped: vim is not installed")
        sys.exit(77)
    print("\n".join(problems) or "all as expected")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
