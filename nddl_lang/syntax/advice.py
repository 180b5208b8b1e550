"""Find the words for what stands where something else was expected, and what to do about it."""

import re

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.lexemes import excerpt
from nddl_lang.syntax.tables import END
from nddl_lang.text.nearest import nearest

_NEXT_WORD = re.compile(r"(?:[ \t\r\n\f]++|//[^\n]*+|/\*.*?\*/)*+(#?\w++|[^\n])?", re.DOTALL)


def describe_found(b: Builder, kinds: list[str], index: int) -> str:
    """What stands at the lexeme `index`, in words."""
    if kinds[index] != END:
        return f"`{excerpt(b.texts[index])}`"
    source = b.anchor.source
    following = _NEXT_WORD.match(source.text, b.anchor.offset + b.piece.length)
    assert following is not None
    b.piece.reach = max(b.piece.reach, following.end() - b.anchor.offset + 1)
    if following[1] is None:
        return "the end of the file"
    return f"`{excerpt(following[1])}`"


def advise(kinds: list[str], texts: list[str], first: int, index: int) -> str | None:
    """What to write instead, where the mistake is one that is often made."""
    kind = kinds[index]
    before = kinds[index - 1] if index else ""
    if kinds[first] == "GOAL" and index == first + 1:
        return f"write `{texts[first]}(object.predicate name);`"
    if kinds[first] == "typedef" and kind in ("IDENT", ";") and "[" not in kinds[first:index]:
        return "a typedef needs a domain: `typedef int [0 10] Name;`"
    if kinds[first] == "enum" and kind in ("[", "INT", "FLOAT"):
        return "an enum lists names; for numbers write `typedef int [0 5] Name;`"
    if kinds[first] == "enum" and kind == "}":
        return "an enum needs at least one value"
    if kind == "}" and before == "SET":
        return "a set needs at least one value"
    if kind in ("]", ";") and "[" in kinds[max(first, index - 2) : index]:
        return "an interval has two bounds: `[0 10]`"
    if kind in ("INT", "FLOAT") and "SET" in kinds[first:index]:
        return "the values of a set are separated by commas"
    if kinds[first] == "IDENT" and index == first + 1 and nearest(texts[first], ["else"]):
        return "did you mean `else`?"
    if kind == "else":
        return "an `else` follows the statement or block of an `if`"
    if kinds[first] in ("predicate", "action") and kind == ";":
        return f"it has a body, if only an empty one: `{kinds[first]} {texts[index - 1]} {{ }}`"
    return None
