"""A model in, its sites and small edits out; texts change in memory only."""

from pathlib import Path

import pytest

from checker.counterfactual.bounds import sets_value
from checker.counterfactual.usage import usage_of
from checker.mutation.choice import mutants_of
from checker.mutation.edits import EditSite, SmallEdit, edited, sites_of
from checker.mutation.kinds import REPAIRS, EditKind
from checker.mutation.variant import load_graph, open_over, with_edit

MODEL = """class T extends Timeline { predicate P { int n; n <= 9; } }
int MOST;
int LEAST;
MOST = 20;
T::P {
    contains(T.P child);
    duration <= MOST;
    if (n == 3) {
        child.n >= n - 1;
    } else {
        leq(child.n, n);
    }
}
"""


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """A model in a file."""
    path = tmp_path / "m.nddl"
    path.write_text(MODEL)
    return path


def sites(path: Path) -> list[EditSite]:
    return sites_of(load_graph(path, ()))


def changes(path: Path, text: str) -> dict[EditKind, set[str]]:
    """What the edits of a line put in the place of what they take, by kind."""
    (site,) = (site for site in sites(path) if site.text == text)
    found: dict[EditKind, set[str]] = {}
    for edit in site.edits:
        found.setdefault(edit.kind, set()).add(edit.new)
    return found


def test_every_line_that_may_be_mistaken_is_a_site(model: Path) -> None:
    found = [(site.first, site.rule, site.text) for site in sites(model) if site.edits]
    assert found == [
        (1, "T.P", "n <= 9;"),
        (4, "", "MOST = 20;"),
        (6, "T.P", "contains(T.P child);"),
        (7, "T.P", "duration <= MOST;"),
        (8, "T.P", "n == 3"),
        (9, "T.P", "child.n >= n - 1;"),
        (11, "T.P", "leq(child.n, n);"),
    ]
    assert [(site.text, site.scope) for site in sites(model) if site.is_rule] == [("T::P", (5, 13))]


def test_each_kind_of_edit_is_made_where_it_fits(model: Path) -> None:
    assert changes(model, "duration <= MOST;") == {
        EditKind.LIMIT: {"LEAST"},
        EditKind.COMPARISON: {">=", "==", "<"},
        EditKind.NAME: {"n", "child.n"},
        EditKind.DROPPED_CONSTRAINT: {""},
    }
    assert changes(model, "child.n >= n - 1;")[EditKind.SIGN] == {"+"}
    assert EditKind.OPERATOR not in changes(model, "child.n >= n - 1;")
    assert changes(model, "leq(child.n, n);")[EditKind.ARGUMENTS] == {"n, child.n"}
    assert changes(model, "MOST = 20;")[EditKind.OFF_BY_ONE] == {"19", "21"}
    assert changes(model, "n == 3")[EditKind.DROPPED_BRANCH] == {""}
    assert "meets" in changes(model, "contains(T.P child);")[EditKind.RELATION]
    assert EditKind.DROPPED_CONSTRAINT not in changes(model, "contains(T.P child);")


def test_an_edit_changes_what_it_says_and_no_line_moves(model: Path) -> None:
    lines = MODEL.splitlines()
    for site in sites(model):
        for edit in site.edits:
            assert MODEL[edit.begin : edit.end] == edit.old != edit.new
            after = edited(MODEL, edit).splitlines()
            assert len(after) == len(lines)
            assert {k for k, line in enumerate(after, 1) if line != lines[k - 1]} <= set(range(site.first, 13))


def test_edits_are_made_in_memory_one_after_the_other(model: Path) -> None:
    one, other = (
        next(edit for site in sites(model) if site.text == text for edit in site.edits if edit.new == new)
        for text, new in (("MOST = 20;", "21"), ("n <= 9;", "10"))
    )
    text = open_over(with_edit(with_edit((), one), other))(model)
    assert text == MODEL.replace("MOST = 20", "MOST = 21").replace("n <= 9", "n <= 10")
    assert model.read_text() == MODEL


def test_mutants_take_turns_of_kinds_and_differ_by_seed(model: Path) -> None:
    def drawn(seed: int) -> list[SmallEdit]:
        return [mutant.edit for mutant in mutants_of(sites(model), seed)]

    everything = drawn(1)
    assert len({edit.kind for edit in everything[:9]}) == 9
    made = [edit for site in sites(model) for edit in site.edits if edit.kind not in REPAIRS]
    assert len(set(everything)) == len(everything) == len(made)
    assert drawn(1) == everything != drawn(2)


TURNED = """class T extends Timeline { predicate P { float a; float b; float c; } }
T::P {
    contains(T.P one);
    contains(T.P two);
    one starts_before two;
    one before [1 5] two;
    mulEq(a, b, c);
    divEq(a, b, c);
}
"""


def test_a_relation_is_turned_round_and_a_result_changes_places_with_what_it_comes_from(tmp_path: Path) -> None:
    path = tmp_path / "t.nddl"
    path.write_text(TURNED)
    assert "starts_after" in changes(path, "one starts_before two;")[EditKind.RELATION]
    assert changes(path, "one before [1 5] two;")[EditKind.RELATION] == {"after"}
    constants = changes(path, "one before [1 5] two;")[EditKind.CONSTANT]
    assert {"2", "50"} <= constants and "6" not in constants  # no interval is left without a value
    assert changes(path, "mulEq(a, b, c);")[EditKind.ARGUMENTS] == {"c, b, a", "c, b"}  # a times b is b times a
    assert changes(path, "divEq(a, b, c);")[EditKind.ARGUMENTS] == {"b, a", "c, b, a", "c, b"}


@pytest.mark.parametrize(
    ("demand", "sets"), [("mulEq(a, b, c);", True), ("a == b;", True), ("leq(a, b);", False), ("a <= b;", False)]
)
def test_a_demand_that_gives_a_value_is_known(demand: str, sets: bool) -> None:
    assert sets_value(demand) is sets


def test_what_a_constructor_reads_is_read(tmp_path: Path) -> None:
    path = tmp_path / "tank.nddl"
    path.write_text(
        "float LEAST = 0.0; float IDLE = 9.0;\n"
        "class Tank { Reservoir fuel; Tank(float level) { fuel = new Reservoir(level, LEAST, 100.0); } }\n"
        "Tank tank = new Tank(30.0);\n"
    )
    usage = usage_of(sites(path))
    assert usage.is_idle("IDLE")
    assert not usage.is_idle("LEAST")
