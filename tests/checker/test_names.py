"""A wrong name, value, time or token in a line: what else may be meant there, and what speaks for it."""

from pathlib import Path

import pytest

from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.usage import usage_of
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """enum Load { sand, stone, none }
float STONE_TIME;
float SPARE;
STONE_TIME = 3.5;
SPARE = 9.0;
typedef float [0.0 60.0] Tons;
class Crane extends Timeline {
    predicate Still { }
    predicate Lift { Load load; float tons; }
    predicate Lower { Load load; float tons; }
}
class Ship extends Timeline { predicate Fill { Load load; Tons tons; } }
Reservoir fuel = new Reservoir(80.0, 10.0, 100.0);
Ship::Fill {
    float hours;
    float span;
    contains(Crane.Lift lift);
    contains(Crane.Lower lower);
    lift.tons == hours;
    lower.load == none;
    hours == tons * tons;
    if (load == stone) {
        span == hours * STONE_TIME;
    }
    lift before lower;
    lower.end <= lift.start;
    lift.start == end;
    any(Reservoir.consume use);
    use.time == end;
    use.quantity == tons;
    duration >= SPARE - span;
}
"""


@pytest.fixture
def sites(tmp_path: Path) -> list[EditSite]:
    """The sites of the model."""
    path = tmp_path / "m.nddl"
    path.write_text(MODEL)
    return sites_of(load_graph(path, ()))


def named(sites: list[EditSite], text: str) -> EditSite:
    return next(site for site in sites if site.text == text)


def changes(sites: list[EditSite], text: str, kind: EditKind) -> set[tuple[str, str]]:
    return {(edit.old, edit.new) for edit in named(sites, text).edits if edit.kind is kind}


def edit(sites: list[EditSite], text: str, old: str, new: str) -> tuple[SmallEdit, EditSite]:
    site = named(sites, text)
    return next(one for one in site.edits if (one.old, one.new) == (old, new)), site


def test_a_variable_gives_way_to_those_of_its_type_that_are_made_before(sites: list[EditSite]) -> None:
    assert changes(sites, "lift.tons == hours;", EditKind.NAME) == {
        *(("lift.tons", new) for new in ("tons", "span", "lower.tons", "SPARE", "STONE_TIME")),
        *(("hours", new) for new in ("tons", "span", "lower.tons", "SPARE", "STONE_TIME")),
    }
    assert ("none", "load") in changes(sites, "lower.load == none;", EditKind.NAME)
    assert not any("use" in new for _, new in changes(sites, "hours == tons * tons;", EditKind.NAME))


def test_a_value_gives_way_to_others_of_its_enumeration(sites: list[EditSite]) -> None:
    assert changes(sites, "load == stone", EditKind.VALUE) == {("stone", "sand"), ("stone", "none")}


def test_times_and_tokens_give_way_to_others_and_events_have_no_ends(sites: list[EditSite]) -> None:
    text = "lower.end <= lift.start;"
    assert changes(sites, text, EditKind.POINT) == {("lower.end", "lower.start"), ("lift.start", "lift.end")}
    assert ("lift.start", "start") in changes(sites, text, EditKind.TOKEN)
    assert changes(sites, "use.time == end;", EditKind.TOKEN) == {("end", "lift.end"), ("end", "lower.end")}


def test_a_predicate_gives_way_to_one_with_the_same_parameters(sites: list[EditSite]) -> None:
    assert changes(sites, "contains(Crane.Lift lift);", EditKind.PREDICATE) == {("Lift", "Lower")}
    assert changes(sites, "any(Reservoir.consume use);", EditKind.PREDICATE) == {("consume", "produce")}


def test_the_same_name_on_both_sides_is_likelier(sites: list[EditSite]) -> None:
    usage = usage_of(sites)
    text = "lift.tons == hours;"
    meant, other = edit(sites, text, "hours", "tons"), edit(sites, text, "hours", "span")
    assert cost_of(*meant, usage) < cost_of(*other, usage)
    soon, late = delay_of(*meant, usage), delay_of(*other, usage)
    assert soon is not None and late is not None and soon < late


def test_what_a_name_takes_its_only_mention_from_is_less_likely_to_give_way(sites: list[EditSite]) -> None:
    usage = usage_of(sites)
    stranded, doubled = (
        edit(sites, "use.quantity == tons;", "tons", "span"),
        edit(sites, "hours == tons * tons;", "tons", "span"),
    )
    only = edit(sites, "duration >= SPARE - span;", "span", "hours")
    assert cost_of(*doubled, usage) < cost_of(*stranded, usage) < cost_of(*only, usage)


