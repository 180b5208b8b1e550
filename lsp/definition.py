"""What a name means in; where that is declared out."""

from lsp.meaning import Meaning, Word
from nddl_lang.analysis import Analysis
from nddl_lang.semantics.constraints import ConstraintRow
from nddl_lang.semantics.functions import FunctionRow, MethodRow
from nddl_lang.semantics.relations import RelationRow
from nddl_lang.semantics.schema import (
    Class,
    Constructor,
    Enumeration,
    EnumValue,
    Label,
    Predicate,
    TokenVariableReference,
    Type,
    Typedef,
    Variable,
)
from nddl_lang.text.source import Anchor, Source, Span


def definition_of(analysis: Analysis, meaning: Meaning) -> Span | None:
    """Where the thing is declared; None for what the language brings along."""
    match meaning.thing:
        case Class(span=span) | Predicate(span=span) | Enumeration(span=span) | Typedef(span=span):
            return span
        case Variable(span=span) | Label(span=span):
            return span
        case Constructor(span=span, class_name=class_name):
            owner = analysis.schema.classes.get(class_name)
            return span or (owner.span if owner is not None else None)
        case EnumValue(enum=enum, value=value):
            return value_span(analysis, enum, value)
        case TokenVariableReference() as variable:
            found = parameter_of(variable)
            return found.span if found is not None else None
        case Source() as source:
            return Span(Anchor(source), 0, 0)
        case Type() | RelationRow() | ConstraintRow() | FunctionRow() | MethodRow() | Word():
            return None


def value_span(analysis: Analysis, enum: str, value: str) -> Span | None:
    """Where a value of an enum is declared."""
    found = analysis.schema.enums.get(enum)
    if found is None or found.node is None:
        return None
    return next((name.span for name in found.node.values if name.name == value), None)


def parameter_of(variable: TokenVariableReference) -> Variable | None:
    """The parameter that a variable of a token is; None where every token has it."""
    return next((each for each in variable.label.predicate.parameters if each.name == variable.name), None)
