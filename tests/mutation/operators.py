"""What can be changed in the body of a function. A mutation is (operator, start, end, text): text[start:end] becomes `text`."""

from cpp_source import closing, without_template

EXCHANGED = {
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==",
    "+": "-", "-": "+", "*": "/", "/": "*", "%": "*",
    "&&": "||", "||": "&&", "&": "|", "|": "&", "<<": ">>", ">>": "<<",
    "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "|=": "&=", "&=": "|=",
    "++": "--", "--": "++",
}
ALWAYS_BINARY = {"==", "!=", "+=", "-=", "*=", "/=", "|=", "&=", "++", "--"}
PAIRS = {"min": "max", "max": "min", "smaller": "larger", "larger": "smaller", "true": "false", "false": "true",
         "break": "continue", "continue": "break", "floor": "ceil", "ceil": "floor"}
# A statement that begins so is no call and no assignment.
NO_CALL = {"return", "if", "else", "for", "while", "do", "switch", "case", "default", "break", "continue", "const", "auto",
           "using", "static", "constexpr", "typedef", "struct", "class", "enum", "goto", "try", "catch", "delete", "public",
           "static_assert", "private", "new", "co_return", "unsigned", "int", "bool", "double", "char", "float", "long", "void"}
# Without effect on what a program does.
HARMLESS_CALLS = {"reserve", "shrink_to_fit", "static_cast", "assert"}


def spaced(text, token):
    """An operator that the formatter has put between two operands"""
    return text[token.start - 1] in " \n" and text[token.end] in " \n"


def exchanged(text, tokens):
    for i, token in enumerate(tokens[1:-1], 1):
        if token.kind == "operator" and token.text in EXCHANGED:
            if token.text in ALWAYS_BINARY or spaced(text, token):
                yield f"{token.text} to {EXCHANGED[token.text]}", token.start, token.end, EXCHANGED[token.text]
            elif token.text == "-" and tokens[i - 1].text in ("(", ",", "=", "return", "?", ":", "<", ">", "+", "*"):
                yield "sign", token.start, token.end, ""
        elif token.text == "!" and token.kind == "operator":
            yield "not", token.start, token.end, ""
        elif token.kind == "name" and token.text in PAIRS:
            yield f"{token.text} to {PAIRS[token.text]}", token.start, token.end, PAIRS[token.text]
        elif token.kind == "number":
            yield "constant", token.start, token.end, f"({token.text} + 1)"


def negated(text, tokens):
    for i, token in enumerate(tokens[:-1]):
        if token.text in ("if", "while") and token.kind == "name":
            at = i + 1 + (tokens[i + 1].text == "constexpr")
            end = closing(tokens, at)
            inside = text[tokens[at].end:tokens[end].start]
            if tokens[at].text == "(" and ";" not in inside and at == i + 1:
                yield "condition", tokens[at].end, tokens[end].start, f"!({inside})"


def removed(text, tokens):
    """Calls and assignments that are a statement"""
    for i in range(1, len(tokens) - 1):
        before, first = tokens[i - 1], tokens[i]
        begins = before.text in (";", "{", "}", "else") and (first.kind == "name" or first.text in ("*", "++", "--", "("))
        if not begins and not (before.text == ")" and first.kind == "name") or first.text in NO_CALL:
            continue
        end = i
        while end < len(tokens) and tokens[end].text not in (";", "{", "}", ")", "]"):
            end = closing(tokens, end) + 1 if tokens[end].text in ("(", "[") else end + 1
        if end >= len(tokens) or tokens[end].text != ";":
            continue
        words = tokens[i:end]
        if HARMLESS_CALLS & {word.text for word in words[:5]}:
            continue
        # Two words one after the other: a declaration.
        if any(a.kind == "name" and b.kind == "name" for a, b in zip(words[:4], words[1:5])) and words[0].text != "delete":
            continue
        if any(word.text in ("=", "(", "++", "--", "+=", "-=", "*=", "/=", "|=", "&=", "<<") for word in words):
            yield "removed", first.start, tokens[end].start, ""


def returned(text, head, tokens):
    """Another result, and none of the work"""
    words = [token.text for token in without_template(list(head))]
    for i, token in enumerate(tokens[:-1]):
        if token.text != "return" or tokens[i + 1].text == ";":
            continue
        end = i
        while tokens[end].text != ";":
            end = closing(tokens, end) + 1 if tokens[end].text in ("(", "[", "{") else end + 1
        value = text[tokens[i + 1].start:tokens[end].start]
        if "bool" in words and len(value) > 5:
            yield "result", tokens[i + 1].start, tokens[end].start, f"!({value})"
    yield "early", tokens[0].end, tokens[0].end, " return;" if "void" in words[:words.index("(")] else " return {};"


def mutations_of(text, body):
    """All of a body, in the order of their places"""
    tokens = list(body.tokens)
    found = [*exchanged(text, tokens), *negated(text, tokens), *removed(text, tokens), *returned(text, body.head, tokens)]
    return sorted(found, key=lambda mutation: (mutation[1], mutation[0]))
