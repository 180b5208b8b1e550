"""A number that did its work before, a limit that mends alone, a limit in a sum, children in one order with a gap."""

from pathlib import Path

import pytest

from checker.counterfactual.dependence import Dependence
from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.usage import Usage, usage_of
from checker.mutation.additions import with_additions
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_file

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
float GAS = [0.9 1.1];
float RATE = 44.0;
float ROOM = 20.0;
float HOT = 250.0;
float CARGO = 80.0;
int PARTS = 40;
int HEAT_MAX = 70;
int WAIT_MAX = 40;
class Oven extends AgentTimeline {
  predicate Cold { }
  predicate Heat { float degrees; float load; }
  predicate Bake { int trays; }
  predicate Cool { int pieces; bool rye; }
  Oven(Mode m) { super(m, "Cold"); }
}
class Round extends AgentTimeline {
  predicate Rest { }
  predicate Batch { bool rye; int ship; int pieces; }
  Round(Mode m) { super(m, "Rest"); }
}
Round::Batch {
  float load;
  load == CARGO + WAIT_MAX;
  contains(Oven.Heat heat);
  heat.load == load;
  if (rye) {
    heat.degrees == HOT;
  }
  heat.duration <= HEAT_MAX;
  contains(Oven.Bake bake);
  bake.trays == PARTS;
  heat before bake;
  bake.start <= heat.end + WAIT_MAX;
  contains(Oven.Cool cool);
  cool.pieces == pieces;
  cool.end == end;
}
Oven::Heat {
  float gas;
  float rate;
  gas == sampledParameter(GAS);
  rate == RATE * gas;
  duration == ceil((degrees - ROOM));
}
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("model") / "m.nddl"
    path.write_text(MODEL, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def sites(path: Path) -> list[EditSite]:
    return with_additions(sites_of(load_graph(path, ())))


@pytest.fixture(scope="module")
def usage(sites: list[EditSite]) -> Usage:
    return usage_of(sites)


def edits(sites: list[EditSite], text: str) -> dict[str, tuple[SmallEdit, EditSite]]:
    """The edits of a line, each by what the line is then."""
    (site,) = (site for site in sites if site.text == text)
    return {" ".join(site.after(edit).split()): (edit, site) for edit in site.edits}


def test_a_number_is_proven_by_tokens_that_are_over_unless_a_condition_guards_it(
    path: Path, sites: list[EditSite]
) -> None:
    graph = Dependence([compile_model(analyse_file(path))], sites)
    assert {sites[one].named for one in graph.proven({"Heat"})} >= {"RATE", "ROOM"}
    assert {sites[one].named for one in graph.proven({"Heat"})}.isdisjoint({"HOT", "HEAT_MAX"})
    proven = {sites[one].named for one in graph.proven({"Heat", "Batch"})}
    assert "HEAT_MAX" in proven
    assert "HOT" not in proven


def test_a_limit_that_mends_alone_is_likelier_than_what_it_limits(sites: list[EditSite], usage: Usage) -> None:
    limit = edits(sites, "int HEAT_MAX = 70;")
    other = edits(sites, "int PARTS = 40;")
    assert cost_of(*limit["int HEAT_MAX = 140;"], usage) < cost_of(*other["int PARTS = 80;"], usage)
    assert cost_of(*limit["int HEAT_MAX = 7;"], usage) == cost_of(*other["int PARTS = 4;"], usage)  # it demands more


def test_a_limit_in_a_sum_that_is_no_time_is_too_much_there(sites: list[EditSite], usage: Usage) -> None:
    found = edits(sites, "load == CARGO + WAIT_MAX;")
    delays = {one: delay_of(*edit, usage) for one, edit in found.items()}
    assert min((delay, one) for one, delay in delays.items() if delay is not None)[1] == "load == CARGO;"
    assert cost_of(*found["load == CARGO;"], usage) < cost_of(*found["load == WAIT_MAX;"], usage)


def test_what_is_rounded_may_lack_a_factor_beside_its_parentheses(sites: list[EditSite]) -> None:
    assert "duration == ceil((degrees - ROOM) / rate);" in edits(sites, "duration == ceil((degrees - ROOM));")


def test_children_in_one_order_may_lack_a_relation_between_two(sites: list[EditSite]) -> None:
    added = [edit.new for site in sites for edit in site.edits if edit.kind is EditKind.LINE]
    assert " bake before cool;" in added
    assert " heat before bake;" not in added


def test_a_constant_that_is_written_is_hardly_a_variable(sites: list[EditSite], usage: Usage) -> None:
    found = edits(sites, "bake.trays == PARTS;")
    twice = edits(sites, "int PARTS = 40;")["int PARTS = 80;"]
    assert cost_of(*found["bake.trays == ship;"], usage) > cost_of(*twice, usage)
