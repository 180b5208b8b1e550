"""Reactors are loaded once per process: what a mission leaves behind must not reach the next one.

Each mission of test_cases is flown again for it as well.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import runtime.build_form
from runtime.build_form import build_form
from checker.mission import read_mission
from checker.models import load_models
from runtime.constraints.domains.arrays import Growth, note_growth
from runtime.executive.agent import Agent
from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.loaded_state import LoadedState
from runtime.executive.mission import MissionPrograms, record_mission, run_mission
from runtime.executive.outcome import Outcome
from runtime.executive.timelines import TimelineState
from runtime.plan.store.rows import Rows
from runtime.solver.configuration.configuration import default_configuration
from tests.checker.judge.missions import GPS
from tests.executive.flying import flown, planner, simulator
from tests.executive.test_cases import CASES, loaded
from tests.executive.test_equal_runs import GOALS, OWNER, USER, toy
from tests.programs import programs_of


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


def test_a_mission_has_the_room_that_earlier_ones_needed() -> None:
    mission, _ = read_mission(GPS)
    assert mission is not None
    agent = load_models(mission).agent
    programs = programs_of(agent)
    first = [record_mission(agent, programs, seed) for seed in (1, 2)]
    growth: list[Growth] = []
    before = note_growth(growth)
    again = [record_mission(agent, programs, seed) for seed in (1, 2, 1, 2)]
    note_growth(before)
    assert again == first + first
    rows = [one for one in growth if isinstance(one[0], Rows)]
    assert len(rows) == 0 or build_form() != "compiled"


def test_restoring_twice_gives_the_same_and_keeps_what_grew() -> None:
    rows = Rows()
    snapshot = LoadedState((rows,))
    before = bytes(memoryview(rows.key))
    for count in (200, 100, 2000, 0, 100):
        growth: list[Growth] = []
        outer = note_growth(growth)
        for _ in range(count):
            rows.new_token(0, 0, -1, -1, -1)
        note_growth(outer)
        snapshot.restore(growth)
        found = bytes(memoryview(rows.key))
        assert found[: len(before)] == before and not any(found[len(before) :])
        assert rows.token_count == 0


def test_arrays_of_made_objects_grow_where_it_is_noted() -> None:
    """What is restored in place after a mission has no other arrays than those that were noted."""
    home = Path(runtime.build_form.__file__).parent
    for room in ("constraints", "plan", "solver", "executive", "user"):
        for path in sorted((home / room).rglob("*.py")):
            # A table that all missions share, and a plan that is loaded before it is kept.
            if path.name in ("handler_table.py", "loading.py", "arrays.py"):
                continue
            for function in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(function, ast.FunctionDef) and function.name != "__init__":
                    assert not list(_arrays_given(function)), path


def _arrays_given(function: ast.FunctionDef) -> Iterator[str]:
    """The attributes that get an array in a function."""
    for node in ast.walk(function):
        if isinstance(node, ast.Assign) and any(isinstance(each, ast.Attribute) for each in node.targets):
            for call in ast.walk(node.value):
                if isinstance(call, ast.Call) and ast.unparse(call.func) in ("array", "blank", "grown"):
                    yield ast.unparse(node)


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
