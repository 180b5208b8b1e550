"""The temporal relations: what each demands of the times of its two tokens, as data."""

from dataclasses import dataclass
from enum import Enum

from nddl_lang.semantics.schema import INFINITY


class Point(Enum):
    """A time of one of the two tokens of a relation; an event has its `time` at both ends."""

    ORIGIN_START = "origin.start"
    ORIGIN_END = "origin.end"
    TARGET_START = "target.start"
    TARGET_END = "target.end"


@dataclass(frozen=True, slots=True)
class Distance:
    """`lower` <= time of `later` - time of `earlier` <= `upper`."""

    earlier: Point
    later: Point
    lower: int
    upper: int


class DurationRule(Enum):
    """What a relation demands of the durations beside the times (it follows from the times)."""

    NONE = "none"
    EQUAL = "origin.duration == target.duration"
    TARGET_SHORTER = "target.duration <= origin.duration"
    ORIGIN_SHORTER = "origin.duration <= target.duration"


@dataclass(frozen=True, slots=True)
class RelationRow:
    """One relation, read as `origin NAME target`.

    `distances` stand in the order in which relation bounds are written (dialect nddlc): a bound replaces
    `lower` and `upper` of its distance. `inverse` is the relation that says the same with the tokens swapped.
    """

    name: str
    distances: tuple[Distance, ...]
    duration: DurationRule
    inverse: str | None
    meaning: str
    europa: str | None = None


_OS, _OE, _TS, _TE = Point
_NO, _SAME = DurationRule.NONE, DurationRule.EQUAL


def _same(one: Point, other: Point) -> Distance:
    return Distance(one, other, 0, 0)


def _order(earlier: Point, later: Point) -> Distance:
    return Distance(earlier, later, 0, INFINITY)


def _strict(earlier: Point, later: Point) -> Distance:
    return Distance(earlier, later, 1, INFINITY)


_CONTAINS_END_QUIRK = "EUROPA demands `origin.end <= target.end` in place of `target.end <= origin.end`."

_ROWS = (
    RelationRow("any", (), _NO, "any", "The target exists; nothing is said about its times."),
    RelationRow("before", (_order(_OE, _TS),), _NO, "after", "The origin ends no later than the target starts."),
    RelationRow("after", (_order(_TE, _OS),), _NO, "before", "The target ends no later than the origin starts."),
    RelationRow("meets", (_same(_OE, _TS),), _NO, "met_by", "The target starts when the origin ends."),
    RelationRow("met_by", (_same(_TE, _OS),), _NO, "meets", "The origin starts when the target ends."),
    RelationRow("starts", (_same(_OS, _TS),), _NO, "starts", "Both start at the same time."),
    RelationRow("ends", (_same(_OE, _TE),), _NO, "ends", "Both end at the same time."),
    RelationRow("equals", (_same(_OS, _TS), _same(_OE, _TE)), _SAME, "equals", "Both start and end together."),
    RelationRow(
        "contains",
        (_order(_OS, _TS), _order(_TE, _OE)),
        DurationRule.TARGET_SHORTER,
        "contained_by",
        "The target lies within the origin.",
    ),
    RelationRow(
        "contained_by",
        (_order(_TS, _OS), _order(_OE, _TE)),
        DurationRule.ORIGIN_SHORTER,
        "contains",
        "The origin lies within the target.",
    ),
    RelationRow(
        "parallels",
        (_order(_OS, _TS), _order(_OE, _TE)),
        _NO,
        "paralleled_by",
        "The origin starts no later and ends no later than the target.",
    ),
    RelationRow(
        "paralleled_by",
        (_order(_TS, _OS), _order(_TE, _OE)),
        _NO,
        "parallels",
        "The target starts no later and ends no later than the origin.",
    ),
    RelationRow("starts_before", (_strict(_OS, _TS),), _NO, "starts_after", "The origin starts before the target."),
    RelationRow("starts_after", (_strict(_TS, _OS),), _NO, "starts_before", "The origin starts after the target."),
    RelationRow(
        "starts_before_end", (_strict(_OS, _TE),), _NO, "ends_after_start", "The origin starts before the target ends."
    ),
    RelationRow(
        "starts_during",
        (_order(_TS, _OS), _strict(_OS, _TE)),
        _NO,
        "contains_start",
        "The origin starts while the target holds.",
    ),
    RelationRow("ends_before", (_strict(_OE, _TE),), _NO, "ends_after", "The origin ends before the target."),
    RelationRow("ends_after", (_strict(_TE, _OE),), _NO, "ends_before", "The origin ends after the target."),
    RelationRow(
        "ends_after_start", (_strict(_TS, _OE),), _NO, "starts_before_end", "The origin ends after the target starts."
    ),
    RelationRow(
        "ends_during",
        (_strict(_TS, _OE), _order(_OE, _TE)),
        _NO,
        "contains_end",
        "The origin ends while the target holds.",
    ),
    RelationRow(
        "contains_start",
        (_order(_OS, _TS), _strict(_TS, _OE)),
        _NO,
        "starts_during",
        "The target starts while the origin holds.",
    ),
    RelationRow(
        "contains_end",
        (_strict(_OS, _TE), _order(_TE, _OE)),
        _NO,
        "ends_during",
        "The target ends while the origin holds.",
        _CONTAINS_END_QUIRK,
    ),
)

RELATIONS: dict[str, RelationRow] = {row.name: row for row in _ROWS}

# A word of the grammar that names no relation: EUROPA parses it and then refuses it.
REFUSED_RELATIONS: dict[str, str] = {"equal": "equals"}
