"""Certificates hold for flights nobody has seen, refutations fail when flown, and safe constants are the least ones."""

import os
from dataclasses import replace
from pathlib import Path

import pytest

from checker.excerpts import Excerpts
from checker.flight import fly_recorded
from checker.limits import Limit
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.variant import open_over
from checker.oracle import Verdict, judge
from checker.proofs.box import Box, Point
from checker.proofs.certify import Certainty, Certifier
from checker.proofs.constants import places_of, safe_constant, with_value
from checker.proofs.rendering import certificate_lines
from nddlc.certify import certifier_of
from runtime.executive.configuration import ParameterConfiguration, PropertyConfiguration, PropertyKind, TokenPattern
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord
from tests.checker.conditions.campaigns import campaign
from tests.programs import programs_of

pytestmark = pytest.mark.once

MODELS = Path(__file__).parents[2] / "models"
# The 10^5 missions of the goal: NDDLC_PROOFS=100000.
MOST = int(os.environ.get("NDDLC_PROOFS", "100"))
LEGS = 12


def certifier(path: Path, overlay: tuple[tuple[str, str], ...] = ()) -> Certifier:
    mission, _ = read_mission(path)
    assert mission is not None
    models = load_models(mission, open_over(overlay))
    assert not models.has_errors
    agent = models.agent
    if overlay:
        programs = programs_of(agent)
        programs = programs.__class__(
            tuple(models.programs[each.model] for each in agent.reactors), programs.solvers, programs.constraints
        )
    else:
        programs = programs_of(agent)

    def fly(point: Point) -> tuple[Outcome, MissionRecord, bool]:
        outcome, record = fly_recorded(agent, programs, 1, point)
        return outcome, record, judge(outcome).verdict is Verdict.PASS

    return Certifier(agent, programs.programs, fly)


def survey(folder: Path, text: str) -> Path:
    """A survey of twelve legs with the models of gps; `text` is the mission file of one with two."""
    for each in (MODELS / "gps").glob("*.nddl"):
        (folder / each.name).write_text(each.read_text())
    goals = "".join(
        f'[[goal]]\ntimeline = "nav"\npredicate = "Transit"\nstart = [{5 + 280 * k}, {65 + 280 * k}]\n'
        f"[goal.parameters]\ndistance = {150.0 + 5 * k}\n\n"
        for k in range(LEGS)
    )
    head, tail = text[: text.index("[[goal]]")], text[text.index("[parameters.") :]
    path = folder / "mission.toml"
    path.write_text(head.replace("900", "4000") + goals + tail)
    return path


def test_flights_too_large_for_z3_refute_and_certify_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("checker.proofs.certify.MOST_TOKENS", 5)
    assert certifier(MODELS / "gps" / "mission.toml").certify().certainty is Certainty.REFUTED
    mended = certifier(MODELS / "gps" / "mended.toml").certify()
    assert mended.certainty is Certainty.UNKNOWN
    assert "more than the 5 that are followed" in mended.why


def test_a_refutation_fails_when_flown_and_names_line_and_parameters() -> None:
    found = (proof := certifier(MODELS / "gps" / "mission.toml")).certify()
    assert found.certainty is Certainty.REFUTED
    assert found.subset == ("GPS_HIT_RATE",)
    assert found.is_smallest
    assert [span.text for span in found.lines] == ["duration <= SURFACE_MAX"]
    assert found.point is not None
    assert not proof.fly(found.point)[2]
    # The other parameter is that of a mission that passes.
    assert found.base is not None
    assert proof.fly(found.base)[2]
    assert found.point["CURRENT"] == found.base["CURRENT"]


def test_z3_alone_finds_the_point_where_no_corner_is_flown() -> None:
    found = certifier(MODELS / "gps" / "mission.toml").certify(corners=False)
    assert found.certainty is Certainty.REFUTED
    assert found.flights <= 3


def test_a_certificate_survives_corners_and_random_missions() -> None:
    proof = certifier(MODELS / "gps" / "mended.toml")
    assert proof.certify(corners=False).certainty is Certainty.CERTIFIED
    kept = PropertyConfiguration("kept", PropertyKind.NEVER, TokenPattern("nav", "None"))
    proof.agent = replace(proof.agent, properties=(kept,))
    assert proof.certify(corners=False).certainty is Certainty.UNKNOWN
    rules = proof.certify(corners=False, rules_only=True)
    assert (rules.certainty, rules.unproved) == (Certainty.CERTIFIED, ("kept",))
    normal = ParameterConfiguration("N", 1.0, 9.0, "normal")
    box = Box({"N": normal, "C": replace(normal, clip=(1.0, 9.0)), "D": replace(normal, clip=(0.0, 9.0))}, ())
    lines = certificate_lines("gps", rules, box, Excerpts(MODELS / "gps"))
    assert "  N and D are drawn outside of the box too, of which nothing is proved" in lines
    for point in (*proof.box.corners(), *proof.box.drawn(MOST, 99)):
        assert proof.fly(point)[2], point


