"""Rule statements in, distances between the times of its tokens out."""

from collections.abc import Iterator

from nddl_lang.lint.network import Edge, Node
from nddl_lang.lint.part import Part
from nddl_lang.lint.reading import declared, domain_of, token_domain
from nddl_lang.semantics import domains
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.natives import LEAST_DURATION
from nddl_lang.semantics.relations import RELATIONS, Point
from nddl_lang.semantics.schema import (
    INFINITY,
    GlobalReference,
    Interval,
    Kind,
    Label,
    LocalReference,
    Predicate,
    TokenVariableReference,
    Variable,
)
from nddl_lang.semantics.types import INT
from nddl_lang.syntax.nodes import (
    Assignment,
    BinaryExpr,
    CallConstraint,
    Expr,
    ExprConstraint,
    GoalStatement,
    IntervalExpr,
    MethodCall,
    PathExpr,
    Relation,
    RuleDecl,
    RuleStatement,
    Statement,
    VariableDecl,
)
from nddl_lang.text.source import Span

_NUMBERS = (Kind.INT, Kind.FLOAT)
_ZERO: Node = ("", "")  # the beginning of time: numbers are distances from it
_CONTAINING = frozenset({"contains", "contained_by", "equals", "contains_start", "contains_end"})
_CALLS = {"eq": "==", "concurrent": "==", "leq": "<=", "precedes": "<=", "lt": "<", "strictlyPrecedes": "<"}


