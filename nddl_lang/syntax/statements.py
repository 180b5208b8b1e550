"""Make the nodes of statements."""

from typing import Any

from nddl_lang.syntax.builder import Builder, plain_values, refuse_waiting
from nddl_lang.syntax.codes import (
    CALL_INITIALISER,
    EXPRESSION_ARGUMENT,
    EXPRESSION_VALUE,
    IN_ASSIGNMENT,
    MEMBER_INITIALISER,
    RELATION_BOUNDS,
)
from nddl_lang.syntax.nodes import (
    Allocation,
    Assignment,
    BrokenStatement,
    CallConstraint,
    CallExpr,
    ClassDecl,
    ConstructorDecl,
    Declarator,
    EnumDecl,
    Expr,
    ExprConstraint,
    Foreach,
    FormalParameter,
    GoalStatement,
    Identifier,
    IfStatement,
    Include,
    Instance,
    IntervalExpr,
    MethodCall,
    NewExpr,
    PathExpr,
    PredicateDecl,
    Relation,
    RuleDecl,
    Statement,
    StringLiteral,
    SuperCall,
    TypedefDecl,
    VariableDecl,
)
from nddl_lang.syntax.placement import CLASS, CONSTRUCTOR, PREDICATE, RULE, Block, EmptyStatement, statements_of
from nddl_lang.syntax.words import BASE_TYPES
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span


def _doc(b: Builder, index: int) -> str | None:
    """The doc comment above the lexeme `index`."""
    docs = b.piece.docs
    return docs.get(b.starts[index]) if docs else None


def _value(b: Builder, value: Expr, where: str) -> Expr:
    """`value` as an initialiser, where a new object may stand."""
    if type(value) is NewExpr:
        b.waiting.pop(value, None)
    elif b.is_strict:
        plain_values(b, [value], EXPRESSION_VALUE, where=where)
    return value


# ---- blocks ----


def empty(b: Builder, v: list[Any]) -> EmptyStatement:
    return EmptyStatement(b.at(v[0]))


def broken(b: Builder, v: list[Any]) -> BrokenStatement:
    return BrokenStatement(b.at(v[0]))


def block(b: Builder, v: list[Any]) -> Block:
    return Block(v[1] if len(v) == 3 else [], b.span(v[0], v[-1]))


# ---- declarations ----


def include(b: Builder, v: list[Any]) -> Include:
    return Include(_string(b, v[1]), b.span(v[0], v[1]))


def _string(b: Builder, index: int) -> StringLiteral:
    """The lexeme `index` as a string."""
    text = b.texts[index]
    return StringLiteral(text[1:-1] if len(text) > 1 and text[-1] == text[0] else text[1:], b.at(index))


def typedef(b: Builder, v: list[Any]) -> TypedefDecl:
    return TypedefDecl(v[1], v[2], b.name(v[3]), _doc(b, v[0]), b.span(v[0], v[4]))


def enum(b: Builder, v: list[Any]) -> EnumDecl:
    return EnumDecl(b.name(v[1]), tuple(v[3]), _doc(b, v[0]), b.span(v[0], v[4]))


def variables(b: Builder, v: list[Any]) -> VariableDecl:
    type_name: Identifier = v[0]
    docs = b.piece.docs
    doc = docs.get(type_name.span.start) if docs else None
    return VariableDecl(type_name, _declarators(b, type_name, v[1]), False, doc, b.span(type_name, v[2]))


def filtered_variables(b: Builder, v: list[Any]) -> VariableDecl:
    return VariableDecl(v[1], _declarators(b, v[1], v[2]), True, _doc(b, v[0]), b.span(v[0], v[3]))


def bare_declarator(b: Builder, v: list[Any]) -> Declarator:
    name = b.name(v[0])
    return Declarator(name, None, False, name.span)


def declarator(b: Builder, v: list[Any]) -> Declarator:
    value = _value(b, v[2], "an initialiser")
    span = b.span(v[0], value)
    is_refused = type(value) is CallExpr and value in b.waiting and refuse_waiting(b, span)
    return Declarator(b.name(v[0]), None if is_refused else value, False, span)


def call_declarator(b: Builder, v: list[Any]) -> Declarator:
    b.waiting.pop(v[2], None)
    return Declarator(b.name(v[0]), v[2], True, b.span(v[0], v[3]))


def _declarators(b: Builder, type_name: Identifier, declarators: list[Declarator]) -> tuple[Declarator, ...]:
    """The declarators of one type, those in the form of a call reported."""
    return tuple(_without_call(b, type_name, one) if one.call_form else one for one in declarators)