def test_a_survey_of_twelve_legs_is_certified(tmp_path: Path) -> None:
    path = survey(tmp_path, (MODELS / "gps" / "mended.toml").read_text())
    proof = certifier(path)
    found = proof.certify(corners=False)
    assert found.certainty is Certainty.CERTIFIED
    assert found.conditions > LEGS * 8
    for point in (*proof.box.corners(), *proof.box.drawn(MOST // 10, 7)):
        assert proof.fly(point)[2], point


@pytest.mark.parametrize(("name", "least"), [("SURFACE_MAX", 67), ("GO_WORST", 200)])
def test_a_safe_constant_is_the_least_one(name: str, least: int, tmp_path: Path) -> None:
    """27 ticks until the receiver is on and 40 for the fix; 240 m at 1.2 m/s."""
    path = MODELS / "gps" / ("mission.toml" if name == "SURFACE_MAX" else "mended.toml")
    proof = certifier(path)
    proof.certify(corners=False)
    safe = safe_constant(proof, name)
    assert safe is not None
    assert (safe.value, safe.is_least) == (least, True)
    (place,) = places_of(name, proof.programs)
    for value, certainty in ((least, Certainty.CERTIFIED), (least - 1, Certainty.REFUTED)):
        overlay = with_value(place, value)
        assert overlay is not None
        assert certifier(path, overlay).certify().certainty is certainty


def test_a_token_may_go_on_when_the_mission_ends(tmp_path: Path) -> None:
    campaign(tmp_path, "p + q + r <= 3.0;")  # the last wait ends two ticks after the mission
    proof = certifier(tmp_path / "mission.toml")
    assert proof.certify(corners=False).certainty is Certainty.CERTIFIED
    for point in (*proof.box.corners(), *proof.box.drawn(MOST, 7)):
        assert proof.fly(point)[2], point


def test_what_code_does_is_not_proved() -> None:
    found = certifier(MODELS / "auv" / "inl" / "mission.toml").certify()
    assert found.certainty is Certainty.UNKNOWN
    assert "Python" in found.why


@pytest.mark.parametrize(("most_repairs", "certainty"), [(None, Certainty.UNKNOWN), (0, Certainty.REFUTED)])
def test_a_limit_that_only_repairs_get_over_is_not_certified(most_repairs: int | None, certainty: Certainty) -> None:
    """With properties or without: that the rules hold is said of what was proved alone; and [check] has its say."""
    mission, _ = read_mission(Path(__file__).parent / "unseen/drill/mission.toml")
    assert mission is not None
    planner = Path(mission.agent.root) / "planner.nddl"
    overlay = ((str(planner.resolve()), planner.read_text().replace("int ICE_MAX = 40;", "int ICE_MAX = 25;")),)
    limits = () if most_repairs is None else ((Limit.REPAIRS, most_repairs),)
    mission = replace(mission, check=replace(mission.check, limits=limits))
    proof = certifier_of(mission, load_models(mission, open_over(overlay)), 1)
    found = proof.certify(corners=False)
    assert found.certainty is certainty
    told = "\n".join(certificate_lines("drill", found, proof.box, Excerpts(planner.parent)))
    assert "the rules hold" not in told
    assert ("L3 at tick 700" if certainty is Certainty.REFUTED else "a plan was repaired") in told


@pytest.mark.parametrize("kind", ["lost", "silent"])
def test_that_the_rules_hold_is_not_said_where_a_line_is_not_part_of_the_proof(kind: str) -> None:
    proof = certifier(MODELS / "gps" / "mended.toml")
    asked = PropertyConfiguration("moving", PropertyKind.NEVER, TokenPattern("nav", "None"))
    proof.agent = replace(proof.agent, properties=(asked,))
    assert "the rules hold" in proof.certify(corners=False).why
    line = next(each.span for each in proof.structures[0].demands if each.span is not None)
    getattr(proof.structures[0], kind)["leq"] = line
    why = proof.certify(corners=False).why
    assert "the rules hold" not in why
    assert f"({Path(line.source.name).name}:{line.source.locate(line.begin)[0]})" in why
