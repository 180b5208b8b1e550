"""What a line may mean, by the other lines of its model: types, parentheses, what the owner tells, what is the same."""

from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.moments import with_durations
from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.turns import Turns
from checker.counterfactual.usage import Usage, usage_of
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_file
from nddl_lang.text.read import real_path

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
float FLOW = [0.3 0.6];
float HEAVY = 0.8;
float DRIVE = 36.0;
float WASTE = 0.9;
int CHANGE_MAX = 110;
int REST_MAX = 20;
class Stage extends AgentTimeline {
  predicate Still { }
  predicate Turn { float tonnes; int seats; bool late; bool full; }
  predicate Act { float tonnes; float load; int seats; }
  Stage(Mode m) { super(m, "Still"); }
}
Stage::Act {
  float kept;
  contains(Stage.Turn turn);
  kept == tonnes * WASTE;
  turn.tonnes == kept;
  turn.end == kept;
  turn.seats == seats;
  turn.start <= CHANGE_MAX;
  duration <= REST_MAX;
}
Stage::Turn {
  float flow;
  float speed;
  bool slow;
  flow == sampledParameter(FLOW);
  slow == (flow > HEAVY);
  full == slow;
  late == seats;
  speed == DRIVE / (tonnes * flow);
  start == ceil(speed) + REST_MAX;
}
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("model") / "m.nddl"
    path.write_text(MODEL, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def sites(path: Path) -> list[EditSite]:
    return with_durations(sites_of(load_graph(path, ())))


@pytest.fixture(scope="module")
def usage(sites: list[EditSite]) -> Usage:
    return usage_of(sites)


def edits(sites: list[EditSite], text: str) -> dict[str, tuple[SmallEdit, EditSite]]:
    """The edits of a line, each by what the line is then."""
    (site,) = (site for site in sites if site.text == text)
    return {" ".join(site.after(edit).split()): (edit, site) for edit in site.edits if edit.kind is not EditKind.LINE}


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("late == seats;", ("late == slow;", "late == full;")),
        ("turn.end == kept;", ("turn.end == end;",)),
        ("start == ceil(speed) + REST_MAX;", ("duration == ceil(speed) + REST_MAX;",)),
    ],
)
def test_what_cannot_be_compared_is_put_right_first(
    sites: list[EditSite], usage: Usage, text: str, meant: tuple[str, ...]
) -> None:
    found = edits(sites, text)
    delays = {one: delay_of(*edit, usage) for one, edit in found.items()}
    assert min((delay, one) for one, delay in delays.items() if delay is not None)[1] in meant


