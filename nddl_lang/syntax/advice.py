"""Find the words for what stands where something else was expected, and what to do about it."""

import re

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.lexemes import excerpt
from nddl_lang.syntax.tables import END
from nddl_lang.syntax.words import RELATIONS
from nddl_lang.text.nearest import nearest

_NEXT_WORD = re.compile(r"(?:[ \t\r\n\f]+|//[^\n]*|/\*.*?\*/)*(#?\w++|[^\n])?", re.DOTALL)  # as in the formatter

_OPERATORS = {
    "and": "write `&&`, or one constraint per statement",
    "or": "write `||`",
    "not": "turn the comparison round, as in `x <= 5`, or write `x == false`",
    "then": "there is no `then`: what follows a condition stands in braces, `if (x > 5) { }`",
    "elif": "write `else if (...) { }`",
    "is": "write `==`",
    "plus": "write `+`",
    "minus": "write `-`",
    "times": "write `*`",
    "over": "write `/`",
}
_OF_EXPRESSIONS = frozenset((".", "<", "<=", ">", ">=", "!=", "+", "*", "/"))
_OPERANDS = frozenset(("IDENT", "this", "INT", "FLOAT", "STRING", "BOOL", "(", "-", "!", "SET", "["))
_OPERATORS_BEFORE = frozenset(("==", "!=", "<", "<=", ">", ">=", "+", "-", "*", "/", "="))
_ENDS_CONDITION = frozenset((")", ";", "&&", "||"))
_CONTRARIES = {"==": "!=", "!=": "==", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}
_LOOPS = ("for", "repeat", "until", "while")


def describe_found(b: Builder, kinds: list[str], index: int) -> str:
    """What stands at the lexeme `index`, in words."""
    if kinds[index] != END:
        return f"`{excerpt(b.texts[index])}`"
    source = b.anchor.source
    following = _NEXT_WORD.match(source.text, b.anchor.offset + b.piece.length)
    assert following is not None
    # A comment that is still open may come to end anywhere.
    end = len(source.text) if following[1] == "/" else following.end()
    b.piece.reach = max(b.piece.reach, end - b.anchor.offset + 1)
    if following[1] is None:
        return "the end of the file"
    return f"`{excerpt(following[1])}`"


def advise(kinds: list[str], texts: list[str], first: int, index: int) -> str | None:
    """What to write instead, where the mistake is one that is often made.

    The statement begins at the lexeme `first` and cannot go on with the lexeme `index`.
    """
    kind = kinds[index]
    for at in (index, index - 1):
        if at >= first and kinds[at] == "IDENT" and (advice := advise_operator(texts[at])) is not None:
            is_between = texts[at] == "not" and at > first and kinds[at - 1] in ("IDENT", ")")
            if is_between:
                return "write `!=`"
            return None if texts[at] == "not" and negated(kinds, texts, at) is not None else advice
    match kinds[first]:
        case "GOAL" if index == first + 1:
            return f"write `{texts[first]}(object.predicate name);`"
        case "typedef" if kind in ("IDENT", ";") and "[" not in kinds[first:index]:
            return "a typedef needs a domain: `typedef int [0 10] Name;`"
        case "enum" if kind in ("[", "INT", "FLOAT"):
            return "an enum lists names; for numbers write `typedef int [0 5] Name;`"
        case "enum" if kind == "}":
            return "an enum needs at least one value"
        case "class" if kind == ":":
            return "a class that builds on another is written `class A extends B { }`"
        case "predicate" | "action" if kind == "(":
            return f"parameters stand in braces: `{kinds[first]} {texts[index - 1]} {{ int x; }}`"
        case "predicate" | "action" if index == first + 2:
            return f"it has a body, if only an empty one: `{kinds[first]} {texts[index - 1]} {{ }}`"
        case "foreach" if kind == ":":
            return "write `in`"
        case "#include":
            return 'the path stands in double quotes: `#include "path.nddl"`'
        case "IDENT" if advice := _advise_after_name(kinds, texts, first, index):
            return advice
    return _advise_anywhere(kinds, texts, first, index)


def negated(kinds: list[str], texts: list[str], at: int) -> tuple[int, str] | None:
    """The last lexeme of what the `not` at the lexeme `at` stands before, and how the contrary is written."""
    last = at + 1
    if kinds[last] != "IDENT" or kinds[at - 1 : at] not in (["("], ["&&"], ["||"], ["{"], [";"], []):
        return None
    while kinds[last + 1 : last + 3] == [".", "IDENT"]:
        last += 2
    left = "".join(texts[at + 1 : last + 1])
    if kinds[last + 1] in _ENDS_CONDITION:
        return last, f"{left} == false"
    contrary = _CONTRARIES.get(kinds[last + 1])
    if contrary is None or kinds[last + 2] not in _OPERANDS or kinds[last + 3] not in _ENDS_CONDITION:
        return None
    return last + 2, f"{left} {contrary} {texts[last + 2]}"


