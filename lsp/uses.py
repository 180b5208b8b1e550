"""Something that a model declares in; the places that use it out."""

from collections.abc import Iterator
from dataclasses import dataclass

from nddl_lang.analysis import Analysis
from nddl_lang.semantics.schema import EnumValue, GlobalReference, Predicate, Reference, Variable
from nddl_lang.syntax.nodes import Assignment, ClassDecl, Expr, MethodCall, RuleDecl
from nddl_lang.text.source import Span


@dataclass(frozen=True, slots=True)
class Use:
    """One place, and in a few words what happens there."""

    text: str
    span: Span


def samplings(analysis: Analysis, parameter: Variable | EnumValue) -> list[Use]:
    """Where a parameter is sampled: for each place the rule or class that does it."""
    found = []
    for node, reference in analysis.tables.sampled.items():
        if _is(reference, parameter):
            span = getattr(node, "span", None)
            assert isinstance(span, Span)
            found.append(Use(_owner(analysis, span), span))
    return found


def givings(analysis: Analysis, variable: Variable) -> Iterator[Use]:
    """Where the script gives a global variable a value."""
    for statement in analysis.statements:
        if isinstance(statement, Assignment | MethodCall):
            reference = analysis.tables.references.get(statement.target)
            if reference is not None and _is(reference, variable):
                yield Use(" ".join(statement.span.text.rstrip(";").split()), statement.span)


def constants(analysis: Analysis) -> dict[Variable, Expr]:
    """What the script assigns to each global variable that it assigns to once."""
    found: dict[Variable, list[Expr]] = {}
    for statement in analysis.statements:
        if isinstance(statement, Assignment):
            reference = analysis.tables.references.get(statement.target)
            if isinstance(reference, GlobalReference):
                found.setdefault(reference.variable, []).append(statement.value)
    return {variable: values[0] for variable, values in found.items() if len(values) == 1}


def rules_on(analysis: Analysis, predicate: Predicate) -> list[RuleDecl]:
    """The rules that fire for a token of the predicate: those on its class and those on the ancestors."""
    classes = analysis.schema.ancestry(predicate.class_name)
    return [
        rule.node
        for rule in analysis.schema.rules
        if rule.predicate.name == predicate.name and rule.predicate.class_name in classes
    ]


def _is(reference: Reference, thing: Variable | EnumValue) -> bool:
    if isinstance(reference, GlobalReference):
        return reference.variable is thing
    return isinstance(reference, EnumValue) and reference == thing


def _owner(analysis: Analysis, span: Span) -> str:
    """What the place at `span` is a part of."""
    for statement in analysis.statements:
        around = statement.span
        if around.anchor is span.anchor and around.start <= span.start and span.end <= around.end:
            match statement:
                case RuleDecl(class_name=class_name, predicate=predicate):
                    return f"{class_name.name}::{predicate.name}"
                case ClassDecl(name=name):
                    return f"class {name.name}"
                case _:
                    break
    return "the script"
