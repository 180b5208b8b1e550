"""The tables of relations, constraints and functions agree with each other."""

import pytest

from nddl_lang.semantics.constraints import CONSTRAINTS, FORMER_CONSTRAINTS
from nddl_lang.semantics.functions import FUNCTIONS, FunctionRow, ResultKind
from nddl_lang.semantics.natives import NATIVE_CLASSES
from nddl_lang.semantics.relations import REFUSED_RELATIONS, RELATIONS, Distance, DurationRule, Point, RelationRow
from nddl_lang.semantics.signature import signature

SWAPPED = {
    Point.ORIGIN_START: Point.TARGET_START,
    Point.ORIGIN_END: Point.TARGET_END,
    Point.TARGET_START: Point.ORIGIN_START,
    Point.TARGET_END: Point.ORIGIN_END,
}
SHORTER = {
    DurationRule.TARGET_SHORTER: DurationRule.ORIGIN_SHORTER,
    DurationRule.ORIGIN_SHORTER: DurationRule.TARGET_SHORTER,
}


def holds(row: RelationRow, origin: tuple[int, int], target: tuple[int, int]) -> bool:
    """Whether two tokens with these times stand in the relation."""
    times = dict(zip(Point, (*origin, *target), strict=True))
    return all(each.lower <= times[each.later] - times[each.earlier] <= each.upper for each in row.distances)


def test_the_grammar_knows_23_words_for_relations() -> None:
    assert len(RELATIONS) + len(REFUSED_RELATIONS) == 23
    assert all(meant in RELATIONS for meant in REFUSED_RELATIONS.values())


@pytest.mark.parametrize("row", RELATIONS.values(), ids=RELATIONS.keys())
def test_a_relation_is_its_inverse_the_other_way_round(row: RelationRow) -> None:
    assert row.inverse is not None
    inverse = RELATIONS[row.inverse]
    assert RELATIONS[inverse.inverse or ""] is row
    swapped = {Distance(SWAPPED[each.earlier], SWAPPED[each.later], each.lower, each.upper) for each in row.distances}
    if row.name not in ("starts", "ends", "equals"):
        assert swapped == set(inverse.distances)
    assert SHORTER.get(row.duration, row.duration) is inverse.duration


@pytest.mark.parametrize(
    ("name", "target", "expected"),
    [
        ("before", (20, 25), True),
        ("before", (19, 25), False),
        ("meets", (20, 30), True),
        ("contains", (10, 20), True),
        ("contains", (9, 15), False),
        ("starts_during", (5, 10), False),
        ("starts_during", (10, 11), True),
        ("ends_during", (20, 25), False),
        ("ends_during", (19, 20), True),
        ("contains_end", (0, 20), True),
        ("contains_end", (0, 10), False),
        ("starts_before", (10, 30), False),
        ("ends_after", (0, 20), False),
    ],
)
def test_a_relation_of_the_origin_from_10_to_20(name: str, target: tuple[int, int], expected: bool) -> None:
    assert holds(RELATIONS[name], (10, 20), target) is expected


@pytest.mark.parametrize("row", FUNCTIONS.values(), ids=FUNCTIONS.keys())
def test_a_function_is_a_constraint_whose_result_stands_first(row: FunctionRow) -> None:
    constraint = CONSTRAINTS[row.constraint]
    if row.name != "rand":  # its argument is there because a call needs one
        assert constraint.result == 0
        assert constraint.signature.accepts(row.signature.minimum + 1)
    if row.result is ResultKind.BOOL:
        assert constraint.signature.required[0].kind.name == "BOOL"


def test_former_names_lead_to_names_of_today() -> None:
    assert [name for name, today in FORMER_CONSTRAINTS.items() if today is not None and today not in CONSTRAINTS] == []
    assert [name for name in FORMER_CONSTRAINTS if name in CONSTRAINTS] == []


def test_an_alias_takes_what_its_other_name_takes() -> None:
    for row in CONSTRAINTS.values():
        if row.alias_of is not None:
            assert CONSTRAINTS[row.alias_of].signature is row.signature


def test_native_classes_extend_each_other_up_to_the_root() -> None:
    assert [native.base for native in NATIVE_CLASSES.values()] == [
        None,
        "Object",
        "Object",
        "Object",
        "Object",
        "Object",
    ]


def test_a_signature_reads_as_a_user_writes_it() -> None:
    places = signature("b:bool x:same y?:same rest*:number")
    assert places.text == "b, x, [y], rest..."
    assert (places.minimum, places.maximum, places.count_text) == (2, None, "at least 2 arguments")
    assert signature("").count_text == "no arguments"
    assert signature("a:any b?:any").count_text == "1 to 2 arguments"
