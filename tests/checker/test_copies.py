"""Lines that were copied, swapped or written beside what says the same: the text itself tells what was meant."""

from dataclasses import replace
from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.ranking import Claim, RankedLine
from checker.counterfactual.rendering import claim_text
from checker.counterfactual.smallness import cost_of, delay_of, is_loosening
from checker.counterfactual.turns import Turns
from checker.counterfactual.usage import Usage, usage_of
from checker.mission import read_mission
from checker.mutation.additions import with_additions
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.mission_edits import mission_sites
from checker.mutation.variant import load_graph
from runtime.executive.outcome import SourcePlace

pytestmark = pytest.mark.once

MODEL = """enum Depth { low, high }
float HOT = 70.0;
float COLD = 35.0;
float SHARE = 0.5;
float RATE = [1.0 2.0];
int WAIT = 9;
class Gate extends Timeline {
    predicate Still { }
    predicate Fill { float litres; int pipes; float degrees; Depth depth; }
}
class Basin { int number; float size; bool old; Basin(int n, float s, bool o) { number = n; size = s; old = o; } }
class Times { int number; int opens; int shuts; Times(int n, int o, int s) { number = n; opens = o; shuts = s; } }
class Lock extends Timeline { predicate Pass { int number; bool warm; bool late; } }
Reservoir lake = new Reservoir(80.0, 10.0, 100.0);
Reservoir sea = new Reservoir(90.0, 10.0, 100.0);
Lock::Pass {
    Basin one;
    Basin two;
    one.number == number;
    two.number == 3;
    contains(Gate.Fill first);
    contains(Gate.Fill second);
    first.litres == one.size;
    first.pipes == 4;
    first.pipes == 5;
    first.degrees == COLD;
    if (warm) {
        first.degrees == HOT;
        first.depth == low;
    } else {
        first.degrees == COLD;
        first.depth == high;
    }
    if (two.old) {
        first.litres == two.size * SHARE;
    } else {
        second.litres == two.size;
    }
    first before second;
    second.start <= first.start + WAIT;
    any(Reservoir.consume use);
    use.object == sea;
    use.time == end;
    one.size == true;
    use.quantity == one.size * SHARE + WAIT;
    start <= summer.shuts;
    duration <= 90;
}
Gate::Fill {
    float rate;
    rate == sampledParameter(RATE);
    duration == rate;
    if (depth == low) {
        litres <= 9.0;
    }
    degrees <= 90.0;
}
Lock::Pass {
    Basin one;
    contains(Gate.Fill second);
    second.litres == one.size * HOT + WAIT;
}
Basin upper = new Basin(1, 20.0, false);
Times spring = new Times(1, 50, 90);
Times summer = new Times(2, 10, 40);
Times autumn = new Times(3, 100, 140);
"""


@pytest.fixture
def sites(tmp_path: Path) -> list[EditSite]:
    """The sites of the model."""
    path = tmp_path / "m.nddl"
    path.write_text(MODEL)
    return with_additions(sites_of(load_graph(path, ())))


@pytest.fixture
def usage(sites: list[EditSite]) -> Usage:
    return usage_of(sites)


def line(sites: list[EditSite], text: str) -> EditSite:
    return next(site for site in sites if site.text == text)


def edit(site: EditSite, kind: EditKind, new: str) -> SmallEdit:
    return next(one for one in site.edits if one.kind is kind and one.new == new)


def is_seen(one: SmallEdit, site: EditSite, usage: Usage) -> bool:
    """Whether an edit is tried before all others and costs as much as what no flight must tell."""
    return delay_of(one, site, usage) == -1.0


def test_a_name_that_is_set_twice_was_copied(sites: list[EditSite], usage: Usage) -> None:
    site = line(sites, "first.pipes == 5;")
    assert is_seen(edit(site, EditKind.NAME, "second.pipes"), site, usage)
    assert not is_seen(edit(site, EditKind.NAME, "number"), site, usage)


def test_what_the_other_branch_sets_is_meant_where_another_name_is_set_twice(
    sites: list[EditSite], usage: Usage
) -> None:
    site = line(sites, "first.litres == two.size * SHARE;")
    assert is_seen(edit(site, EditKind.NAME, "second.litres"), site, usage)
    right = line(sites, "second.litres == two.size;")
    assert not is_seen(edit(right, EditKind.NAME, "first.litres"), right, usage)


