"""The syntax tree: one frozen class per construct, each with the span of its text.

Nodes compare by identity, so they serve as keys of side tables. Everything the grammar of either dialect
accepts has a node; what was not understood is a `BrokenStatement`.
"""

from dataclasses import dataclass

from nddl_lang.text.source import Span


@dataclass(frozen=True, eq=False, slots=True)
class Identifier:
    """A name as written."""

    name: str
    span: Span


# ---- values and expressions ----


@dataclass(frozen=True, eq=False, slots=True)
class IntLiteral:
    """A whole number or `inf`; `value` is Python's int, infinities are ±(2**52 - 1)."""

    value: int
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class FloatLiteral:
    """A real number or `inff`; infinities are ±(2**52 - 1) as a float."""

    value: float
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class BoolLiteral:
    """`true` or `false`."""

    value: bool
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class StringLiteral:
    """A text; `value` is what stands between the quotes, escapes not decoded."""

    value: str
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class PathExpr:
    """`a.b.c`; the first part may be `this`."""

    parts: tuple[Identifier, ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class IntervalExpr:
    """`[lower upper]`."""

    lower: "Expr"
    upper: "Expr"
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class SetExpr:
    """`{a, b, c}`."""

    items: tuple["Expr", ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class NewExpr:
    """`new C(...)`."""

    class_name: Identifier
    arguments: tuple["Expr", ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class CallExpr:
    """`f(...)` in value position."""

    function: Identifier
    arguments: tuple["Expr", ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class BinaryExpr:
    """`left op right`; `op` is one of `|| && == != < <= > >= + - * /`."""

    op: str
    left: "Expr"
    right: "Expr"
    op_span: Span
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class UnaryExpr:
    """`-operand` or `!operand` (dialect nddlc only)."""

    op: str
    operand: "Expr"
    span: Span


Expr = (
    IntLiteral
    | FloatLiteral
    | BoolLiteral
    | StringLiteral
    | PathExpr
    | IntervalExpr
    | SetExpr
    | NewExpr
    | CallExpr
    | BinaryExpr
    | UnaryExpr
)

# ---- statements ----


@dataclass(frozen=True, eq=False, slots=True)
class Declarator:
    """One name of a declaration; `call_form` marks `int a(5);`, which EUROPA drops silently."""

    name: Identifier
    initialiser: Expr | None
    call_form: bool
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class VariableDecl:
    """`T a = 1, b;` anywhere; `is_filter` marks the keyword `filter`, which has no effect."""

    type_name: Identifier
    declarators: tuple[Declarator, ...]
    is_filter: bool
    doc: str | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class TypedefDecl:
    """`typedef int [0 10] Percent;`."""

    base: Identifier
    domain: Expr
    name: Identifier
    doc: str | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class EnumDecl:
    """`enum E { a, b }`."""

    name: Identifier
    values: tuple[Identifier, ...]
    doc: str | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Assignment:
    """`path = value;` (`op` is `=` or `in`)."""

    target: PathExpr
    op: str
    value: Expr
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class CallConstraint:
    """`eq(a, b);` as a statement, with the message of its violation if one is given."""

    name: Identifier
    arguments: tuple[Expr, ...]
    message: StringLiteral | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class ExprConstraint:
    """`a + b == c;` as a statement."""

    expression: Expr
    enforce: bool
    message: StringLiteral | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class FormalParameter:
    """`T x` of a constructor."""

    type_name: Identifier
    name: Identifier
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class SuperCall:
    """`super(...)` in a constructor."""

    arguments: tuple[Expr, ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class ConstructorDecl:
    """A constructor; its body holds assignments and `super(...)`."""

    name: Identifier
    parameters: tuple[FormalParameter, ...]
    body: tuple["Assignment | SuperCall | BrokenStatement", ...]
    doc: str | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class PredicateDecl:
    """A predicate or, with `is_action`, an action."""

    name: Identifier
    is_action: bool
    body: tuple["VariableDecl | CallConstraint | ExprConstraint | Assignment | BrokenStatement", ...]
    doc: str | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class ClassDecl:
    """A class; a forward declaration has `members` None."""

    name: Identifier
    base: Identifier | None
    members: tuple["VariableDecl | ConstructorDecl | PredicateDecl | Include | BrokenStatement", ...] | None
    doc: str | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Instance:
    """One token of a goal or relation: `object.p name`, with `condition`/`effect` as `role`."""

    role: str | None
    path: PathExpr
    name: Identifier | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Relation:
    """`origin R (targets);`.

    `created` holds instances written in parentheses (new tokens), `existing` a bare name (a token that exists);
    exactly one of the two is set. `origin` None means the rule's own token. `bounds` are relation bounds
    (dialect nddlc), one interval per bound.
    """

    origin: Identifier | None
    relation: Identifier
    bounds: tuple[IntervalExpr, ...]
    created: tuple[Instance, ...]
    existing: PathExpr | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class IfStatement:
    """`if (condition) then else otherwise`; `otherwise` None where there is no else."""

    condition: Expr
    then: tuple["RuleStatement", ...]
    otherwise: tuple["RuleStatement", ...] | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Foreach:
    """`foreach (x in path) block`."""

    variable: Identifier
    collection: PathExpr
    body: tuple["RuleStatement", ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class RuleDecl:
    """`C::p { ... }`."""

    class_name: Identifier
    predicate: Identifier
    body: tuple["RuleStatement", ...]
    doc: str | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class GoalStatement:
    """`goal(...)`, `fact(...)` or `rejectable(...)`."""

    kind: str
    instances: tuple[Instance, ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Allocation:
    """`new C(...);` without a variable."""

    value: NewExpr
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class MethodCall:
    """`path.method(arguments);` and, with a target of no parts, `close();`."""

    target: PathExpr
    method: Identifier
    arguments: tuple[Expr, ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Include:
    """`#include "path"`; it may stand inside a class, where the included text continues the members."""

    path: StringLiteral
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class BrokenStatement:
    """Text that was not understood; its diagnostic has been given."""

    span: Span


RuleStatement = Relation | VariableDecl | CallConstraint | ExprConstraint | IfStatement | Foreach | BrokenStatement
Statement = (
    TypedefDecl
    | EnumDecl
    | VariableDecl
    | Assignment
    | CallConstraint
    | ExprConstraint
    | ClassDecl
    | RuleDecl
    | GoalStatement
    | Relation
    | Allocation
    | MethodCall
    | Include
    | BrokenStatement
)


@dataclass(frozen=True, eq=False, slots=True)
class Module:
    """One parsed text: its top-level statements in order."""

    statements: tuple[Statement, ...]
