"""Moments are held to moments and durations to durations; and what a violated property speaks of comes sooner."""

from pathlib import Path

import pytest

from checker.counterfactual.moments import with_durations
from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.usage import Usage, usage_of
from checker.mutation.additions import with_additions
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
int SOAK_MIN = 10;
int SOAK_MAX = 60;
int SLOT = 400;
float DRIP_RATE = 4.0;
class Garden extends AgentTimeline {
  predicate Rest { float litres; float dose; }
  predicate Water { float litres; }
  Garden(Mode m) { super(m, "Rest"); }
}
Garden::Water {
  contains(Garden.Rest open);
  contains(Garden.Rest probe);
  probe.start >= open.duration + SOAK_MIN;
  probe.start <= open.end + SOAK_MIN;
  probe.start <= open.end + SOAK_MAX;
  probe.end == end;
  open.start <= SLOT;
  open.litres == litres;
}
Garden::Rest {
  float sum;
  sum == litres - dose;
  duration == ceil(litres) + 3;
}
"""


@pytest.fixture
def sites(tmp_path: Path) -> list[EditSite]:
    path = tmp_path / "m.nddl"
    path.write_text(MODEL)
    return with_durations(with_additions(sites_of(load_graph(path, ()))))


@pytest.fixture
def usage(sites: list[EditSite]) -> Usage:
    return usage_of(sites)


def after(sites: list[EditSite], text: str, kind: EditKind) -> dict[str, tuple[SmallEdit, EditSite]]:
    """The edits of a kind of a line, each by what the line is then."""
    (site,) = (site for site in sites if site.text == text)
    return {site.after(edit): (edit, site) for edit in site.edits if edit.kind is kind}


def test_a_moment_that_is_held_to_a_duration_is_put_right_first(sites: list[EditSite], usage: Usage) -> None:
    text = "probe.start >= open.duration + SOAK_MIN;"
    points = after(sites, text, EditKind.POINT)
    meant = points["probe.start >= open.end + SOAK_MIN;"]
    assert delay_of(*meant, usage) == -1.0
    other = next(iter(after(sites, text, EditKind.COMPARISON).values()))
    assert cost_of(*meant, usage) < cost_of(*other, usage)


def test_no_line_is_made_that_mixes_moments_and_durations(sites: list[EditSite], usage: Usage) -> None:
    assert set(after(sites, "probe.end == end;", EditKind.POINT)) == {"probe.start == end;", "probe.end == start;"}
    assert "open.duration <= SLOT;" in after(sites, "open.start <= SLOT;", EditKind.POINT)
    scaled = after(sites, "probe.start <= open.end + SOAK_MAX;", EditKind.OPERATOR)
    mixed = scaled["probe.start <= open.end * SOAK_MAX;"]
    delay = delay_of(*mixed, usage)
    assert delay is not None and delay > 2.0


def test_the_comparison_that_a_constant_asks_for_comes_before_other_words(sites: list[EditSite], usage: Usage) -> None:
    text = "probe.start <= open.end + SOAK_MIN;"
    comparisons = after(sites, text, EditKind.COMPARISON)
    soon = delay_of(*comparisons["probe.start >= open.end + SOAK_MIN;"], usage)
    usual = delay_of(*after(sites, "probe.start <= open.end + SOAK_MAX;", EditKind.SIGN).popitem()[1], usage)
    assert soon is not None and usual is not None and soon < 0.0 < usual


def test_what_nothing_reads_may_divide(sites: list[EditSite]) -> None:
    added = set(after(sites, "duration == ceil(litres) + 3;", EditKind.MISSING))
    assert {"duration == ceil(litres / DRIP_RATE) + 3;", "duration == ceil(litres * DRIP_RATE) + 3;"} <= added
    assert "sum == litres / dose;" in after(sites, "sum == litres - dose;", EditKind.FORMULA)


def test_no_variable_is_set_by_itself(sites: list[EditSite], usage: Usage) -> None:
    names = after(sites, "sum == litres - dose;", EditKind.NAME)
    itself, other = names["sum == sum - dose;"], names["sum == litres - litres;"]
    late, sooner = delay_of(*itself, usage), delay_of(*other, usage)
    assert late is not None and (sooner is None or sooner < late)
    assert late > 3.0