def test_what_both_branches_say_is_not_said_before(sites: list[EditSite], usage: Usage) -> None:
    outer = next(site for site in sites if site.text == "first.degrees == COLD;")
    assert outer.first < line(sites, "first.degrees == HOT;").first
    gone = edit(outer, EditKind.DROPPED_CONSTRAINT, "")
    assert is_seen(gone, outer, usage)
    assert not is_loosening(gone, outer)
    inner = line(sites, "first.degrees == HOT;")
    assert is_loosening(edit(inner, EditKind.DROPPED_CONSTRAINT, ""), inner)


def test_branches_may_have_each_what_the_other_one_says(sites: list[EditSite]) -> None:
    site = line(sites, "first.degrees == HOT;")
    swap = next(one for one in site.edits if one.kind is EditKind.SWAP)
    assert swap.old.startswith("HOT") and swap.new.startswith("COLD") and swap.new.endswith("HOT")
    place = SourcePlace("m.nddl", swap.line, 1, site.text)
    told = claim_text(RankedLine(place, "Lock.Pass", Claim.MENDS, swap, helped=1, missions=1))
    assert told.startswith(f"exchange `HOT` here and `COLD` in line {swap.line + 3}:")


def test_where_branches_say_one_thing_their_condition_is_meant(sites: list[EditSite]) -> None:
    assert all(one.kind is not EditKind.SWAP for one in line(sites, "second.litres == two.size;").edits)


def test_rows_of_a_table_that_are_put_in_order_were_swapped(sites: list[EditSite], usage: Usage) -> None:
    rows = line(sites, "Times spring = new Times(1, 50, 90);")
    swap = next(one for one in rows.edits if one.kind is EditKind.SWAP)
    assert rows.after(swap).startswith("Times spring = new Times(1, 10, 40)")
    assert is_seen(swap, rows, usage)
    others = line(sites, "Times summer = new Times(2, 10, 40);")
    assert not is_seen(next(one for one in others.edits if one.kind is EditKind.SWAP), others, usage)


def test_another_object_and_a_member_of_another_one_may_be_meant(sites: list[EditSite], usage: Usage) -> None:
    used = line(sites, "use.object == sea;")
    assert edit(used, EditKind.NAME, "lake")
    shuts = {one.new for one in line(sites, "start <= summer.shuts;").edits if one.kind is EditKind.NAME}
    assert {"summer.opens", "spring.shuts", "autumn.shuts"} <= shuts
    size = line(sites, "first.litres == one.size;")
    assert edit(size, EditKind.NAME, "two.size")
    assert edit(line(sites, "two.old"), EditKind.NAME, "one.old")
    key = line(sites, "one.number == number;")
    assert usage.mentions.merges(edit(key, EditKind.NAME, "two.number"), key)  # who declares two objects wants two
    assert not usage.mentions.merges(edit(key, EditKind.NAME, "WAIT"), key)


def test_what_an_object_is_made_of_may_be_another_value(tmp_path: Path) -> None:
    path = tmp_path / "v.nddl"
    path.write_text(
        "enum Soil { clay, chalk }\nclass Street { Soil below; Street(Soil b) { below = b; } }\n"
        "Street market = new Street(clay);\n"
    )
    (site,) = [one for one in sites_of(load_graph(path, ())) if one.named == "market"]
    assert edit(site, EditKind.VALUE, "chalk")


def test_a_number_that_the_token_brings_along_is_missed_where_nothing_reads_it(sites: list[EditSite]) -> None:
    site = line(sites, "duration == rate;")
    added = {one.new for one in site.edits if one.kind is EditKind.MISSING}
    assert "rate * pipes" in added
    assert not any("degrees" in one for one in added)


def test_an_upper_bound_ends_no_token(sites: list[EditSite]) -> None:
    asked = line(sites, "contains(Gate.Fill second);")
    assert edit(asked, EditKind.LINE, " second.end == end;")


def test_numbers_that_branches_tell_apart_are_not_the_same(sites: list[EditSite], usage: Usage) -> None:
    site = line(sites, "float HOT = 70.0;")
    same, other = edit(site, EditKind.CONSTANT, "35.0"), edit(site, EditKind.CONSTANT, "140.0")
    assert cost_of(same, site, usage) > cost_of(other, site, usage) + 1.0


