"""Each bug variant fails at its failing values, and passes at its passing values, by repair, rejection and abort."""

from dataclasses import replace
from pathlib import Path

import pytest

from checker.mission import read_mission
from checker.models import load_models
from runtime.executive.mission import run_mission
from runtime.executive.outcome import EventKind, Outcome
from tests.models.bug_variants import Case, Mechanism, Variant, apply, read_variant
from tests.programs import programs_of

pytestmark = pytest.mark.once

BUGS = Path(__file__).parents[2] / "models" / "auv" / "bugs"
VARIANTS = [read_variant(file) for file in sorted(BUGS.glob("*.toml"))]
NOMINAL = {
    "GPS_HIT_RATE": 1.0,
    "ERROR_RATE_X": 0.0,
    "ERROR_RATE_Y": 0.0,
    "DX_NOISE": 0.0,
    "DY_NOISE": 0.0,
    "CLUSTER_ID": 5.0,
}
ENDS = (EventKind.RELAX, EventKind.ABORT)


def fly(mission: Path, case: Case, until: int | None) -> Outcome:
    parsed, _ = read_mission(mission)
    assert parsed is not None
    agent = load_models(parsed).agent
    if case.seed is None:
        return run_mission(agent, programs_of(agent), 1, NOMINAL | case.values, until=until)
    agent = replace(agent, parameters=tuple(replace(each, mode="intra") for each in agent.parameters))
    return run_mission(agent, programs_of(agent), case.seed, None, until=until)


@pytest.mark.parametrize(
    ("variant", "case"),
    [(variant, case) for variant in VARIANTS for case in variant.fails],
    ids=lambda given: getattr(given, "name", None) or str(given.values or given.seed),
)
def test_a_variant_fails_where_it_must(variant: Variant, case: Case, tmp_path: Path) -> None:
    outcome = fly(apply(variant, tmp_path), case, None)
    assert outcome.abort is not None
    shows = variant.shows
    *repairs, abort = [event for event in outcome.events if event.kind in ENDS and event.tick == outcome.last_tick]
    assert abort.kind is EventKind.ABORT
    assert abort.code in shows.code.split(" or ")
    assert abort.reactor == shows.reactor
    assert shows.timeline in abort.timeline.split(", ") or shows.broke.lower().startswith(shows.timeline)
    assert {event.reactor for event in repairs} == {shows.reactor}, "it gave up without a repair"
    assert shows.broke in _speaks_of(outcome, shows)
    rejected = {event.timeline for event in outcome.events if event.kind is EventKind.REJECT}
    assert not shows.rejects or shows.rejects in rejected


def _speaks_of(outcome: Outcome, shows: Mechanism) -> set[str]:
    """The predicates that the reasons of the last repairs of a reactor name."""
    found = [event.reason for event in outcome.events if event.kind in ENDS and event.reactor == shows.reactor]
    return {reason.token.predicate if reason.token else reason.predicate for reason in found[-5:] if reason is not None}


@pytest.mark.parametrize(
    ("variant", "case"),
    [(variant, case) for variant in VARIANTS for case in variant.passes],
    ids=lambda given: getattr(given, "name", None) or str(given.values),
)
def test_a_variant_passes_where_it_must(variant: Variant, case: Case, tmp_path: Path) -> None:
    outcome = fly(apply(variant, tmp_path), case, None)
    assert outcome.abort is None
    assert outcome.last_tick == 30_000


@pytest.mark.parametrize("variant", [one for one in VARIANTS if one.fails], ids=lambda variant: variant.name)
def test_the_model_without_the_mistake_does_not_fail_there(variant: Variant) -> None:
    outcome = fly(BUGS / variant.mission, variant.fails[0], None)
    assert outcome.abort is None


def test_a_message_that_a_waypoint_cuts_off_is_sent_once_more() -> None:
    # The third leg begins at tick 1501: the message of tick 1500, which takes two ticks, may slide by thirty.
    values = {"DX_NOISE": 0.2, "GPS_HIT_RATE": 1.1}
    outcome = fly(BUGS / "../inl/standard.toml", Case(values, None), 1600)
    assert outcome.abort is None
    sent = [e for e in outcome.events if e.kind is EventKind.OBSERVATION and e.timeline == "outbox"]
    assert [(e.tick, e.predicate) for e in sent if 1500 <= e.tick < 1600] == [
        (1500, "Send"),
        (1501, "Hush"),
        (1506, "Send"),
        (1508, "Idle"),
    ]


def test_an_edit_that_finds_no_place_is_refused(tmp_path: Path) -> None:
    first = VARIANTS[0]
    with pytest.raises(ValueError, match="0 places"):
        apply(replace(first, edits=((first.edits[0][0], "no such line", ""),)), tmp_path)
