"""Minimal conflicts: what an explanation prints contradicts itself by the model's text, and every part is needed."""

import os
from dataclasses import replace
from itertools import islice
from pathlib import Path

import pytest

from checker.proofs.conflict import Finding, confirm, needed_elements
from checker.proofs.places import ModelText
from runtime.executive.outcome import Conflict, ElementKind
from tests.checker.conditions.campaigns import RANGES, campaign, flown
from tests.checker.mutant_conflicts import conflicts_of_mutants

pytestmark = pytest.mark.once

ROOT = Path(__file__).parents[2]
GPS = ROOT / "models" / "gps" / "mission.toml"
# All 10^3 conflicts of the goal: NDDLC_PROOFS=1000.
MOST = int(os.environ.get("NDDLC_PROOFS", "40"))


@pytest.fixture(scope="module")
def conflicts() -> list[tuple[Conflict, ModelText]]:
    return list(islice(conflicts_of_mutants(GPS, MOST, 4 if MOST < 500 else 10), MOST))


def test_each_printed_conflict_contradicts_itself_and_needs_every_part(
    conflicts: list[tuple[Conflict, ModelText]],
) -> None:
    assert len(conflicts) == MOST
    for conflict, text in conflicts:
        found = confirm(conflict, text)
        assert found.finding is Finding.CONFIRMED
        assert found.is_minimal
        assert not found.untranslated
        shown = Conflict(tuple(conflict.elements[number] for number in needed_elements(conflict, found)))
        assert confirm(shown, text).core == tuple(range(len(shown.elements)))
        for dropped in range(len(shown.elements)):
            rest = tuple(one for number, one in enumerate(shown.elements) if number != dropped)
            assert confirm(replace(shown, elements=rest), text).finding is Finding.REFUTED


def test_the_meaning_of_each_line_is_read_off_the_text(conflicts: list[tuple[Conflict, ModelText]]) -> None:
    for conflict, text in conflicts:
        found = confirm(conflict, text)
        lines = [number for number in found.core if conflict.elements[number].place is not None]
        assert found.written >= len(lines) > 0


def test_the_text_counts_and_not_what_the_engine_says_of_it(conflicts: list[tuple[Conflict, ModelText]]) -> None:
    conflict, text = next(
        (conflict, text)
        for conflict, text in conflicts
        if any(one.kind is ElementKind.ASSIGNMENT for one in conflict.elements)
    )
    elements = []
    for one in conflict.elements:
        if one.kind is ElementKind.ASSIGNMENT:
            (term,) = one.terms
            one = replace(one, terms=(replace(term, arguments=(term.arguments[0], 10**6, 10**6)),))
        elements.append(one)
    lie = Conflict(tuple(elements))
    assert confirm(lie).finding is Finding.REFUTED
    assert confirm(lie, text).finding is Finding.CONFIRMED


@pytest.mark.parametrize("model", ["models/templates/battery", "tests/checker/unseen/quay"])
def test_conflicts_over_resources_are_confirmed_from_the_line_that_makes_them(model: str) -> None:
    path = ROOT / model / "mission.toml"
    found = [
        (conflict, text)
        for conflict, text in islice(conflicts_of_mutants(path, 12, 2), 24)
        if any(one.kind is ElementKind.RESOURCE for one in conflict.elements)
    ]
    assert found
    for conflict, text in found:
        answer = confirm(conflict, text)
        assert answer.finding is Finding.CONFIRMED and answer.is_minimal and not answer.untranslated
        shown = tuple(conflict.elements[number] for number in answer.core)
        for dropped in range(len(shown)):
            rest = Conflict(tuple(one for number, one in enumerate(shown) if number != dropped))
            assert confirm(rest, text).finding is Finding.REFUTED


def test_a_limit_of_a_resource_is_read_off_the_text() -> None:
    path = ROOT / "models/templates/battery/mission.toml"
    for conflict, text in conflicts_of_mutants(path, 12, 2):
        elements = [
            replace(one, terms=(replace(one.terms[0], arguments=(one.terms[0].arguments[0], -1e3, -1e3)),))
            if one.place is not None and one.place.text.startswith("new Reservoir") and "Min" in str(one.variables[0])
            else one
            for one in conflict.elements
        ]
        lie = Conflict(tuple(elements))
        if lie != conflict and confirm(conflict, text).finding is Finding.CONFIRMED:
            assert confirm(lie, text).finding is Finding.CONFIRMED
            assert confirm(lie).finding is Finding.REFUTED
            return
    pytest.fail("no conflict over the least level")


def test_a_draw_that_is_a_time_itself_is_told_to_z3_as_such(tmp_path: Path) -> None:
    """`duration == sampledParameter(S)` has no variable of the rule's own: z3 was told that it cannot hold."""
    given = campaign(tmp_path, "duration == sampledParameter(S);", ranges=f"{RANGES} int S = [5 9];", missions=1)
    (failed,) = flown(given)
    confirmation = given.story(failed, None).confirmation
    assert confirmation is not None and confirmation.finding is Finding.CONFIRMED
    assert len(confirmation.core) == 2 and confirmation.written == 2
