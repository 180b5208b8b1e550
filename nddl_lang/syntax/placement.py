"""Say which statements may stand in which block."""

from dataclasses import dataclass
from typing import Any

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.codes import EMPTY_IN_PREDICATE, MISPLACED, OF_LEXEMES
from nddl_lang.syntax.nodes import (
    Allocation,
    Assignment,
    BinaryExpr,
    BrokenStatement,
    CallConstraint,
    ClassDecl,
    ConstructorDecl,
    EnumDecl,
    ExprConstraint,
    Foreach,
    GoalStatement,
    IfStatement,
    Include,
    MethodCall,
    PathExpr,
    PredicateDecl,
    Relation,
    RuleDecl,
    SuperCall,
    TypedefDecl,
    VariableDecl,
)
from nddl_lang.syntax.words import RELATIONS
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Span


@dataclass(frozen=True, eq=False, slots=True)
class EmptyStatement:
    """A `;` by itself; it never leaves the parser."""

    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Block:
    """Statements in braces, on their way into the statement that they belong to."""

    statements: list[Any]
    span: Span


@dataclass(frozen=True, slots=True)
class BlockGrammar:
    """A kind of block: how messages call it, and what may stand there."""

    where: str
    allowed: frozenset[type]


TOP = BlockGrammar(
    "at the top level",
    frozenset(
        (
            TypedefDecl,
            EnumDecl,
            VariableDecl,
            Assignment,
            CallConstraint,
            ExprConstraint,
            ClassDecl,
            RuleDecl,
            GoalStatement,
            Relation,
            Allocation,
            MethodCall,
            Include,
        )
    ),
)
CLASS = BlockGrammar("in a class", frozenset((VariableDecl, ConstructorDecl, PredicateDecl, Include)))
CONSTRUCTOR = BlockGrammar("in a constructor", frozenset((Assignment, SuperCall)))
PREDICATE = BlockGrammar("in a predicate", frozenset((VariableDecl, CallConstraint, ExprConstraint, Assignment)))
RULE = BlockGrammar(
    "in a rule", frozenset((Relation, VariableDecl, CallConstraint, ExprConstraint, IfStatement, Foreach))
)

_NAMES: dict[type, str] = {
    TypedefDecl: "a typedef",
    EnumDecl: "an enum",
    VariableDecl: "a variable",
    Assignment: "an assignment",
    CallConstraint: "a constraint",
    ExprConstraint: "a constraint",
    ClassDecl: "a class",
    RuleDecl: "a rule",
    GoalStatement: "a goal",
    Relation: "a relation",
    Allocation: "a new object",
    MethodCall: "a method call",
    Include: "an include",
    ConstructorDecl: "a constructor",
    PredicateDecl: "a predicate",
    SuperCall: "`super(...)`",
    IfStatement: "an `if`",
    Foreach: "a `foreach`",
    Block: "a block of its own",
}

_HOMES: dict[type, str] = {
    IfStatement: "put it into a rule: `Class::predicate { if (...) { ... } }`",
    Foreach: "put it into a rule: `Class::predicate { foreach (...) { ... } }`",
    PredicateDecl: "put it into a class",
    SuperCall: "put it first into a constructor",
    ConstructorDecl: "put it into its class",
    ClassDecl: "put it at the top level, before its first use",
    TypedefDecl: "put it at the top level, before its first use",
    EnumDecl: "put it at the top level, before its first use",
    RuleDecl: "put it at the top level, after its class",
    Include: "put it between two statements at the top level, or between two members of a class",
    Block: "only the body of a rule, `if`, `else` or `foreach` stands in braces",
    GoalStatement: "put it at the top level; in a rule, a relation asks for a token: `meets(object.p name);`",
    MethodCall: "put it at the top level",
    Allocation: "give it a name: `Class name = new Class(...);`",
}


def statements_of(b: Builder, body: Any, block: BlockGrammar) -> tuple[Any, ...]:
    """What stands in `body`, a block or a single statement, with what may not stand in `block` reported as broken."""
    statements = body.statements if type(body) is Block else (body,)
    return place_statements(b, statements, block)


def place_statements(b: Builder, statements: list[Any] | tuple[Any, ...], block: BlockGrammar) -> tuple[Any, ...]:
    """`statements` as they may stand in `block`, the others reported and replaced by a broken statement."""
    placed: list[Any] = []
    for statement in statements:
        kind = type(statement)
        if kind in block.allowed or kind is BrokenStatement:
            placed.append(statement)
        elif kind is EmptyStatement:
            if block is PREDICATE and b.is_strict:
                fix = Fix("remove the `;`", (Edit(statement.span, ""),))
                b.report(EMPTY_IN_PREDICATE, statement.span, fixes=(fix,))
        else:
            placed.append(_misplaced(b, statement, block))
    return tuple(placed)


