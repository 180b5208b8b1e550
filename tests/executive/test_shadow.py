"""The general reactor that is asked for causes of what a determined one did: it goes on from where it stands."""

from pathlib import Path

import pytest

from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.variant import load_over
from nddl_lang.text.read import real_path
from runtime.determined.publish import row_key
from runtime.determined.reactor import DeterminedReactor
from runtime.executive import mission
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.rendering import trace_line
from tests.programs import programs_of

MODELS = Path(__file__).parents[2] / "models"
GPS = MODELS / "gps" / "mission.toml"
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


def test_what_it_never_published_has_no_causes(flown: DeterminedReactor) -> None:
    for general in (None, flown._new_shadow().reactor):
        flown.general = general
        for token, key in ((10**6, row_key(3)), (10**6, 3), (-1, 3), (-1, row_key(0)), (-1, -1)):
            assert flown.why_it_lasts(token, key, -1) is None


def test_its_own_tokens_are_not_those_of_the_general_reactor(flown: DeterminedReactor) -> None:
    flown.general = general = flown._asked()
    bench = general.bench
    current = [line.current for line in general.by_name.values() if line.is_internal and line.current >= 0]
    lasting = [t for t in current if flown.why_it_lasts(t, bench.key(t), -1) is not None]
    assert lasting
    assert all(flown.why_it_lasts(t, row_key(bench.key(t) + 10**6), -1) is None for t in lasting)


@pytest.mark.once
def test_an_abort_that_hangs_on_what_was_published_before_the_general_reactor_took_over_is_told() -> None:
    mission_file, _ = read_mission(MODELS / "auv/inl/mission.toml")
    assert mission_file is not None
    file = real_path(MODELS / "auv/common/navigator.nddl")
    text = file.read_text()
    right = "Gps::Fix {\n    duration == 1;"
    assert right in text
    fly = load_over(((str(file), text.replace(right, right.replace("1", "2"))),), load_models(mission_file).agent)
    outcome = fly(1)
    assert outcome.abort is not None and outcome.abort.code == "F2"
    assert outcome.abort.conflict is not None
    assert any("duration == 2" in one.place.text for one in outcome.abort.conflict.elements if one.place)
