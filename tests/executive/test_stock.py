"""Reactors are loaded once per process: what a mission leaves behind must not reach the next one.

Each mission of test_cases is flown again for it as well.
"""

import pytest

from runtime.executive.agent import Agent
from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.loaded_state import LoadedState
from runtime.executive.mission import MissionPrograms, record_mission, run_mission
from runtime.executive.outcome import Outcome
from runtime.executive.timelines import TimelineState
from runtime.plan.store.rows import Rows
from runtime.solver.configuration.configuration import default_configuration
from tests.executive.flying import flown, planner, simulator
from tests.executive.test_cases import CASES, loaded
from tests.executive.test_equal_runs import GOALS, OWNER, USER, toy


def test_repairs_of_another_mission_leave_no_trace() -> None:
    fresh = [toy(seed) for seed in range(8)]  # each with a solver of its own: nothing is in stock
    glow = ParameterConfiguration("GLOW", 2.0, 9.0, mode="intra", update=5, is_whole=True)
    flyers = (planner("user", USER, "user", "lamp"), simulator("sim", OWNER, "lamp"))
    first = flown(*flyers, until=80, goals=GOALS, parameters=(glow,))
    programs = MissionPrograms(first.programs, tuple(default_configuration() for _ in flyers))
    again = [run_mission(first.agent, programs, seed) for seed in (*range(8), *range(8))]
    assert any(event.kind == "relax" for outcome in fresh for event in outcome.events)
    assert again == fresh + fresh


def test_a_mission_that_was_broken_off_gives_nothing_back(monkeypatch: pytest.MonkeyPatch) -> None:
    agent, programs = loaded(CASES[0])
    expected = record_mission(agent, programs, 1, compiles=False)
    record_mission(agent, programs, 1, compiles=False)
    with monkeypatch.context() as patch:
        patch.setattr("runtime.executive.mission.Agent", Stopping)
        with pytest.raises(RuntimeError):
            record_mission(agent, programs, 1, compiles=False)
    assert record_mission(agent, programs, 1, compiles=False) == expected


class Stopping(Agent):
    """Breaks a mission off."""

    def run(self, until: int | None = None) -> Outcome:
        """Fail."""
        raise RuntimeError


def test_a_script_that_draws_is_run_in_each_mission() -> None:
    text = """
int GLOW = [2 9];
int glow = [2 9];
class Lamp extends AgentTimeline { predicate Off { int n; } Lamp(Mode m) { super(m, "Off"); } }
Lamp::Off { n == glow; }
Lamp lamp = new Lamp(Internal);
glow == sampledParameter(GLOW);
close();
"""
    first = flown(simulator("sim", text, "lamp"))
    programs = MissionPrograms(first.programs, (default_configuration(),))
    seen = [run_mission(first.agent, programs, seed, compiles=False) for seed in range(6)]
    assert len({outcome.draws for outcome in seen}) > 1
    assert all(len(outcome.draws) == 1 for outcome in seen)
    assert len({event.arguments for outcome in seen for event in outcome.events if event.kind == "observation"}) > 1


def test_what_grew_or_changed_is_restored() -> None:
    rows = Rows()
    table: dict[str, list[int]] = {"a": [1]}
    line = TimelineState("lamp", 3, True, 0, {"Off": 0})
    snapshot = LoadedState((rows, table, line))
    before, key = bytes(memoryview(rows.cells)), bytes(memoryview(rows.key))
    rows.cells[5] = 7
    for _ in range(200):
        rows.new_token(0, 0, -1, -1, -1)
    table["a"].append(2)
    table["b"] = []
    line.current, line.event = 5, 6
    snapshot.restore()
    assert (bytes(memoryview(rows.cells)), bytes(memoryview(rows.key))) == (before, key)
    assert rows.token_count == 0
    assert table == {"a": [1]}
    assert (line.current, line.event) == (-1, -1)


def test_what_is_to_be_kept_is_not_restored() -> None:
    inner: list[int] = []
    table: dict[str, list[int]] = {"a": inner}
    line = TimelineState("lamp", 3, True, 0, {"Off": 0})
    snapshot = LoadedState((table, line), kept=(inner,))
    inner.append(1)
    table["b"] = []
    line.current = 5
    snapshot.restore()
    assert table == {"a": [1]}
    assert line.current == -1
