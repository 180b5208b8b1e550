"""Find what EUROPA does otherwise than it reads; most is asked only of texts in the dialect nddl3."""

from collections.abc import Iterator
from pathlib import Path

from nddl_lang.lint.codes import (
    BESIDE_FILE,
    ESCAPE,
    EXACT_TYPES,
    LITERAL_TRUTH,
    NO_FILTER,
    OBJECT_IN_PREDICATE,
    OTHER_METHOD,
    OTHER_RELATION,
    OVERLOOKED,
)
from nddl_lang.lint.part import Finding, Part
from nddl_lang.lint.whole import Whole
from nddl_lang.semantics.constraints import CONSTRAINTS
from nddl_lang.semantics.functions import FUNCTIONS
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.semantics.schema import Kind, MemberReference, TokenVariableReference
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import (
    BoolLiteral,
    CallConstraint,
    CallExpr,
    MethodCall,
    NewExpr,
    PathExpr,
    PredicateDecl,
    Relation,
    StringLiteral,
    VariableDecl,
)
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix
from nddl_lang.text.source import Span


def lint_texts(part: Part) -> Iterator[Finding]:
    """Escapes in strings."""
    for literal in part.all(StringLiteral):
        at = literal.value.find("\\")
        if at >= 0:
            start = literal.span.start + 1 + at
            span = Span(literal.span.anchor, start, start + 2)
            yield ESCAPE.at(span, text=literal.value[at : at + 2])


def lint_filters(part: Part) -> Iterator[Finding]:
    """The keyword `filter`."""
    for node in part.all(VariableDecl):
        if node.is_filter:
            gap = node.type_name.span.start - node.span.start
            span = Span(node.span.anchor, node.span.start, node.span.start + min(gap, len("filter")))
            removed = Span(node.span.anchor, node.span.start, node.type_name.span.start)
            yield NO_FILTER.at(span, fixes=(Fix("remove `filter`", (Edit(removed, ""),)),))


def lint_portability(part: Part) -> Iterator[Finding]:
    """What EUROPA carries out otherwise, in a text that is written for it."""
    if part.dialect is not Dialect.NDDL3:
        return
    yield from _relations(part)
    yield from _truths(part)
    yield from _constructors(part)
    yield from _predicates(part)
    yield from _calls(part)
    if isinstance(part.node, MethodCall) and part.node.method.name == "set_limit":
        name = part.node.method
        yield OTHER_METHOD.at(name.span, help="it changes the capacity instead", name=name.name)


def _relations(part: Part) -> Iterator[Finding]:
    for relation in part.all(Relation):
        row = RELATIONS.get(relation.relation.name)
        if row is not None and row.europa is not None:
            yield OTHER_RELATION.at(relation.relation.span, help=row.europa, name=row.name)


def _truths(part: Part) -> Iterator[Finding]:
    for call in part.all(CallConstraint):
        row = CONSTRAINTS.get(call.name.name)
        if row is None or not row.is_reified or not call.arguments or isinstance(call.arguments[0], BoolLiteral):
            continue
        help_ = "write it with operators: `b == (x < y)`"
        yield LITERAL_TRUTH.at(call.arguments[0].span, help=help_, name=call.name.name)


def _constructors(part: Part) -> Iterator[Finding]:
    for new in part.all(NewExpr):
        chosen = part.tables.constructors.get(new)
        if chosen is None:
            continue
        for argument, parameter in zip(new.arguments, chosen.constructor.parameters, strict=False):
            type_ = part.tables.types.get(argument)
            if type_ is not None and type_.kind is Kind.INT and parameter.type.kind is Kind.FLOAT:
                text = argument.span.text
                is_literal = text.lstrip("-").isdigit()
                fixes = (Fix(f"write `{text}.0`", (Edit(argument.span, f"{text}.0"),)),) if is_literal else ()
                help_ = "its constructors take exactly the types that they declare"
                yield EXACT_TYPES.at(argument.span, help=help_, fixes=fixes, name=new.class_name.name, found="an int")


def _predicates(part: Part) -> Iterator[Finding]:
    for predicate in part.all(PredicateDecl):
        for node in descendants(predicate):
            reference = part.reference(node) if isinstance(node, PathExpr) else None
            if isinstance(reference, MemberReference) and isinstance(reference.base, TokenVariableReference):
                help_ = f"`{node.span.text}` belongs into a rule"
                yield OBJECT_IN_PREDICATE.at(node.span, help=help_, name=predicate.name.name)


def _calls(part: Part) -> Iterator[Finding]:
    for call in part.all(CallExpr):
        row = FUNCTIONS.get(call.function.name)
        if row is None or not row.overlooks_rest or len(call.arguments) <= row.signature.minimum:
            continue
        rest = call.arguments[row.signature.minimum]
        count = row.signature.count_text
        yield OVERLOOKED.at(rest.span, count=count, name=call.function.name)


def lint_includes(whole: Whole) -> Iterator[Diagnostic]:
    """Includes that are found only because they stand beside the file that includes them."""
    if whole.dialect is not Dialect.NDDL3:
        return
    paths = whole.analysis.loaded.paths
    for include, source in whole.analysis.loaded.included.items():
        directory = paths[include.span.source].parent
        path = include.path.value
        if paths[source] == directory / path and directory.resolve() != Path().resolve():
            help_ = "it looks in `nddl.includePath` and where it is started; start it here, or name the path from there"
            yield BESIDE_FILE.at(include.path.span, help=help_, path=path)