class RuleTimes:
    """The times of the tokens of one rule."""

    def __init__(self, part: Part) -> None:
        self._part = part
        self._known: set[object] = set()

    def own_edges(self) -> list[Edge]:
        """What the declaration of the predicate says of the rule's own token."""
        node = self._part.node
        predicate = self._part.tables.predicates.get(node) if isinstance(node, RuleDecl) else None
        return list(self._lasting(None, predicate, "this")) if predicate is not None else []

    def edges(self, statement: RuleStatement | Statement) -> Iterator[Edge]:
        """What a statement of a rule or of the script demands of times."""
        match statement:
            case GoalStatement(instances=instances):
                for instance in instances:
                    label, predicate = self._part.label_of(instance), self._part.predicate_of(instance)
                    if label is not None and predicate is not None:
                        yield from self._lasting(label, predicate, label.name)
            case VariableDecl():
                yield from self._declared(statement)
            case Assignment(target=target, value=value):
                yield from self._comparison(target, "==", value, statement.span)
            case MethodCall(target=target, method=method, arguments=(value,)) if method.name == "specify":
                yield from self._comparison(target, "==", value, statement.span)
            case Relation():
                yield from self._relation(statement)
            case ExprConstraint(expression=BinaryExpr(op="<" | "<=" | ">" | ">=" | "==" as op) as comparison):
                yield from self._comparison(comparison.left, op, comparison.right, statement.span)
            case CallConstraint(name=name, arguments=(left, right)) if name.name in _CALLS:
                yield from self._comparison(left, _CALLS[name.name], right, statement.span)
            case CallConstraint(name=name, arguments=(first, distance, second)) if name.name == "temporalDistance":
                yield from self._distance(first, distance, second, statement.span)

    def _declared(self, declaration: VariableDecl) -> Iterator[Edge]:
        """What the domains of variables say that are numbers."""
        for declarator in declaration.declarators:
            variable = self._part.tables.declared.get(declarator.name)
            if isinstance(variable, Variable) and variable.type.kind in _NUMBERS:
                domain = declared(variable)
                hull = domains.hull(domain) if domain is not None else None
                if hull is not None:
                    names: dict[object, str] = {variable: variable.name}
                    yield from _edges(_ZERO, (variable, "value"), hull.lower, hull.upper, names, declarator.span, None)

    # ---- tokens ----

    def _token(self, label: Label) -> object:
        """What stands for a token: None for the rule's own."""
        return None if label.name == "this" else label

    def _time(self, token: object, point: str, predicate: Predicate) -> Node:
        return token, "time" if predicate.is_event else point

    def _lasting(self, token: object, predicate: Predicate, name: str) -> Iterator[Edge]:
        """How long a token lasts by its declaration, and what that leaves to its parameters."""
        yield from _ranges(token, predicate, name)
        if predicate.is_event:
            return
        start, end = (token, "start"), (token, "end")
        yield Edge(end, start, -1, f"`{name}` lasts at least 1", None, is_duration=True)
        hull = domains.hull(token_domain(predicate, "duration", INT) or LEAST_DURATION)
        if hull is None:
            return
        if hull.lower > 1:
            words = f"`{name}` lasts at least {_number(hull.lower)} by its declaration"
            yield Edge(end, start, -hull.lower, words, predicate.span, is_duration=True)
        if hull.upper < INFINITY:
            words = f"`{name}` lasts at most {_number(hull.upper)} by its declaration"
            yield Edge(start, end, hull.upper, words, predicate.span, is_duration=True)

    # ---- relations ----

    def _relation(self, relation: Relation) -> Iterator[Edge]:
        tables = self._part.tables
        row, origin = RELATIONS.get(relation.relation.name), tables.origins.get(relation)
        if row is None or origin is None:
            return
        targets: list[tuple[object, Predicate, str]] = []
        for instance in relation.created:
            predicate = self._part.predicate_of(instance)
            if predicate is not None:
                label = self._part.label_of(instance)
                name = label.name if label is not None else instance.path.span.text
                targets.append((label or instance, predicate, name))
                yield from self._lasting(label or instance, predicate, name)
        if (existing := tables.existing.get(relation)) is not None:
            targets.append((self._token(existing), existing.predicate, existing.name))
        for token, predicate, name in targets:
            ends = {
                Point.ORIGIN_START: self._time(self._token(origin), "start", origin.predicate),
                Point.ORIGIN_END: self._time(self._token(origin), "end", origin.predicate),
                Point.TARGET_START: self._time(token, "start", predicate),
                Point.TARGET_END: self._time(token, "end", predicate),
            }
            names = {self._token(origin): origin.name, token: name}
            span = relation.span if not relation.created else relation.relation.span
            for index, distance in enumerate(row.distances):
                lower, upper = _bounds(relation, index, distance.lower, distance.upper)
                is_containment = row.name in _CONTAINING
                earlier, later = ends[distance.earlier], ends[distance.later]
                yield from _edges(earlier, later, lower, upper, names, span, row.name, is_containment=is_containment)

    # ---- constraints ----

    def _comparison(self, left: Expr, op: str, right: Expr, span: Span) -> Iterator[Edge]:
        if op in (">", ">="):
            left, right, op = right, left, op.replace(">", "<")
        for one, other, way in ((left, right, 1), (right, left, -1)):
            token = self._duration(one)
            hull = self._hull(other) if token is not None else None
            if token is not None and hull is not None:
                yield from _durations(token, hull, op, way, span)
                return
        first, second = self._term(left), self._term(right)
        if first is not None and second is None and op == "==" and isinstance(right, IntervalExpr):
            yield from self._distance(None, right, left, span)
        if first is None or second is None or first[0] == second[0]:
            return
        (one_node, plus), (other_node, more) = first, second
        gap = plus - more
        if op == "<" and gap == int(gap) and self._is_whole(left) and self._is_whole(right):
            gap += 1
        names = {one_node[0]: _token_name(left), other_node[0]: _token_name(right)}
        upper = gap if op == "==" else INFINITY
        yield from _edges(one_node, other_node, gap, upper, names, span, None)

    def _is_whole(self, expression: Expr) -> bool:
        """Whether what `_term` understands is a whole number, apart from what is added to it."""
        while isinstance(expression, BinaryExpr):
            expression = expression.left
        reference = self._part.reference(expression) if isinstance(expression, PathExpr) else None
        match reference:
            case LocalReference(variable=variable) | GlobalReference(variable=variable):
                return variable.type.kind is Kind.INT
            case TokenVariableReference(type=type_):
                return type_.kind is Kind.INT
            case _:
                return True

    def _distance(self, first: Expr | None, distance: Expr, second: Expr, span: Span) -> Iterator[Edge]:
        """`first` and `second` are so far apart; without `first`, `second` is at that time."""
        one, other = (self._term(first) if first is not None else (_ZERO, 0.0)), self._term(second)
        bounds: tuple[float | None, float | None] = (self._number(distance),) * 2
        if isinstance(distance, IntervalExpr):
            bounds = self._number(distance.lower), self._number(distance.upper)
        if one is None or other is None or bounds[0] is None or bounds[1] is None or one[0] == other[0]:
            return
        shift = one[1] - other[1]
        names = {one[0][0]: _token_name(first) if first is not None else "", other[0][0]: _token_name(second)}
        yield from _edges(one[0], other[0], bounds[0] + shift, bounds[1] + shift, names, span, None)

    def _duration(self, expression: Expr) -> tuple[object, str] | None:
        """The token whose duration an expression is, and its name."""
        reference = self._part.reference(expression) if isinstance(expression, PathExpr) else None
        if not isinstance(reference, TokenVariableReference) or reference.name != "duration":
            return None
        return self._token(reference.label), reference.label.name

    def _hull(self, expression: Expr) -> Interval | None:
        """Between which numbers an expression lies, None where nothing is known."""
        if (value := self._number(expression)) is not None:
            return Interval(value, value)
        if isinstance(expression, PathExpr) and isinstance(self._part.reference(expression), GlobalReference):
            return None  # what a script makes of a variable is more than what declares it
        domain = domain_of(self._part, expression)
        return domains.hull(domain) if domain is not None else None

    def _number(self, expression: Expr) -> float | int | None:
        """The number that an expression stands for: of literals and of global constants."""
        return number(expression, self._constant)

    def _constant(self, path: PathExpr) -> float | int | None:
        reference = self._part.reference(path)
        if not isinstance(reference, GlobalReference) or reference.variable.type.kind not in _NUMBERS:
            return None
        domain = declared(reference.variable)
        hull = domains.hull(domain) if domain is not None and domains.is_single(domain) else None
        return hull.lower if hull is not None else None

    def _term(self, expression: Expr) -> tuple[Node, float] | None:
        """An expression as a time and a distance from it."""
        if (value := self._number(expression)) is not None:
            return (_ZERO, value) if abs(value) < INFINITY else None
        if isinstance(expression, BinaryExpr) and expression.op in ("+", "-"):
            offset = self._number(expression.right)
            inner = (
                self._term(expression.left) if offset is not None and isinstance(expression.left, PathExpr) else None
            )
            if inner is None or offset is None:
                return None
            return inner[0], inner[1] + (offset if expression.op == "+" else -offset)
        reference = self._part.reference(expression) if isinstance(expression, PathExpr) else None
        if isinstance(reference, TokenVariableReference) and reference.name in ("start", "end", "time"):
            return self._time(self._token(reference.label), reference.name, reference.label.predicate), 0
        match reference:
            case LocalReference(variable=variable) | GlobalReference(variable=variable):
                return ((variable, "value"), 0) if variable.type.kind in _NUMBERS else None
            case TokenVariableReference(label=label, name=name, type=type_):
                is_number = type_.kind in _NUMBERS and name not in ("duration", "state", "object")
                return ((self._token(label), name), 0) if is_number else None
            case _:
                return None


