"""Symbols: a text in, the outline of what it declares out; a word in, what the models declare under such names out."""

from collections.abc import Iterable, Iterator

from lsprotocol.types import DocumentSymbol, Position, SymbolInformation, SymbolKind

from lsp.documents import Documents
from lsp.occurrences import SymbolType
from lsp.positions import Encoding, Lines
from nddl_lang.syntax.nodes import (
    ClassDecl,
    ConstructorDecl,
    Declarator,
    EnumDecl,
    GoalStatement,
    Identifier,
    NewExpr,
    PredicateDecl,
    RuleDecl,
    Statement,
    TypedefDecl,
    VariableDecl,
)
from nddl_lang.syntax.parser import Parse
from nddl_lang.text.source import Span


class Outlines:
    """Tells outlines again and again while a text is edited: what has not moved is told as before."""

    def __init__(self) -> None:
        self._known: dict[Statement, tuple[Encoding, Position, list[DocumentSymbol]]] = {}

    def outline(self, parse: Parse, lines: Lines) -> list[DocumentSymbol]:
        """The declarations of the text, in order, members inside their classes."""
        fresh = _Outline(lines)
        known: dict[Statement, tuple[Encoding, Position, list[DocumentSymbol]]] = {}
        for statement in parse.module.statements:
            begin = lines.position(statement.span.begin)
            before = self._known.get(statement)
            is_as_before = before is not None and before[:2] == (lines.encoding, begin)
            known[statement] = (
                before if before is not None and is_as_before else (lines.encoding, begin, fresh.all([statement]))
            )
        self._known = known
        return [symbol for statement in parse.module.statements for symbol in known[statement][2]]


class _Outline:
    def __init__(self, lines: Lines) -> None:
        self._lines = lines

    def all(self, nodes: Iterable[object]) -> list[DocumentSymbol]:
        return [symbol for node in nodes for symbol in self._symbols(node)]

    def _symbols(self, node: object) -> Iterator[DocumentSymbol]:
        match node:
            case ClassDecl(name=name, base=base, members=members, span=span):
                detail = f"extends {base.name}" if base is not None else None
                yield self._symbol(name, SymbolKind.Class, span, detail, members or ())
            case EnumDecl(name=name, values=values, span=span):
                yield self._symbol(name, SymbolKind.Enum, span, None, values)
            case Identifier(span=span):  # a value of an enum
                yield self._symbol(node, SymbolKind.EnumMember, span)
            case TypedefDecl(name=name, base=base, span=span):
                yield self._symbol(name, SymbolKind.TypeParameter, span, base.name)
            case VariableDecl(type_name=type_name, declarators=declarators):
                for declarator in declarators:
                    yield self._variable(declarator, type_name.name)
            case ConstructorDecl(name=name, parameters=parameters, span=span):
                formals = ", ".join(f"{each.type_name.name} {each.name.name}" for each in parameters)
                yield self._symbol(name, SymbolKind.Constructor, span, f"({formals})")
            case PredicateDecl(name=name, is_action=is_action, body=body, span=span):
                yield self._symbol(name, SymbolKind.Method, span, "action" if is_action else "predicate", body)
            case RuleDecl(class_name=class_name, predicate=predicate, span=span):
                name = Identifier(f"{class_name.name}::{predicate.name}", class_name.span.to(predicate.span))
                yield self._symbol(name, SymbolKind.Event, span, "rule")
            case GoalStatement(kind=kind, instances=instances):
                for instance in instances:
                    if instance.name is not None:
                        detail = f"{kind} {instance.path.span.text}"
                        yield self._symbol(instance.name, SymbolKind.Object, instance.span, detail)
            case _:
                pass

    def _variable(self, declarator: Declarator, type_name: str) -> DocumentSymbol:
        kind = SymbolKind.Object if isinstance(declarator.initialiser, NewExpr) else SymbolKind.Variable
        return self._symbol(declarator.name, kind, declarator.span, type_name)

    def _symbol(
        self,
        name: Identifier,
        kind: SymbolKind,
        span: Span,
        detail: str | None = None,
        inside: Iterable[object] = (),
    ) -> DocumentSymbol:
        whole = self._lines.range(min(span.begin, name.span.begin), max(span.finish, name.span.finish))
        place = self._lines.range(name.span.begin, name.span.finish)
        # Editors refuse an outline with an empty name.
        return DocumentSymbol(name.name or "?", kind, whole, place, detail, children=self.all(inside) or None)


_OF_SYMBOL = {
    SymbolType.CLASS: SymbolKind.Class,
    SymbolType.ENUM: SymbolKind.Enum,
    SymbolType.ENUM_VALUE: SymbolKind.EnumMember,
    SymbolType.TYPEDEF: SymbolKind.TypeParameter,
    SymbolType.PREDICATE: SymbolKind.Method,
    SymbolType.VARIABLE: SymbolKind.Variable,
    SymbolType.TOKEN: SymbolKind.Object,
}
_MOST_SYMBOLS = 500


def workspace_symbols(documents: Documents, query: str) -> list[SymbolInformation]:
    """What the models declare whose names hold the letters of `query` in that order, the closest names first."""
    conversion = documents.conversion()
    wanted = query.casefold()
    found: dict[tuple[str, int, str], tuple[int, SymbolInformation]] = {}
    for snapshot in documents.snapshots():
        for symbol in snapshot.names.all:
            kind = _OF_SYMBOL.get(symbol.type)
            declared = snapshot.names.declarations(symbol) if kind is not None else []
            distance = _distance(wanted, symbol.name.casefold())
            if kind is None or not declared or distance is None:
                continue
            place = conversion.location(declared[0].span)
            container = symbol.owner if isinstance(symbol.owner, str) else None
            shown = SymbolInformation(place, symbol.name, kind, container_name=container)
            found.setdefault((place.uri, declared[0].span.begin, symbol.name), (distance, shown))
    ordered = sorted(found.items(), key=lambda each: (each[1][0], each[0]))
    return [shown for _, (_, shown) in ordered[:_MOST_SYMBOLS]]


def _distance(wanted: str, name: str) -> int | None:
    """How far a name is from what is wanted: 0 the same, then those that begin so, hold it, hold its letters."""
    if wanted == name:
        return 0
    if wanted in name:
        return 1 if name.startswith(wanted) else 2
    letters = iter(name)
    return 3 if all(letter in letters for letter in wanted) else None
