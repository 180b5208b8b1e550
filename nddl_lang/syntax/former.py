"""Recognise what earlier dialects of NDDL knew, and say what to write today."""

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.codes import FORMER_RELATION, FORMER_SIGNATURE, FORMER_WORD
from nddl_lang.syntax.skipping import end_of_statement
from nddl_lang.syntax.tables import END
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span

_ACCESS = frozenset(("private", "public", "protected"))
_BEFORE_STATEMENT = frozenset(("{", "}", ";", ")", "else"))
_DECLARATIONS = frozenset(("BASETYPE", "predicate", "action", "class", "enum", "filter"))
_WHOLE = {
    "switch": "write `if (x == a) { ... } else { ... }`",
    "subgoal": "a relation asks for a token: `meets(object.p name);`",
    "delete": "remove it: nothing can be deleted",
}
_FOLLOWED_BY = {"switch": ("(",), "subgoal": ("(",), "delete": ("IDENT", "this")}


def replace_former(b: Builder) -> None:
    """Report words of earlier dialects and leave what can be understood without them."""
    b.own()
    index = 0
    while index < len(b.kinds):
        following = b.kinds[index + 1 : index + 3]
        is_first = index == 0 or b.kinds[index - 1] in _BEFORE_STATEMENT
        if b.kinds[index] == "IDENT" and following and is_first and not _replace(b, index, following):
            continue
        index += 1


def _replace(b: Builder, index: int, following: list[str]) -> bool:
    """Whether the lexeme `index`, at the start of a statement, is something else now or stays; not if it is gone."""
    word = b.texts[index]
    declares = following[0] in _DECLARATIONS or following == ["IDENT", "IDENT"]
    if (word in _ACCESS and (declares or following[0] == ":")) or (word == "filterOnly" and declares):
        last = index + 1 if following[0] == ":" else index
        span = b.span(index, last)
        blanks = b.starts[last + 1] - b.ends[last] if last + 1 < len(b.starts) else 0
        edit = Edit(Span(span.anchor, span.start, span.end + blanks), "")
        help_text = "every member can be reached" if word in _ACCESS else "it has no effect"
        b.report(
            FORMER_WORD, span, text=word, help=f"remove it: {help_text}", fixes=(Fix(f"remove `{word}`", (edit,)),)
        )
        b.remove(index, last + 1)
        return False
    if word in _WHOLE and following[0] in _FOLLOWED_BY[word]:
        b.report(FORMER_WORD, b.at(index), text=word, help=_WHOLE[word])
        _break(b, index)
    elif word == "constraint" and following[0] == "IDENT" and following[1:] != [";"]:
        b.report(FORMER_SIGNATURE, b.at(index), help="remove it: the engine knows its constraints by itself")
        _break(b, index)
    return True


def _break(b: Builder, first: int) -> None:
    """Put one broken statement in place of the statement that begins at `first`."""
    last = end_of_statement([*b.kinds, END], first, first + 1)
    end = b.ends[last - 1]
    b.remove(first + 1, last)
    b.kinds[first] = "BROKEN"
    b.ends[first] = end
    b.piece.broken.append((b.starts[first], end))


def put_in_parentheses(b: Builder, first: int, index: int) -> bool:
    """Put the targets of a relation, which stand bare or in braces as of old, into parentheses; whether it is one.

    The relation begins at the lexeme `first`, and the parser did not know what to make of the lexeme `index`.
    """
    kinds = b.kinds
    edits: tuple[Edit, ...]
    name = first if kinds[first] == "RELATION" else first + 1
    if kinds[name : name + 1] != ["RELATION"] or index <= name:
        return False
    if kinds[index] == "SET" and index == name + 1 and "}" in kinds[index:]:
        last = kinds.index("}", index)
        kinds[index] = "("
        kinds[last] = ")"
        edits = (Edit(b.at(index), "("), Edit(b.at(last), ")"))
    elif kinds[index] == "IDENT" and all(kind in ("IDENT", "this", ".") for kind in kinds[name + 1 : index]):
        last = index
        edits = (
            Edit(Span(b.anchor, b.ends[name], b.starts[name + 1]), "("),
            Edit(Span(b.anchor, b.ends[index], b.ends[index]), ")"),
        )
        if kinds[index + 1] == ")":
            edits = edits[:1]
        else:
            b.insert(index + 1, ")")
        b.insert(name + 1, "(")
    else:
        return False
    at = b.at(name)
    b.report(FORMER_RELATION, at, help="write `( )`", fixes=(Fix("put the tokens into parentheses", edits),))
    return True
