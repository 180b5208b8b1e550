"""Changes that nobody means, though a mission passes with them: they come behind what may be the mistake."""

import pytest

from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.usage import usage_of
from checker.mutation.additions import with_additions
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
enum Drop { forest, castle, sea }
float PACE = 2.0;
int REST_MAX = 20;
class Courier { int box; Drop drop; Courier(int b, Drop d) { box = b; drop = d; } }
class Batten extends AgentTimeline {
  predicate Hangs { }
  predicate Flies { float metres; float litres; bool up; }
  Batten(Mode m) { super(m, "Hangs"); }
}
class Show extends AgentTimeline {
  predicate Rests { }
  predicate Scene { int bags; Drop from; float length; }
  Show(Mode m) { super(m, "Rests"); }
}
Show::Scene {
  Courier courier;
  courier.box >= bags;
  courier.drop == from;
  contains(Batten.Flies out);
  contains(Batten.Flies back);
  out.up == true;
  out.up == false;
  duration <= REST_MAX;
}
Batten::Flies {
  duration == ceil(metres / PACE);
}
Reusable crew = new Reusable(2.0, 0.0);
Courier bike = new Courier(6, forest);
Courier van = new Courier(12, sea);
close();
"""


@pytest.fixture(scope="module")
def sites(tmp_path_factory: pytest.TempPathFactory) -> list[EditSite]:
    path = tmp_path_factory.mktemp("show") / "m.nddl"
    path.write_text(MODEL)
    return with_additions(sites_of(load_graph(path, ())))


def cost(sites: list[EditSite], text: str, old: str, new: str) -> float:
    found = [
        (edit, site) for site in sites for edit in site.edits if (site.text, edit.old, edit.new) == (text, old, new)
    ]
    ((edit, site),) = found
    return cost_of(edit, site, usage_of(sites))


def test_a_quotient_is_hardly_divided_once_more(sites: list[EditSite]) -> None:
    line = "duration == ceil(metres / PACE);"
    more, again = (cost(sites, line, "metres / PACE", f"metres / PACE {sign} litres") for sign in "*/")
    assert again > more + 3.0
    assert again > cost(sites, line, "/", "*")
    ((edit, site),) = [(one, site) for site in sites for one in site.edits if one.new == "metres / PACE / litres"]
    assert delay_of(edit, site, usage_of(sites)) == 3.0  # when all likelier changes have been tried


def test_a_limit_with_a_name_is_likelier_mistaken_than_what_an_object_is_made_of(sites: list[EditSite]) -> None:
    limit = cost(sites, "int REST_MAX = 20;", "20", "200")
    assert cost(sites, "Courier bike = new Courier(6, forest);", "6", "60") > limit + 1.0
    assert cost(sites, "Reusable crew = new Reusable(2.0, 0.0);", "2.0", "20.0") < limit + 1.0


def test_a_goal_need_not_ask_for_what_an_object_is_made_of_where_lines_only_compare_it(sites: list[EditSite]) -> None:
    usage = usage_of(sites)

    def wished(text: str, old: str, new: str) -> float:
        edit = SmallEdit(EditKind.GOAL, "mission.toml", text.index(old), text.index(old) + len(old), old, new, 1)
        return cost_of(edit, EditSite("mission.toml", 1, 1, 1, "", (1, 1), text, (edit,)), usage)

    assert wished("bags = 5", "5", "12") == wished("bags = 5", "5", "7")  # a box must hold as many
    assert wished('from = "castle"', '"castle"', '"sea"') < wished('from = "castle"', '"castle"', '"moon"')


def test_the_lower_of_two_lines_was_copied_and_not_changed(sites: list[EditSite]) -> None:
    copied = {site.text for site in sites for edit in site.edits if (edit.begin, edit.new) in site.wanted}
    assert copied == {"out.up == false;"}
