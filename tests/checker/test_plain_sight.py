"""What a careful reader sees in a model without a flight makes a change likelier, and is tried sooner."""

from pathlib import Path

import pytest

from checker.counterfactual.bounds import Directions
from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.numbers import between
from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.turns import Turns
from checker.counterfactual.usage import Usage, usage_of
from checker.counterfactual.word_odds import compared
from checker.mission import read_mission
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.mission_edits import mission_sites
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
int CALM = [10 20];
int BED_SPACING = 4;
int EACH = 16;
int HEAD = 2;
class Window { int opens; int closes; Window(int a, int b) { opens = a; closes = b; } }
class Gap { int number; int opens; int closes; Gap(int n, int a, int b) { number = n; opens = a; closes = b; } }
class Pen { int number; float fish; Pen(int n, float f) { number = n; fish = f; } }
class Wind extends AgentTimeline {
  predicate Calm { int left; }
  predicate Gusty { int left; }
  Wind(Mode m) { super(m, "Calm"); }
}
class Cart extends AgentTimeline {
  predicate Drive { int bed; int plants; int metres; int data; }
  Cart(Mode m) { super(m, "undefined"); }
}
Cart::Drive {
  starts_during(Wind.Gusty calm);
  calm.left >= bed - plants;
  metres == plants * BED_SPACING;
  data == plants * HEAD + EACH;
  metres <= 90;
  data == ceil(1.3 * plants * (1.0 - 0.5 * bed));
}
Wind::Calm { duration == CALM; meets(object.Gusty g); }
Window morning = new Window(10, 20);
Window noon = new Window(40, 30);
Window evening = new Window(50, 60);
Gap first = new Gap(1, 5, 25);
Gap second = new Gap(2, 45, 30);
Gap third = new Gap(3, 50, 60);
Pen north = new Pen(1, 60.0);
Pen south = new Pen(120, 2.0);
"""


@pytest.fixture
def sites(tmp_path: Path) -> list[EditSite]:
    path = tmp_path / "m.nddl"
    path.write_text(MODEL)
    return sites_of(load_graph(path, ()))


def change(sites: list[EditSite], text: str, kind: EditKind, new: str) -> tuple[SmallEdit, EditSite]:
    (site,) = (site for site in sites if site.text == text)
    return next((edit, site) for edit in site.edits if (edit.kind, edit.new) == (kind, new))


def cost(sites: list[EditSite], usage: Usage, text: str, kind: EditKind, new: str) -> float:
    return cost_of(*change(sites, text, kind, new), usage)


def test_operands_change_places_in_a_difference_and_between_a_product_and_what_is_added(sites: list[EditSite]) -> None:
    def exchanged(text: str) -> set[str]:
        (site,) = (site for site in sites if site.text == text)
        return {edit.new for edit in site.edits if edit.kind is EditKind.ARGUMENTS}

    assert exchanged("calm.left >= bed - plants;") == {"plants - bed"}
    assert exchanged("data == plants * HEAD + EACH;") == {"EACH + HEAD", "EACH * HEAD + plants"}
    assert exchanged("metres == plants * BED_SPACING;") == set()  # a product says the same in any order


def test_a_name_is_likelier_beside_a_constant_that_bears_it(sites: list[EditSite]) -> None:
    usage = usage_of(sites)
    line = "metres == plants * BED_SPACING;"
    (site,) = (site for site in sites if site.text == line)
    costs = {edit.new: cost_of(edit, site, usage) for edit in site.edits if edit.old == "plants"}
    assert costs["bed"] < min(costs[other] for other in ("calm.left", "data"))


def test_a_predicate_is_likelier_that_its_token_is_called_by(sites: list[EditSite]) -> None:
    usage = usage_of(sites)
    line = "starts_during(Wind.Gusty calm);"
    assert cost(sites, usage, line, EditKind.PREDICATE, "Calm") < 2.0
    assert cost(sites, usage, "meets(object.Gusty g);", EditKind.PREDICATE, "Calm") > 2.0


def test_an_object_that_is_made_the_other_way_round_is_seen_without_a_flight(sites: list[EditSite]) -> None:
    usage = usage_of(sites)
    turned = change(sites, "Window noon = new Window(40, 30);", EditKind.ARGUMENTS, "30, 40")
    usual = change(sites, "Window morning = new Window(10, 20);", EditKind.ARGUMENTS, "20, 10")
    assert usage.directions.is_put_in_order(*turned) and not usage.directions.is_put_in_order(*usual)
    assert delay_of(*turned, usage) == -1.0
    mixed = change(sites, "Pen south = new Pen(120, 2.0);", EditKind.ARGUMENTS, "2, 120.0")
    assert delay_of(*mixed, usage) == -1.0


@pytest.mark.parametrize(("new", "is_right"), [("30, 45", True), ("45, 2", False)])
def test_an_object_of_three_numbers_with_two_the_other_way_round_is_seen_too(
    sites: list[EditSite], new: str, is_right: bool
) -> None:
    directions = usage_of(sites).directions
    assert (
        directions.is_put_in_order(*change(sites, "Gap second = new Gap(2, 45, 30);", EditKind.ARGUMENTS, new))
        is is_right
    )


def test_a_number_of_a_formula_is_less_likely_wrong_than_a_limit_and_the_one_of_a_share_hardly(
    sites: list[EditSite],
) -> None:
    usage, formula = usage_of(sites), "data == ceil(1.3 * plants * (1.0 - 0.5 * bed));"
    costs = [
        cost(sites, usage, line, EditKind.CONSTANT, new) for line, new in (("metres <= 90;", "180"), (formula, "2.6"))
    ]
    whole = change(sites, formula, EditKind.CONSTANT, "2.0")
    assert costs[0] < costs[1] < cost_of(*whole, usage) - 1.0
    assert delay_of(*whole, usage) == 3.0


def test_what_others_are_to_lie_within_had_better_be_long(sites: list[EditSite]) -> None:
    named = {site.named for site in sites if site.named}
    held = [*sites, *_with_child(sites, "contained_by(Wind.Calm c);")]
    (calm,) = (site for site in sites if site.named == "EACH")
    edit = next(edit for edit in calm.edits if edit.kind is EditKind.CONSTANT)
    limit = EditSite(calm.file, 40, 1, 40, "Wind.Calm", (40, 41), "duration == EACH;", ())
    assert Directions([*sites, limit], named, is_late=True).of(edit, calm) == -1
    assert Directions([*held, limit], named, is_late=True).of(edit, calm) == 1


def _with_child(sites: list[EditSite], text: str) -> list[EditSite]:
    return [EditSite(sites[0].file, 50, 1, 50, "Cart.Drive", (50, 51), text, ())]


def test_where_a_relation_left_out_changes_nothing_its_line_is_doubted_but_not_its_order() -> None:
    kinds = ((EditKind.RELATION, 4, "meets"), (EditKind.TOKEN, 11, "c"), (EditKind.RELATION, 4, "after"))
    edits = tuple(SmallEdit(kind, "a.nddl", begin, begin + 6, "before", new, 1) for kind, begin, new in kinds)
    line = Candidate(EditSite("a.nddl", 1, 1, 1, "", (1, 1), "a before b;", edits), 0.0, Suspicion.CONFLICT)
    turns = Turns(lambda _: ())
    for edit in edits:
        turns.add(0.0, line, edit)
    turns.doubt(line.site, None)
    waits = {edit.new: at for at, _, edit in (turns.pop() for _ in edits)}
    assert waits["after"] == 0.0 < waits["meets"] == waits["c"]


def test_a_goal_may_come_as_soon_as_the_one_before_it(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text(MODEL.replace("Wind::Calm { duration == CALM;", "Wind::Calm {"))
    goals = "".join(
        f'[[goal]]\ntimeline = "wind"\npredicate = "Calm"\nstart = [{low}, {high}]\n'
        for low, high in ((5, 40), (90, 95))
    )
    (tmp_path / "mission.toml").write_text(
        '[mission]\nname = "wind"\nfinal_tick = 100\n[[reactor]]\nname = "keeper"\nmodel = "m.nddl"\n'
        f'internal = ["wind"]\nlookahead = 100\n{goals}[check]\nmissions = 1\n'
    )
    mission, found = read_mission(tmp_path / "mission.toml")
    assert mission is not None, found
    times = [[edit.new for edit in mission_sites(mission)["goal", number][0].edits] for number in (0, 1)]
    assert times == [["[0, 100]", "[5, 100]"], ["[0, 100]", "[40, 95]", "[90, 100]"]]


def test_a_part_of_a_sum_or_product_is_left_out_sooner_where_both_parts_are_one_name(tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(
        "class T extends Timeline { predicate P { int n; int m; } }\n"
        "T::P { contains(T.P c); c.n == n + n; c.m == m * n; duration == (n + m) * c.n; duration >= n / m; }\n"
    )
    found = sites_of(load_graph(path, ()))
    usage = usage_of(found)
    left = {site.text: {e.new for e in site.edits if e.kind is EditKind.TERM} for site in found if site.edits}
    assert left["c.n == n + n;"] == {"n"}
    assert left["c.m == m * n;"] == {"m", "n"}
    assert left["duration == (n + m) * c.n;"] == {"(n + m)", "n", "m"}
    assert left["duration >= n / m;"] == {"n"}
    twice, once = (change(found, text, EditKind.TERM, "n") for text in ("c.n == n + n;", "c.m == m * n;"))
    assert cost_of(*twice, usage) < cost_of(*once, usage)
    sooner, later = delay_of(*twice, usage), delay_of(*once, usage)
    assert sooner is not None and later is not None and sooner < later


def test_a_comparison_that_is_written_as_a_call_is_read_as_one(tmp_path: Path) -> None:
    assert compared("leq(speed, MOST);") == "    speed<=MOST ;"
    assert compared("eq(a,b);") == "eq(a,b);"  # no room for a sign between its operands
    path = tmp_path / "m.nddl"
    path.write_text(
        "int MOST = 4;\n"
        "class T extends Timeline { predicate P { int n; } }\n"
        "T::P { contains(T.P c); eq(c.n, MOST); before(T.P d); d.n == MOST; leq(n, MOST); }\n"
    )
    found = sites_of(load_graph(path, ()))
    usage = usage_of(found)
    for line in ("eq(c.n, MOST);", "d.n == MOST;"):
        (site,) = (site for site in found if site.text == line)
        assert [edit.old for edit in site.edits if edit.new == "n" and usage.is_fitting(edit, site)] == ["MOST"]
    (site,) = (site for site in found if site.text == "leq(n, MOST);")
    assert {usage.directions.of(edit, site) for edit in site.edits if edit.old == "MOST"} == {1}


def test_a_duration_that_is_rounded_is_set_and_not_bounded(sites: list[EditSite]) -> None:
    rounded = SmallEdit(EditKind.COMPARISON, "/m.nddl", 9, 11, "==", "<=", 1)
    odds = [
        usage_of(sites).odds(rounded, EditSite("/m.nddl", 1, 1, 1, "T.P", (1, 2), text, (rounded,)))
        for text in ("duration == ceil(time);", "duration == limit;")
    ]
    assert odds[0] > odds[1]


def test_a_number_is_changed_less_where_a_large_change_is_as_bad_in_another_way(sites: list[EditSite]) -> None:
    (site,) = (site for site in sites if site.named == "EACH")
    large = {edit.new: edit for edit in site.edits if edit.kind is EditKind.CONSTANT}
    assert [edit.new for edit in between(large["160"], site)] == ["32", "64"]
    assert [edit.new for edit in between(large["2"], site)] == ["8", "4"]
    assert between(large["32"], site) == []


@pytest.mark.parametrize("is_apart", [True, False])
def test_what_another_rule_computes_tells_what_is_meant_and_what_another_branch_does_not(
    is_apart: bool, tmp_path: Path
) -> None:
    end = "}\nBath::Rinse { float time; time == tank.soaking * drift; " if is_apart else " else { SOAK }"
    rule = "Bath::Soak { float time; if (deep) { time == tank.washing * drift; }" + end
    (tmp_path / "m.nddl").write_text(
        "class Tank { int soaking; int washing; Tank(int a, int b) { soaking = a; washing = b; } }\n"
        "Tank tank = new Tank(40, 70);\n"
        "class Bath extends Timeline { predicate Soak { bool deep; float drift; } predicate Rinse { float drift; } }\n"
        + rule.replace("SOAK", "time == tank.soaking * drift;")
        + " duration == ceil(time); }\n"
    )
    found = sites_of(load_graph(tmp_path / "m.nddl", ()))
    usage = usage_of(found)
    delay = delay_of(*change(found, "time == tank.washing * drift;", EditKind.NAME, "tank.soaking"), usage)
    assert delay is not None
    assert (delay == -1.0) is is_apart  # seen without any flight


def test_a_number_that_its_comment_names_is_likelier_meant(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text(
        "/// Twelve ticks, or more in winter.\n"
        "int VENTING = 120;\n"
        "int PUMPING = 120;  // 60 in summer\n"
        "int MOVING = 120;\n"
        "// One wafer at a time: the operator brings ten litres.\n"
        "Lock::Refill { duration == PUMPING; gain.quantity == 1.0; }\n"
        "class Lock extends Timeline { predicate Refill { int a; } }\n"
    )
    found = sites_of(load_graph(tmp_path / "m.nddl", ()))
    noted = {site.text: {new for _, new in site.noted} for site in found if site.noted}
    assert noted == {
        "int VENTING = 120;": {"12"},
        "int PUMPING = 120;": {"60"},
        "gain.quantity == 1.0;": {"10.0"},
    }
    usage = usage_of(found)
    told, other = (cost(found, usage, f"int {name} = 120;", EditKind.CONSTANT, "12") for name in ("VENTING", "MOVING"))
    assert told < other
