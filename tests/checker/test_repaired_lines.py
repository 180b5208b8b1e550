"""A moment that stands for a duration is put right, a stray constant goes, and a slack that other lines have comes."""

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
int GAP_MAX = 9;
int ORBIT = 90;
int SETTLING = 4;
float PACE = 2.0;
Reservoir battery = new Reservoir(90.0, 15.0, 100.0);
class Arm extends AgentTimeline {
  predicate Rest { }
  predicate Reach { int number; float way; }
  Arm(Mode m) { super(m, "Rest"); }
}
class Radio extends AgentTimeline {
  predicate Pass { int passes; }
  Radio(Mode m) { super(m, "Pass"); }
}
class Work extends AgentTimeline {
  predicate Idle { }
  predicate Pick { int number; }
  Work(Mode m) { super(m, "Idle"); }
}
Work::Pick {
  contains(Arm.Reach one);
  contains(Arm.Reach two);
  contains(Arm.Reach three);
  one before two;
  two.start <= one.end;
  three.start <= two.end + GAP_MAX;
  two.number == duration;
  three.end == number;
  any(Reservoir.consume use);
  use.time == number;
}
Arm::Reach {
  start == way * PACE;
  duration == ceil(way) + ORBIT + SETTLING;
}
Radio::Pass {
  duration == passes * ORBIT;
}
"""


@pytest.fixture(scope="module")
def sites(tmp_path_factory: pytest.TempPathFactory) -> list[EditSite]:
    path = tmp_path_factory.mktemp("m") / "m.nddl"
    path.write_text(MODEL)
    return with_durations(with_additions(sites_of(load_graph(path, ()))))


@pytest.fixture(scope="module")
def usage(sites: list[EditSite]) -> Usage:
    return usage_of(sites)


def change(sites: list[EditSite], text: str, new: str, kind: EditKind) -> tuple[SmallEdit, EditSite]:
    """The edit of a kind by which a line becomes another one."""
    (site,) = (site for site in sites if site.text == text)
    return next((edit, site) for edit in site.edits if edit.kind is kind and site.after(edit) == new)


@pytest.mark.parametrize(
    ("text", "new", "kind"),
    [
        ("start == way * PACE;", "duration == way * PACE;", EditKind.POINT),
        ("three.end == number;", "three.end == end;", EditKind.NAME),
        ("use.time == number;", "use.time == end;", EditKind.NAME),
        ("two.number == duration;", "two.number == number;", EditKind.NAME),
        ("two.start <= one.end;", "two.start <= one.end + GAP_MAX;", EditKind.MISSING),
    ],
)
def test_what_a_line_is_held_to_is_put_right_at_once(
    sites: list[EditSite], usage: Usage, text: str, new: str, kind: EditKind
) -> None:
    delay = delay_of(*change(sites, text, new, kind), usage)
    assert delay is not None and delay < 0.0


def test_a_constant_that_belongs_elsewhere_is_left_out_sooner_than_one_with_its_only_use(
    sites: list[EditSite], usage: Usage
) -> None:
    text = "duration == ceil(way) + ORBIT + SETTLING;"
    stray = change(sites, text, "duration == ceil(way) + SETTLING;", EditKind.TERM)
    own = change(sites, text, "duration == ceil(way) + ORBIT;", EditKind.TERM)
    assert cost_of(*stray, usage) < cost_of(*own, usage) - 3.0
    sooner, later = delay_of(*stray, usage), delay_of(*own, usage)
    assert sooner is not None and later is not None and sooner < later - 1.0


def test_a_slack_is_likelier_missing_than_the_comparison_is_turned(sites: list[EditSite], usage: Usage) -> None:
    text = "two.start <= one.end;"
    slack = change(sites, text, "two.start <= one.end + GAP_MAX;", EditKind.MISSING)
    turned = change(sites, text, "two.start >= one.end;", EditKind.COMPARISON)
    assert cost_of(*slack, usage) < cost_of(*turned, usage)
