"""Tie the names of types and classes to what they name."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from nddl_lang.semantics.codes import UNDEFINED_CLASS, UNKNOWN_CLASS, UNKNOWN_TYPE
from nddl_lang.semantics.names import suggest_name
from nddl_lang.semantics.schema import Class, Type
from nddl_lang.semantics.scope import Context
from nddl_lang.semantics.types import BASIC_TYPES, enum_type, object_type
from nddl_lang.syntax.nodes import Identifier
from nddl_lang.text.diagnostic import Code, Diagnostic, Edit, Fix, Note
from nddl_lang.text.nearest import nearest

_TYPE_TABLES = ("typedef", "enum", "class")
# What other languages call the basic types.
_ELSEWHERE = {
    "boolean": "bool",
    "double": "float",
    "integer": "int",
    "logical": "bool",
    "long": "int",
    "number": "float",
    "real": "float",
    "text": "string",
    "unsigned": "int",
}
# What other languages write before a name, or a value.
_NO_TYPES = {
    **dict.fromkeys(
        ("auto", "def", "let", "val", "var"), "say which: `bool`, `int`, `float`, `string`, an enum or a class"
    ),
    "return": "a rule gives nothing back: it states what holds",
}


def find_type(context: Context, name: Identifier) -> Type | None:
    """The type of that name; a complaint where there is none."""
    type_ = known_type(context, name.name)
    if type_ is None:
        if _is_told(context, name.name):
            return None
        known = [*BASIC_TYPES, *context.symbols.names(*_TYPE_TABLES)]
        word = name.name.casefold()
        meant = word if word in _ELSEWHERE else nearest(name.name, [*known, *_ELSEWHERE])
        _complain_missing(context, name, UNKNOWN_TYPE, known, _ELSEWHERE.get(meant or ""))
        return None
    context.tables.type_names[name] = type_
    return type_


def find_declared_type(context: Context, name: Identifier, declared: Sequence[Identifier]) -> Type | None:
    """The type of what is declared; of `place Place` it is said that the type stands first."""
    is_turned = len(declared) == 1 and not (name.name[0].isupper() and declared[0].name[0].islower())
    if is_turned and known_type(context, name.name) is None and known_type(context, declared[0].name) is not None:
        if not context.symbols.is_doubtful(name.name):
            text = f"{declared[0].name} {name.name}"
            fix = Fix(f"write `{text}`", (Edit(name.span.to(declared[0].span), text),), safe=False)
            help_ = f"the type stands first: `{text}`"
            context.complain(UNKNOWN_TYPE.at(name.span, name=name.name, help=help_, fixes=(fix,)))
            context.symbols.put_faulty(name.name)
        return None
    return find_type(context, name)


def known_type(context: Context, name: str) -> Type | None:
    """The type of that name: a basic one, a typedef, a class or an enum."""
    symbols = context.symbols
    if (basic := BASIC_TYPES.get(name)) is not None:
        return basic
    if (typedef := symbols.find_typedef(name)) is not None:
        return typedef.type
    if symbols.find_class(name) is not None:
        return object_type(name)  # also where an enum above has that name, as in EUROPA
    return enum_type(name) if symbols.find_enum(name) is not None else None


def find_class(context: Context, name: Identifier) -> Class | None:
    """The class of that name; a complaint where there is none."""
    found = context.symbols.find_class(name.name)
    if found is None:
        _complain_missing(context, name, UNKNOWN_CLASS, context.symbols.names("class"))
        return None
    context.tables.type_names[name] = object_type(name.name)
    return found


def find_defined_class(context: Context, name: Identifier) -> Class | None:
    """The class of that name; a complaint where there is none, or where it is only announced."""
    found = find_class(context, name)
    if found is not None and not found.is_defined:
        if not context.symbols.is_doubtful(name.name):
            notes = (Note("it is announced here", found.span),) if found.span is not None else ()
            below = context.symbols.declared_below(name.name)
            if below is not None:
                notes = (*notes, Note("it is defined here; statements run in order", below))
            context.complain(UNDEFINED_CLASS.at(name.span, notes=notes, name=name.name))
        return None
    return found


def _is_told(context: Context, name: str) -> bool:
    """Whether of a name that is missing nothing more is to be said."""
    return name in context.reported or context.symbols.is_doubtful(name)


def _complain_missing(
    context: Context, name: Identifier, code: Code, candidates: Iterable[str], meant: str | None = None
) -> None:
    """Say that there is no such type or class, unless an earlier mistake may be the reason.

    `meant` is what should stand here where that is known, else the nearest of the candidates.
    """
    word = name.name
    if _is_told(context, word):
        return
    context.reported.add(word)
    complaint: Diagnostic = code.at(name.span, name=word)
    if (below := context.symbols.declared_below(word)) is not None:
        note = Note(f"`{word}` is declared here; statements run in order", below)
        same = [each for each in candidates if each.casefold() == word.casefold() and each != word]
        context.complain(suggest_name(code.at(name.span, notes=(note,), name=word), name, same, meant))
        return
    if word in _NO_TYPES:
        context.complain(replace(complaint, help=_NO_TYPES[word]))
        return
    context.complain(suggest_name(complaint, name, candidates, meant))
