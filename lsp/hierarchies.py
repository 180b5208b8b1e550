"""Call hierarchy (which rule asks for which tokens) and type hierarchy (classes): an item in; its neighbours out."""

from collections.abc import Iterable, Iterator

from lsprotocol.types import (
    CallHierarchyIncomingCall,
    CallHierarchyItem,
    CallHierarchyOutgoingCall,
    Range,
    SymbolKind,
    TypeHierarchyItem,
)

from lsp.diagnostics import Conversion
from lsp.occurrences import Role, Symbol, SymbolType, symbol_of_class, symbol_of_predicate
from lsp.open_text import DocumentContext
from lsp.references import occurrence_at
from nddl_lang.semantics.schema import Class, Predicate
from nddl_lang.syntax.nodes import Instance, RuleDecl
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.source import Span


def prepare_calls(view: DocumentContext, offset: int, conversion: Conversion) -> list[CallHierarchyItem] | None:
    """The predicate at `offset`, of which tokens are asked for and which asks for tokens by its rules."""
    here = occurrence_at(view, offset)
    if here is None or here.symbol.type is not SymbolType.PREDICATE:
        return None
    predicate = _predicate_of(view, here.symbol)
    item = _call_item(predicate, conversion) if predicate is not None else None
    return [item] if item is not None else None


def incoming_calls(view: DocumentContext, offset: int, conversion: Conversion) -> list[CallHierarchyIncomingCall]:
    """The predicates whose rules ask for tokens of the one at `offset`."""
    here = occurrence_at(view, offset)
    found: dict[Symbol, tuple[Predicate, list[Range]]] = {}
    if here is not None:
        for rule, predicate in view.snapshot.analysis.tables.predicates.items():
            for name, target in _requests(view, [rule]):
                if symbol_of_predicate(target) == here.symbol:
                    entry = found.setdefault(symbol_of_predicate(predicate), (predicate, []))
                    entry[1].append(conversion.range(name))
    return [
        CallHierarchyIncomingCall(item, ranges)
        for predicate, ranges in found.values()
        if (item := _call_item(predicate, conversion)) is not None
    ]


def outgoing_calls(view: DocumentContext, offset: int, conversion: Conversion) -> list[CallHierarchyOutgoingCall]:
    """The predicates of which the rules on the one at `offset` ask for tokens."""
    here = occurrence_at(view, offset)
    if here is None:
        return []
    predicates = view.snapshot.analysis.tables.predicates
    rules = [rule for rule, predicate in predicates.items() if symbol_of_predicate(predicate) == here.symbol]
    found: dict[Symbol, tuple[Predicate, list[Range]]] = {}
    for name, target in _requests(view, rules):
        found.setdefault(symbol_of_predicate(target), (target, []))[1].append(conversion.range(name))
    return [
        CallHierarchyOutgoingCall(item, ranges)
        for predicate, ranges in found.values()
        if (item := _call_item(predicate, conversion)) is not None
    ]


def _requests(view: DocumentContext, rules: Iterable[RuleDecl]) -> Iterator[tuple[Span, Predicate]]:
    """The tokens that rules ask for: where, and of which predicate."""
    targets = view.snapshot.analysis.tables.targets
    for rule in rules:
        for node in descendants(rule):
            if isinstance(node, Instance) and (target := targets.get(node)) is not None:
                yield node.path.parts[-1].span, target.predicate


def _predicate_of(view: DocumentContext, symbol: Symbol) -> Predicate | None:
    return view.snapshot.analysis.schema.find_predicate(str(symbol.owner), symbol.name)


def _call_item(predicate: Predicate, conversion: Conversion) -> CallHierarchyItem | None:
    if predicate.span is None or not predicate.nodes:
        return None
    place = conversion.location(predicate.span)
    whole = _around(conversion.range(predicate.nodes[-1].span), place.range)
    detail = predicate.class_name
    return CallHierarchyItem(predicate.name, SymbolKind.Method, place.uri, whole, place.range, detail=detail)


def prepare_types(view: DocumentContext, offset: int, conversion: Conversion) -> list[TypeHierarchyItem] | None:
    """The class at `offset`."""
    owner = _class_at(view, offset)
    item = _type_item(owner, conversion) if owner is not None else None
    return [item] if item is not None else None


def supertypes(view: DocumentContext, offset: int, conversion: Conversion) -> list[TypeHierarchyItem]:
    """The class that the one at `offset` extends."""
    owner = _class_at(view, offset)
    base = view.snapshot.analysis.schema.classes.get(owner.base or "") if owner is not None else None
    item = _type_item(base, conversion) if base is not None else None
    return [item] if item is not None else []


def subtypes(view: DocumentContext, offset: int, conversion: Conversion) -> list[TypeHierarchyItem]:
    """The classes that extend the one at `offset`."""
    owner = _class_at(view, offset)
    found = [each for each in view.snapshot.analysis.schema.classes.values() if owner and each.base == owner.name]
    return [item for each in found if (item := _type_item(each, conversion)) is not None]


def _class_at(view: DocumentContext, offset: int) -> Class | None:
    here = occurrence_at(view, offset)
    if here is None or here.role is Role.WRITES or here.symbol != symbol_of_class(here.symbol.name):
        return None
    return view.snapshot.analysis.schema.classes.get(here.symbol.name)


def _type_item(owner: Class, conversion: Conversion) -> TypeHierarchyItem | None:
    if owner.span is None or owner.node is None:
        return None
    place = conversion.location(owner.span)
    whole = _around(conversion.range(owner.node.span), place.range)
    detail = f"extends {owner.base}" if owner.base is not None else None
    return TypeHierarchyItem(owner.name, SymbolKind.Class, place.uri, whole, place.range, detail=detail)


def _around(whole: Range, inner: Range) -> Range:
    """`whole`, which must hold `inner`."""
    is_inside = (whole.start.line, whole.start.character) <= (inner.start.line, inner.start.character)
    return whole if is_inside else Range(inner.start, whole.end)
