"""Work out whether a condition holds for all, or for no values that its variables can have."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from nddl_lang.lint.part import Key, Part
from nddl_lang.lint.reading import bounded, domain_of, key_of
from nddl_lang.semantics import domains
from nddl_lang.semantics.schema import INFINITY, Domain, Interval, Kind, Values
from nddl_lang.syntax.nodes import BinaryExpr, BoolLiteral, Expr, PathExpr, UnaryExpr

_SWAPPED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
_NEGATED = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}
_Value = float | int | bool | str
_DEEPEST = 50  # conditions nested deeper are not judged


@dataclass(frozen=True, slots=True)
class Known:
    """What holds at a place: the domains of variables, and single values that they do not have."""

    domains: dict[Key, Domain] = field(default_factory=dict)
    excluded: dict[Key, frozenset[_Value]] = field(default_factory=dict)
    constants: Mapping[Key, Domain] = field(default_factory=dict)  # what the script, not the declaration, gives

    def without_exclusions(self) -> "Known":
        """What holds apart from the `else` branches on the way: their conditions are often spelt out again."""
        return replace(self, excluded={})


def truth(part: Part, condition: Expr, known: Known, depth: int = 0) -> bool | None:
    """Whether the condition holds for all values (True) or for none (False) of those that are known."""
    if depth > _DEEPEST:
        return None
    match condition:
        case BoolLiteral(value=value):
            return value
        case UnaryExpr(op="!", operand=operand):
            inner = truth(part, operand, known, depth + 1)
            return None if inner is None else not inner
        case BinaryExpr(op="&&" | "||" as op, left=left, right=right):
            decisive = op == "||"
            # The right side matters only where the left one has not decided.
            beside = assume(part, left, not decisive, known)
            sides = (truth(part, left, known, depth + 1), truth(part, right, beside, depth + 1))
            if decisive in sides:
                return decisive
            return not decisive if sides == (not decisive, not decisive) else None
        case BinaryExpr(op=op, left=left, right=right) if op in _NEGATED:
            return _comparison(part, condition, known)
        case PathExpr():
            domain = _domain(part, condition, known)
            return (
                bool(domain.items[0]) if isinstance(domain, Values) and set(domain.items) in ({True}, {False}) else None
            )
        case _:
            return None


def _comparison(part: Part, condition: BinaryExpr, known: Known) -> bool | None:
    left, right = (_domain(part, side, known) for side in (condition.left, condition.right))
    kind = _kind(part, condition)
    if condition.op in ("==", "!="):
        answer = None if left is None or right is None else _equality(left, right, kind)
        if answer is None and _is_excluded(part, condition, known):
            answer = False
        return answer if condition.op == "==" or answer is None else not answer
    if left is None or right is None:
        return None
    return _order(condition.op, domains.hull(left), domains.hull(right), kind)


def _equality(left: Domain, right: Domain, kind: Kind) -> bool | None:
    if domains.intersect(left, right, kind) is None:
        return False
    return True if domains.is_single(left) and domains.is_single(right) else None


def _is_excluded(part: Part, condition: BinaryExpr, known: Known) -> bool:
    for one, other in ((condition.left, condition.right), (condition.right, condition.left)):
        key = key_of(part.reference(one)) if isinstance(one, PathExpr) else None
        value = _single(domain_of(part, other))
        if key is not None and value is not None and value in known.excluded.get(key, ()):
            return True
    return False


def _order(op: str, left: Interval | None, right: Interval | None, kind: Kind) -> bool | None:
    if left is None or right is None or (kind is Kind.FLOAT and op in ("<", ">")):
        return None
    if op in (">", ">="):
        op, left, right = _SWAPPED[op], right, left
    if op == "<":
        return True if left.upper < right.lower else False if left.lower >= right.upper else None
    return True if left.upper <= right.lower else False if left.lower > right.upper else None


def _kind(part: Part, condition: BinaryExpr) -> Kind:
    kinds = {type_.kind for side in (condition.left, condition.right) if (type_ := part.tables.types.get(side))}
    return Kind.FLOAT if Kind.FLOAT in kinds else next(iter(kinds), Kind.INT) if len(kinds) == 1 else Kind.INT


def _domain(part: Part, expression: Expr, known: Known) -> Domain | None:
    found = domain_of(part, expression)
    key = key_of(part.reference(expression)) if isinstance(expression, PathExpr) else None
    if key is None:
        return found
    narrowed = known.domains.get(key)
    type_ = part.tables.types.get(expression)
    kind = type_.kind if type_ is not None else Kind.INT
    if narrowed is not None:
        found = narrowed if found is None else domains.intersect(found, narrowed, kind) or found
    gone = known.excluded.get(key)
    if gone and isinstance(found, Values):
        left = tuple(item for item in found.items if item not in gone)
        found = Values(left) if left else found
    return found


def assume(part: Part, condition: Expr, holds: bool, known: Known, depth: int = 0) -> Known:
    """What is known where `condition` holds, or where it does not."""
    if depth > _DEEPEST:
        return known
    match condition:
        case UnaryExpr(op="!", operand=operand):
            return assume(part, operand, not holds, known, depth + 1)
        case BinaryExpr(op="&&" | "||" as op, left=left, right=right):
            if holds is (op == "&&"):
                known = assume(part, left, holds, known, depth + 1)
                return assume(part, right, holds, known, depth + 1)
            return known
        case BinaryExpr(op=op, left=left, right=right) if op in _NEGATED:
            op = op if holds else _NEGATED[op]
            known = _assume_side(part, left, op, right, known, is_branch=not holds)
            return _assume_side(part, right, _SWAPPED[op], left, known, is_branch=not holds)
        case PathExpr() if (key := key_of(part.reference(condition))) is not None:
            if holds:
                return replace(known, domains={**known.domains, key: Values((True,))})
            return _excluding(known, key, True)
        case _:
            return known


def _assume_side(part: Part, path: Expr, op: str, other: Expr, known: Known, *, is_branch: bool) -> Known:
    key = key_of(part.reference(path)) if isinstance(path, PathExpr) else None
    type_ = part.tables.types.get(path)
    named = key_of(part.reference(other)) if isinstance(other, PathExpr) else None
    given = known.constants.get(named) if named is not None else None
    value = given if given is not None else domain_of(part, other)
    if key is None or type_ is None or value is None or (isinstance(other, PathExpr) and _single(value) is None):
        return known
    if op == "!=":
        single = _single(value)
        return _excluding(known, key, single) if single is not None else known
    given = value
    if op != "==":
        single = _single(value)
        given = None
        if isinstance(single, int | float) and abs(single) < INFINITY:
            step = 1 if type_.kind is Kind.INT and isinstance(single, int) and op in ("<", ">") else 0
            given = bounded(op, single - step if op == "<" else single + step)
    if given is None or (is_branch and op != "=="):
        return known
    before = known.domains.get(key)
    both = domains.intersect(before, given, type_.kind) if before is not None else given
    return replace(known, domains={**known.domains, key: both or given})


def _excluding(known: Known, key: Key, value: _Value) -> Known:
    return replace(known, excluded={**known.excluded, key: known.excluded.get(key, frozenset()) | {value}})


def _single(domain: Domain | None) -> _Value | None:
    if domain is None or not domains.is_single(domain):
        return None
    return domain.lower if isinstance(domain, Interval) else domain.items[0]