def test_both_ends_and_both_starts_are_likelier_equal(sites: list[EditSite]) -> None:
    usage = usage_of(sites)
    text = "lift.start == end;"
    meant, other = edit(sites, text, "lift.start", "lift.end"), edit(sites, text, "==", "!=")
    soon, late = delay_of(*meant, usage), delay_of(*other, usage)
    assert soon is not None and late is not None and soon < late
    assert cost_of(*meant, usage) < cost_of(*other, usage)


@pytest.mark.parametrize(
    ("text", "old", "looser", "tighter"),
    [
        ("SPARE = 9.0;", "9.0", "0.9", "90.0"),  # it stands at the greater side of `>=`
        ("Reservoir fuel = new Reservoir(80.0, 10.0, 100.0);", "10.0", "1.0", "100.0"),
        ("Reservoir fuel = new Reservoir(80.0, 10.0, 100.0);", "100.0", "1000.0", "10.0"),
    ],
)
def test_a_looser_limit_is_tried_before_a_tighter_one(
    sites: list[EditSite], text: str, old: str, looser: str, tighter: str
) -> None:
    usage = usage_of(sites)
    soon, late = (delay_of(*edit(sites, text, old, new), usage) for new in (looser, tighter))
    assert soon is not None and late is not None and soon < late


