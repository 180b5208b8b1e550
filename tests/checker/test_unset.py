"""A constant that was given no value is named where it is declared, and one with a value is not."""

from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.loose_ends import loose_ends
from checker.counterfactual.smallness import usage_of
from checker.mutation.edits import sites_of
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """int LONG;
int SHORT;
int NEVER;
float GIVEN = 3.0;
SHORT = 3;
class T extends Timeline { predicate P { } }
T::P { duration <= LONG; duration >= SHORT; start >= GIVEN; }
"""


def test_a_constant_without_a_value_is_named_where_it_is_declared(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text(MODEL, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "m.nddl", ()))
    candidates = [Candidate(site, 0.25, Suspicion.CONFLICT) for site in sites]
    found = loose_ends(Dependence((), sites), candidates, usage_of(sites))
    assert [(one.candidate.site.first, one.variable) for one in found if one.is_unset] == [(1, "LONG")]
