"""Missions that once went wrong, each by a fault of the executive: `missions/` holds them."""

from dataclasses import replace
from pathlib import Path
from time import process_time

import pytest

from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Verdict, judge
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_file
from runtime.executive.mission import MissionPrograms, run_mission
from runtime.executive.outcome import EventKind, Outcome
from runtime.solver.configuration.configuration import default_configuration

HERE = Path(__file__).parent / "missions"


def flown(name: str, seed: int = 1, until: int | None = None) -> Outcome:
    """One of the missions, to its end or to a tick."""
    mission, found = read_mission(HERE / name / "mission.toml")
    assert mission is not None, found
    agent = load_models(mission).agent
    programs = tuple(compile_model(analyse_file(HERE / name / reactor.model)) for reactor in agent.reactors)
    last = agent.final_tick if until is None else until
    solvers = tuple(default_configuration() for _ in programs)
    return run_mission(replace(agent, final_tick=last), MissionPrograms(programs, solvers), seed)


@pytest.mark.parametrize("seed", range(12))
def test_a_repair_takes_back_no_more_than_what_has_lost_its_place(seed: int) -> None:
    outcome = flown("repair", seed)
    (drawn,) = {draw.value for draw in outcome.draws}
    assert judge(outcome).code == ("F1" if drawn > 10 else "")


def test_a_running_mean_is_carried_on_for_ever() -> None:
    assert judge(flown("running_mean", until=2_000)).verdict is Verdict.PASS


def test_children_of_a_token_that_lasts_are_archived() -> None:
    def cost(until: int) -> float:
        return min(seconds(until) for _ in range(3))

    def seconds(until: int) -> float:
        began = process_time()
        assert judge(flown("merged_children", until=until)).verdict is Verdict.PASS
        return process_time() - began

    assert cost(1_600) < 12 * cost(200)


def test_a_command_begins_when_it_may_though_the_vehicle_never_rests() -> None:
    began = [e.tick for e in flown("command_while_busy").events if e.predicate == "Run" and e.timeline == "helm"]
    assert began[1] <= 7


def test_requests_are_executed_in_the_order_of_the_plan() -> None:
    outcome = flown("order_of_requests")
    seen = [e for e in outcome.events if e.kind is EventKind.OBSERVATION and e.predicate == "Go"]
    numbers = [dict(e.arguments)["k"].interval for e in seen]
    assert numbers == [(1, 1), (2, 2), (3, 3), (4, 4)]


def test_what_follows_a_value_that_came_by_itself_is_asked_for() -> None:
    outcome = flown("request_lost")
    assert judge(outcome).verdict is Verdict.PASS
    asked = [e for e in outcome.events if e.kind is EventKind.REQUEST and e.predicate == "Run"]
    assert len(asked) == 2
