"""What the text of a model speaks against by itself is tried first, whatever a mission did."""

import pytest

from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.usage import Usage, usage_of
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.told_by_text import with_told
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
float DAY = [0.0 1.0];
float WARM = 4.0;
float COLD = 0.2;
/// Tonnes in one bale.
int PER_BALE = 2;
int TRUCK = 7;
float HEIGHT = 25.0;
float TROLLEY_SPEED = 2.0;
int WAIT = 10;
class Lot { int number; int tonnes; Lot(int n, int t) { number = n; tonnes = t; } }
class Vent extends AgentTimeline {
  predicate Shut { }
  predicate Airing { int litres; }
  Vent(Mode m) { super(m, "Shut"); }
}
class Tap extends AgentTimeline {
  predicate Closed { }
  predicate Give { int litres; }
  Tap(Mode m) { super(m, "Closed"); }
}
class Crop extends AgentTimeline {
  predicate Grows { }
  predicate Tend { int number; int bales; int litres; float time; float speed; }
  predicate Sow { float speed; }
  predicate Refill { int bales; }
  predicate Sell { int bales; }
  Crop(Mode m) { super(m, "Grows"); }
}
Reservoir yard = new Reservoir(2.0, 0.0, 15.0);
Crop::Tend {
  Lot lot;
  float day;
  day == sampledParameter(DAY);
  bales == PER_BALE * lot.tonnes;
  mulEq(speed, time, HEIGHT);
  speed <= TROLLEY_SPEED;
  contains(Tap.Give give);
  give.litres == 10 * litres;
  contains(Tap.Give airing);
  give before airing;
  airing.start <= start + WAIT;
  give.start <= start + WAIT;
  if (day > 4.0) { give.duration <= 9; } else { give.duration <= 8; }
  if (day < WARM) { airing.duration <= 9; } else { airing.duration <= 8; }
  if (day < COLD) { airing.duration <= 9; } else { airing.duration <= 8; }
}
Crop::Sow {
  float rate;
  rate == TROLLEY_SPEED / speed;
  float dust;
  float pace;
  float slow;
  pace == rate * (1.0 - dust);
  slow == rate * dust;
}
Crop::Refill { any(yard.consume more); more.quantity == bales; }
Crop::Sell { any(yard.consume gone); gone.quantity == bales; }
Lot first = new Lot(1, 12);
Lot second = new Lot(2, 16);
Lot third = new Lot(2, 10);
close();
"""


@pytest.fixture(scope="module")
def sites(tmp_path_factory: pytest.TempPathFactory) -> list[EditSite]:
    path = tmp_path_factory.mktemp("crop") / "m.nddl"
    path.write_text(MODEL)
    return with_told(sites_of(load_graph(path, ())))


@pytest.fixture(scope="module")
def usage(sites: list[EditSite]) -> Usage:
    return usage_of(sites)


def found(sites: list[EditSite], text: str, old: str, new: str) -> tuple[SmallEdit, EditSite]:
    ((edit, site),) = [
        (edit, site) for site in sites for edit in site.edits if (site.text, edit.old, edit.new) == (text, old, new)
    ]
    return edit, site


@pytest.mark.parametrize(
    ("text", "old", "new"),
    [
        ("Lot third = new Lot(2, 10);", "2", "3"),  # a row copied
        ("day > 4.0", "4.0", "0.4"),  # a day is never above 1
        ("float WARM = 4.0;", "4.0", "0.4"),
        ("airing.start <= start + WAIT;", "start", "give.end"),  # `give` comes before it
        ("slow == rate * dust;", "dust", "(1.0 - dust)"),  # of another line what the dust leaves
    ],
)
def test_what_the_text_speaks_against_is_tried_before_any_flight(
    sites: list[EditSite], usage: Usage, text: str, old: str, new: str
) -> None:
    edit, site = found(sites, text, old, new)
    assert delay_of(edit, site, usage) == -1.0
    assert cost_of(edit, site, usage) == 1.5


def test_nothing_is_told_of_what_the_text_agrees_with(sites: list[EditSite]) -> None:
    wanted = [site.text for site in sites if site.wanted]
    assert wanted == [
        "float WARM = 4.0;",
        "airing.start <= start + WAIT;",
        "day > 4.0",
        "slow == rate * dust;",
        "Lot third = new Lot(2, 10);",
    ]


def test_a_rate_belongs_on_the_other_side_before_what_else_a_product_may_be(
    sites: list[EditSite], usage: Usage
) -> None:
    edit, site = found(sites, "bales == PER_BALE * lot.tonnes;", "PER_BALE * lot.tonnes", "lot.tonnes / PER_BALE")
    delay = delay_of(edit, site, usage)
    computing = (EditKind.FORMULA, EditKind.OPERATOR, EditKind.TERM, EditKind.COMPARISON)
    others = [delay_of(one, site, usage) for one in site.edits if one is not edit and one.kind in computing]
    assert delay is not None and delay < min(one for one in others if one is not None)


def test_the_only_line_that_may_fill_a_resource_does_so_if_it_is_called_so(sites: list[EditSite], usage: Usage) -> None:
    more, gone = (found(sites, f"any(yard.consume {name});", "consume", "produce") for name in ("more", "gone"))
    assert delay_of(*more, usage) == -1.0
    assert cost_of(*more, usage) < cost_of(*gone, usage)


def test_a_token_is_of_the_predicate_whose_name_it_has(sites: list[EditSite], usage: Usage) -> None:
    edit, site = found(sites, "contains(Tap.Give airing);", "Tap.Give", "Vent.Airing")
    assert delay_of(edit, site, usage) == pytest.approx(-1.5)
    assert not any(one.new == "Vent.Airing" for site in sites for one in site.edits if "Give give" in site.text)


def test_a_bare_number_is_left_out_of_a_product_sooner_than_what_has_a_name(
    sites: list[EditSite], usage: Usage
) -> None:
    number = found(sites, "give.litres == 10 * litres;", "10 * litres", "litres")
    name = found(sites, "bales == PER_BALE * lot.tonnes;", "PER_BALE * lot.tonnes", "lot.tonnes")
    assert cost_of(*number, usage) < cost_of(*name, usage)
    delays = [delay_of(*one, usage) for one in (number, name)]
    assert delays[0] is not None and delays[1] is not None and delays[0] < delays[1]


def test_a_product_is_not_what_its_factor_is_called(sites: list[EditSite], usage: Usage) -> None:
    line = "mulEq(speed, time, HEIGHT);"
    speed = found(sites, line, "HEIGHT", "TROLLEY_SPEED")
    assert speed[0].kind is EditKind.LIMIT
    assert delay_of(*speed, usage) == 3.0  # when all likelier changes have been tried
    assert cost_of(*speed, usage) > cost_of(*found(sites, line, "HEIGHT", "TRUCK"), usage)


def test_a_rate_may_be_a_quotient_of_rates_however_seldom_that_is(sites: list[EditSite], usage: Usage) -> None:
    turned = found(sites, "rate == TROLLEY_SPEED / speed;", "TROLLEY_SPEED / speed", "speed / TROLLEY_SPEED")
    assert delay_of(*turned, usage) is not None  # its only quotient is this one
    assert cost_of(*turned, usage) > 4.0
