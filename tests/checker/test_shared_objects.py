"""One object that two models of a mission make with other numbers: each may have the other one's, before any flight."""

from pathlib import Path

import pytest

from checker.counterfactual.smallness import delay_of, first_edits
from checker.counterfactual.usage import usage_of
from checker.mutation.edits import sites_of
from checker.mutation.shared_objects import with_shared
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
class Batten extends AgentTimeline {
  predicate Hangs { }
  float metres;
  float kilos;
  Batten(Mode m, float l, float k) { super(m, "Hangs"); metres = l; kilos = k; }
}
Batten one = new Batten(MODE, METRES, 90.0);
Batten two = new Batten(MODE, 12.0, KILOS);
"""


def wanted(folder: Path, *files: tuple[str, str, str]) -> set[tuple[str, str, str]]:
    sites = []
    for number, words in enumerate(files):
        path = folder / f"m{number}.nddl"
        text = MODEL
        for word, value in zip(("MODE", "METRES", "KILOS"), words, strict=True):
            text = text.replace(word, value)
        path.write_text(text)
        sites += sites_of(load_graph(path, ()))
    sites = with_shared(sites)
    usage = usage_of(sites)
    found = [(site, edit) for site in sites for edit in site.edits if (edit.begin, edit.new) in site.wanted]
    assert all(delay_of(edit, site, usage) == -1.0 for site, edit in found)
    assert all(first_edits(site, usage)[0][1] == edit for site, edit in found)  # before its numbers change places
    assert all(site.after(edit).startswith(f"Batten {site.named} = new Batten(") for site, edit in found)
    return {(Path(edit.file).stem, edit.old, edit.new) for _, edit in found}


def test_the_number_of_the_other_model_may_be_meant(tmp_path: Path) -> None:
    own, other = ("Internal", "100.0", "140.0"), ("External", "10.0", "140.0")
    assert wanted(tmp_path, own, other) == {("m0", "100.0", "10.0"), ("m1", "10.0", "100.0")}


@pytest.mark.parametrize("metres", ["10.0", "10", "-METRES", "LENGTH"])
def test_what_is_the_same_or_no_number_is_left_alone(metres: str, tmp_path: Path) -> None:
    assert wanted(tmp_path, ("Internal", "10.0", "140.0"), ("External", metres, "140.0")) == set()
