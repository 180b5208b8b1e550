"""A reserved word meant as a name in; lexemes read as that name, and the fix that renames them, out."""

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.words import RELATIONS
from nddl_lang.text.diagnostic import Edit, Fix

_NAMES = ("IDENT", "FORMER", "this", "object")


def read_as_name(b: Builder, index: int) -> tuple[Fix, ...]:
    """Read the lexeme `index` as a name, and a relation wherever behind it in the piece no relation can stand."""
    text = b.texts[index]
    places = [index]
    if text in RELATIONS:
        places += [at for at in range(index + 1, len(b.texts)) if b.texts[at] == text and _is_name(b.kinds, at)]
    for at in places:
        b.kinds[at] = "IDENT"
    name = f"{text}_"
    if text not in RELATIONS or name in b.texts:
        return ()
    return (Fix(f"write `{name}`", tuple(Edit(b.at(at), name) for at in places)),)


def _is_name(kinds: list[str], at: int) -> bool:
    """Whether a word stands where a relation cannot: that has a name on both sides, or a list behind it."""
    is_between = kinds[at - 1] in (*_NAMES, "]") and kinds[at + 1] in _NAMES
    return kinds[at + 1] not in ("(", "[") and not is_between