def _bounds(relation: Relation, index: int, lower: float, upper: float) -> tuple[float, float]:
    if index >= len(relation.bounds):
        return lower, upper
    bound = relation.bounds[index]
    least, most = number(bound.lower), number(bound.upper)
    return (lower if least is None else least), (upper if most is None else most)


def _ranges(token: object, predicate: Predicate, name: str) -> Iterator[Edge]:
    """What its declaration leaves to the parameters of a token that are numbers."""
    for parameter in predicate.parameters:
        domain = token_domain(predicate, parameter.name, parameter.type) if parameter.type.kind in _NUMBERS else None
        hull = domains.hull(domain) if domain is not None else None
        if hull is None:
            continue
        at = (token, parameter.name)
        words = f"`{_time_name(at, {token: name})}` is at {{}} by its declaration"
        if hull.lower > -INFINITY:
            yield Edge(at, _ZERO, -hull.lower, words.format(f"least {_number(hull.lower)}"), predicate.span)
        if hull.upper < INFINITY:
            yield Edge(_ZERO, at, hull.upper, words.format(f"most {_number(hull.upper)}"), predicate.span)


def _token_name(expression: Expr) -> str:
    while isinstance(expression, BinaryExpr):
        expression = expression.left
    return expression.parts[0].name if isinstance(expression, PathExpr) and len(expression.parts) > 1 else "this"


def _durations(token: tuple[object, str], hull: Interval, op: str, way: int, span: Span) -> Iterator[Edge]:
    start, end = (token[0], "start"), (token[0], "end")
    strict = 1 if op == "<" else 0
    if (op == "==" or way == 1) and hull.upper < INFINITY:
        words = f"`{token[1]}` lasts at most {_number(hull.upper - strict)}"
        yield Edge(start, end, hull.upper - strict, words, span, is_duration=True)
    if (op == "==" or way == -1) and hull.lower > -INFINITY:
        words = f"`{token[1]}` lasts at least {_number(hull.lower + strict)}"
        yield Edge(end, start, -hull.lower - strict, words, span, is_duration=True)


def _edges(
    earlier: Node,
    later: Node,
    lower: float,
    upper: float,
    names: dict[object, str],
    span: Span,
    relation: str | None,
    *,
    is_containment: bool = False,
) -> Iterator[Edge]:
    """`lower` <= later - earlier <= `upper` as edges."""
    one, other = _time_name(earlier, names), _time_name(later, names)
    word = f"`{relation}`: " if relation is not None else ""
    if abs(lower) < INFINITY:
        words = f"{word}`{_shifted(one, lower)} <= {other}`" if other else f"`{one} <= {_number(-lower)}`"
        yield Edge(later, earlier, -lower, words, span, is_containment=is_containment)
    if abs(upper) < INFINITY:
        words = f"{word}`{other} <= {_shifted(one, upper)}`" if other else f"`{_number(-upper)} <= {one}`"
        yield Edge(earlier, later, upper, words, span, is_containment=is_containment)


def _time_name(node: Node, names: dict[object, str]) -> str:
    if node == _ZERO:
        return ""
    if node[1] == "value":
        return getattr(node[0], "name", "")
    name = names[node[0]]
    return node[1] if name == "this" else f"{name}.{node[1]}"


def _shifted(name: str, distance: float) -> str:
    if not name:
        return _number(distance)
    if distance == 0:
        return name
    return f"{name} {'+' if distance > 0 else '-'} {_number(abs(distance))}"


def _number(value: float) -> str:
    return str(int(value)) if value == int(value) else str(value)
