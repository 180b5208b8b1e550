"""Missions of one fault and missions that passed in; those out on which a change is tried."""

from collections.abc import Sequence

from checker.batch.result import MissionResult
from checker.counterfactual.missions import Missions
from checker.coverage import is_event, is_trouble
from checker.oracle import Verdict

_MOST_FAILED = 3
_MOST_PASSED = 2


def examples_of(failed: Sequence[MissionResult], passed: Sequence[MissionResult]) -> Missions:
    """The first failed mission, and of the others those whose draws are farthest from it, and from each other.

    A change that only suits the draws of a failed mission shows where draws are opposite.
    """
    own = _drawn(failed[0])
    spread = {
        name: max(values) - min(values)
        for name, value in own.items()
        if (values := [value, *(drawn[name] for one in (*failed, *passed) if name in (drawn := _drawn(one)))])
    }

    def distance(result: MissionResult, other: MissionResult) -> float:
        drawn, theirs = _drawn(result), _drawn(other)
        names = [name for name in spread if name in drawn and name in theirs and spread[name] > 0.0]
        return sum(abs(drawn[name] - theirs[name]) / spread[name] for name in names)

    chosen = sorted(passed, key=lambda one: (-distance(one, failed[0]), one.number))[:_MOST_PASSED]
    kept, left = [failed[0]], list(failed[1:])
    while left and len(kept) < _MOST_FAILED:
        far = max(left, key=lambda one: (min(distance(one, other) for other in kept), -one.number))
        kept.append(far)
        left.remove(far)
    share = len(passed) / (len(passed) + len(failed))
    return Missions(kept, chosen, _only_exercised_by(failed, passed), _usual(passed), share)


def violated_by_all(results: Sequence[MissionResult]) -> frozenset[str]:
    """The properties that every mission violated which got to its end; none where some passed."""
    found: list[frozenset[str]] = []
    for one in results:
        if one.verdict is Verdict.PASS:
            return frozenset()
        outcome = one.outcome
        if outcome is not None and outcome.abort is None and not outcome.ended_early and one.verdict is Verdict.FAIL:
            found.append(frozenset(each.name for each in outcome.properties if not each.is_kept))
    return frozenset.intersection(*found) if found else frozenset()


def _only_exercised_by(failed: Sequence[MissionResult], passed: Sequence[MissionResult]) -> frozenset[int]:
    """What all failed missions exercised and no other; nothing where no other is known."""
    others = _behaviours(passed)
    return frozenset.intersection(*_behaviours(failed)).difference(*others) if others else frozenset()


def _usual(passed: Sequence[MissionResult]) -> frozenset[int]:
    """The kinds of events of all missions that passed, but for troubles: a mission does well without."""
    behaviours = _behaviours(passed)
    common = frozenset.intersection(*behaviours) if behaviours else frozenset()
    return frozenset(one for one in common if is_event(one) and not is_trouble(one))


def _behaviours(results: Sequence[MissionResult]) -> list[frozenset[int]]:
    """What each mission exercised."""
    return [frozenset(one.outcome.behaviour) for one in results if one.outcome is not None]


def _drawn(result: MissionResult) -> dict[str, float]:
    """The value of each parameter when the mission ended."""
    return {draw.parameter: draw.value for draw in result.outcome.draws} if result.outcome is not None else {}
