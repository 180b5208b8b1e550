"""Code lenses: a text in its model in; what can be done with its declarations, above their lines, out."""

from collections.abc import Iterator
from typing import Any

from lsprotocol.types import CodeLens, Command

from lsp.diagnostics import Conversion
from lsp.documents import DocumentContext
from lsp.navigation import rules_of
from lsp.occurrences import Role, SymbolType
from nddl_lang.semantics.schema import Predicate
from nddl_lang.syntax.nodes import ClassDecl, Identifier, PredicateDecl, Statement
from nddl_lang.text.source import Span

_SHOW_REFERENCES = "nddlc.showReferences"
_DECLARES = (SymbolType.CLASS, SymbolType.PREDICATE)


def code_lenses(view: DocumentContext, conversion: Conversion) -> list[CodeLens]:
    """How often each class and predicate is named, and how many rules it has; a click shows where."""
    lenses = []
    lines = view.document.lines
    uri = view.document.uri
    for statement in view.parse.module.statements:
        for name in _declared(statement):
            here = view.snapshot.names.at(name.span.anchor, name.span.begin)
            if here is None or here.symbol.type not in _DECLARES:
                continue
            place = lines.range(name.span.begin, name.span.finish)
            found = [each.span for each in view.snapshot.names.of(here.symbol) if each.role is not Role.DECLARES]
            lenses.append(CodeLens(place, _shown(_count(found, "reference"), uri, name.span, found, conversion)))
            predicate = view.snapshot.analysis.tables.declared.get(name)
            if isinstance(predicate, Predicate):
                rules = rules_of(view, predicate)
                lenses.append(CodeLens(place, _shown(_count(rules, "rule"), uri, name.span, rules, conversion)))
    return lenses


def _declared(statement: Statement) -> Iterator[Identifier]:
    if isinstance(statement, ClassDecl) and statement.members is not None:
        yield statement.name
        yield from (member.name for member in statement.members if isinstance(member, PredicateDecl))


def _shown(title: str, uri: str, at: Span, found: list[Span], conversion: Conversion) -> Command:
    arguments: list[Any] = [uri, conversion.range(at).start, [conversion.location(span) for span in found]]
    return Command(title, _SHOW_REFERENCES, arguments=arguments)


def _count(found: list[Span], word: str) -> str:
    return f"{len(found)} {word}" if len(found) == 1 else f"{len(found)} {word}s"
