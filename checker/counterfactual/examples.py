"""Missions of one fault and missions that passed in; those out on which a change is tried."""

from collections.abc import Sequence

from checker.batch.result import MissionResult
from checker.counterfactual.trials import Missions
from checker.coverage import is_event, is_trouble

_MOST_FAILED = 3
_MOST_PASSED = 2


def examples_of(failed: Sequence[MissionResult], passed: Sequence[MissionResult]) -> Missions:
    """The first failed missions, and of those that passed the ones whose draws are farthest from the first of them.

    A change that only suits the draws of the failed missions shows where draws are opposite.
    """
    own = _drawn(failed[0])
    spread = {
        name: max(values) - min(values)
        for name, value in own.items()
        if (values := [value, *(drawn[name] for one in passed if name in (drawn := _drawn(one)))])
    }

    def nearness(result: MissionResult) -> float:
        drawn = _drawn(result)
        shares = (abs(drawn[name] - own[name]) / spread[name] for name in own if name in drawn and spread[name] > 0.0)
        return -sum(shares)

    chosen = sorted(passed, key=lambda one: (nearness(one), one.number))[:_MOST_PASSED]
    share = len(passed) / (len(passed) + len(failed))
    return Missions(failed[:_MOST_FAILED], chosen, _only_exercised_by(failed, passed), _usual(passed), share)


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
