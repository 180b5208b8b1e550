"""One mission, one outcome: again, in another process, in the other form of the engine, or with every tick visited."""

import os
import subprocess
import sys
from dataclasses import replace
from functools import lru_cache
from hashlib import sha256
from pathlib import Path

import pytest

from checker.mission import read_mission
from checker.models import load_models
from checker.proofs.conflict import Finding, confirm
from checker.sampling.seeds import mission_seed
from runtime.executive.configuration import AgentConfiguration, GoalConfiguration, ParameterConfiguration
from runtime.executive.mission import MissionPrograms, run_mission
from runtime.executive.outcome import Outcome
from runtime.executive.rendering import trace_json
from tests.executive.flying import fly, lines, planner, simulator
from tests.programs import programs_of

FOLDER = Path(__file__).resolve().parents[2]
LAMP = """
class Lamp extends AgentTimeline { predicate Off { } predicate On { int n; } Lamp(Mode m) { super(m, "Off"); } }
"""
OWNER = f"""{LAMP}
int GLOW = [2 9];
Lamp::On {{ int glow; glow == sampledParameter(GLOW); duration == glow; }}
Lamp lamp = new Lamp(Internal); close();
"""
USER = f"""{LAMP}
class User extends AgentTimeline {{
  predicate Idle {{ }} predicate Busy {{ int k; }} User(Mode m) {{ super(m, "Idle"); }}
}}
User::Busy {{ contains(Lamp.On on); on.n == k; meets(Idle rest); on.end == end; on.duration <= 6; }}
User user = new User(Internal); Lamp lamp = new Lamp(External); close();
"""
GOALS = tuple(
    GoalConfiguration("user", "Busy", mandatory=True, start=(1, 90), parameters=(("k", k),)) for k in range(5)
)


def toy(seed: int) -> Outcome:
    """Five goals, some of which are repaired away when the lamp glows too long."""
    glow = ParameterConfiguration("GLOW", 2.0, 9.0, mode="intra", update=5, is_whole=True)
    return fly(
        planner("user", USER, "user", "lamp"),
        simulator("sim", OWNER, "lamp"),
        until=80,
        goals=GOALS,
        parameters=(glow,),
        seed=seed,
    )


def told(hash_seed: str, interpreted: str) -> str:
    """The trace of one toy mission, flown by another process."""
    code = "from tests.executive.test_equal_runs import lines, toy; print(*lines(toy(3)), sep='\\n')"
    environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "NDDLC_INTERPRETED": interpreted}
    done = subprocess.run(
        [sys.executable, "-c", f"import runtime.build_form; {code}"],
        env=environment,
        cwd=FOLDER,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def test_the_same_seed_flies_the_same_mission_twenty_times() -> None:
    first = toy(3)
    assert any(event.kind == "relax" for event in first.events)
    assert all(toy(3) == first for _ in range(19))
    assert toy(4) != first


def test_neither_hash_seed_nor_form_of_the_engine_matters() -> None:
    here = "\n".join(lines(toy(3))) + "\n"
    assert told("1", "0") == here
    assert told("2", "1") == here


def test_visiting_every_tick_changes_nothing() -> None:
    glow = ParameterConfiguration("GLOW", 2.0, 9.0, mode="intra", update=5, is_whole=True)
    flyers = (planner("user", USER, "user", "lamp"), simulator("sim", OWNER, "lamp"))
    for seed in range(6):
        visited = fly(*flyers, until=80, goals=GOALS, parameters=(glow,), seed=seed, every_tick=True)
        assert visited == toy(seed)


SHIPPED = ("gps", "auv/inl", "auv/front")
RUNS = 10  # in each of two processes
UNTIL = 900  # of other flights
LAST = None if "NDDLC_PROOFS" in os.environ else UNTIL  # the traces of whole missions take a minute and more


@lru_cache(maxsize=1)
def shipped(folder: str) -> tuple[AgentConfiguration, MissionPrograms]:
    """A mission of models/."""
    mission, _ = read_mission(FOLDER / "models" / folder / "mission.toml")
    assert mission is not None
    agent = load_models(mission).agent
    return agent, programs_of(agent)


def digests(folder: str, runs: int) -> list[str]:
    """Of the traces of one mission, flown again and again with a part of another one in between."""
    found = []
    agent, programs = shipped(folder)
    first = digest = ""
    for number in range(runs):
        trace = run_mission(agent, programs, mission_seed(7234, 1), until=LAST).events
        if (told := repr(trace)) != first:  # writing a trace takes four times as long as the flight
            first = told
            digest = sha256("\n".join(map(trace_json, trace)).encode()).hexdigest()
        found.append(digest)
        run_mission(agent, programs, number, until=UNTIL // 4)
    return found


@pytest.mark.slow
@pytest.mark.once
@pytest.mark.parametrize("folder", SHIPPED)
def test_twenty_runs_of_a_shipped_mission_have_one_trace_in_any_process_and_folder(folder: str, tmp_path: Path) -> None:
    code = f"from tests.executive.test_equal_runs import digests; print(*digests({folder!r}, {RUNS}))"
    told: list[str] = []
    for hash_seed, place in (("1", tmp_path), ("2", FOLDER)):
        environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": str(FOLDER)}
        command = [sys.executable, "-c", f"import runtime.build_form; {code}"]
        done = subprocess.run(command, env=environment, cwd=place, capture_output=True, text=True, check=True)
        told += done.stdout.split()
    assert len(told) == 2 * RUNS
    assert set(told) == set(digests(folder, 1))


@pytest.mark.slow
@pytest.mark.parametrize("folder", SHIPPED)
def test_visiting_every_tick_of_a_shipped_mission_changes_nothing(folder: str) -> None:
    agent, programs = shipped(folder)
    seed = mission_seed(7234, 3)
    visited = run_mission(agent, programs, seed, every_tick=True, until=UNTIL // 3)
    assert visited == run_mission(agent, programs, seed, until=UNTIL // 3)
    assert len(visited.events) > 20


@pytest.mark.slow
@pytest.mark.parametrize("number", [0, 16])
def test_visiting_every_tick_of_a_real_mission_changes_nothing(number: int) -> None:
    agent, programs = shipped("gps")
    seed = mission_seed(7234, number)
    assert run_mission(agent, programs, seed, every_tick=True) == run_mission(agent, programs, seed)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(3))
def test_z3_agrees_that_a_failing_mission_cannot_go_on(number: int) -> None:
    agent, programs = shipped("gps")
    seed = mission_seed(7234, number)
    outcome = run_mission(replace(agent, final_tick=420), programs, seed, {"GPS_HIT_RATE": 3.9 + number / 30})
    assert outcome.abort is not None and outcome.abort.conflict is not None
    for conflict in (outcome.abort.conflict, *outcome.abort.repairs):
        found = confirm(conflict)
        assert found.finding is Finding.CONFIRMED and found.untranslated == ()
