"""Tokens of a C++ source and the bodies of its functions: as much of C++ as mutating needs."""

import re
from dataclasses import dataclass

TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<directive>^[ \t]*\#(?:[^\n\\]|\\.)*)
      | (?P<raw>(?:u8|[uUL])?R"(?P<delimiter>[^(\s]*)\(.*?\)(?P=delimiter)")
      | (?P<string>(?:u8|[uUL])?"(?:[^"\\\n]|\\.)*")
      | (?P<character>(?:u8|[uUL])?'(?:[^'\\\n]|\\.)+')
      | (?P<number>\.?\d(?:[eEpP][+-]|'(?=\w)|[\w.])*)
      | (?P<name>[A-Za-z_]\w*)
      | (?P<operator><<=|>>=|<=>|->\*|\.\.\.|::|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[^\s\w])
    """, re.VERBOSE | re.DOTALL | re.MULTILINE)


@dataclass(frozen=True)
class Token:
    kind: str  # name, number, operator, string, character
    text: str
    start: int
    end: int


@dataclass(frozen=True)
class Body:
    """The tokens from the first to the last brace of a function, and those of its head."""
    head: tuple
    tokens: tuple


def tokens_of(text):
    """Without comments and directives"""
    out = []
    for match in TOKEN.finditer(text):
        kind = match.lastgroup
        if kind == "delimiter" or match.group("raw"):
            kind = "string"
        if kind not in ("comment", "directive"):
            out.append(Token(kind, match.group(), match.start(), match.end()))
    return out


def closing(tokens, at):
    """The index of the bracket that closes the one at `at`; the end where there is none"""
    depth = 0
    for i in range(at, len(tokens)):
        if tokens[i].kind != "operator":
            continue
        if tokens[i].text in ("(", "{", "["):
            depth += 1
        elif tokens[i].text in (")", "}", "]"):
            depth -= 1
            if depth == 0:
                return i
    return len(tokens) - 1


def without_template(head):
    """The head of a declaration without template <...>"""
    while head and head[0].text == "template":
        depth = 0
        for i, token in enumerate(head[1:], 1):
            depth += {"<": 1, ">": -1, ">>": -2}.get(token.text, 0)
            if depth == 0:
                break
        head = head[i + 1:]
    return head


def scope_of(head):
    """What a brace after `head` begins: 'scope', 'body', 'member' (of an initialiser list) or 'other'"""
    head = without_template(head)
    words = [token.text for token in head]
    if not words:
        return "other"
    if "namespace" in words or words[0] == "extern" and head[-1].kind == "string":
        return "scope"
    if "enum" in words:
        return "other"
    depth, parenthesis, assigned, colon = 0, False, False, False
    for i, word in enumerate(words):
        if word in "([{":
            parenthesis = parenthesis or word == "("
            depth += 1
        elif word in ")]}":
            depth -= 1
        elif depth == 0 and word == "=" and words[i - 1] != "operator":
            assigned = True
        elif depth == 0 and word == ":" and parenthesis:
            colon = True
    if assigned:
        return "other"
    if not parenthesis:
        return "scope" if {"class", "struct", "union"} & set(words) else "other"
    if colon and (head[-1].kind == "name" or words[-1] == ">"):
        return "member"
    return "body"


def bodies_of(text):
    """The outermost function bodies of a source or header"""
    tokens = tokens_of(text)
    bodies, head, at = [], [], 0
    while at < len(tokens):
        token = tokens[at]
        if token.text in ("(", "[") and token.kind == "operator":
            end = closing(tokens, at)
            head += tokens[at:end + 1]
            at = end + 1
            continue
        if token.text == "{" and token.kind == "operator":
            kind = scope_of(head)
            if kind == "scope":
                head, at = [], at + 1
                continue
            end = closing(tokens, at)
            if kind == "body":
                bodies.append(Body(tuple(head), tuple(tokens[at:end + 1])))
                head = []
            else:
                head += tokens[at:end + 1]
            at = end + 1
            continue
        is_access = token.text == ":" and head and head[-1].text in ("public", "private", "protected")
        if token.kind == "operator" and (token.text in (";", "}") or is_access):
            head = []
        else:
            head.append(token)
        at += 1
    return bodies