def _misplaced(b: Builder, statement: Any, block: BlockGrammar) -> BrokenStatement:
    """Report `statement` instead of anything that is wrong inside it."""
    span: Span = statement.span
    broken = break_statement(b, span)
    help_text = _HOMES.get(type(statement))
    fixes: tuple[Fix, ...] = ()
    if isinstance(statement, Assignment) and block is RULE:
        is_negated = statement.value.span.text.startswith("!")  # `x =! y`
        sign = "!=" if is_negated else "=="
        help_text = f"a rule states constraints: write `{sign}`"
        between = Span(b.anchor, statement.target.span.end, statement.value.span.start)
        if statement.op == "=":
            at = between.start + between.text.index("=")
            end = between.end + 1 if is_negated else at + 1
            fixes = (Fix(f"write `{sign}`", (Edit(Span(b.anchor, at, end), sign),)),)
    elif isinstance(statement, ExprConstraint) and block is CLASS and (meant := _pointer(statement)) is not None:
        help_text = f"there are no pointers, and no `*`: `{meant}`"
        fixes = (Fix(f"write `{meant}`", (Edit(span, meant),), safe=False),)
    elif isinstance(statement, CallConstraint | ExprConstraint) and block is CLASS:
        help_text = "put it into a predicate or a rule; a constructor needs a body: `{ }`"
    elif isinstance(statement, CallConstraint) and block is CONSTRUCTOR and _is_super(statement.name.name):
        help_text = "did you mean `super`?"
    elif isinstance(statement, CallConstraint) and b.kinds[2:3] == ["extends"] and b.texts[3] == statement.name.name:
        help_text = "the constructor of the base class is called by `super(...)`"
        fixes = (Fix("write `super`", (Edit(statement.name.span, "super"),), safe=False),)
    elif isinstance(statement, CallConstraint | ExprConstraint) and block is CONSTRUCTOR:
        help_text = "a constructor gives members their values: write `member = value;`"
        match statement:
            case ExprConstraint(expression=BinaryExpr(op="==", left=PathExpr(parts=(_,)) as left, right=right)):
                meant = f"{left.span.text} = {right.span.text};"
                help_text = f"a constructor gives members their values: write `{meant}`"
                fixes = (Fix(f"write `{meant}`", (Edit(span, meant),), safe=False),)
    elif isinstance(statement, Assignment) and block is CLASS:
        help_text = "put it into a constructor"
    elif isinstance(statement, MethodCall) and block is RULE and statement.method.name in RELATIONS:
        arguments = ", ".join(each.span.text for each in statement.arguments)
        meant = f"{statement.target.span.text} {statement.method.name} {arguments};"
        help_text = f"a relation stands between its tokens: `{meant}`"
        fixes = (Fix(f"write `{meant}`", (Edit(span, meant),), safe=False),)
    elif isinstance(statement, Relation):
        help_text = "put it into a rule: `Class::predicate { ... }`"
    elif isinstance(statement, VariableDecl) and block is CONSTRUCTOR:
        help_text = "declare it as a member of the class"
    b.report(MISPLACED, head_of(span), what=_NAMES[type(statement)], where=block.where, help=help_text, fixes=fixes)
    return broken


def _is_super(name: str) -> bool:
    """Whether a call was meant to be that of the constructor of the base class."""
    return name in ("base", "parent", "inherited") or nearest(name, ["super"]) is not None


def _pointer(statement: ExprConstraint) -> str | None:
    """The declaration that `Class* name;` was meant to be, which reads as a product."""
    match statement.expression:
        case BinaryExpr(op="*", left=PathExpr(parts=(type_,)), right=PathExpr(parts=(name,))):
            return f"{type_.name} {name.name};"
    return None


def head_of(span: Span) -> Span:
    """The first line of `span`: enough to underline."""
    text = span.text
    end = text.find("\n")
    return span if end < 0 else Span(span.anchor, span.start, span.start + len(text[:end].rstrip()))


def break_statement(b: Builder, span: Span) -> BrokenStatement:
    """Give the statement at `span` up: what was said about its inside does not matter any more."""
    piece = b.piece
    piece.diagnostics = [
        diagnostic
        for diagnostic in piece.diagnostics
        if not span.start <= diagnostic.span.start <= span.end or diagnostic.code in OF_LEXEMES
    ]
    piece.broken.append((span.start, span.end))
    return BrokenStatement(span)
