"""z3 judges conflicts from their terms alone, and finds where they begin."""

from dataclasses import replace
from fractions import Fraction

import pytest

from checker.proofs.conflict import Finding, confirm
from checker.simplest import shortest_decimal, simplest_between
from checker.smt.edges import RangeEnd, find_failing_range
from runtime.executive.outcome import Conflict, ConflictElement, ElementKind
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.statements import Argument, Term
from tests.checker.fake_agent import linked_conflict, split_conflict


def conflict(kinds: dict[str, str], *terms: Term) -> Conflict:
    def operand(given: Argument) -> Argument:
        return VariableName(given, kinds[given]) if isinstance(given, str) and given in kinds else given

    named = [replace(term, arguments=tuple(operand(one) for one in term.arguments)) for term in terms]
    return Conflict(tuple(ConflictElement(ElementKind.CONSTRAINT, None, "", None, term, (term,)) for term in named))


def test_a_real_conflict_is_confirmed_with_its_core() -> None:
    found = confirm(linked_conflict(3.95))
    assert found.finding is Finding.CONFIRMED
    # That start + duration = end is what a token is, no cause.
    causes = [n for n, one in enumerate(linked_conflict(3.95).elements) if one.terms[0].name != "temporalDistance"]
    assert found.core == tuple(causes)
    assert len(causes) == 6
    assert confirm(split_conflict(3.95)).finding is Finding.CONFIRMED


def test_a_conflict_that_can_hold_is_not_confirmed() -> None:
    assert confirm(linked_conflict(3.7)).finding is Finding.REFUTED


def test_the_core_leaves_out_what_does_not_matter() -> None:
    bystander = conflict({"SURFACE_MAX": "int"}, Term("leq", ("SURFACE_MAX", 1000)))
    padded = Conflict((*bystander.elements, *linked_conflict(3.95).elements))
    assert confirm(padded).core == tuple(number + 1 for number in confirm(linked_conflict(3.95)).core)


def test_terms_without_translation_are_named() -> None:
    found = confirm(conflict({"x": "int"}, Term("ll_dist", ("x", "x")), Term("bounds", ("x", 3, 2))))
    assert found.finding is Finding.CONFIRMED
    assert found.untranslated == ("ll_dist",)
    assert found.core == (1,)


@pytest.mark.parametrize(
    ("kinds", "terms"),
    [
        ({"x": "int"}, [Term("lt", ("x", 3)), Term("lt", (2, "x"))]),
        ({"x": "bool"}, [Term("neq", ("x", 0)), Term("neq", ("x", 1))]),
        ({"x": "symbol"}, [Term("eq", ("x", "RED")), Term("eq", ("x", "BLUE"))]),
        ({"x": "int"}, [Term("divEq", (7, 2, "x"))]),
        ({"x": "int"}, [Term("ceil", ("x", 2.1)), Term("neq", ("x", 3))]),
        ({"x": "float"}, [Term("sqrt", ("x", 2.0)), Term("leq", ("x", 1.414))]),
        ({"d": "float"}, [Term("calcDistance", ("d", 0.0, 0.0, 3.0, 4.0)), Term("neq", ("d", 5))]),
        ({"b": "bool", "x": "int"}, [Term("testLeq", ("b", "x", 3)), Term("eq", ("x", 4)), Term("or", ("b",))]),
        ({"x": "int"}, [Term("eqMaximum", ("x", 1, 2, 3)), Term("leq", ("x", 2))]),
        ({"x": "int"}, [Term("countNonZeroes", ("x", 0, 1, 2)), Term("leq", ("x", 1))]),
        (
            {"x": "symbol"},
            [Term("bounds", ("x", 3, 7), ("RED", "BLUE")), Term("neq", ("x", "RED")), Term("neq", ("x", "BLUE"))],
        ),
        ({"x": "int"}, [Term("precedence", ("x", "x", -1))]),
    ],
)
def test_constraints_mean_what_the_table_says(kinds: dict[str, str], terms: list[Term]) -> None:
    assert confirm(conflict(kinds, *terms)).finding is Finding.CONFIRMED
    assert confirm(conflict(kinds, *terms[1:])).finding is Finding.REFUTED or len(terms) == 1


def test_the_threshold_of_the_hit_rate_is_exact() -> None:
    found = find_failing_range(linked_conflict(3.95), "GPS_HIT_RATE", 3.95, (-4.0, 8.0))
    assert found is not None
    assert found.below == RangeEnd(Fraction(19, 5), is_safe=True, is_proved=True)
    assert found.above is None


def test_an_open_edge_is_told_from_a_closed_one() -> None:
    terms = [Term("sampledParameter", ("x", "P", 0.25)), Term("lt", (0.5, "x"))]
    found = find_failing_range(conflict({"x": "float"}, *terms), "P", 0.25, (0.0, 1.0))
    assert found is not None
    assert found.above == RangeEnd(Fraction(1, 2), is_safe=False, is_proved=True)
    assert found.below is None


def test_a_failing_band_has_two_edges() -> None:
    terms = [
        Term("sampledParameter", ("x", "P", 0.5)),
        Term("mulEq", ("y", "y", "z")),
        Term("addEq", ("y", 0.5, "x")),
        Term("leq", (0.04, "z")),
    ]
    found = find_failing_range(conflict({"x": "float", "y": "float", "z": "float"}, *terms), "P", 0.5, (0.0, 1.0))
    assert found is not None
    assert found.below is not None
    assert found.above is not None
    assert float(found.below.value) == pytest.approx(0.3, abs=1e-8)
    assert float(found.above.value) == pytest.approx(0.7, abs=1e-8)


def test_another_parameter_has_no_threshold_there() -> None:
    assert find_failing_range(linked_conflict(3.95), "CURRENT", 0.1, (-1.0, 1.0)) is None


def test_the_simplest_number_between_two() -> None:
    assert simplest_between(Fraction(3799, 1000), Fraction(3801, 1000)) == Fraction(19, 5)
    assert simplest_between(Fraction(-1, 3), Fraction(1, 7)) == 0
    assert simplest_between(Fraction(-27, 10), Fraction(-26, 10)) == Fraction(-8, 3)
    assert simplest_between(Fraction(5, 2), Fraction(7, 2)) == 3
    assert shortest_decimal(3.7912, 3.8123) == 3.8
    assert shortest_decimal(-1.26, -1.24) == -1.25
