"""Words for causes: one line for each term, as a modeler would write it."""

from math import inf

import pytest

from runtime.constraints.domains.tags import INF
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.plan import tags
from runtime.plan.readout.cause_rendering import words
from runtime.plan.readout.statements import ResourceTerm, Term
from runtime.plan.readout.terms import TermReader
from runtime.plan.tags import NONE
from tests.plan.models import loaded


@pytest.mark.parametrize(
    ("term", "line"),
    [
        (Term("precedence", ("a.end", "b.start", 0)), "b.start <= a.end"),
        (Term("precedence", ("a.end", "b.start", 3)), "b.start <= a.end + 3"),
        (Term("precedence", ("a.end", "b.start", -5)), "b.start + 5 <= a.end"),
        (Term("bounds", ("x", 3, 3)), "x = 3"),
        (Term("bounds", ("x", 1, 3)), "x in [1, 3]"),
        (Term("bounds", ("x", 0.5, inf)), "x >= 0.5"),
        (Term("bounds", ("x", -inf, 4)), "x <= 4"),
        (Term("bounds", ("x", -inf, inf)), "x may be anything"),
        (
            Term(
                "bounds",
                (
                    "x",
                    7,
                    7,
                ),
                ("red",),
            ),
            "x = red",
        ),
        (Term("bounds", ("x", 7, 9), ("green", "red")), "x in {green, red}"),
        (Term("eq", ("x", "y")), "x == y"),
        (Term("eq", ("x", "y", "z")), "eq(x, y, z)"),
        (Term("leq", (2, "x")), "2 <= x"),
        (Term("addEq", ("x", 1, "y")), "x + 1 == y"),
        (Term("temporalDistance", ("a.start", "a.duration", "a.end")), "a.start + a.duration == a.end"),
        (Term("mulEq", ("x", 2.5, "y")), "x * 2.5 == y"),
        (
            Term("foreach", ("g::d", "{a, b}")),
            "g::d may not lose a value any more: `foreach` has gone through {a, b}",
        ),
        (Term("sampledParameter", ("x", "RATE", 0.25)), "x = RATE = 0.25"),
        (Term("memberOf", ("t::r.to", "t::r", "a.to", "b.to"), ("a", "b")), "t::r.to is that of a or b"),
        (Term("memberOf", ("t::r.to", "t::r", "a.to"), ("a",)), "t::r.to is that of a"),
        (Term("allDiff", ("x", "y", 3)), "allDiff(x, y, 3)"),
    ],
)
def test_a_term_is_one_line(term: Term, line: str) -> None:
    assert words(term) == line


@pytest.mark.parametrize(("at", "when"), [(17, "at 17"), (INF, "in the end"), (INF - 5, "in the end")])
def test_a_level_that_is_too_low_at_no_certain_time_is_so_in_the_end(at: int, when: str) -> None:
    low = ResourceTerm("pond", tags.TOO_LOW, at, at, 100.0, 100.0, 900.0, True, False, ())
    assert words(low) == f"the level of pond falls to 0 {when}, its least is 100"
    users = (("Reservoir.consume#1", 900.0),)
    used = words(ResourceTerm("pond", tags.TOO_LOW, at, at, 100.0, 100.0, 900.0, True, False, users))
    alone = when if at == 17 else "by these uses alone"  # something may fill it in the end
    assert used == f"the level of pond falls to 0 {alone}, its least is 100: Reservoir.consume#1 900"
    assert "4503" not in words(ResourceTerm("pond", tags.TOO_LOW, at, at, 1.0, 100.0, 900.0, True, at > 17, ()))


FIELDS = """
class Field { }
Field a = new Field(); Field b = new Field(); Field c = new Field();
close();
Field one;
"""


@pytest.mark.parametrize(
    ("first", "last", "kept"), [("b", "", ("b", "c")), ("", "b", ("a", "b")), ("", "", ("a", "b", "c"))]
)
def test_a_bound_of_an_object_that_is_open_on_a_side_names_the_objects(
    first: str, last: str, kept: tuple[str, ...]
) -> None:
    database = loaded(FIELDS)
    names, engine = database.objects.names, database.engine
    v = next(int(v) for v in database.plan.globals if TermReader(database, str).variable(v) == "one")
    lower = float(names.index(first)) if first else -inf
    upper = float(names.index(last)) if last else inf
    assert engine.restrict_base(v, lower, upper, NONE, NONE)
    cause = Cause(CauseKind.RESTRICTION, engine.restriction_head[v], NONE, NONE)
    term = TermReader(database, str).term(cause)
    assert isinstance(term, Term)
    assert term.values == kept
