"""Go to declaration, type definition and implementation: what a name means in; the places that tell more out."""

from collections.abc import Iterator

from lsp.definition import definition_of, parameter_of
from lsp.documents import Documents
from lsp.meaning import Meaning, meaning_at
from lsp.occurrences import Role, symbol_of_predicate
from lsp.open_text import DocumentContext
from lsp.references import everywhere, extending, occurrence_at
from nddl_lang.analysis import Analysis
from nddl_lang.semantics.schema import (
    Class,
    Constructor,
    EnumValue,
    Kind,
    Label,
    Predicate,
    TokenVariableReference,
    Type,
    Variable,
)
from nddl_lang.text.source import Span


def definition(view: DocumentContext, offset: int) -> Span | None:
    """Where what is named at `offset` is defined."""
    analysis = view.snapshot.analysis
    meaning = meaning_at(analysis, view.parse, offset)
    return definition_of(analysis, meaning) if meaning is not None else None


def declaration(view: DocumentContext, offset: int) -> Span | None:
    """Where the name at `offset` is first declared: of a class where it is announced, if it is."""
    here = occurrence_at(view, offset)
    if here is not None and (declared := view.snapshot.names.declarations(here.symbol)):
        return declared[0].span
    return definition(view, offset)


def type_definition(view: DocumentContext, offset: int) -> Span | None:
    """Where the type of what is named at `offset` is declared: of a token its predicate, of an object its class."""
    analysis = view.snapshot.analysis
    meaning = meaning_at(analysis, view.parse, offset)
    return _type_span(analysis, meaning) if meaning is not None else None


def _type_span(analysis: Analysis, meaning: Meaning) -> Span | None:
    schema = analysis.schema
    match meaning.thing:
        case Variable(type=type_) | TokenVariableReference(type=type_):
            return _span_of(analysis, type_)
        case Label(predicate=predicate):
            return predicate.span
        case EnumValue(enum=name):
            return schema.enums[name].span if name in schema.enums else None
        case Predicate(class_name=name) | Constructor(class_name=name):
            return schema.classes[name].span if name in schema.classes else None
        case _:
            return None


def _span_of(analysis: Analysis, type_: Type) -> Span | None:
    schema = analysis.schema
    if (typedef := schema.typedefs.get(type_.name)) is not None:
        return typedef.span
    if type_.kind is Kind.OBJECT:
        return schema.classes[type_.base].span if type_.base in schema.classes else None
    return schema.enums[type_.base].span if type_.base in schema.enums else None


def implementations(documents: Documents, view: DocumentContext, offset: int) -> list[Span]:
    """Of a predicate, its rules in all models; of a class, those that extend it; of a parameter, where it stands."""
    analysis = view.snapshot.analysis
    meaning = meaning_at(analysis, view.parse, offset)
    return list(_implementations(documents, view, meaning)) if meaning is not None else []


def _implementations(documents: Documents, view: DocumentContext, meaning: Meaning) -> Iterator[Span]:
    match meaning.thing:
        case Predicate() as predicate:
            yield from _rules_on(documents, view, predicate)
        case Label(predicate=predicate):
            yield from _rules_on(documents, view, predicate)
        case Class(name=name) | Constructor(class_name=name):
            yield from (owner.span for owner in extending(documents, view.snapshot, name) if owner.span is not None)
        case TokenVariableReference() as variable if (found := parameter_of(variable)) is not None:
            yield from [found.span] if found.span is not None else []
        case _:
            pass


def _rules_on(documents: Documents, view: DocumentContext, predicate: Predicate) -> Iterator[Span]:
    """The rules on a predicate and on what inherits or extends it: of this model, then of others that share it."""
    symbol = symbol_of_predicate(predicate)
    own = [each.span for each in view.snapshot.names.of(symbol) if each.role is Role.HAS_RULE]
    yield from own
    keys = view.snapshot.keys
    known = {(keys[each.source], each.begin) for each in own}
    found = everywhere(documents, view.snapshot, symbol).found
    for (key, begin, _), each in found.items():
        if each.role is Role.HAS_RULE and (key, begin) not in known:
            yield each.span
