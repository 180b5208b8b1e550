"""Code lenses: a text in its model in; what can be done with its declarations, above their lines, out.

How often something is named in all models is told once an editor shows the lens.
"""

from collections.abc import Iterator
from typing import Any

from lsprotocol.types import CodeLens, Command, Position, Range

from lsp.documents import Documents
from lsp.mission_texts import MissionTexts
from lsp.mission_uses import throughout
from lsp.navigation import implementations
from lsp.occurrences import Role, SymbolType
from lsp.open_text import DocumentContext
from lsp.references import occurrence_at
from nddl_lang.semantics.schema import Predicate
from nddl_lang.syntax.nodes import ClassDecl, Identifier, PredicateDecl, Statement
from nddl_lang.text.printable import counted

# Carried out by the editor, which asks for the places then.
_SHOW_REFERENCES = "nddlc.showReferences"
_SHOW_RULES = "nddlc.showRules"
_DECLARES = (SymbolType.CLASS, SymbolType.PREDICATE)


def code_lenses(view: DocumentContext) -> list[CodeLens]:
    """A lens for the references of each class and predicate, and one for the rules of a predicate; not counted yet."""
    lenses = []
    for statement in view.parse.module.statements:
        for name in _declared(statement):
            here = view.snapshot.names.at(name.span.anchor, name.span.begin)
            if here is None or here.symbol.type not in _DECLARES:
                continue
            place = view.document.lines.range(name.span.begin, name.span.finish)
            lenses.append(_lens(view, place, _SHOW_REFERENCES))
            if isinstance(view.snapshot.analysis.tables.declared.get(name), Predicate):
                lenses.append(_lens(view, place, _SHOW_RULES))
    return lenses


def counting(
    documents: Documents, missions: MissionTexts, view: DocumentContext, start: Position, command: str
) -> Command:
    """How often the class or predicate there is named, or how many rules it has; a click shows where."""
    offset = view.document.lines.offset(start)
    if command == _SHOW_RULES:
        title = counted(len(implementations(documents, view, offset)), "rule")
    else:
        title = counted(_references(documents, missions, view, offset), "reference")
    arguments: list[Any] = [view.document.uri, start]
    return Command(title, command, arguments=arguments)


def _references(documents: Documents, missions: MissionTexts, view: DocumentContext, offset: int) -> int:
    here = occurrence_at(view, offset)
    if here is None:
        return 0  # it was written over since
    found, uses = throughout(documents, missions, view.snapshot, here.symbol)
    return sum(each.role is not Role.DECLARES for each in found.found.values()) + len(uses)


def _declared(statement: Statement) -> Iterator[Identifier]:
    if isinstance(statement, ClassDecl) and statement.members is not None:
        yield statement.name
        yield from (member.name for member in statement.members if isinstance(member, PredicateDecl))


def _lens(view: DocumentContext, place: Range, command: str) -> CodeLens:
    return CodeLens(place, data={"uri": view.document.uri, "command": command})
