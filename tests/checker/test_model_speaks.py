"""What the lines of a model say of each other makes a change likelier than another one before anything is flown."""

from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.turns import Turns
from checker.counterfactual.usage import Usage, usage_of
from checker.mutation.additions import with_additions
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
int TRACK_EXTRA = 65;
float WIND_DRAG = 0.1;
float RATE = 3.0;
float WIND_X = 1.0;
float WIND_Y = 1.0;
class Mount extends AgentTimeline {
  predicate Track { int seconds; int frames; float wind; float dx; float dy; }
  predicate Look { int seconds; int frames; float ax; float ay; float bx; float by; }
  Mount(Mode m) { super(m, "Track"); }
}
Mount::Look {
  int nominal;
  float dose;
  contains(Mount.Track track);
  contains(Mount.Track turn);
  nominal == seconds + frames;
  dose == 2.0;
  track.seconds == nominal;
  track.dx == bx - ax;
  track.dy == bx - ay;
  turn before track;
  turn.start <= track.end + 5;
}
Mount::Track {
  float rate;
  float time;
  rate == RATE * WIND_DRAG - wind;
  mulEq(dx, time, rate);
  duration == seconds * frames;
}
Mount::Look {
  float length;
  float time;
  mulEq(length, time, dx);
  float tx;
  float ty;
  mulEq(WIND_X, tx, ax);
  mulEq(WIND_Y, ty, ay);
}
"""


@pytest.fixture
def sites(tmp_path: Path) -> list[EditSite]:
    path = tmp_path / "m.nddl"
    path.write_text(MODEL)
    return with_additions(sites_of(load_graph(path, ())))


@pytest.fixture
def usage(sites: list[EditSite]) -> Usage:
    return usage_of(sites)


def change(sites: list[EditSite], text: str, new: str, kind: EditKind) -> tuple[SmallEdit, EditSite]:
    (site,) = (site for site in sites if site.text == text)
    return next((edit, site) for edit in site.edits if site.after(edit) == new and edit.kind is kind)


def assert_likelier(one: tuple[SmallEdit, EditSite], other: tuple[SmallEdit, EditSite], usage: Usage) -> None:
    assert cost_of(*one, usage) < cost_of(*other, usage)
    sooner, later = delay_of(*one, usage), delay_of(*other, usage)
    assert sooner is not None and (later is None or sooner < later)


def test_what_nothing_reads_is_added_where_its_name_belongs(sites: list[EditSite], usage: Usage) -> None:
    added = {site.after(edit) for site in sites for edit in site.edits if edit.kind is EditKind.MISSING}
    assert "track.seconds == nominal + TRACK_EXTRA;" in added
    assert "track.dx == bx * dose - ax;" in added
    assert not any("RATE +" in text or "+ WIND_DRAG" in text for text in added)  # lines read these
    wanted = change(sites, "track.seconds == nominal;", "track.seconds == nominal + TRACK_EXTRA;", EditKind.MISSING)
    other = change(
        sites, "nominal == seconds + frames;", "nominal == seconds + frames - TRACK_EXTRA;", EditKind.MISSING
    )
    assert usage.is_wanted(*wanted)
    assert delay_of(*wanted, usage) is not None
    assert cost_of(*wanted, usage) <= cost_of(*other, usage)


def test_operands_are_joined_as_they_are_elsewhere(sites: list[EditSite], usage: Usage) -> None:
    wrong = "nominal == seconds + frames;"
    product = change(sites, wrong, "nominal == seconds * frames;", EditKind.OPERATOR)
    sound = "duration == seconds * frames;"
    quotient = change(sites, sound, "duration == seconds / frames;", EditKind.FORMULA)
    assert_likelier(product, quotient, usage)


def test_operators_change_places_for_the_variable_that_a_constant_bears(sites: list[EditSite], usage: Usage) -> None:
    wrong = "rate == RATE * WIND_DRAG - wind;"
    exchanged = change(sites, wrong, "rate == RATE - WIND_DRAG * wind;", EditKind.FORMULA)
    other = change(sites, wrong, "rate == RATE / WIND_DRAG - wind;", EditKind.FORMULA)
    assert_likelier(exchanged, other, usage)


def test_arguments_stand_where_they_do_elsewhere(sites: list[EditSite], usage: Usage) -> None:
    wrong = "mulEq(dx, time, rate);"
    right = change(sites, wrong, "mulEq(rate, time, dx);", EditKind.ARGUMENTS)
    other = change(sites, wrong, "mulEq(dx, rate, time);", EditKind.ARGUMENTS)
    assert_likelier(right, other, usage)


def test_a_relation_follows_the_limit_beside_it(sites: list[EditSite], usage: Usage) -> None:
    right = change(sites, "turn before track;", "turn after track;", EditKind.RELATION)
    other = change(sites, "turn before track;", "turn meets track;", EditKind.RELATION)
    assert_likelier(right, other, usage)


def test_a_line_says_of_one_axis_what_another_says_of_another(sites: list[EditSite], usage: Usage) -> None:
    right = change(sites, "track.dy == bx - ay;", "track.dy == by - ay;", EditKind.NAME)
    other = change(sites, "track.dy == bx - ay;", "track.dy == ax - ay;", EditKind.NAME)
    assert_likelier(right, other, usage)
    assert usage.is_fitting(*right)
    kept = change(sites, "track.dx == bx - ax;", "track.dx == by - ax;", EditKind.NAME)
    assert not usage.siblings.completes(*kept)
    kept = change(sites, "mulEq(WIND_X, tx, ax);", "mulEq(WIND_Y, tx, ax);", EditKind.LIMIT)
    assert not usage.siblings.completes(*kept)  # `X` of one axis and `x` of it are one


def test_other_edits_of_a_line_come_sooner_where_one_let_the_mission_come_farther(sites: list[EditSite]) -> None:
    first, second = [site for site in sites if site.edits][:2]
    turns = Turns(lambda _: ())
    edits = {site: site.edits[0] for site in (first, second)}
    turns.add(0.6, Candidate(first, 0.0, Suspicion.CONFLICT), edits[first])
    turns.add(0.5, Candidate(second, 0.0, Suspicion.CONFLICT), edits[second])
    turns.encourage(first)
    assert turns.pop()[1].site is first
