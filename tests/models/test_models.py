"""The models that come with the project: formatted, without a finding of lint, and flying."""

from dataclasses import replace
from pathlib import Path
from typing import Literal

import pytest

from checker.mission import read_mission
from checker.models import load_models
from nddlc.main import run
from runtime.executive.mission import run_mission
from runtime.executive.outcome import EventKind, Outcome
from tests.programs import programs_of

MODELS = Path(__file__).parents[2] / "models"
FILES = sorted(MODELS.rglob("*.nddl"))
OWN = [file for file in FILES if "gps" not in file.relative_to(MODELS).parts]
NOMINAL = {
    "GPS_HIT_RATE": 1.0,
    "ERROR_RATE_X": 0.0,
    "ERROR_RATE_Y": 0.0,
    "DX_NOISE": 0.0,
    "DY_NOISE": 0.0,
    "CLUSTER_ID": 5.0,
}


Captured = pytest.CaptureFixture[str]


def told(capsys: Captured, *words: str) -> tuple[int, str]:
    code = run(list(words))
    said = capsys.readouterr()
    return code, said.out + said.err


def fly(name: str, seed: int = 1, values: dict[str, float] | None = None) -> Outcome:
    mission, _ = read_mission(MODELS / name)
    assert mission is not None
    models = load_models(mission)
    assert not models.has_errors
    return run_mission(models.agent, programs_of(models.agent), seed, values)


@pytest.mark.parametrize("file", OWN, ids=lambda file: str(file.relative_to(MODELS)))
def test_a_model_is_in_the_one_style(file: Path, capsys: Captured) -> None:
    code, said = told(capsys, "fmt", "--check", str(file))
    assert code == 0, said


@pytest.mark.parametrize("file", OWN, ids=lambda file: str(file.relative_to(MODELS)))
def test_lint_finds_nothing(file: Path, capsys: Captured) -> None:
    code, said = told(capsys, "lint", str(file))
    assert code == 0 and "nothing wrong" in said, said


@pytest.mark.once
def test_the_survey_is_flown_to_its_end_without_a_repair() -> None:
    outcome = fly("auv/inl/mission.toml", values=NOMINAL)
    kinds = {event.kind for event in outcome.events}
    assert outcome.abort is None and not outcome.open_goals
    assert not kinds & {EventKind.RELAX, EventKind.REJECT, EventKind.REFUSE}
    fixes = [event for event in outcome.events if event.predicate == "Fix"]
    checks = [event.tick for event in outcome.events if event.predicate == "CheckIn" and event.timeline == "comms"]
    assert len(fixes) == len(checks)
    assert all(after - before <= 5405 for before, after in zip([0, *checks], checks, strict=False))


@pytest.mark.once
def test_a_detection_brings_a_closer_look_and_water_samples() -> None:
    outcome = fly("auv/inl/mission.toml", values=NOMINAL | {"CLUSTER_ID": 28.0})
    assert outcome.abort is None and not outcome.open_goals
    done = [
        event.predicate for event in outcome.events if event.kind is EventKind.ACHIEVED and event.request is not None
    ]
    assert "HighRes" in done and "Firing" in done


@pytest.mark.once
def test_shore_sends_another_track() -> None:
    outcome = fly("auv/front/mission.toml", values=NOMINAL)
    assert outcome.abort is None and not outcome.open_goals
    said = [event.kind for event in outcome.events if event.reactor == "shore"]
    assert said == [EventKind.REQUEST, EventKind.RECALL, EventKind.REQUEST]
    tracks = [
        e for e in outcome.events if e.timeline == "front" and e.predicate == "Track" and e.kind is EventKind.ACHIEVED
    ]
    assert tracks, "no track was finished"
    cells = {dict(e.arguments)["bin"].interval for e in outcome.events if e.predicate == "Profile"}
    assert {(float(k), float(k)) for k in range(1, 8)} <= cells


@pytest.mark.once
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_survey_copes_with_what_is_drawn(seed: int) -> None:
    outcome = fly("auv/inl/mission.toml", seed)
    assert outcome.abort is None and not outcome.open_goals


@pytest.mark.once
@pytest.mark.parametrize("shape", ["uniform", "normal"])
@pytest.mark.parametrize("mode", ["inter", "intra"])
@pytest.mark.parametrize("seed", [1635799601, 3553905289])
def test_the_survey_needs_no_repair_whatever_is_drawn(seed: int, mode: Literal["inter", "intra"], shape: str) -> None:
    mission, _ = read_mission(MODELS / "auv/inl/mission.toml")
    assert mission is not None
    agent = load_models(mission).agent
    drawn = tuple(replace(each, mode=mode, distribution=shape) for each in agent.parameters)
    outcome = run_mission(replace(agent, parameters=drawn), programs_of(agent), seed)
    kinds = {event.kind for event in outcome.events}
    assert outcome.abort is None and not outcome.open_goals
    assert not kinds & {EventKind.RELAX, EventKind.REJECT, EventKind.REFUSE}
    ready = [e for e in outcome.events if e.kind is EventKind.OBSERVATION and e.timeline == "gulper"]
    left = [dict(each.arguments)["left"].interval for each in ready]
    assert all(bounds is not None and bounds[0] >= 0 for bounds in left), "a sampler was fired twice"
    closer = [e for e in outcome.events if e.kind is EventKind.REQUEST and e.predicate == "HighRes"]
    assert len(closer) == 5 if mode == "intra" else len(closer) <= 5


@pytest.mark.parametrize("name", sorted(file.name for file in (MODELS / "classic").glob("*.nddl")))
def test_a_classic_problem_is_planned_with_all_its_goals(name: str, capsys: Captured) -> None:
    arguments = ["plan", "--horizon", "0", "100", "--max-steps", "20000", str(MODELS / "classic" / name)]
    code, said = told(capsys, *arguments)
    assert code == 0 and "plan found" in said, said
    assert "not planned" not in said
