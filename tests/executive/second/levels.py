"""Levels of a plan's stores: whether they can be within bounds, and orders of uses by which they are."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from tests.executive.second.description import Child, Guarded, Item, Store, Use
from tests.executive.second.network import ContradictionError
from tests.executive.second.plan import Plan


@dataclass(frozen=True, slots=True)
class Change:
    """A level changes by `amount` at a time between `low` and `high`; `time` is its number in the network."""

    amount: int
    low: int
    high: int
    time: int | None = None
    token: int = -1


def changes(plan: Plan, store: Store) -> list[Change]:
    """All that changes the level of a store, what is forgotten too."""
    found = [Change(amount, tick, tick) for name, amount, tick in plan.spent if name == store.name]
    for number, use in plan.uses:
        if use.store != store.name:
            continue
        token, net = plan.tokens[number], plan.net
        ends = [(token.start, use.amount), (token.end, -use.amount)]
        if use.when != "all":
            ends = [(token.start if use.when == "start" else token.end, use.amount)]
        found += [Change(amount, net.low[time], net.high[time], time, number) for time, amount in ends]
    return found


def is_possible(plan: Plan, waits: bool = False) -> bool:
    """Whether no level is out of bounds for certain, however uses fall within their times and orders.

    One that open tokens may relieve is judged later if it `waits`.
    """
    for store in plan.part.stores:
        every = changes(plan, store)
        for sign, limit in ((1, store.most), (-1, store.least)):
            for one in every:
                if one.amount * sign > 0 and sign * (_extreme(plan, store, every, one.high, -sign)[0] - limit) > 0:
                    if not (waits and _may_come(plan, store, -sign)):
                        return False
    return True


def _may_come(plan: Plan, store: Store, sign: int) -> bool:
    """Whether something open may yet raise the level of a reservoir (`sign` 1) or lower it."""
    agenda: list[Item] = [item for _, item in plan.waiting if isinstance(item, Guarded)]
    for one in plan.open():
        if plan.window(one)[1] <= plan.now:
            agenda += _body(plan, plan.tokens[one].timeline, plan.tokens[one].predicate)
    met: set[tuple[str, str]] = set()
    while store.kind == "Reservoir" and agenda:
        match agenda.pop():
            case Use(name, amount) if name == store.name and amount * sign > 0:
                return True
            case Guarded(_, _, body):
                agenda += body
            case Child(_, timeline, predicate) if (timeline, predicate) not in met:
                met.add((timeline, predicate))
                agenda += _body(plan, timeline, predicate)
    return False


def _body(plan: Plan, timeline: str, predicate: str) -> list[Item]:
    """All that the rules of a predicate say."""
    rules = [rule for rule in plan.part.rules if (rule.timeline, rule.predicate) == (timeline, predicate)]
    return [item for rule in rules for item in rule.body]


def within_levels(plan: Plan) -> Iterator[Plan]:
    """Plans in which uses come in such an order that no level can be out of bounds; all, where nobody orders uses."""
    if not plan.part.orders:
        if is_possible(plan):
            yield plan
        return
    flaw = _flaw(plan)
    if flaw is None:
        yield plan
        return
    for before, after in flaw:
        trial = plan.copy()
        trial.decisions += 1
        try:
            assert before.time is not None and after.time is not None
            trial.net.speaker = after.token
            trial.net.differ(before.time, after.time, 0, 100_000)
            trial.settle()
        except ContradictionError:
            continue
        yield from within_levels(trial)


def _flaw(plan: Plan) -> list[tuple[Change, Change]] | None:
    """Of the first level that may be out of bounds: the pairs that may be put in order; None if there is none."""
    for store in plan.part.stores:
        every = changes(plan, store)
        for sign, limit in ((-1, store.least), (1, store.most)):
            for one in sorted(every, key=lambda change: change.low):
                if one.amount * sign <= 0:
                    continue
                level, there = _extreme(plan, store, every, one.low, sign)
                if sign * (level - limit) > 0:
                    helping = [each for each in every if each.amount * sign < 0 and each.high > one.low]
                    helping = [each for each in helping if each not in there and each.time is not None]
                    helping.sort(key=lambda change: change.low)
                    taking = [each for each in there if each.amount * sign > 0 and each.time is not None]
                    taking.sort(key=lambda change: -change.high)
                    return [(before, after) for before in helping for after in taking if before.token != after.token]
    return None


def _extreme(plan: Plan, store: Store, every: list[Change], tick: int, sign: int) -> tuple[int, list[Change]]:
    """The highest level (`sign` 1) or the lowest that a store may have at a tick, and what has come to pass then."""
    certain = [one for one in every if one.high <= tick]
    open_ones = [one for one in every if one.low <= tick < one.high]
    wanted = [one for one in open_ones if one.amount * sign > 0]
    best: tuple[int, list[Change]] | None = None
    for count in range(len(wanted) + 1):
        for chosen in combinations(wanted, count):
            there = [*certain, *(one for one in open_ones if any(_comes_before(plan, one, other) for other in chosen))]
            level = store.first + sum(one.amount for one in there)
            if best is None or sign * (level - best[0]) > 0:
                best = level, there
    assert best is not None
    return best


def _comes_before(plan: Plan, one: Change, other: Change) -> bool:
    if one is other:
        return True
    assert one.time is not None and other.time is not None
    return plan.net.distance(other.time, one.time) <= 0
