"""Words for causes and constraints: a term or a violation in, one line out. Nobody else words them."""

from typing import assert_never

from runtime.constraints.domains.tags import HALF_INF
from runtime.plan import tags
from runtime.plan.readout.statements import Argument, ResourceTerm, Term

_INFIX = {"eq": "==", "neq": "!=", "leq": "<=", "lt": "<"}
_SIGNS = {"addEq": "+", "mulEq": "*", "temporalDistance": "+"}


def words(cause: Term | ResourceTerm) -> str:
    """What a cause says, as a modeler would write it."""
    match cause:
        case ResourceTerm():
            return _violation(cause)
        case Term("precedence", (source, target, weight)):
            return _precedence(str(source), str(target), weight)
        case Term("bounds", (variable, lower, upper)):
            return _bounds(str(variable), lower, upper, cause.values)
        case Term("sampledParameter", (variable, parameter, value)):
            return f"{variable} = {parameter} = {value}"
        case Term("memberOf", (result, _, *_)):
            return f"{result} is that of {_one_of(cause.values)}"
        case Term(name, arguments):
            return _constraint(name, [str(argument) for argument in arguments])
        case _:
            assert_never(cause)


def _one_of(names: tuple[str, ...]) -> str:
    return f"{', '.join(names[:-1])} or {names[-1]}" if len(names) > 1 else "".join(names)


def _precedence(source: str, target: str, weight: Argument) -> str:
    assert isinstance(weight, int | float)
    if weight < 0:
        return f"{target} + {-weight} <= {source}"
    return f"{target} <= {source}" if weight == 0 else f"{target} <= {source} + {weight}"


def _bounds(name: str, lower: Argument, upper: Argument, values: tuple[str, ...]) -> str:
    if values:
        return f"{name} = {values[0]}" if len(values) == 1 else f"{name} in {{{', '.join(values)}}}"
    has_lower, has_upper = lower != float("-inf"), upper != float("inf")
    if lower == upper:
        return f"{name} = {lower}"
    if has_lower and has_upper:
        return f"{name} in [{lower}, {upper}]"
    if not has_lower and not has_upper:
        return f"{name} may be anything"
    return f"{name} >= {lower}" if has_lower else f"{name} <= {upper}"


def _constraint(name: str, texts: list[str]) -> str:
    if name in _INFIX and len(texts) == 2:
        return f"{texts[0]} {_INFIX[name]} {texts[1]}"
    if name in _SIGNS and len(texts) == 3:
        return f"{texts[0]} {_SIGNS[name]} {texts[1]} == {texts[2]}"
    if name == "foreach" and len(texts) == 2:
        return f"{texts[0]} may not lose a value any more: `foreach` has gone through {texts[1]}"
    return f"{name}({', '.join(texts)})"


def _violation(found: ResourceTerm) -> str:
    """What is wrong with a resource, and who uses it."""
    name, amount, limit = found.resource, found.amount, found.limit
    is_dated = found.at < HALF_INF  # a latest time that hangs on one without end lies a little before infinity
    when = f"at {found.at}" if is_dated else "in the end"
    users = ", ".join(f"{user} {used:g}" for user, used in found.users)
    users = f": {users}" if users else ""
    so = "by these uses alone" if users and not is_dated else when  # what gives it back may not be in the plan yet
    if found.in_any_order:
        side = "falls below its least" if found.wrong == tags.TOO_LOW else "rises above its greatest"
        by = f"by {found.at}" if is_dated else "in the end"
        return f"the level of {name} {side}, {limit:g}, {by} in any order{users}"
    match found.wrong:
        case tags.TOO_LOW if found.has_helper:
            return f"the level of {name} falls to {limit - amount:g} {so}, its least is {limit:g}{users}"
        case tags.TOO_LOW:
            return f"{name} needs {found.room + amount:g} of {found.room:g} available {when}{users}"
        case tags.TOO_HIGH:
            return f"the level of {name} rises to {limit + amount:g} {so}, its greatest is {limit:g}{users}"
        case tags.TOO_TIGHT:
            have = found.room * (found.until - found.at)
            unit = "ticks" if found.room == 1.0 else "amount times ticks"
            until = found.until if found.until < HALF_INF else "inf"
            return f"{name} needs {have + amount:g} of {have:g} {unit} available in [{found.at}, {until}]{users}"
        case tags.TOO_FAST:
            return f"too much of {name} flows {when}, by {amount:g}{users}"
    return f"too much of {name} is used altogether, by {amount:g}{users}"
