"""A name misspelt where it is declared: one message there, in place of one at each place that uses it."""

import re
from collections.abc import Iterable, Sequence

from nddl_lang.semantics.codes import (
    CONSTRUCTOR_NAME,
    MISSPELT_DECLARATION,
    UNKNOWN_CLASS,
    UNKNOWN_ENUM_VALUE,
    UNKNOWN_MEMBER,
    UNKNOWN_NAME,
    UNKNOWN_PREDICATE,
    UNKNOWN_TOKEN_VARIABLE,
    UNKNOWN_TYPE,
)
from nddl_lang.syntax.nodes import Identifier
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.source import Source

_CODES = frozenset(
    (
        CONSTRUCTOR_NAME,
        UNKNOWN_CLASS,
        UNKNOWN_ENUM_VALUE,
        UNKNOWN_MEMBER,
        UNKNOWN_NAME,
        UNKNOWN_PREDICATE,
        UNKNOWN_TOKEN_VARIABLE,
        UNKNOWN_TYPE,
    )
)
_TYPES = frozenset((UNKNOWN_CLASS, UNKNOWN_TYPE))
_FEWEST = 2  # uses; a single one is as likely to be misspelt itself
_MOST_NOTES = 3
_WORD = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)|[A-Za-z_$][A-Za-z0-9_$]*", re.DOTALL)


def name_misspelt_declaration(
    sources: Iterable[Source], found: Sequence[Diagnostic], declared: Iterable[Identifier]
) -> tuple[Diagnostic, ...]:
    """`found`, where a name that is unknown wherever it stands is told once, at the declaration that was meant.

    That is the one of the `declared` names which every message proposes, in the same text, and which nothing uses.
    """
    groups: dict[tuple[Source, str, str], list[Diagnostic]] = {}
    for each in found:
        if each.code in _CODES and (meant := _meant(each)) is not None:
            groups.setdefault((each.span.source, each.span.text, meant), []).append(each)
    if not groups:
        return tuple(found)
    texts = tuple(sources)
    words: dict[Source, dict[str, int]] = {}

    def count(source: Source, word: str) -> int:
        if word not in source.text:
            return 0
        if source not in words:
            words[source] = _words(source)
        return words[source].get(word, 0)

    asked = {name for _, used, meant in groups for name in (used, meant)}
    declarations = {each.name: each for each in declared if each.name in asked}
    told: dict[Diagnostic, Diagnostic | None] = {}
    for (source, used, name), complaints in groups.items():
        declaration = declarations.get(name)
        if declaration is None or declaration.span.source is not source:
            continue
        is_unused = sum(count(each, name) for each in texts) == 1
        is_type = any(each.code in _TYPES for each in complaints)  # a variable may be called like the type meant
        uses = len(complaints) if is_type or used in declarations else count(source, used)
        is_capital = name[0].islower() and used == name[0].upper() + name[1:]
        if is_type and is_capital and count(source, used) >= _FEWEST:
            is_unused, uses = True, count(source, used)  # what has that name in small letters is a variable
        if is_unused and uses >= _FEWEST:
            told |= dict.fromkeys(complaints)
            told[complaints[0]] = _told_there(declaration, used, complaints)
    return _without_echoes(found, told)


def name_misspelt_part(
    sources: Sequence[Source], found: Sequence[Diagnostic], declared: Iterable[Identifier], parts: frozenset[Source]
) -> tuple[Diagnostic, ...]:
    """Like `name_misspelt_declaration`, of all models that include the `parts`: a name that one of these declares."""
    groups: dict[tuple[str, str], list[Diagnostic]] = {}
    for each in found:
        if each.code in _CODES and (meant := _meant(each)) is not None:
            groups.setdefault((each.span.text, meant), []).append(each)
    asked = {name for _, name in groups}
    places: dict[str, dict[tuple[str, int], Identifier]] = {}
    for identifier in declared:
        if identifier.name in asked:
            place = identifier.span.source.name, identifier.span.begin
            places.setdefault(identifier.name, {}).setdefault(place, identifier)
    texts = tuple({each.name: each for each in sources}.values())
    told: dict[Diagnostic, Diagnostic | None] = {}
    for (used, name), complaints in groups.items():
        declarations = tuple(places.get(name, {}).values())
        is_type = any(each.code in _TYPES for each in complaints)
        is_built = any(each.code is CONSTRUCTOR_NAME for each in complaints)  # its own constructor has the other name
        if len(complaints) < _FEWEST or not declarations or declarations[0].span.source not in parts:
            continue
        uses = sum(_words(text).get(name, 0) for text in texts if name in text.text)
        is_unused = is_built or uses == len(declarations)
        if is_unused and (is_type or len(declarations) == 1):
            told |= dict.fromkeys(complaints)
            told[complaints[0]] = _told_there(declarations[0], used, complaints)
    return _without_echoes(found, told)


def _without_echoes(found: Sequence[Diagnostic], told: dict[Diagnostic, Diagnostic | None]) -> tuple[Diagnostic, ...]:
    """`found`, with what is `told` in place; who lacks the same is not told again, whatever else is proposed there."""
    said = {each.message for each in told if each.code is not UNKNOWN_NAME}
    left = (told.get(each, None if each.message in said else each) for each in found)
    return tuple(each for each in left if each is not None)


def _meant(complaint: Diagnostic) -> str | None:
    """The name that the complaint proposes to write in place of the one it is about."""
    edits = complaint.fixes[0].edits if complaint.fixes else ()
    return edits[0].text if len(edits) == 1 and edits[0].span == complaint.span else None


def _words(source: Source) -> dict[str, int]:
    """How often each word stands in a text, comments left out."""
    count: dict[str, int] = {}
    for each in _WORD.findall(source.text):
        count[each] = count.get(each, 0) + 1
    return count


def _told_there(declaration: Identifier, used: str, complaints: Sequence[Diagnostic]) -> Diagnostic:
    notes = tuple(Note("used here", each.span) for each in complaints[:_MOST_NOTES])
    fix = Fix(f"write `{used}`", (Edit(declaration.span, used),), safe=False)
    return MISSPELT_DECLARATION.at(declaration.span, notes=notes, fixes=(fix,), name=declaration.name, used=used)
