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
from lsp.documents import Documents
from lsp.occurrences import Occurrence, Role, Symbol, SymbolType, symbol_of_class, symbol_of_predicate
from lsp.open_text import DocumentContext
from lsp.project import Snapshot
from lsp.references import extending, models_sharing, occurrence_at
from nddl_lang.semantics.schema import Class, Predicate
from nddl_lang.syntax.nodes import Instance, RuleDecl
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.source import Span


def prepare_calls(view: DocumentContext, offset: int, conversion: Conversion) -> list[CallHierarchyItem] | None:
    """The rule whose head is at `offset`, or the predicate, of which tokens are asked for."""
    here = occurrence_at(view, offset)
    if here is None or here.symbol.type is not SymbolType.PREDICATE:
        return None
    if (rule := _rule_at(view, here)) is not None:
        return [_rule_item(rule, conversion)]
    predicate = _predicate_of(view, here.symbol)
    item = _call_item(predicate, conversion) if predicate is not None else None
    return [item] if item is not None else None


def incoming_calls(
    documents: Documents, view: DocumentContext, offset: int, conversion: Conversion
) -> list[CallHierarchyIncomingCall]:
    """The rules of all models that ask for tokens of the predicate at `offset`."""
    here = occurrence_at(view, offset)
    if here is None:
        return []
    found: dict[tuple[str, int], CallHierarchyIncomingCall] = {}
    for snapshot in models_sharing(documents, view.snapshot, here.symbol):
        for rule in snapshot.analysis.tables.predicates:
            names = [name for name, target in _requests(snapshot, [rule]) if symbol_of_predicate(target) == here.symbol]
            if names:
                call = CallHierarchyIncomingCall(
                    _rule_item(rule, conversion), [conversion.range(each) for each in names]
                )
                found.setdefault((call.from_.uri, rule.span.begin), call)
    return list(found.values())


def outgoing_calls(
    documents: Documents, view: DocumentContext, offset: int, conversion: Conversion
) -> list[CallHierarchyOutgoingCall]:
    """The predicates of which the rule at `offset` asks for tokens; of a predicate, all rules on it."""
    here = occurrence_at(view, offset)
    if here is None:
        return []
    found: dict[tuple[str, int], tuple[CallHierarchyItem, list[Range]]] = {}
    own = _rule_at(view, here)
    for snapshot in [view.snapshot] if own is not None else models_sharing(documents, view.snapshot, here.symbol):
        rules = [own] if own is not None else _rules_on(snapshot, here.symbol)
        for name, target in _requests(snapshot, rules):
            if (item := _call_item(target, conversion)) is not None:
                start = item.selection_range.start
                _, ranges = found.setdefault((item.uri, start.line << 32 | start.character), (item, []))
                place = conversion.range(name)
                # The protocol places them in the file of the item that was asked about.
                if name.source is view.parse.source and place not in ranges:
                    ranges.append(place)
    return [CallHierarchyOutgoingCall(item, ranges) for item, ranges in found.values()]


def _rule_at(view: DocumentContext, here: Occurrence) -> RuleDecl | None:
    """The rule whose head names the predicate there."""
    if here.role is not Role.HAS_RULE:
        return None
    return next((each for each in _rules_on(view.snapshot, here.symbol) if each.predicate.span == here.span), None)


def _rules_on(snapshot: Snapshot, symbol: Symbol) -> list[RuleDecl]:
    predicates = snapshot.analysis.tables.predicates
    return [rule for rule, predicate in predicates.items() if symbol_of_predicate(predicate) == symbol]


def _requests(snapshot: Snapshot, rules: Iterable[RuleDecl]) -> Iterator[tuple[Span, Predicate]]:
    """The tokens that rules ask for: where, and of which predicate."""
    targets = snapshot.analysis.tables.targets
    for rule in rules:
        for node in descendants(rule):
            if isinstance(node, Instance) and (target := targets.get(node)) is not None:
                yield node.path.parts[-1].span, target.predicate


def _rule_item(rule: RuleDecl, conversion: Conversion) -> CallHierarchyItem:
    place = conversion.location(rule.predicate.span)
    whole = _around(conversion.range(rule.span), place.range)
    detail = rule.class_name.name
    return CallHierarchyItem(rule.predicate.name, SymbolKind.Method, place.uri, whole, place.range, detail=detail)


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


def subtypes(
    documents: Documents, view: DocumentContext, offset: int, conversion: Conversion
) -> list[TypeHierarchyItem]:
    """The classes of all models that extend the one at `offset`."""
    owner = _class_at(view, offset)
    found = extending(documents, view.snapshot, owner.name) if owner is not None else []
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
