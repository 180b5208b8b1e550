"""What a resource demands of its uses as a claim of z3: its level after each use, exactly, in whatever order they come.

Which uses there are is taken from the engine's account, as are changes of the limits by the script. Times, quantities,
limits and the resource that a use is of are variables. What is given back at an instant is there for what is taken
then, as for the judge (checker/judge/resources.py).
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import inf

import z3

from checker.proofs.claims import Claim, Number
from runtime.plan.readout.statements import Argument, Term

_SIGNS = {"consume": -1, "produce": 1, "use": -1}
_DEMANDS = ("levelAtLeast", "levelAtMost", "rateAtMost", "totalAtMost")


@dataclass(frozen=True, eq=False, slots=True)
class _Use:
    """What a use adds to the level (0: it is of another resource) from `start` on, up to `end` if it gives it back."""

    sign: int
    amount: Number
    start: Number
    end: Number | None


def is_demand(terms: Sequence[Term]) -> bool:
    """Whether terms say what a resource demands."""
    return bool(terms) and terms[0].name in _DEMANDS


def demand_claim(terms: Sequence[Term], number: Callable[[Argument], Number]) -> Claim:
    """What the first of the terms demands, by the numbers of their arguments."""
    demand, resource = terms[0], terms[0].arguments[0]
    given = [term for term in terms if term.name in _SIGNS]
    uses = [_use(term, resource, number) for term in given]
    steps = [term.arguments[1:] for term in terms if term.name == "capacityFrom"]
    limits = [term.arguments[1:] for term in terms if term.name == "levelFrom"]
    match demand.name:
        case "levelAtLeast" | "levelAtMost":
            parts = _level_claims(demand, uses, steps, limits, number)
        case "rateAtMost":
            parts = [_flow(each.sign, uses, each.start) <= limit for each, limit in _limited(demand, uses, number)]
        case _:
            limited = {each.sign: limit for each, limit in _limited(demand, uses, number)}
            parts = [_flow(sign, uses, None) <= limit for sign, limit in limited.items()]
    return z3.And(*parts, *[number(term.arguments[1]) >= 0 for term in given])  # by the type of a quantity


def _use(term: Term, resource: Argument, number: Callable[[Argument], Number]) -> _Use:
    holder, quantity, start, *end = term.arguments
    amount = _real(number(quantity))
    if holder != resource:
        amount = z3.If(number(holder) == number(resource), amount, z3.RealVal(0))
    return _Use(_SIGNS[term.name], amount, number(start), number(end[0]) if end else None)


def _level_claims(
    demand: Term,
    uses: Sequence[_Use],
    steps: Sequence[tuple[Argument, ...]],
    limits: Sequence[tuple[Argument, ...]],
    number: Callable[[Argument], Number],
) -> list[Claim]:
    """The level at each instant at which it, or its limit, changes."""
    _, first, limit = demand.arguments
    is_least = demand.name == "levelAtLeast"
    capacity = _real(number(first))
    parts = []
    changes: list[tuple[Number, Number]] = []  # of the capacity, for good
    for at, lower, upper in steps:
        after = z3.FreshReal("capacity")
        parts.append(z3.And(after >= _real(number(lower)), after <= _real(number(upper))))
        changes.append((number(at), after - capacity))
        capacity = after
    instants = [each.start for each in uses] + [at for at, _ in changes] + [number(at) for at, _, _ in limits]
    for now in instants:
        level = _real(number(first)) + sum(_had(each, now) for each in uses)
        level += sum(z3.If(at <= now, more, z3.RealVal(0)) for at, more in changes)
        in_force = [z3.BoolVal(True), *(number(at) <= now for at, _, _ in limits)]  # each until the next is
        bounds = [limit, *((lower if is_least else upper) for _, lower, upper in limits)]
        for k, bound in enumerate(bounds):
            if not _is_endless(bound):
                least = _real(number(bound))
                is_this = z3.And(in_force[k], *[z3.Not(later) for later in in_force[k + 1 :]])
                parts.append(z3.Implies(is_this, level >= least if is_least else level <= least))
    return parts


def _had(use: _Use, now: Number) -> Number:
    """What a use has added to the level at an instant."""
    is_on = use.start <= now if use.end is None else z3.And(use.start <= now, now < use.end)
    return z3.If(is_on, use.sign * use.amount, z3.RealVal(0))


def _limited(demand: Term, uses: Sequence[_Use], number: Callable[[Argument], Number]) -> Iterator[tuple[_Use, Number]]:
    """The uses whose flow has a limit, with that."""
    _, consumption, production = demand.arguments
    for each in uses:
        limit = consumption if each.sign < 0 else production
        if not _is_endless(limit):
            yield each, _real(number(limit))


def _flow(sign: int, uses: Sequence[_Use], at: Number | None) -> Number:
    """What uses of one sign take, or give, at an instant, or altogether."""
    same = [each for each in uses if each.sign == sign]
    return sum(each.amount if at is None else z3.If(each.start == at, each.amount, z3.RealVal(0)) for each in same)


def _real(value: Number) -> Number:
    return z3.ToReal(value) if z3.is_int(value) else value


def _is_endless(value: Argument) -> bool:
    return isinstance(value, float) and abs(value) == inf