def test_a_wait_counts_from_the_end_of_what_comes_before(sites: list[EditSite], usage: Usage) -> None:
    site = line(sites, "second.start <= first.start + WAIT;")
    assert is_seen(edit(site, EditKind.POINT, "first.end"), site, usage)
    assert not is_seen(edit(site, EditKind.POINT, "second.end"), site, usage)


def test_a_truth_value_stands_beside_a_truth_value(sites: list[EditSite], usage: Usage) -> None:
    site = line(sites, "one.size == true;")
    assert site.is_apart
    assert delay_of(edit(site, EditKind.NAME, "warm"), site, usage) < 0.0  # type: ignore[operator]


def test_what_another_line_computes_is_meant(sites: list[EditSite], usage: Usage) -> None:
    site = line(sites, "second.litres == one.size * HOT + WAIT;")
    assert is_seen(edit(site, EditKind.LIMIT, "SHARE"), site, usage)
    assert not is_seen(edit(site, EditKind.LIMIT, "COLD"), site, usage)


def test_another_value_of_a_condition_is_not_doubted_where_one_changed_nothing(sites: list[EditSite]) -> None:
    turns = Turns(lambda _: ())
    site = line(sites, "depth == low")
    value, sign = edit(site, EditKind.VALUE, "high"), next(one for one in site.edits if one.kind is EditKind.COMPARISON)
    candidate = Candidate(site, 0.0, Suspicion.CONFLICT)
    for at, one in ((0.5, value), (0.6, sign)):
        turns.add(at, candidate, one)
    turns.doubt(site, value.begin)
    assert turns.pop()[2] is value


def test_tokens_come_as_they_are_asked_for(sites: list[EditSite], usage: Usage) -> None:
    site = line(sites, "first before second;")
    turned, other = edit(site, EditKind.RELATION, "after"), edit(site, EditKind.RELATION, "meets")
    assert usage.orders.as_written(turned, site) == -1 and usage.orders.as_written(other, site) == 0


def test_a_whole_number_is_hardly_meant_for_a_real_one(sites: list[EditSite], usage: Usage) -> None:
    site = line(sites, "second.litres == two.size;")
    assert (edit(site, EditKind.NAME, "second.pipes").begin, "second.pipes") in site.unlike
    assert (edit(site, EditKind.NAME, "first.litres").begin, "first.litres") not in site.unlike


def test_it_is_said_of_how_many_missions_some_were_tried() -> None:
    cause = RankedLine(SourcePlace("m.nddl", 1, 1, "x"), "", Claim.EVADES, None, helped=3, missions=3, among=18)
    assert "all 3 failed missions tried (of 18) pass then" in claim_text(cause)
    assert "(of" not in claim_text(replace(cause, among=3))


MISSION = """[mission]
name = "lock"
final_tick = 100
[[reactor]]
name = "keeper"
model = "lock.nddl"
latency = 1
lookahead = 90
internal = ["lock"]
"""


@pytest.mark.parametrize(
    ("numbers", "wanted"),
    [
        ((1, 1, 3), {1: {"2"}}),
        ((1, 2, 3), {}),
        ((4, 4, 4), {1: {"5", "3"}, 2: {"5", "3"}}),
        ((2, 2), {1: {"3", "1"}}),
    ],
)
def test_a_goal_that_has_the_number_of_another_was_copied(
    tmp_path: Path, numbers: tuple[int, ...], wanted: dict[int, set[str]]
) -> None:
    goals = "".join(
        f'[[goal]]\ntimeline = "lock"\npredicate = "Pass"\n[goal.parameters]\nnumber = {number}\n' for number in numbers
    )
    (tmp_path / "lock.nddl").write_text(MODEL)
    (tmp_path / "mission.toml").write_text(MISSION + goals)
    mission, found = read_mission(tmp_path / "mission.toml")
    assert mission is not None, found
    asked = {
        number: {new for _, new in site.wanted}
        for (table, number), found in mission_sites(mission).items()
        for site in found
        if table == "asked" and site.wanted
    }
    assert asked == wanted
