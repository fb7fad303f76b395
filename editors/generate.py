#!/usr/bin/env python3
"""Writes the syntax files of editors/ from the compiler's own tables: the words of the scanner
(compiler/syntax/keywords.cpp), the elementary types (compiler/semantics/types.cpp), the built-in
functions (compiler/semantics/builtins.def) and the pragmas (compiler/syntax/pragmas.def).

  generate.py           writes what has changed
  generate.py --check   writes nothing; fails when something is out of date
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# What a word is for a reader, by when the scanner takes it for a keyword (Keyword::Kind) …
GROUP_OF_KIND = {
    "Hard": "control",
    "Operation": "operator",
    "Qualifier": "modifier",
    "At": "modifier",
    "Pointer": "type",
    "Infix": "operator",
    "Statement": "control",
    "Clause": "modifier",
    "Modifier": "modifier",
    "Construct": "declaration",
    "Local": "declaration",
    "Assignment": None,  # S=, R=, REF=: operators, see below
}
# … and where that says too little.
GROUP_OF_WORD = {"NOT": "operator", "TRUE": "constant", "FALSE": "constant", "ARRAY": "type", "STRING": "type",
                 "WSTRING": "type", "OF": "control", "JMP": "control", "R_EDGE": "modifier", "F_EDGE": "modifier",
                 "READ_ONLY": "modifier", "READ_WRITE": "modifier", "ON": "modifier", "WITH": "modifier"}
DECLARING = re.compile(r"(END_)?(PROGRAM|FUNCTION|FUNCTION_BLOCK|TYPE|STRUCT|VAR\w*|METHOD|PROPERTY|INTERFACE|CLASS"
                       r"|ACTIONS?|GET|SET|NAMESPACE|CONFIGURATION|RESOURCE|UNION|STEP|TRANSITION)$")
# Kinds whose words are names elsewhere, too: coloured only where a declaration can begin.
LINE_START = ("Construct", "Local")


def read(path):
    return (ROOT / path).read_text(encoding="utf-8")


def scanner_words():
    """(word, kind) of each row of kWords."""
    text = read("compiler/syntax/keywords.cpp")
    table = text[text.index("constexpr Word kWords[] = {"):]
    table = table[:table.index("\n};")]
    rows = [(word, "Hard") for word in re.findall(r"^\s*HARD\((\w+)\)", table, re.M)]
    rows += re.findall(r'\{"(\w+)", Tok::\w+, Kind::(\w+)\}', table)
    if len(rows) < 100:
        raise SystemExit("the table of words in keywords.cpp is not found")
    return rows


def elementary_types():
    names = re.findall(r'\{TypeKind::\w+, "([A-Z_]+)"\}', read("compiler/semantics/types.cpp"))
    shorter = {"TOD", "LTOD", "DT", "LDT"}  # beside their long names
    return sorted(set(names) | shorter | {"DATE_AND_TIME", "TIME_OF_DAY", "LDATE_AND_TIME", "LTIME_OF_DAY"})


def builtin_functions():
    text = read("compiler/semantics/builtins.def")
    names = re.findall(r'^STC_BUILTIN(?:_ALIAS)?\(\w+, "([A-Z_0-9]+)"', text, re.M)
    return sorted(set(names))


def pragma_words():
    return sorted(set(re.findall(r'^STC_PRAGMA\(\w+, "(\w+)"', read("compiler/syntax/pragmas.def"), re.M)))


class Words:
    """All words by group; those of `names` can be names as well."""

    def __init__(self):
        self.groups = {"control": [], "operator": [], "modifier": [], "declaration": [], "type": [], "constant": []}
        self.at_line_start = []
        self.assignments = []
        for word, kind in scanner_words():
            group = GROUP_OF_WORD.get(word, GROUP_OF_KIND[kind])
            if kind == "Hard" and DECLARING.match(word):
                group = "declaration"
            if group is None:
                self.assignments.append(word)
            elif kind in LINE_START and group == "declaration":
                self.at_line_start.append(word)
            else:
                self.groups[group].append(word)
        keywords = {word for group in self.groups.values() for word in group}
        self.groups["type"] += [name for name in elementary_types() if name not in keywords]
        known = keywords | set(self.groups["type"])
        self.functions = [name for name in builtin_functions() if name not in known]
        self.pragmas = pragma_words()


def one_of(words):
    """A regular expression for exactly these words; the longest first."""
    return "(?:" + "|".join(sorted(words, key=lambda word: (-len(word), word))) + ")"


NUMBER = (r"(?i)\b(?:[A-Z_]\w*#)?[+-]?(?:\d+#[0-9A-Z](?:_?[0-9A-Z])*"
          r"|\d(?:_?\d)*\.\d(?:_?\d)*(?:E[+-]?\d+)?|\d(?:_?\d)*E[+-]?\d+|\d(?:_?\d)*)\b")
TIME = (r"(?i)\b(?:(?:T|TIME|LT|LTIME)#[+-]?(?:\d[\d_]*(?:\.\d[\d_]*)?(?:MS|US|NS|D|H|M|S)_?)+"
        r"|(?:L?DATE_AND_TIME|L?TIME_OF_DAY|L?DATE|L?TOD|L?DT|L?D)#\d+(?:[:.-]\d+)*)")
ADDRESS = r"%[A-Za-z]+(?:\*|\d+(?:\.\d+)*)"


def textmate(words):
    def word(name, group, kind):
        return {"name": name + ".st", "match": r"(?i)\b" + one_of(group) + r"\b" + kind}

    strings = [
        {"name": f"string.quoted.{kind}.st", "begin": quote, "end": quote,
         "patterns": [{"name": "constant.character.escape.st", "match": r"\$(?:[0-9A-Fa-f]{2,4}|.)"}]}
        for kind, quote in (("single", "'"), ("double", '"'))]
    pragma = {
        "name": "meta.preprocessor.st", "begin": r"(?i)\{\s*(" + one_of(words.pragmas) + r"\b)?", "end": r"\}",
        "beginCaptures": {"1": {"name": "keyword.control.directive.st"}},
        "patterns": [{"include": "#strings"}]}
    comments = [
        {"name": "comment.line.documentation.st", "match": r"///.*$"},
        {"name": "comment.line.double-slash.st", "match": r"//.*$"},
        {"name": "comment.block.st", "begin": r"/\*", "end": r"\*/"},
        {"name": "comment.block.st", "begin": r"\(\*", "end": r"\*\)", "patterns": [{"include": "#nested"}]}]
    declared = one_of(word for word in ("PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "METHOD", "PROPERTY", "INTERFACE",
                                        "CLASS", "ACTION", "NAMESPACE"))
    modifiers = one_of(["ABSTRACT", "FINAL", "PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "OVERRIDE"])
    patterns = [
        {"include": "#comments"}, {"include": "#pragmas"}, {"include": "#strings"},
        {"match": r"(?i)^\s*(" + declared + r")\b((?:\s+" + modifiers + r"\b)*)\s+([A-Za-z_][\w.]*)(?!\w|\s*(?::=|\())",
         "captures": {"1": {"name": "keyword.declaration.st"}, "2": {"name": "storage.modifier.st"},
                      "3": {"name": "entity.name.type.st"}}},
        {"name": "keyword.declaration.st",
         "match": r"(?i)^\s*" + one_of(words.at_line_start) + r"\b(?!\s*(?::=|\.|\[|\(|:))"},
        {"name": "constant.numeric.time.st", "match": TIME},
        {"name": "constant.numeric.st", "match": NUMBER},
        {"name": "variable.other.address.st", "match": ADDRESS},
        {"name": "keyword.operator.assignment.st",
         "match": r"(?i):=|=>|\b" + one_of(words.assignments) + "="},
        word("keyword.declaration", words.groups["declaration"], ""),
        word("keyword.control", words.groups["control"], ""),
        word("keyword.operator.word", words.groups["operator"], ""),
        word("storage.modifier", words.groups["modifier"], r"(?!\s*(?::=|\.|\())"),
        word("constant.language", words.groups["constant"], ""),
        word("support.type", words.groups["type"], ""),
        word("support.function", words.functions, r"(?=\s*\()"),
        {"name": "support.function.conversion.st", "match": r"(?i)\b(?:[A-Z]+_)?TO_[A-Z]+(?=\s*\()"},
        {"name": "keyword.operator.st", "match": r"\*\*|<>|<=|>=|[-+*/<>=&^]"},
    ]
    return {
        "$schema": "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
        "name": "Structured Text", "scopeName": "source.st", "fileTypes": ["st"], "patterns": patterns,
        "repository": {
            "comments": {"patterns": comments}, "strings": {"patterns": strings},
            "pragmas": {"patterns": [pragma]},
            "nested": {"name": "comment.block.st", "begin": r"\(\*", "end": r"\*\)",
                       "patterns": [{"include": "#nested"}]}}}


def vim_syntax(words):
    def keywords(group, names):
        lines, line = [], f"syn keyword {group}"
        for name in sorted(names):
            if len(line) + len(name) > 110:
                lines.append(line)
                line = f"syn keyword {group}"
            line += " " + name
        return lines + [line]

    start = r"\|".join(sorted(words.at_line_start, key=lambda word: (-len(word), word)))
    number = (r"\<\%(\h\w*#\)\=[-+]\=\%(\d\+#\x[0-9A-Za-z_]*\|\d[0-9_]*\.\d[0-9_]*\%(e[-+]\=\d\+\)\="
              r"\|\d[0-9_]*e[-+]\=\d\+\|\d[0-9_]*\)\>")
    time = (r"\<\%(ltime\|time\|lt\|t\)#[-+]\=\%(\d[0-9_]*\%(\.\d[0-9_]*\)\=\%(ms\|us\|ns\|d\|h\|m\|s\)_\=\)\+"
            r"\|\<l\=\%(date_and_time\|time_of_day\|date\|tod\|dt\|d\)#\d\+\%([-:.]\d\+\)*")
    lines = [
        '" Structured Text (IEC 61131-3), as Stride reads it. Written by editors/generate.py.',
        'if exists("b:current_syntax")', "  finish", "endif", "syn case ignore", ""]
    for group, names in (("stControl", words.groups["control"]), ("stDeclaration", words.groups["declaration"]),
                         ("stOperatorWord", words.groups["operator"]), ("stModifier", words.groups["modifier"]),
                         ("stConstant", words.groups["constant"])):
        lines += keywords(group, names)
    # Not those of literals, TIME#5s: a keyword would win over them.
    types = r"\|".join(sorted(words.groups["type"], key=lambda word: (-len(word), word)))
    lines += ["", rf'syn match stType "\<\%({types}\)\>#\@!"']
    functions = r"\|".join(sorted(words.functions, key=lambda word: (-len(word), word)))
    assignments = r"\|".join(sorted(words.assignments, key=len, reverse=True))
    lines += [
        "",
        # A match of the same place that is defined later wins.
        rf'syn match stFunction "\<\%({functions}\)\>\ze\s*("',
        r'syn match stFunction "\<\%([A-Za-z]\+_\)\=TO_[A-Za-z]\+\ze\s*("',
        rf'syn match stDeclaration "^\s*\zs\%({start}\)\>\ze\%(\s*\%(:\|\.\|\[\|(\)\)\@!"',
        r'syn match stOperator "\*\*\|<>\|<=\|>=\|=>\|:=\|[-+*/<>=&^]"',
        rf'syn match stOperator "\<\%({assignments}\)="',
        rf'syn match stNumber "{number}"',
        rf'syn match stNumber "{time}"',
        r'syn match stAddress "%\a\+\%(\*\|\d\+\%(\.\d\+\)*\)"',
        r'syn match stEscape contained "\$\%(\x\x\|.\)"',
        "syn region stString start=+'+ end=+'+ oneline contains=stEscape",
        'syn region stString start=+"+ end=+"+ oneline contains=stEscape',
        r'syn region stPragma start="{" end="}" contains=stString',
        'syn keyword stTodo contained TODO FIXME XXX',
        r'syn region stComment start="(\*" end="\*)" contains=stComment,stTodo',
        r'syn region stComment start="/\*" end="\*/" contains=stTodo',
        r'syn match stComment "//.*$" contains=stTodo',
        r'syn match stDoc "///.*$" contains=stTodo',
        "",
        "hi def link stControl Statement", "hi def link stDeclaration Structure", "hi def link stOperatorWord Operator",
        "hi def link stOperator Operator", "hi def link stModifier StorageClass", "hi def link stConstant Boolean",
        "hi def link stType Type", "hi def link stFunction Function", "hi def link stNumber Number",
        "hi def link stAddress Identifier", "hi def link stEscape SpecialChar", "hi def link stString String",
        "hi def link stPragma PreProc", "hi def link stTodo Todo", "hi def link stComment Comment",
        "hi def link stDoc SpecialComment", "", 'let b:current_syntax = "st"', ""]
    return "\n".join(lines)


def generated():
    words = Words()
    grammar = json.dumps(textmate(words), indent=2, ensure_ascii=False) + "\n"
    return {"editors/vscode/syntaxes/st.tmLanguage.json": grammar, "editors/vim/syntax/st.vim": vim_syntax(words)}


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        raise SystemExit(__doc__)
    stale = []
    for name, text in generated().items():
        path = ROOT / name
        if path.exists() and path.read_text(encoding="utf-8") == text:
            continue
        stale.append(name)
        if not check:
            path.write_text(text, encoding="utf-8")
    if check and stale:
        raise SystemExit("out of date: " + ", ".join(stale) + "; run editors/generate.py")


if __name__ == "__main__":
    main()
