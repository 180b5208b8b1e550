"""Parameters of a constructor in, such as `float a, b`; each with the type of the one before it out."""

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.codes import MISSING
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span

_TYPES = frozenset(("BASETYPE", "IDENT"))
_ENDS = frozenset((",", ")"))


def type_parameters(b: Builder, first: int, index: int) -> bool:
    """Put a type before the name that ends at the lexeme `index`, and before those that follow; whether it was one.

    The statement begins at `first`; the parser took the name for a type.
    """
    kinds = b.kinds
    name = index - 1
    if name < first + 4 or kinds[name - 1 : name + 1] != [",", "IDENT"] or kinds[index] not in _ENDS:
        return False
    type_ = name - 3
    if kinds[type_] not in _TYPES or kinds[name - 2] != "IDENT" or kinds[type_ - 1] not in (*_ENDS, "("):
        return False
    names = [name]
    while kinds[names[-1] + 1 : names[-1] + 3] == [",", "IDENT"] and kinds[names[-1] + 3] in _ENDS:
        names.append(names[-1] + 2)
    kind, text = kinds[type_], b.texts[type_]
    edits = tuple(Edit(Span(b.anchor, b.starts[at], b.starts[at]), f"{text} ") for at in names)
    fixes = (Fix(f"add `{text}`", edits, safe=False),)
    b.report(MISSING, b.at(name), text=text, place="here", help="each parameter has a type of its own", fixes=fixes)
    for at in reversed(names):
        b.insert(at, kind)
        b.texts[at] = text
    return True