def test_what_a_rule_computes_may_be_how_long_it_lasts(tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(MODEL.replace("late == seats;", "duration == speed;"), encoding="utf-8")
    found = edits(sites_of(load_graph(path, ())), "duration == speed;")
    assert "tonnes == speed;" not in found


def test_a_limit_without_another_moment_bounds_how_long(sites: list[EditSite], usage: Usage) -> None:
    found = edits(sites, "turn.start <= CHANGE_MAX;")
    assert cost_of(*found["turn.duration <= CHANGE_MAX;"], usage) < cost_of(*found["turn.end <= CHANGE_MAX;"], usage)
    away = edits(sites, "duration <= REST_MAX;")
    assert not any(one.startswith(("start", "end")) for one in away)


def test_parentheses_that_nothing_needs_speak_for_a_quotient(sites: list[EditSite], usage: Usage) -> None:
    found = edits(sites, "speed == DRIVE / (tonnes * flow);")
    times, plus = found["speed == DRIVE * (tonnes * flow);"], found["speed == DRIVE + (tonnes * flow);"]
    assert min(usage.formulas.odds(*times), usage.formulas.odds(*plus)) > 0.5


def test_a_line_is_not_missed_that_says_what_the_owner_tells(sites: list[EditSite], usage: Usage) -> None:
    (site,) = (site for site in sites if site.text == "contains(Stage.Turn turn);")
    told = [one for one in site.edits if one.kind is EditKind.LINE and one.new.startswith(" turn.full ==")]
    assert told
    assert all(delay_of(one, site, usage) == 3.0 for one in told)


def test_no_variable_is_set_from_what_is_the_same(sites: list[EditSite], usage: Usage) -> None:
    found = edits(sites, "kept == tonnes * WASTE;")
    circle, other = found["kept == turn.tonnes * WASTE;"], found["kept == load * WASTE;"]
    assert cost_of(*circle, usage) > cost_of(*other, usage) + 5.0


def test_the_range_of_a_draw_is_hardly_meant_as_a_number(sites: list[EditSite], usage: Usage) -> None:
    found = edits(sites, "slow == (flow > HEAVY);")
    assert cost_of(*found["slow == (flow > FLOW);"], usage) > cost_of(*found["slow == (flow > WASTE);"], usage) + 2.0


def test_beside_a_line_are_the_numbers_that_the_lines_beside_it_read(path: Path, sites: list[EditSite]) -> None:
    graph = Dependence([compile_model(analyse_file(path))], sites)
    (site,) = (site for site in sites if site.text == "turn.tonnes == kept;")
    assert "WASTE" in {one.named for one in graph.beside(site)}
    assert {one.file for one in graph.beside(site)} == {str(real_path(path))}


def test_a_rate_is_multiplied_or_divided_and_hardly_added(tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    text = MODEL.replace("WASTE", "DRIP_RATE").replace("tonnes * DRIP_RATE", "tonnes - DRIP_RATE")
    path.write_text(text, encoding="utf-8")
    sites = sites_of(load_graph(path, ()))
    usage, found = usage_of(sites), edits(sites, "kept == tonnes - DRIP_RATE;")
    divided, added = found["kept == tonnes / DRIP_RATE;"], found["kept == tonnes + DRIP_RATE;"]
    assert cost_of(*divided, usage) < cost_of(*added, usage)


def test_a_product_that_fails_alike_does_not_speak_against_a_quotient(sites: list[EditSite]) -> None:
    found = edits(sites, "kept == tonnes * WASTE;")
    (times, site), (renamed, _) = found["kept == tonnes / WASTE;"], found["kept == load * WASTE;"]
    turns = Turns(lambda _: ())
    candidate = Candidate(site, 0.0, Suspicion.CONFLICT)
    for edit in (times, renamed):
        turns.add(0.0, candidate, edit)
        turns.doubt(site, edit.begin)
    assert [turns.pop()[2] for _ in range(2)] == [times, renamed]


CRANE = """#include "TREX.nddl"
/// Tonnes%s that are counted on.
float SLOWEST = 16.0;
/// Ticks%s.
int PAUSE = 24;
class Crane extends AgentTimeline {
  predicate Still { }
  predicate Drain { float tonnes; }
  predicate Fill { float tonnes; }
  Crane(Mode m) { super(m, "Still"); }
}
class Work extends AgentTimeline {
  predicate Idle { }
  predicate Move { float tonnes; int ticks; }
  Work(Mode m) { super(m, "Idle"); }
}
Work::Move {
  contains(Crane.Drain drain);
  contains(Crane.Fill fill);
  fill.end + 3 <= drain.start;
  duration <= tonnes / SLOWEST;
  ticks <= PAUSE : "no more than %d ticks";
}
"""


def crane_cost(
    folder: Path, kind: EditKind, line: str, new: str, per: str = "", told: int = 7, said: str = ""
) -> float:
    """What it costs to write something into a line, by what comments and a message say."""
    (folder / "m.nddl").write_text(CRANE % (per, said, told), encoding="utf-8")
    found = sites_of(load_graph(folder / "m.nddl", ()))
    usage = usage_of(found)
    return min(cost_of(edit, site, usage) for site, edit in edits_of(found, kind, line) if edit.new == new)


def edits_of(sites: list[EditSite], kind: EditKind, line: str) -> list[tuple[EditSite, SmallEdit]]:
    return [(site, edit) for site in sites if site.text == line for edit in site.edits if edit.kind is kind]


def test_what_a_comment_calls_so_much_per_something_is_hardly_added(tmp_path: Path) -> None:
    line = "duration <= tonnes / SLOWEST;"
    costs = [crane_cost(tmp_path, EditKind.FORMULA, line, "+", per=per) for per in ("", " per tick")]
    assert costs[1] > costs[0] + 0.5


@pytest.mark.parametrize(("told", "said"), [(24, ""), (7, ", 24 at most")])
def test_a_number_that_a_comment_or_a_message_names_is_hardly_wrong(told: int, said: str, tmp_path: Path) -> None:
    line = "int PAUSE = 24;"
    costs = [crane_cost(tmp_path, EditKind.CONSTANT, line, "48"), 0.0]
    costs[1] = crane_cost(tmp_path, EditKind.CONSTANT, line, "48", told=told, said=said)
    assert costs[1] > costs[0] + 1.0


def test_tokens_of_a_limit_come_in_the_order_in_which_they_are_asked_for(tmp_path: Path) -> None:
    turned = crane_cost(tmp_path, EditKind.TURN, "fill.end + 3 <= drain.start;", "drain.end + 3 <= fill")
    assert turned < crane_cost(tmp_path, EditKind.COMPARISON, "fill.end + 3 <= drain.start;", ">=") - 1.0
