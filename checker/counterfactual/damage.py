"""A mission flown with a change in; out: what happened, what it has lost though it passed, what it no longer does."""

import math
from collections.abc import Sequence

from checker.batch.result import MissionResult
from checker.coverage import left_out
from checker.losses import GoalFate
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.events import heads_of, single_events

_GIVEN_UP = (GoalFate.LATE, GoalFate.REJECTED)
HEAVY = 10.0  # damage of a mission that passes without a goal
ALIKE = 1.0  # of each that the failed one had given up in the same way
_COLLAPSED = 1.5  # of each of two predicates that hardly hold
_LONG = 10  # ticks that are no moment
_VIOLATED = 1.5  # of a property that was violated in any case
_STRAYED, _MOST_STRAYED = 0.4, 2.0  # of each rule or branch that the mission no longer exercises


def damage_of(result: MissionResult, is_cut: bool = False, unknown: frozenset[int] = frozenset()) -> float:
    """What a mission that passed has lost all the same: goals weigh most, then requests, then repairs.

    The more was lost, the less one more of it tells: many are usual in some models. Where a flight `is_cut` off before
    the mission ends, open goals may be achieved yet. Goals by number that are `unknown` do not weigh.
    """
    losses = result.losses
    kept = (GoalFate.ACHIEVED, GoalFate.RECALLED, *((GoalFate.OPEN,) if is_cut else ()))
    goals = sum(one.fate not in kept and one.number not in unknown for one in losses.goals)
    return HEAVY * goals + math.log2(1.0 + losses.lost + losses.dropped + 0.5 * losses.repaired)


def unknown_goals(failed: MissionResult, goals: Sequence[GoalConfiguration]) -> frozenset[int]:
    """The optional goals of which a failed mission does not tell whether it would have lost them without its failure.

    They had been given up before, or were not to begin before it was over; the latter only beside mandatory ones, for a
    mission of which nothing is demanded passes by doing nothing.
    """
    if failed.outcome is None or failed.outcome.abort is None:
        return frozenset()
    last = failed.outcome.last_tick
    given_up = {one.number for one in failed.losses.goals if one.fate in _GIVEN_UP and one.tick < last}
    optional = {number: goal for number, goal in enumerate(goals) if not goal.mandatory}
    later = {number for number, goal in optional.items() if goal.start is not None and goal.start[0] > last}
    return frozenset(optional.keys() & (given_up if len(optional) == len(goals) else given_up | later))


def unkept_goals(passed: Sequence[MissionResult], goals: Sequence[GoalConfiguration]) -> frozenset[int]:
    """Goals that no change loses: the mission file takes them back, or no mission that passed achieved them."""
    taken_back = {number for number, goal in enumerate(goals) if goal.recall is not None}
    kept = {one.number for each in passed for one in each.losses.goals if one.fate is GoalFate.ACHIEVED}
    known = {one.number for each in passed for one in each.losses.goals}
    return frozenset(taken_back | (known - kept))


def lost_alike(result: MissionResult, failed: MissionResult, goals: Sequence[GoalConfiguration]) -> frozenset[int]:
    """The optional goals that were given up at the same tick without the change: it does not cost them."""
    before = {(one.number, one.fate, one.tick) for one in failed.losses.goals}
    return frozenset(
        one.number
        for one in result.losses.goals
        if one.fate in _GIVEN_UP and (one.number, one.fate, one.tick) in before
        if one.number < len(goals) and not goals[one.number].mandatory
    )


def voided_of(result: MissionResult, failed: MissionResult) -> float:
    """What it costs that the property which was violated is kept only as nothing that it promises was due."""
    broken = failed.judgement.broken
    if broken is None or result.outcome is None:
        return 0.0
    return HEAVY * any(one.is_void for one in result.outcome.properties if one.name == broken.name)


def violated_of(result: MissionResult) -> float:
    """What it costs that properties are violated which a failure is not about: one change may mend both."""
    if result.outcome is None:
        return 0.0
    return _VIOLATED * any(not one.is_kept for one in result.outcome.properties)


def is_farther(result: MissionResult, failed: MissionResult) -> bool:
    """Whether a mission that fails as well does so later in another way, achieves more, or violates a property by less.

    One that gives up more goals lasts longer as it does less.
    """
    if result.outcome is None or failed.outcome is None:
        return False
    achieved, before = (one.losses.count(GoalFate.ACHIEVED) for one in (result, failed))
    given_up, others = (
        sum(one.losses.count(fate) for fate in (GoalFate.LATE, GoalFate.REJECTED)) for one in (result, failed)
    )
    is_other = result.judgement.code != failed.judgement.code
    is_later = result.outcome.last_tick > failed.outcome.last_tick and given_up <= others
    return achieved > before or (achieved == before and is_other and is_later) or _gained(result, failed) > 0.0


def is_worse(result: MissionResult, failed: MissionResult) -> bool:
    """Whether a mission violates the property that the failed one did by more than that did."""
    return _gained(result, failed) < 0.0


def _gained(result: MissionResult, failed: MissionResult) -> float:
    """By how much less a mission violates the property that the failed one did; 0 where no number tells."""
    broken = failed.judgement.broken
    if broken is None or result.outcome is None:
        return 0.0
    margin = next((one.margin for one in result.outcome.properties if one.name == broken.name), math.nan)
    gained = margin - broken.margin
    return gained if math.isfinite(gained) else 0.0


def strayed_of(result: MissionResult, failed: MissionResult) -> float:
    """What a mission that passes no longer does of what the failed one did before it failed."""
    if result.outcome is None or failed.outcome is None:
        return 0.0
    return min(_STRAYED * left_out(failed.outcome.behaviour, result.outcome.behaviour), _MOST_STRAYED)


def collapsed_of(result: MissionResult, failed: MissionResult) -> float:
    """What a mission that passes does in a moment, and the failed one did not: any limit is kept so."""
    before, after = _longest(failed), _longest(result)
    return _COLLAPSED * min(sum(ticks <= 1 and before.get(name, 0) >= _LONG for name, ticks in after.items()), 2)


def is_cut_short(result: MissionResult, failed: MissionResult, own: str) -> bool:
    """Whether tokens of a predicate last a tick at most, and did not in the failed mission; `own` need not be there."""
    before = {own: _LONG, **_longest(failed)}
    return any(ticks <= 1 < before.get(name, 0) for name, ticks in _longest(result).items())


def _longest(result: MissionResult) -> dict[str, int]:
    """How long each predicate held at most, by its name."""
    if result.outcome is None:
        return {}
    found: dict[str, int] = {}
    begun: dict[str, tuple[str, int]] = {}
    for _, tick, timeline, predicate in heads_of(result.outcome.events):
        known = begun.get(timeline)
        begun[timeline] = (predicate, tick)
        if known is not None:
            found[known[0]] = max(found.get(known[0], 0), tick - known[1])
    for predicate, tick in begun.values():
        found[predicate] = max(found.get(predicate, 0), result.outcome.last_tick - tick)
    return found


def course_of(result: MissionResult) -> tuple[object, ...]:
    """What happened in a mission, without when it was planned and why."""
    events = single_events(result.outcome.events) if result.outcome is not None else ()
    return tuple((one.tick, one.kind, one.reactor, one.timeline, one.predicate, one.arguments) for one in events)
