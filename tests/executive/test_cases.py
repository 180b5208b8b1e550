"""Small missions without chance, each with what must come out of it: `cases/` holds one rule per folder.

Each is read once, and flown in every way that must not matter.
"""

import json
import math
import os
from pathlib import Path
from typing import Any

import pytest

from checker.flight import fly_programs
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import judge
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, record_mission, run_mission
from runtime.executive.outcome import Outcome
from runtime.executive.rendering import event_data
from tests.executive.determined_models import told as told_by_both
from tests.programs import programs_of

HERE = Path(__file__).parent
CASES = sorted(path.parent for path in HERE.glob("cases/*/expected.json"))
FEWER = 1 if os.environ.get("NDDLC_CASES") == "all" else 4  # `make cases` has all flown again
Data = dict[str, Any]
Loaded = tuple[AgentConfiguration, MissionPrograms]


def loaded(folder: Path) -> Loaded:
    """A mission file, or an agent file of T-REX, its models and its code."""
    (file,) = [*folder.glob("mission.toml"), *folder.glob("agent.xml")]
    mission, found = read_mission(file)
    assert mission is not None, found
    models = load_models(mission)
    return models.agent, programs_of(models.agent, models.programs)


@pytest.fixture(scope="module", params=CASES, ids=lambda folder: folder.name)
def case(request: pytest.FixtureRequest) -> tuple[Path, Loaded]:
    """A folder and what it holds: the scope has all tests of a case run one after another."""
    return request.param, loaded(request.param)


def told(outcome: Outcome) -> list[Data]:
    """The events as the trace has them."""
    found: list[Data] = json.loads(json.dumps([event_data(event) for event in outcome.events]))
    return found


def test_what_must_come_out_does(case: tuple[Path, Loaded]) -> None:
    folder, (agent, programs) = case
    expected = json.loads((folder / "expected.json").read_text())
    outcome = fly_programs(agent, programs, 1)  # the judge has to agree
    judgement = judge(outcome)
    codes = expected["code"] if isinstance(expected["code"], list) else [expected["code"]]
    assert judgement.verdict.value == expected["verdict"]
    assert (judgement.code or None) in codes
    assert at(expected["last_tick"], outcome.last_tick)
    events = told(outcome)
    for timeline, wanted in expected["observations"].items():
        got = [event for event in events if event["kind"] == "observation" and event["timeline"] == timeline]
        if isinstance(wanted, dict):
            got = [event for event in got if wanted["from"] <= event["tick"] <= wanted["to"]]
            wanted = wanted["list"]
        shown = [(event["tick"], event["predicate"], event["arguments"]) for event in got]
        assert is_sequence(wanted, got), f"{timeline}: {shown}"
    position = 0
    for pattern in expected.get("events", ()):
        found = [index for index in range(position, len(events)) if fits(pattern, events[index])]
        assert found, pattern
        position = found[0] + 1
    for pattern in expected.get("unordered", ()):
        assert any(fits(pattern, event) for event in events), pattern
    for pattern in expected.get("counts", ()):
        assert sum(fits(pattern, event) for event in events) == pattern["n"], pattern
    for draw in expected.get("draws", ()):
        check_draws(draw, events)


@pytest.mark.once
def test_no_way_of_flying_changes_anything(case: tuple[Path, Loaded]) -> None:
    """Register code or the general engine, each tick visited or not, another seed, reactors in stock."""
    folder, (agent, programs) = case
    one, other = (run_mission(agent, programs, 1, every_tick=every) for every in (False, True))
    assert [brief(event) for event in told(one)] == [brief(event) for event in told(other)]
    for seed in (1, 2) if agent.parameters else (1,):
        general, compiled = (run_mission(agent, programs, seed, compiles=way) for way in (False, True))
        assert told_by_both(compiled) == told_by_both(general)
    for compiles in (True, False) if folder in CASES[::FEWER] else ():
        # The next mission finds its reactors as they were loaded: one takes a snapshot, one starts from it.
        first, *later = (record_mission(agent, programs, 1, compiles=compiles) for _ in range(3))
        assert all(each == first for each in later)


def brief(event: Data) -> tuple[Any, ...]:
    """An event without its reasons: a limit that is reached may be told in two ways."""
    return tuple(event[key] for key in ("tick", "kind", "reactor", "timeline", "predicate", "arguments"))


def at(wanted: Any, tick: int) -> bool:
    """Whether a tick is the one wanted, or within bounds."""
    return bool(wanted[0] <= tick <= wanted[1] if isinstance(wanted, list) else wanted == tick)


def same(wanted: Any, got: Any) -> bool:
    """Whether two values are equal, but for the rounding of numbers."""
    if isinstance(wanted, bool) or isinstance(got, bool):
        return wanted is got
    if isinstance(wanted, int | float) and isinstance(got, int | float):
        return math.isclose(wanted, got, rel_tol=1e-9, abs_tol=1e-9)
    if isinstance(wanted, dict) and isinstance(got, dict):
        return wanted.keys() == got.keys() and all(same(wanted[key], got[key]) for key in wanted)
    if isinstance(wanted, list) and isinstance(got, list):
        return len(wanted) == len(got) and all(map(same, wanted, got))
    return bool(wanted == got)


def fits(pattern: Data, event: Data) -> bool:
    """Whether an event is as a pattern has it."""
    for key, wanted in pattern.items():
        if key == "tick" and not at(wanted, event["tick"]):
            return False
        if key == "arguments":
            got = event["arguments"]
            if not all(name in got and same(value, got[name]) for name, value in wanted.items()):
                return False
        elif key not in ("n", "tick") and event.get(key) != wanted:
            return False
    return True


def is_sequence(wanted: list[Any], got: list[Data]) -> bool:
    """Whether observations are those wanted, in order; those marked optional may be missing."""
    if not wanted:
        return not got
    tick, predicate, arguments = wanted[0][:3]
    if got and at(tick, got[0]["tick"]) and got[0]["predicate"] == predicate and same(arguments, got[0]["arguments"]):
        return is_sequence(wanted[1:], got[1:])
    return len(wanted[0]) > 3 and is_sequence(wanted[1:], got)


def check_draws(draw: Data, events: list[Data]) -> None:
    """One value for each period of `update` ticks, whoever shows it."""
    values: dict[int, float] = {}
    for event in events:
        for timeline, name in draw["of"]:
            if event["kind"] == "observation" and event["timeline"] == timeline and name in event["arguments"]:
                value = event["arguments"][name]
                assert any(same(one, value) for one in draw["values"])
                assert same(values.setdefault(event["tick"] // draw["update"], value), value), event
    assert values and (not draw.get("changes") or len(set(values.values())) > 1)
