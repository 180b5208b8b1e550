"""The general reactor that is asked for causes of what a determined one did: it goes on from where it stands."""

from pathlib import Path

import pytest

from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import programs_of
from runtime.determined.reactor import DeterminedReactor
from runtime.executive import mission
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.rendering import trace_line

GPS = Path(__file__).parents[2] / "models" / "gps" / "mission.toml"
MADE: list[DeterminedReactor] = []
VISITS: list[int] = []


class Kept(DeterminedReactor):
    """A reactor that outlives its mission."""

    def __init__(self, *given: object) -> None:
        super().__init__(*given)  # type: ignore[arg-type]
        MADE.append(self)


class Counted(PlanReactor):
    """A reactor whose visits are counted."""

    def start_tick(self, tick: int) -> None:
        VISITS.append(tick)
        super().start_tick(tick)


@pytest.fixture
def flown(monkeypatch: pytest.MonkeyPatch) -> DeterminedReactor:
    """The simulated vehicle of a mission, after its end."""
    MADE.clear()
    read, _ = read_mission(GPS)
    assert read is not None
    agent = load_models(read).agent
    monkeypatch.setattr(mission, "DeterminedReactor", Kept)
    monkeypatch.setattr(mission, "PlanReactor", Counted)
    mission.record_mission(agent, programs_of(agent), 1)
    VISITS.clear()
    return MADE[0]


def told(flown: DeterminedReactor, ticks: list[int]) -> list[str]:
    """What a general reactor published that was brought up to one tick after the other."""
    shadow = flown._new_shadow()
    for tick in ticks:
        shadow.catch_up(tick, True)
    return [trace_line(event) for event in shadow.shadow.events if event.tick <= ticks[-1]]


def test_it_tells_the_same_whether_it_comes_at_once_or_step_by_step(flown: DeterminedReactor) -> None:
    assert len(flown.inputs.received) > 2
    last = flown.inputs.received[-1].tick + 5
    first = flown.inputs.received[0].tick
    assert told(flown, [0, first, first + 1, last // 2, last - 5, last]) == told(flown, [last])


def test_it_lives_through_each_tick_once(flown: DeterminedReactor) -> None:
    last = flown.inputs.received[-1].tick + 5
    told(flown, list(range(0, last, 7)))
    assert len(VISITS) > 3
    assert sorted(set(VISITS)) == VISITS