def test_a_name_of_the_type_of_the_other_side_is_likelier_than_one_of_another(tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(
        """int CARS = 3;
float LENGTH = 80.0;
class Ferry extends Timeline { predicate Load { int cars; } }
class Quay extends Timeline { predicate Trip { float miles; int wanted; float tons; } }
Quay::Trip {
    contains(Ferry.Load load);
    load.cars == miles;
}
"""
    )
    found = sites_of(load_graph(path, ()))
    usage = usage_of(found)
    whole, split = (edit(found, "load.cars == miles;", "miles", new) for new in ("wanted", "tons"))
    assert cost_of(*whole, usage) < cost_of(*split, usage)
    assert (delay_of(*whole, usage) or 0.0) < (delay_of(*split, usage) or 0.0)


def test_what_both_branches_say_is_hardly_meant(tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(
        """enum Gear { low, middle, high }
class Car extends Timeline { predicate Go { Gear gear; } }
class Job extends Timeline { predicate Trip { bool heavy; } }
Job::Trip {
    contains(Car.Go go);
    contains(Car.Go back);
    if (heavy) {
        go.gear == Gear.low;
        back.gear == Gear.low;
    } else {
        go.gear == Gear.low;
        back.gear == Gear.middle;
    }
}
"""
    )
    found = sites_of(load_graph(path, ()))
    usage = usage_of(found)
    twice = edit(found, "go.gear == Gear.low;", "Gear.low", "high")
    once = edit(found, "back.gear == Gear.low;", "Gear.low", "high")
    alike = edit(found, "back.gear == Gear.low;", "Gear.low", "middle")
    assert cost_of(*twice, usage) < cost_of(*once, usage)
    assert cost_of(*once, usage) <= cost_of(*alike, usage)


@pytest.mark.parametrize(("levels", "is_soon"), [("10.0, 80.0, 100.0", True), ("80.0, 10.0, 100.0", False)])
def test_the_levels_of_a_store_may_be_in_the_wrong_order(tmp_path: Path, levels: str, is_soon: bool) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(f'#include "Resources.nddl"\nReservoir store = new Reservoir({levels});\n')
    (site,) = sites_of(load_graph(path, ()))
    swapped = [one for one in site.edits if one.kind is EditKind.ARGUMENTS]
    assert [one.new for one in swapped] == [
        ", ".join(levels.split(", ")[k] for k in (1, 0)),
        ", ".join(levels.split(", ")[k] for k in (2, 1)),
    ]
    usage = usage_of([site])
    assert ((delay_of(swapped[0], site, usage) or 0.0) < 0.0) is is_soon


SEA = """#include "Resources.nddl"
float CURRENT = [0.1 0.9];
float CRUISE;
CRUISE = 1.2;
class Thruster extends Timeline { predicate Drive { float distance; } }
class Sonar extends Timeline { predicate Scan { } predicate Off { } }
Thruster::Drive {
    float current;
    float speed;
    float time;
    current == sampledParameter(CURRENT);
    speed == CRUISE * current;
    mulEq(speed, time, distance);
    duration == ceil(time);
    if (distance <= 9.0) {
        speed == CRUISE;
    }
    any(Reservoir.produce use);
    use.quantity == 20.0;
}
Sonar::Scan {
    float storing;
    int rest;
    storing == sampledParameter(CURRENT);
    contains(Thruster.Drive drive);
    rest == ceil(drive.distance);
    drive.start + rest == end;
}
Sonar::Off {
    contains(Thruster.Drive leg);
    leg.end + 3 == leg.end;
}
"""


@pytest.fixture
def sea(tmp_path: Path) -> list[EditSite]:
    """The sites of a simulator."""
    path = tmp_path / "sea.nddl"
    path.write_text(SEA)
    return sites_of(load_graph(path, ()))


@pytest.mark.parametrize(
    ("meant", "other"),
    [
        # `time` would be in one line alone, `storing` is in none but that which draws it.
        (("speed == CRUISE * current;", "*", "+"), ("duration == ceil(time);", "time", "distance")),
        (("rest == ceil(drive.distance);", "drive.distance", "storing"), ("CRUISE = 1.2;", "1.2", "12.0")),
        # Nothing else says what `rest` is.
        (("speed == CRUISE * current;", "*", "+"), ("rest == ceil(drive.distance);", "==", "<=")),
        # What is only filled is hardly meant.
        (("any(Reservoir.produce use);", "produce", "consume"), ("use.quantity == 20.0;", "20.0", "200.0")),
    ],
)
def test_a_change_is_likelier_that_leaves_nothing_unused_or_unsaid(
    sea: list[EditSite], meant: tuple[str, str, str], other: tuple[str, str, str]
) -> None:
    usage = usage_of(sea)
    assert cost_of(*edit(sea, *meant), usage) < cost_of(*edit(sea, *other), usage)


@pytest.mark.parametrize(
    "change",
    [
        ("drive.start + rest == end;", "drive.start", "drive.end"),  # two ends are related more often
        ("leg.end + 3 == leg.end;", "leg.end", "end"),  # the rule says nothing else of its own end
    ],
)
def test_an_end_is_likelier_meant_where_ends_are_spoken_of(sea: list[EditSite], change: tuple[str, str, str]) -> None:
    assert usage_of(sea).fitness(*edit(sea, *change)) > 0.0


def test_a_constraint_that_is_called_may_set_what_it_names(sea: list[EditSite]) -> None:
    usage = usage_of(sea)
    change, site = edit(sea, "speed == CRUISE * current;", "speed", "time")
    assert usage.mentions.gain(change, site) == 0.0


def test_a_number_is_tried_twice_as_large_soon_where_more_may_be_worse(sea: list[EditSite]) -> None:
    usage = usage_of(sea)
    twice, much = (delay_of(*edit(sea, "use.quantity == 20.0;", "20.0", new), usage) for new in ("40.0", "200.0"))
    assert twice is not None and much is not None and much < twice < 1.0


def test_a_zero_or_a_step_is_doubted_sooner_where_it_has_a_name(tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(
        """int SLIDE;
SLIDE = 0;
int STEP;
STEP = 1;
class Boat extends Timeline { predicate Go { int wait; int k; } predicate Stay { int wait; } }
Boat::Go { wait == 0; wait == k + 1; k <= STEP; }
Boat::Stay { wait == SLIDE; }
"""
    )
    found = sites_of(load_graph(path, ()))
    usage = usage_of(found)
    for old, new, name, bare in (("0", "5", "SLIDE = 0;", "wait == 0;"), ("1", "10", "STEP = 1;", "wait == k + 1;")):
        soon, late = (delay_of(*edit(found, text, old, new), usage) for text in (name, bare))
        assert soon is not None and late is not None and soon < late
    named, bare_zero = (edit(found, text, "0", "5") for text in ("SLIDE = 0;", "wait == 0;"))
    assert cost_of(*named, usage) < cost_of(*bare_zero, usage)


OWN = """class Row extends Timeline {
    int metres;
    int opens;
    int closes;
    float height;
    predicate Visit { int metres; }
    Row(int m, int o, int c, float h) { metres = m; opens = o; closes = c; height = h; }
}
Row::Visit { metres == object.closes; }
"""


def test_another_member_of_the_own_object_may_be_meant(tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(OWN)
    found = sites_of(load_graph(path, ()))
    site = named(found, "metres == object.closes;")
    others = [one for one in site.edits if one.old == "object.closes"]
    assert [one.new for one in others] == ["object.metres", "object.opens"]
    costs = [cost_of(one, site, usage_of(found)) for one in others]
    assert costs[0] < costs[1]  # it has the name of what is compared with it
