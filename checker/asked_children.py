"""A rule and a request in, the children of the rule out for which it may have been, and the token that asked so.

What the rule says of its children, by the arguments of its own tokens: equalities, sums, and the branches that these
take. What cannot be worked out so excludes nothing.
"""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence

from checker.single_values import single_value
from compiler.instructions import branched_instructions
from compiler.program import (
    FIRST_PARAMETER,
    Child,
    Guard,
    LocalVariable,
    NewVariable,
    Operand,
    Post,
    RuleCode,
    TokenVariable,
)
from runtime.executive.outcome import Event

_Value = float | int | bool | str
_Known = dict[Operand, _Value]


def children_asked_for(
    rule: RuleCode,
    slots: Collection[int],
    names: tuple[Sequence[str], Sequence[str]],
    request: Event,
    tokens: Iterable[Event],
    numbers: Mapping[Operand, float | str],
) -> tuple[frozenset[int], Event | None]:
    """The slots, of some children of one predicate, that have the arguments of a request, by one token of the rule.

    `names` are the parameters of the rule's predicate and of the child's, `tokens` tell of the rule's tokens with their
    arguments: of those that were there by then the last one counts for which a child fits. All slots, where none fits.
    """
    own, theirs = names
    for token in reversed([one for one in tokens if one.tick <= request.tick]):
        known = {**numbers, **_arguments(0, own, token)}
        fitting = {slot for slot in slots if _fits(rule, slot, {**known, **_arguments(slot, theirs, request)})}
        if fitting:
            return frozenset(fitting), token
    return frozenset(slots), None


def left_out(
    rule: RuleCode,
    slots: Iterable[int],
    names: tuple[Sequence[str], Sequence[str]],
    request: Event,
    token: Event,
    numbers: Mapping[Operand, float | str],
) -> list[Post]:
    """The constraints that asked for none of some children: in branches that the token did not take, or untrue of it.

    `names` are the parameters of the rule's predicate and of the child's.
    """
    own, theirs = names
    found: list[Post] | None = None
    for slot in slots:
        known = {**numbers, **_arguments(0, own, token), **_arguments(slot, theirs, request)}
        _fits(rule, slot, known)
        out = [
            step
            for step, within in branched_instructions(rule.body)
            if isinstance(step, Post) and (_is_left(within, known) or (within and not _agrees(step, known.copy())))
        ]
        found = out if found is None else [step for step in found if step in out]
    return found or []


def may_ask(
    rule: RuleCode, slot: int, names: Sequence[str], request: Event, numbers: Mapping[Operand, float | str]
) -> bool:
    """Whether nothing that a rule says whatever its token's arguments are contradicts that a child was the request.

    `names` are the parameters of the child's predicate.
    """
    return _fits(rule, slot, {**numbers, **_arguments(slot, names, request)})


def _arguments(slot: int, names: Sequence[str], event: Event) -> _Known:
    """The arguments of an event that have one value, as the variables of the token in a slot."""
    values = {name: single_value(domain) for name, domain in event.arguments}
    return {
        TokenVariable(slot, FIRST_PARAMETER + at): value
        for at, name in enumerate(names)
        if (value := values.get(name)) is not None
    }


def _is_left(within: Iterable[tuple[Guard, bool]], known: _Known) -> bool:
    """Whether one of the branches in which an instruction stands is not taken."""
    return any(known.get(guard.condition, not is_else) is is_else for guard, is_else in within)


def _fits(rule: RuleCode, slot: int, known: _Known) -> bool:
    """Whether nothing that the rule says contradicts the values, and the branch of the child is taken.

    What follows from them becomes `known`.
    """
    steps = branched_instructions(rule.body)
    own = next((within for step, within in steps if isinstance(step, Child) and step.slot == slot), ())
    for guard, is_else in own:
        if known.setdefault(guard.condition, not is_else) is is_else:
            return False
    grows = True
    while grows:
        count = len(known)
        for step, within in branched_instructions(rule.body):
            if _is_left(within, known):
                if isinstance(step, Child) and step.slot == slot:
                    return False
                continue
            if isinstance(step, NewVariable) and step.copy_of is not None and step.copy_of in known:
                known.setdefault(LocalVariable(step.slot), known[step.copy_of])
            is_sure = all(guard.condition in known for guard, _ in within)
            if isinstance(step, Post) and is_sure and not _agrees(step, known):
                return False
        grows = len(known) > count
    return True


def _agrees(post: Post, known: _Known) -> bool:
    """Whether a constraint may hold; what it gives becomes known, of local variables alone: others may be any."""
    values = [known.get(one) for one in post.operands]
    match post.name, values:
        case "eq", [one, other]:
            results = [(0, other), (1, one)]
        case "testEq", [_, one, other] if one is not None and other is not None:
            results = [(0, one == other)]
        case "addEq", [int() | float() as one, int() | float() as other, _]:
            results = [(2, one + other)]
        case "addEq", [_, int() | float() as other, int() | float() as result]:
            results = [(0, result - other)]
        case "addEq", [int() | float() as one, _, int() | float() as result]:
            results = [(1, result - one)]
        case _:
            return True
    for at, value in results:
        if value is None:
            continue
        operand = post.operands[at]
        if isinstance(operand, LocalVariable):
            known.setdefault(operand, value)
        if not _may_be_equal(values[at], value):
            return False
    return True


def _may_be_equal(one: _Value | None, other: _Value) -> bool:
    """Whether two values are one but for rounding; anything may be what is not known."""
    match one, other:
        case None, _:
            return True
        case ((float() | int()), (float() | int())):
            return math.isclose(one, other, rel_tol=1e-9, abs_tol=1e-9)
        case _:
            return one == other
