"""What the language brings along in; Markdown out: relations, constraints, functions, methods."""

from collections.abc import Iterator, Sequence

from nddl_lang.semantics.constraints import CONSTRAINTS, ConstraintRow, Origin
from nddl_lang.semantics.functions import FunctionRow, MethodRow, ResultKind
from nddl_lang.semantics.relations import Distance, DurationRule, Point, RelationRow
from nddl_lang.semantics.schema import INFINITY
from nddl_lang.semantics.signature import Argument, Signature

Bound = tuple[str, str]

_RESULTS = {
    ResultKind.WIDEST: "an `int` over ints, otherwise a `float`",
    ResultKind.SAMPLED: "a value of the type of the parameter",
}


def fenced(text: str) -> str:
    """`text` as a block of NDDL."""
    return f"```nddl\n{text}\n```"


def relation_head(row: RelationRow) -> Iterator[str]:
    """What a relation means, whichever tokens it links."""
    yield fenced(f"origin {row.name} (target)")
    yield row.meaning


def relation_tail(row: RelationRow) -> Iterator[str]:
    """How else the same can be said, and where EUROPA differs."""
    if row.inverse is not None and row.inverse != row.name:
        yield f"The same as `target {row.inverse} origin`."
    elif row.inverse == row.name and row.distances:
        yield f"The same as `target {row.name} origin`."
    if row.europa is not None:
        yield f"*EUROPA:* {row.europa}"


def demands(
    row: RelationRow, points: dict[Point, str], durations: Bound, bounds: Sequence[Bound] = ()
) -> tuple[str, ...]:
    """What a relation demands, with the times and durations of its two tokens by the names that are given."""
    lines = []
    for index, distance in enumerate(row.distances):
        written = bounds[index] if index < len(bounds) else None
        lines.append(_demand(distance, points[distance.earlier], points[distance.later], written))
    if not bounds:
        origin, target = durations
        match row.duration:
            case DurationRule.EQUAL:
                lines.append(f"{origin} == {target}")
            case DurationRule.TARGET_SHORTER:
                lines.append(f"{target} <= {origin}")
            case DurationRule.ORIGIN_SHORTER:
                lines.append(f"{origin} <= {target}")
            case DurationRule.NONE:
                pass
    return tuple(lines)


def _demand(distance: Distance, earlier: str, later: str, bound: Bound | None) -> str:
    if bound is not None:
        return f"{bound[0]} <= {later} - {earlier} <= {bound[1]}"
    match distance.lower, distance.upper:
        case 0, 0:
            return f"{earlier} == {later}"
        case 0, upper if upper >= INFINITY:
            return f"{earlier} <= {later}"
        case 1, upper if upper >= INFINITY:
            return f"{earlier} < {later}"
        case lower, upper:
            return f"{lower} <= {later} - {earlier} <= {upper}"


def points_of(
    origin: str, target: str, is_origin_event: bool = False, is_target_event: bool = False
) -> dict[Point, str]:
    """How the times of two tokens are written; a prefix is empty for the rule's own token."""
    return {
        Point.ORIGIN_START: origin + ("time" if is_origin_event else "start"),
        Point.ORIGIN_END: origin + ("time" if is_origin_event else "end"),
        Point.TARGET_START: target + ("time" if is_target_event else "start"),
        Point.TARGET_END: target + ("time" if is_target_event else "end"),
    }


def constraint_text(row: ConstraintRow) -> Iterator[str]:
    """A named constraint."""
    yield fenced(f"{row.name}({row.signature.text})")
    yield _sentence(row.meaning)
    yield from _places(row.signature)
    if row.is_reified:
        yield "The first argument is the truth value: it follows from the others, and they from it."
    elif (determined := _determined(row)) is not None and row.forward_only:
        yield f"`{determined.name}` is computed once all others are known; nothing follows for them from it."
    elif determined is not None:
        yield f"`{determined.name}` is determined by the others; bounds follow in both directions."
    elif row.forward_only:
        yield "It waits until its arguments are known."
    if row.alias_of is not None:
        yield f"Another name of `{row.alias_of}`."
    if row.europa is not None:
        yield f"*EUROPA:* {row.europa}"
    yield from _origin(row.origin)


def _determined(row: ConstraintRow) -> Argument | None:
    if row.result is None:
        return None
    if row.result == -1:
        return row.signature.rest or row.signature.required[-1]
    return row.signature.argument(row.result)


def function_text(row: FunctionRow) -> Iterator[str]:
    """A function of expressions."""
    yield fenced(f"{row.name}({row.signature.text})")
    yield _sentence(row.meaning)
    yield from _places(row.signature)
    yield f"Gives {_RESULTS.get(row.result, f'`{row.result.value}`')}."
    bound = CONSTRAINTS.get(row.constraint)
    if bound is not None and bound.name != row.name and row.result is not ResultKind.SAMPLED:
        yield f"Its value is bound by the constraint `{bound.name}({bound.signature.text})`: {bound.meaning}."
    yield from _origin(row.origin)


def method_text(row: MethodRow) -> Iterator[str]:
    """A method of the script."""
    yield fenced(f"{row.name}({row.signature.text})")
    yield f"Method of {row.receiver.value}: {row.meaning}."
    yield from _places(row.signature)
    if row.europa is not None:
        yield f"*EUROPA:* {row.europa}"


def _places(signature: Signature) -> Iterator[str]:
    places = [*signature.required, *signature.optional]
    lines = [f"- `{place.name}`: {place.kind.value}" for place in places]
    if signature.rest is not None:
        lines.append(f"- `{signature.rest.name}...`: any number, each {signature.rest.kind.value}")
    if lines:
        yield "\n".join(lines)


def _origin(origin: Origin) -> Iterator[str]:
    if origin is not Origin.EUROPA:
        yield f"Comes with {origin.value}."


def _sentence(text: str) -> str:
    return text if text.endswith(".") else f"{text}."