def _without_call(b: Builder, type_name: Identifier, declarator: Declarator) -> Declarator:
    name, value = declarator.name.name, declarator.initialiser
    assert value is not None
    if type_name.name == "return":  # no type, as is told where types are looked up
        return Declarator(declarator.name, None, True, declarator.span)
    mend = f"{name} = {value.span.text}"
    is_plain = type_name.name in BASE_TYPES
    made = f"{name} = new {type_name.name}({value.span.text})"
    help_text = "" if is_plain else f"; for an object of a class, `{made}`"
    fix = Fix(f"write `{name} = ...`", (Edit(declarator.span, mend),), safe=is_plain)
    other = Fix(f"write `{made}`", (Edit(declarator.span, made),), safe=False)
    fixes = (fix,) if is_plain else (fix, other)
    b.report(CALL_INITIALISER, declarator.span, name=name, help=f"write `{name} = ...`{help_text}", fixes=fixes)
    return declarator if is_plain else Declarator(declarator.name, None, True, declarator.span)


def first_parameter(b: Builder, v: list[Any]) -> list[FormalParameter]:
    return [FormalParameter(v[0], b.name(v[1]), b.span(v[0], v[1]))]


def next_parameter(b: Builder, v: list[Any]) -> list[FormalParameter]:
    v[0].append(FormalParameter(v[2], b.name(v[3]), b.span(v[2], v[3])))
    return v[0]  # type: ignore[no-any-return]


# ---- classes ----


def forward_class(b: Builder, v: list[Any]) -> ClassDecl:
    return ClassDecl(b.name(v[1]), None, None, _doc(b, v[0]), b.span(v[0], v[2]))


def root_class(b: Builder, v: list[Any]) -> ClassDecl:
    return ClassDecl(b.name(v[1]), None, _members_of(b, v[2]), _doc(b, v[0]), b.span(v[0], v[2]))


def derived_class(b: Builder, v: list[Any]) -> ClassDecl:
    return ClassDecl(b.name(v[1]), b.name(v[3]), _members_of(b, v[4]), _doc(b, v[0]), b.span(v[0], v[4]))


def _members_of(b: Builder, body: Block) -> tuple[Any, ...]:
    """The members in `body`."""
    members = statements_of(b, body, CLASS)
    if b.is_strict:
        report_member_initialisers(b, members)
    return members


def report_member_initialisers(b: Builder, members: tuple[Any, ...]) -> None:
    """Report each member that gets its value where it is declared, which nddl3 does not know."""
    for member in members:
        if type(member) is VariableDecl:
            for one in member.declarators:
                if one.initialiser is not None and not one.call_form:
                    name = one.name.name
                    help_text = f"declare `{member.type_name.name} {name};` and write `{name} = ...;` in a constructor"
                    b.report(MEMBER_INITIALISER, one.span, help=help_text)


def predicate(b: Builder, v: list[Any]) -> PredicateDecl:
    body = statements_of(b, v[2], PREDICATE)
    return PredicateDecl(b.name(v[1]), b.texts[v[0]] == "action", body, _doc(b, v[0]), b.span(v[0], v[2]))


def plain_constructor(b: Builder, v: list[Any]) -> ConstructorDecl:
    body = statements_of(b, v[3], CONSTRUCTOR)
    return ConstructorDecl(b.name(v[0]), (), body, _doc(b, v[0]), b.span(v[0], v[3]))


def constructor(b: Builder, v: list[Any]) -> ConstructorDecl:
    body = statements_of(b, v[4], CONSTRUCTOR)
    return ConstructorDecl(b.name(v[0]), tuple(v[2]), body, _doc(b, v[0]), b.span(v[0], v[4]))


def super_call(b: Builder, v: list[Any]) -> SuperCall:
    arguments = v[2] if len(v) == 5 else []
    plain_values(b, arguments, EXPRESSION_VALUE, where="an argument")
    return SuperCall(tuple(arguments), b.span(v[0], v[-1]))


# ---- plain statements ----


def assignment(b: Builder, v: list[Any]) -> Assignment:
    target: PathExpr = v[0]
    op = b.texts[v[1]]
    value = _value(b, v[2], "the right side of an assignment")
    if op == "in":
        at = b.at(v[1])
        b.report(IN_ASSIGNMENT, at, help="write `=`", fixes=(Fix("write `=`", (Edit(at, "="),)),))
    return Assignment(target, op, value, b.span(target, v[3]))


