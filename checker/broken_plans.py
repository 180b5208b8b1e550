"""Repairs of a mission in, the one in which a plan broke out: what is told of missions that fail after repairs.

A repair sets aside what broke, so that what ends the mission later may only follow from it.
"""

from collections import Counter
from collections.abc import Container, Sequence

from checker.batch.result import MissionResult
from checker.causes import Failed, decided_at, failed_by
from checker.culprit import culprit_of
from checker.limits import Limit
from checker.oracle import Verdict, given_up
from runtime.executive.events import numbered
from runtime.executive.outcome import Event, EventKind, RepairStage, SourcePlace

Breaking = tuple[str, SourcePlace | None]  # a reactor, and the line at which its plan broke


def usual_breaking(results: Sequence[MissionResult]) -> frozenset[Breaking]:
    """Where plans break in missions that pass all the same."""
    passed = [one for one in results if one.verdict is Verdict.PASS]
    return frozenset((each.reactor, each.place) for one in passed for each in one.losses.repairs)


def broken_plan(result: MissionResult, usual: Container[Breaking] = frozenset()) -> Event | None:
    """The repair of a plan that broke before the mission ended, of those with a conflict and not `usual`, the first.

    At the tick of the end a plan of who gave up broke by that; another one's broke before. What broke after a goal was
    given up for good, or a property violated, has no part in that.
    Of a mission that fails as there were too many repairs, the first at the line where plans broke most often.
    """
    outcome = result.outcome
    if outcome is None:
        return None
    abort, decided = given_up(outcome), decided_at(outcome)
    violated = result.judgement.broken.tick if result.judgement.broken is not None else None
    last = outcome.last_tick if violated is None else violated
    repairs = [
        (at, event, (event.reactor, culprit_of(event.conflict).place))
        for at, event in numbered(outcome.events)
        if event.kind is EventKind.RELAX
        and event.stage is RepairStage.KEEP_PAST
        and event.conflict is not None
        and (abort is None or (at < abort.event and (event.tick, event.reactor) != (abort.tick, abort.reactor)))
    ]
    if fails_by_repairs(result):
        counts = Counter(at for *_, at in repairs)
        most = max(counts.values(), default=0)
        return next((event for _, event, at in repairs if counts[at] == most), None)
    before = [(event, at) for number, event, at in repairs if event.tick <= last and (decided < 0 or number < decided)]
    return next((event for event, at in before if at not in usual), None)


def blamed(result: MissionResult) -> Failed:
    """What is known of why a mission failed; of one with too many repairs, what broke its plan."""
    if fails_by_repairs(result) and (repair := broken_plan(result)) is not None:
        return Failed(repair.conflict, repair.deadlock)
    return failed_by(result.outcome)


def fails_by_repairs(result: MissionResult) -> bool:
    """Whether all that is wrong with a mission is that its plans were repaired too often."""
    exceeded = result.judgement.exceeded
    is_over = result.outcome is not None and result.outcome.abort is None
    return is_over and exceeded is not None and exceeded.limit is Limit.REPAIRS
