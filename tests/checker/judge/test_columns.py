"""Judging columns: the judge says the same of a simulator's columns as of the tokens that they stand for."""

import random
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import pytest

from checker.judge.judge import judge_mission
from checker.judge.report import JudgeReport
from checker.mission import read_mission
from runtime.determined.expand import expand
from runtime.determined.loading import RegisterProgram
from runtime.determined.machine import Machine
from runtime.executive.columns import TokenColumns
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, record_mission
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord, TokenRecord
from tests.checker.judge.corrupted_columns import FILES, compare, flight
from tests.programs import programs_of


class Flown(NamedTuple):
    """A mission that was flown; program and machine of its simulator, and the tick up to which it was recorded."""

    agent: AgentConfiguration
    programs: MissionPrograms
    outcome: Outcome
    record: MissionRecord
    simulator: tuple[RegisterProgram, Machine, int]


INL = Path(__file__).resolve().parents[3] / "models/auv/inl/mission.toml"


@pytest.fixture(name="flown")
def fly(monkeypatch: pytest.MonkeyPatch) -> Flown:
    """A mission, and what its simulator's record was made of."""
    caught: list[tuple[RegisterProgram, Machine, int]] = []

    def catching(program: RegisterProgram, machine: Machine, tick: int) -> TokenColumns:
        caught.append((program, machine, tick))
        return expand(program, machine, tick)

    monkeypatch.setattr("runtime.determined.reactor.expand", catching)
    mission, _ = read_mission(INL)
    assert mission is not None
    programs = programs_of(mission.agent)
    outcome, record = record_mission(mission.agent, programs, 3, until=400)
    return Flown(mission.agent, programs, outcome, record, *caught)


def judged(flown: Flown, tokens: Sequence[TokenRecord]) -> JudgeReport:
    """The report on a mission whose simulator did what `tokens` say."""
    mission, navigator, simulator = flown.record.reactors
    record = MissionRecord((mission, navigator, simulator._replace(tokens=tokens)))
    return judge_mission(flown.agent, flown.programs.programs, flown.outcome, record)


def test_a_right_mission_is_judged_alike(flown: Flown) -> None:
    tokens = flown.record.reactors[2].tokens
    assert isinstance(tokens, TokenColumns)
    assert judged(flown, tokens).holds
    assert judged(flown, tokens) == judged(flown, tuple(tokens))


def test_altered_columns_are_found_out_as_altered_tokens_are(flown: Flown) -> None:
    """Numbers that a simulator has logged are changed under the record, one at a time."""
    program, machine, tick = flown.simulator
    chance = random.Random(5)
    found = 0
    for _ in range(24):
        index = chance.randrange(machine.log.value_count)
        before = machine.log.values[index]
        machine.log.values[index] = before + chance.choice((1.0, -2.0, 0.01))
        tokens = expand(program, machine, tick)
        report = judged(flown, tokens)
        assert report == judged(flown, tuple(tokens)), index
        found += bool(report.disagreements)
        machine.log.values[index] = before
    assert found > 12


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.parent.name)
def test_columns_say_of_corrupted_records_what_single_tokens_say(path: Path) -> None:
    flown = flight(path, 4)
    told = [compare(flown, random.Random(f"{path.parent.name} {number}")) for number in range(10)]
    assert all(is_same for _, is_same, _ in told), told
    assert sum(is_noticed for _, _, is_noticed in told) >= 3
