"""Fly random agents in every way there is, and put them to the oracle."""

import json
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import judge
from nddlc.main import run
from runtime.executive.clocks import LogClock, StepClock
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, record_mission, run_mission
from runtime.executive.outcome import Outcome
from runtime.executive.rendering import event_data
from tests.executive.determined_models import told
from tests.executive.generated.agents import RandomAgent
from tests.executive.generated.batches import batch_faults
from tests.executive.generated.oracle import Oracle
from tests.executive.generated.promises import broken_promises
from tests.programs import programs_of

UNLIMITED = 10**6  # steps in a tick


def loaded(file: Path) -> tuple[AgentConfiguration, MissionPrograms]:
    """A mission file or an agent file, and its models, without their places on this machine."""
    mission, found = read_mission(file)
    assert mission is not None, found
    models = load_models(mission)
    assert not models.has_errors, models.diagnostics
    return models.agent, programs_of(models.agent)


def lines_of(outcome: Outcome) -> list[dict[str, Any]]:
    """The trace as its JSON Lines have it."""
    found: list[dict[str, Any]] = json.loads(json.dumps([event_data(event) for event in outcome.events]))
    return found


def brief(outcome: Outcome) -> list[tuple[Any, ...]]:
    """The events without their reasons, which may be told in two ways, and without draws."""
    keys = ("tick", "kind", "reactor", "timeline", "predicate", "arguments", "request", "stage", "code", "start", "end")
    return [tuple(event.get(key) for key in keys) for event in lines_of(outcome)]


def without_places(data: Any) -> Any:
    """An event without the places in files: a goal stands elsewhere in an agent file."""
    if isinstance(data, dict):
        return {key: without_places(value) for key, value in data.items() if key != "place"}
    return [without_places(one) for one in data] if isinstance(data, list) else data


def replayed(file: Path) -> str:
    """What `nddlc replay` says of the trace of `nddlc run`; empty if it is the same flight again."""
    trace, said = file.with_name("trace.jsonl"), StringIO()
    with redirect_stdout(said), redirect_stderr(said):
        run(["run", str(file), "--seed", "1", "--trace", str(trace)])
        said.seek(0)
        said.truncate()
        code = run(["replay", "--trust", str(trace)])
    return "" if code == 0 else f"by `nddlc replay` it is another flight: {' '.join(said.getvalue().split())[:200]}"


def faults_of(agent: RandomAgent, replays: bool = False, batches: bool = False) -> tuple[Outcome, list[str]]:
    """One flight of an agent, and what is wrong about it; `replays`, `batches`: by the commands too."""
    with TemporaryDirectory() as folder:
        file = agent.write(Path(folder))
        configuration, programs = loaded(file)
        outcome, record = record_mission(configuration, programs, 1)
        report = judge_mission(configuration, programs.programs, outcome, record, programs.constraints)
        wrong = [f"the judge: {disagreement_text(one)}" for one in report.disagreements]
        if brief(run_mission(configuration, programs, 1, every_tick=True)) != brief(outcome):
            wrong.append("with every tick visited it is another flight")
        if told(run_mission(configuration, programs, 1, compiles=False)) != told(outcome):
            wrong.append("the general engine flies another mission")
        clock = StepClock(agent.steps or UNLIMITED)
        counted = record_mission(configuration, programs, 1, clock=clock)[0]
        logged = record_mission(configuration, programs, 1, clock=LogClock(clock.counts))[0]
        if not told(counted) == told(logged) == told(outcome):
            wrong.append("by a log of its steps it is another flight")
        if replays and (said := replayed(file)):
            wrong.append(said)
        if batches:
            wrong += batch_faults(file)
        text = agent.agent_file()
        if text is not None:
            (Path(folder) / "agent.xml").write_text(text)
            other = run_mission(*loaded(Path(folder) / "agent.xml"), 1)
            if [without_places(one) for one in lines_of(other)] != [without_places(one) for one in lines_of(outcome)]:
                wrong.append("the agent file tells of another agent")
    oracle = Oracle(agent, lines_of(outcome))
    oracle.read()
    wrong += oracle.wrong
    judgement = judge(outcome)
    if (judgement.verdict.value, judgement.code) != oracle.verdict():
        wrong.append(f"the verdict is {judgement.verdict} {judgement.code}, the trace says {oracle.verdict()}")
    return outcome, [*wrong, *broken_promises(oracle)]