def constraint(b: Builder, v: list[Any]) -> Statement:
    value: Expr = v[0]
    message = _string(b, v[2]) if len(v) == 4 else None
    span = b.span(value, v[-1])
    if type(value) is CallExpr:
        method = b.methods.get(value)
        if method is None:
            b.waiting.pop(value, None)
            plain_values(b, value.arguments, EXPRESSION_ARGUMENT, name=value.function.name)
            return CallConstraint(value.function, value.arguments, message, span)
        if message is None:
            b.waiting.pop(value, None)
            plain_values(b, value.arguments, EXPRESSION_VALUE, where="an argument")
            return MethodCall(*method, value.arguments, span)
    if type(value) is NewExpr and message is None:
        b.waiting.pop(value, None)
        return Allocation(value, span)
    return _expression(b, value, False, message, span)


def enforced_constraint(b: Builder, v: list[Any]) -> Statement:
    return _expression(b, v[1], True, _string(b, v[3]) if len(v) == 5 else None, b.span(v[0], v[-1]))


def _expression(
    b: Builder, value: Expr, enforce: bool, message: StringLiteral | None, span: Span
) -> ExprConstraint | BrokenStatement:
    if b.waiting and refuse_waiting(b, span):
        return BrokenStatement(span)
    return ExprConstraint(value, enforce, message, span)


def close_all(b: Builder, v: list[Any]) -> MethodCall:
    method = b.name(v[0])
    start = method.span.start
    return MethodCall(PathExpr((), Span(b.anchor, start, start)), method, (), b.span(v[0], v[3]))


# ---- tokens and rules ----


def goal(b: Builder, v: list[Any]) -> GoalStatement:
    return GoalStatement(b.texts[v[0]], tuple(v[2]), b.span(v[0], v[4]))


def instance(b: Builder, v: list[Any]) -> Instance:
    return Instance(None, v[0], b.name(v[1]) if len(v) == 2 else None, b.span(v[0], v[-1]))


def played_instance(b: Builder, v: list[Any]) -> Instance:
    return Instance(v[0].name, v[1], b.name(v[2]) if len(v) == 3 else None, b.span(v[0], v[-1]))


def no_instances(b: Builder, v: list[Any]) -> list[Instance]:
    return []


def in_parentheses(b: Builder, v: list[Any]) -> list[Instance]:
    return v[1]  # type: ignore[no-any-return]


def own_relation(b: Builder, v: list[Any]) -> Relation:
    return _relation(b, None, v[0], [], v[1], b.span(v[0], v[2]))


def own_bounded_relation(b: Builder, v: list[Any]) -> Relation:
    return _relation(b, None, v[0], v[1], v[2], b.span(v[0], v[3]))


def relation(b: Builder, v: list[Any]) -> Relation:
    return _relation(b, v[0], v[1], [], v[2], b.span(v[0], v[3]))


def bounded_relation(b: Builder, v: list[Any]) -> Relation:
    return _relation(b, v[0], v[1], v[2], v[3], b.span(v[0], v[4]))


def _relation(
    b: Builder, origin: Identifier | None, name: int, bounds: list[IntervalExpr], target: Any, span: Span
) -> Relation:
    if bounds and b.is_strict:
        help_text = "name the token and bound the distance: `temporalDistance(end, gap, q.start);`"
        b.report(RELATION_BOUNDS, bounds[0].span.to(bounds[-1].span), help=help_text)
    if type(target) is PathExpr:
        return Relation(origin, b.name(name), tuple(bounds), (), target, span)
    return Relation(origin, b.name(name), tuple(bounds), tuple(target), None, span)


def rule(b: Builder, v: list[Any]) -> RuleDecl:
    body = statements_of(b, v[3], RULE)
    return RuleDecl(b.name(v[0]), b.name(v[2]), body, _doc(b, v[0]), b.span(v[0], v[3]))


def if_then(b: Builder, v: list[Any]) -> IfStatement:
    return IfStatement(v[2], statements_of(b, v[4], RULE), None, b.span(v[0], v[4]))


def if_then_else(b: Builder, v: list[Any]) -> IfStatement:
    then = statements_of(b, v[4], RULE)
    return IfStatement(v[2], then, statements_of(b, v[6], RULE), b.span(v[0], v[6]))


def foreach(b: Builder, v: list[Any]) -> Foreach:
    return Foreach(b.name(v[2]), v[4], statements_of(b, v[6], RULE), b.span(v[0], v[6]))
