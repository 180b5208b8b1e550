"""Check rules: their bodies statement by statement, with the names of each block."""

import re
from collections.abc import Iterator
from dataclasses import replace

from nddl_lang.semantics.allocation import check_allocation
from nddl_lang.semantics.codes import NOT_A_COLLECTION, UNKNOWN_CLASS, UNKNOWN_TYPE
from nddl_lang.semantics.constraining import check_call_constraint, check_expression_constraint
from nddl_lang.semantics.expressions import check_guard
from nddl_lang.semantics.names import resolve_value
from nddl_lang.semantics.schema import Class, Kind, LocalReference, Rule, Variable
from nddl_lang.semantics.scope import Context, Scope, rule_scope
from nddl_lang.semantics.tokens import check_relation, find_predicate
from nddl_lang.semantics.typenames import find_class, find_declared_type
from nddl_lang.semantics.types import phrase, plain, reference_type
from nddl_lang.semantics.values import check_value
from nddl_lang.syntax.nodes import (
    BrokenStatement,
    CallConstraint,
    ExprConstraint,
    Foreach,
    IfStatement,
    NewExpr,
    Relation,
    RuleDecl,
    RuleStatement,
    VariableDecl,
)
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span

_RETURNED = re.compile(r"return\s+([^;{}\n]+?)\s*;")
_LASTS = re.compile(r"(?<![.\w])(?:duration|end|start)\b")
_Block = tuple[Iterator[RuleStatement], Scope]


def _told_turned(context: Context, node: RuleDecl) -> Class | None:
    """The class of a rule whose class and predicate stand in the wrong order, after a complaint."""
    symbols = context.symbols
    owner = symbols.find_class(node.predicate.name)
    is_turned = owner is not None and symbols.find_predicate(owner.name, node.class_name.name) is not None
    if not is_turned or symbols.find_class(node.class_name.name) is not None or owner is None:
        return None
    text = f"{owner.name}::{node.class_name.name}"
    fix = Fix(f"write `{text}`", (Edit(node.class_name.span.to(node.predicate.span), text),), safe=False)
    help_ = f"the class stands first: `{text}`"
    context.complain(UNKNOWN_CLASS.at(node.class_name.span, name=node.class_name.name, help=help_, fixes=(fix,)))
    context.symbols.put_faulty(node.predicate.name)
    return owner


def check_rule(context: Context, node: RuleDecl) -> None:
    """Declare the rule of `node` and check its body."""
    owner = _told_turned(context, node) or find_class(context, node.class_name)
    predicate = find_predicate(context, owner, node.predicate) if owner is not None else None
    if predicate is None:
        return
    context.tables.predicates[node] = predicate
    context.symbols.put("rule", predicate.full_name, Rule(predicate, node))
    # Blocks are kept on a list and not on Python's stack: `else if` may go on for long.
    open_blocks: list[_Block] = [(iter(node.body), rule_scope(predicate, node))]
    first = len(context.complaints)
    while open_blocks:
        statements, scope = open_blocks[-1]
        statement = next(statements, None)
        if statement is None:
            open_blocks.pop()
            scope.leave()
        else:
            open_blocks += reversed(_check_statement(context, scope, statement))
    _propose_duration(context, node, first)


def _propose_duration(context: Context, node: RuleDecl, first: int) -> None:
    """Of `return x;` in a rule that says nothing of how long its token lasts: that may be meant by it."""
    text, begin = node.span.source.text, node.span.begin
    for number, complaint in enumerate(context.complaints[first:], start=first):
        if complaint.code is not UNKNOWN_TYPE or complaint.span.text != "return":
            continue
        returned = _RETURNED.match(text, complaint.span.begin, node.span.finish)
        others = text[begin : complaint.span.begin] + text[complaint.span.finish : node.span.finish]
        if returned is not None and _LASTS.search(others) is None:
            written = f"duration == {returned[1]};"
            span = Span(complaint.span.anchor, complaint.span.start, complaint.span.start + len(returned[0]))
            fix = Fix(f"write `{written}`", (Edit(span, written),), safe=False)
            context.complaints[number] = replace(complaint, help=f"{complaint.help}, as in `{written}`", fixes=(fix,))


def _check_statement(context: Context, scope: Scope, statement: RuleStatement) -> list[_Block]:
    """Check one statement; the blocks inside it, to be checked next."""
    match statement:
        case ExprConstraint():
            check_expression_constraint(context, scope, statement)
        case Relation():
            check_relation(context, scope, statement)
        case CallConstraint():
            check_call_constraint(context, scope, statement)
        case VariableDecl():
            _check_locals(context, scope, statement)
        case IfStatement(condition=condition, then=then, otherwise=otherwise):
            check_guard(context, scope, condition)
            return [(iter(block), scope.block()) for block in (then, otherwise) if block is not None]
        case Foreach():
            return [(iter(statement.body), _open_foreach(context, scope, statement))]
        case BrokenStatement(span=span):
            scope.doubt(span.text)
    return []


def _check_locals(context: Context, scope: Scope, node: VariableDecl) -> None:
    type_ = find_declared_type(context, node.type_name, [one.name for one in node.declarators])
    for declarator in node.declarators:
        name = declarator.name.name
        if isinstance(declarator.initialiser, NewExpr):
            check_allocation(context, scope, declarator.initialiser)
        if type_ is None:
            scope.doubt(name)
            continue
        if declarator.initialiser is not None:
            check_value(context, scope, declarator.initialiser, type_, name, node)
        variable = Variable(name, type_, declarator.name.span, declarator.initialiser, node, node.doc)
        scope.variables[name] = LocalReference(variable)
        context.tables.locals[declarator] = variable
        context.tables.declared[declarator.name] = variable


def _open_foreach(context: Context, scope: Scope, node: Foreach) -> Scope:
    block = scope.block()
    reference = resolve_value(context, scope, node.collection)
    type_ = reference_type(reference, scope.own_class) if reference is not None else None
    name = node.variable.name
    if type_ is None:
        block.doubt(name)
        return block
    context.tables.types[node.collection] = type_
    if type_.kind is not Kind.OBJECT:
        text = node.collection.span.text
        context.complain(NOT_A_COLLECTION.at(node.collection.span, text=text, found=phrase(type_)))
        block.doubt(name)
        return block
    variable = Variable(name, plain(type_), node.variable.span)
    block.variables[name] = LocalReference(variable)
    context.tables.locals[node] = variable
    context.tables.declared[node.variable] = variable
    return block