def _advise_after_name(kinds: list[str], texts: list[str], first: int, index: int) -> str | None:
    """What to write where the statement begins with a name, which may be meant to be anything."""
    kind, before, name = kinds[index], kinds[first:index], texts[first]
    if name in _LOOPS:
        return "a rule states what holds, and has no loop but `foreach (x in set) { }`"
    if index == first + 1 and nearest(name, ["else"]):
        return "did you mean `else`?"
    if index == first + 1 and kind == "STRING":
        is_meant = name in ("include", "import", "using", "require") or nearest(name, ["include"])
        return "did you mean `#include`?" if is_meant else None
    if before == ["IDENT", "IDENT"] and kind == "::":
        return "a rule is written `Class::predicate { }`"
    if before == ["IDENT"] and kind == "{":
        return f"say what it is: `class {name} {{ }}`, `predicate {name} {{ }}`, or `Class::{name} {{ }}` for a rule"
    if before == ["IDENT", ":"] and kind in ("IDENT", "RELATION", "GOAL", "if", "foreach") and kinds[index + 1] != "{":
        return f"a statement has no label: leave out `{name}:`"
    if before in (["IDENT", ":"], ["IDENT", ".", "IDENT"]) and kind in ("IDENT", "{"):
        return "a rule is written `Class::predicate { }`"
    if before[1:2] == ["::"]:
        return "a rule has no parameters of its own: `Class::predicate { }`" if "(" in before else None
    if before[1:2] == ["("] and kind == "{":
        return f"the parameters of a constructor have types: `{name}(int a) {{ }}`"
    if before[1:2] == ["("] and kind == ";":
        return "arguments are separated by commas; a constructor has a body, if only an empty one: `{ }`"
    if before == ["IDENT", "IDENT"] and kind in _OF_EXPRESSIONS and "{" not in kinds[index : index + 3]:
        return f"remove `{name}`, or join the names: `{name}.{texts[first + 1]}`"
    if before == ["IDENT", "IDENT"] and kind == "-":
        return "a name holds letters, digits and `_` only"
    return None


def _advise_anywhere(kinds: list[str], texts: list[str], first: int, index: int) -> str | None:
    """What to write where it does not matter how the statement begins."""
    kind, before = kinds[index], kinds[index - 1] if index else ""
    if before == "if" and kind != "(":
        return "the condition stands in parentheses: `if (x > 5) { }`"
    if kinds[first + 2 : first + 3] == ["("] and (word := f"{texts[first]}_{texts[first + 1]}") in RELATIONS:
        return f"did you mean `{word}`?"
    if kind in (":", "::") and before == "IDENT" and kinds[first] in ("RELATION", "GOAL"):
        return "a predicate of an object or class is written `object.predicate`"
    if kind == "=" and before == ":":
        return "write `==` for a constraint, or `=` to give a variable its value"
    if kind == "," and before == "INT" and kinds[index + 1] == "INT":
        return f"numbers have a decimal point: `{texts[index - 1]}.{texts[index + 1]}`"
    if kind == "IDENT" and before == "IDENT" and kinds[index - 2] in _OPERATORS_BEFORE and index - 2 > first:
        return f"the argument of a function stands in parentheses: `{texts[index - 1]}({texts[index]})`"
    if kind == "IDENT" and before in ("INT", "FLOAT"):
        return f"a number has no unit; a product is written `{texts[index - 1]} * {texts[index]}`"
    if kind == "}" and before == "SET":
        return "a set needs at least one value"
    if kind in ("]", ";") and "[" in kinds[max(first, index - 2) : index]:
        return "an interval has two bounds: `[0 10]`"
    if kind in ("INT", "FLOAT") and "SET" in kinds[first:index]:
        return "the values of a set are separated by commas"
    if kind == "else":
        return "an `else` follows the statement or block of an `if`"
    return None


def is_operator(b: Builder, at: int) -> bool:
    """Whether the lexeme `at` is a word that is an operator elsewhere, with an operand behind it."""
    return b.kinds[at] == "IDENT" and b.kinds[at + 1] in _OPERANDS and advise_operator(b.texts[at]) is not None


def advise_operator(text: str) -> str | None:
    """What to write instead of a word that is an operator in other languages."""
    return _OPERATORS.get(text.casefold())
