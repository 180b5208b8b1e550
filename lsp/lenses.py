"""Code lenses: a text in its model in; what can be done with its declarations, above their lines, out."""

from collections.abc import Iterator
from typing import Any

from lsprotocol.types import CodeLens, Command

from lsp.navigation import rules_of
from lsp.occurrences import Role, SymbolType
from lsp.open_text import DocumentContext
from nddl_lang.semantics.schema import Predicate
from nddl_lang.syntax.nodes import ClassDecl, Identifier, PredicateDecl, Statement
from nddl_lang.text.printable import counted
from nddl_lang.text.source import Span

# Carried out by the editor, which asks for the places then.
_SHOW_REFERENCES = "nddlc.showReferences"
_SHOW_RULES = "nddlc.showRules"
_DECLARES = (SymbolType.CLASS, SymbolType.PREDICATE)


def code_lenses(view: DocumentContext) -> list[CodeLens]:
    """How often each class and predicate is named, and how many rules it has; a click shows where."""
    lenses = []
    for statement in view.parse.module.statements:
        for name in _declared(statement):
            here = view.snapshot.names.at(name.span.anchor, name.span.begin)
            if here is None or here.symbol.type not in _DECLARES:
                continue
            count = sum(each.role is not Role.DECLARES for each in view.snapshot.names.of(here.symbol))
            lenses.append(_lens(view, name.span, counted(count, "reference"), _SHOW_REFERENCES))
            predicate = view.snapshot.analysis.tables.declared.get(name)
            if isinstance(predicate, Predicate):
                lenses.append(_lens(view, name.span, counted(len(rules_of(view, predicate)), "rule"), _SHOW_RULES))
    return lenses


def _declared(statement: Statement) -> Iterator[Identifier]:
    if isinstance(statement, ClassDecl) and statement.members is not None:
        yield statement.name
        yield from (member.name for member in statement.members if isinstance(member, PredicateDecl))


def _lens(view: DocumentContext, at: Span, title: str, command: str) -> CodeLens:
    place = view.document.lines.range(at.begin, at.finish)
    arguments: list[Any] = [view.document.uri, place.start]
    return CodeLens(place, Command(title, command, arguments=arguments))
