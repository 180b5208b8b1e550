"""The judge notices engines and executives that are broken on purpose, wherever their missions break the model."""

from collections import Counter
from random import Random

import pytest

from runtime.build_form import build_form
from checker.judge.values import may_be_equal
from runtime.executive.outcome import EventKind
from tests.checker.judge.faults import broken, faults
from tests.checker.judge.missions import walking
from tests.executive.flying import Flown

SPANS = 48  # as many pieces of text as the model has, and some of the library


def history(mission: Flown) -> list[tuple[object, ...]]:
    """What was executed on each timeline, whatever number a token has."""
    return [
        (record.reactor, one.object, one.start, one.end, one.predicate, *one.arguments)
        for record in mission.record.reactors
        for one in sorted(record.tokens, key=lambda one: (str(one.object), str(one.start), one.key))
        if one.state == "active" and isinstance(one.end, int) and one.end <= record.last_tick
    ]


def is_alike(mission: Flown, right: Flown) -> bool:
    """Whether two missions executed the same, reals within the tolerance."""
    ours, theirs = history(mission), history(right)
    return len(ours) == len(theirs) and all(
        len(one) == len(other) and all(may_be_equal(a, b) for a, b in zip(one, other, strict=True))  # type: ignore[arg-type]
        for one, other in zip(ours, theirs, strict=True)
    )


@pytest.mark.slow
@pytest.mark.skipif(build_form() == "compiled", reason="functions of the compiled engine cannot be replaced")
def test_broken_engines_are_noticed() -> None:
    right = walking(1, until=24, compiles=False)
    seen: Counter[str] = Counter()
    silent = []
    for number in range(2):
        for fault in faults(Random(f"walking {number}"), SPANS):
            try:
                with broken(fault):
                    mission = walking(1, until=24, compiles=False)
            except Exception:
                seen["raised"] += 1
                continue
            is_repaired = any(event.kind is EventKind.RELAX for event in mission.outcome.events)
            if not mission.report.holds:
                seen["noticed"] += 1
            elif mission.outcome.abort is not None or is_repaired or is_alike(mission, right):
                seen["harmless"] += 1  # it failed, it was repaired as it should be, or it changed nothing
            else:
                silent.append((fault.kind, fault.name))
    assert seen["noticed"] >= 5, seen
    # Where the model leaves a choice, a fault may lead to another mission that is right.
    assert len(silent) <= 1 + seen["noticed"] / 20, silent
