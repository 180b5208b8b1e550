"""Arguments of the project's own functions: the name of the argument tells what is meant, if a model has that name."""

from dataclasses import replace
from pathlib import Path

import pytest

from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.usage import usage_of
from checker.mutation.arguments import with_arguments
from checker.mutation.edits import sites_of
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
class Envelope extends AgentTimeline {
  predicate Drifts { }
  predicate Climbs { float metres; float ballast; int bags; int frames; }
  Envelope(Mode m) { super(m, "Drifts"); }
}
Envelope::Climbs {
  ballast == 2.0 + sand_for(CALL);
  holds(ballast, frames);
  eq(bags, frames);
}
"""
PYTHON = """from runtime.user.constraint import function, Constraint


class Holds(Constraint):
    name = "holds"
    signature = "ballast:number bags:number"
    meaning = "the bags hold it"


def sand_for(metres, per):
    return metres / per


CONSTRAINTS = [Holds(), function("sand_for", "metres:number per:number", "float", sand_for, "the ballast of a climb")]
"""


def wanted(folder: Path, call: str, python: str = PYTHON) -> set[tuple[str, str]]:
    path = folder / "m.nddl"
    path.write_text(MODEL.replace("CALL", call))
    sites = with_arguments(sites_of(load_graph(path, ())), [python])
    edits = {(edit.old, edit.new) for site in sites for edit in site.edits if (edit.begin, edit.new) in site.wanted}
    usage = usage_of(sites)
    for site in sites:
        for edit in (one for one in site.edits if (one.begin, one.new) in site.wanted):
            assert cost_of(edit, site, usage) < cost_of(edit, replace(site, wanted=frozenset()), usage)
            assert delay_of(edit, site, usage) == -1.0
            assert usage.is_fitting(edit, site)
    return edits


@pytest.mark.parametrize(
    ("call", "found"),
    [
        ("frames, 0.1", {("frames", "metres")}),
        ("frames + 1.0, 0.1", set()),  # a part of an argument
        ("metres, 0.1", set()),
        ("0.1, frames", set()),  # nothing is called `per`
        ("abs(frames), 0.1", set()),  # an argument of a function that is built in
        ("max(1.0, metres), frames", set()),
    ],
)
def test_an_argument_is_meant_that_bears_the_name_which_the_function_gives_it(
    call: str, found: set[tuple[str, str]], tmp_path: Path
) -> None:
    assert wanted(tmp_path, call) == found | {("frames", "bags")}


def test_a_module_that_tells_nothing_leaves_all_as_it_was(tmp_path: Path) -> None:
    assert wanted(tmp_path, "frames, 0.1", "CONSTRAINTS = made()\n") == set()
    assert wanted(tmp_path, "frames, 0.1", PYTHON.replace('"holds"', '"before"')) == set()
