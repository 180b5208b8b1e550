"""How small an edit is as a repair, and how soon it is worth a trial, before anything is known of it."""

import math
import re
from collections import Counter
from collections.abc import Container, Sequence
from dataclasses import dataclass

from checker.mutation.edits import DROPPED, EditKind, EditSite, SmallEdit

_WORD = re.compile(r"[A-Za-z_]\w*")
_LOOSE = "any"  # the relation that demands nothing
_EQUAL, _UNEQUAL = ("==", "eq"), ("!=", "neq")
_COMMON = ("contains", "contained_by", "before", "meets", "met_by")
_TIMES = ("start", "end", "duration")
_DROP = 2.5
_NUMERIC = (EditKind.CONSTANT, EditKind.OFF_BY_ONE)
_MOST_FOLLOW_UPS = 3
_FEW = 3  # numbers so small that one more is much
_LATE = 3.0  # what is tried when all likelier edits have been
_RARITY = 0.3  # what a kind of fault costs that could stand at many lines, for each factor of e


@dataclass(frozen=True, eq=False, slots=True)
class Usage:
    """How often the lines of a model use each word; `named` are its global variables, `kinds` counts lines by edit."""

    counts: Counter[str]
    named: Container[str]
    kinds: Counter[EditKind]

    def is_idle(self, name: str) -> bool:
        """Whether nothing uses a variable that somebody declared: another may have taken its place."""
        return name in self.named and not self.counts[name]


def usage_of(sites: Sequence[EditSite]) -> Usage:
    """The usage of words in all lines; a line that sets a variable does not use it."""
    counts: Counter[str] = Counter()
    kinds: Counter[EditKind] = Counter()
    for site in sites:
        counts.update(word for word in _WORD.findall(site.text) if word != site.named)
        kinds.update({edit.kind for edit in site.edits})
    return Usage(counts, {site.named for site in sites if site.named}, kinds)


def cost_of(edit: SmallEdit, site: EditSite, usage: Usage) -> float:
    """How much an edit changes: 1 is one word or sign, what takes a demand away altogether costs most."""
    return _change(edit, site, usage) + _RARITY * math.log(max(usage.kinds[edit.kind], 1))


def _change(edit: SmallEdit, site: EditSite, usage: Usage) -> float:
    match edit.kind:
        case EditKind.OFF_BY_ONE | EditKind.SIGN | EditKind.ARGUMENTS:
            return 0.8
        case EditKind.LIMIT:
            return 0.4 if usage.is_idle(edit.new) else 1.5
        case EditKind.COMPARISON:
            if edit.old in _UNEQUAL:
                return 0.8
            if edit.new in _UNEQUAL:
                return _DROP
            if edit.new in _EQUAL or edit.old in _EQUAL:
                return 1.0 if edit.new in _EQUAL or _is_about_time(site) else 1.5
            return 1.2 if edit.old[0] != edit.new[0] else 1.0  # the other way round, or strictly
        case EditKind.RELATION:
            return _DROP if edit.new == _LOOSE else 1.2 + _rareness(edit.new, usage)
        case EditKind.CONSTANT:
            return 0.9 + 0.15 * _octaves(edit)
        case EditKind.DROPPED_CONSTRAINT | EditKind.DROPPED_BRANCH:
            return _DROP


def delay_of(edit: SmallEdit, site: EditSite, usage: Usage) -> float | None:
    """How late an edit is tried at its line; None: only if another edit of the line has helped.

    What loosens most comes first: where it does not help, smaller ones seldom do.
    """
    match edit.kind:
        case EditKind.LIMIT:
            return -1.0 if usage.is_idle(edit.new) else None
        case EditKind.SIGN | EditKind.ARGUMENTS:
            return 0.5
        case EditKind.DROPPED_CONSTRAINT:
            return 0.6 if "==" in edit.old else 0.3
        case EditKind.DROPPED_BRANCH:
            return 1.0
        case EditKind.RELATION:
            return 0.3 if edit.new == _LOOSE else 1.1 + _rareness(edit.new, usage)
        case EditKind.COMPARISON if not _is_demand(edit, site):
            return _LATE
        case EditKind.COMPARISON if edit.old in _UNEQUAL:
            return -0.5
        case EditKind.COMPARISON if edit.old in _EQUAL:
            return 1.0 if edit.new not in _UNEQUAL else _LATE
        case EditKind.COMPARISON:
            # What is no time is seldom bounded only: `x >= y` leaves it open where `x == y` was meant.
            return _LATE if edit.new not in _EQUAL else 0.8 if _is_about_time(site) else -0.3
        case EditKind.CONSTANT:
            octaves = _octaves(edit)
            return None if octaves < 1.0 else 1.2 if octaves < 2.0 else -0.3
        case EditKind.OFF_BY_ONE:
            return 0.4 if abs(float(edit.old)) <= _FEW else None


def follow_ups(edit: SmallEdit, site: EditSite, usage: Usage) -> list[SmallEdit]:
    """Smaller edits of the same line, where this one has helped; the smallest first."""
    mine = cost_of(edit, site, usage)
    smaller = [
        (cost_of(other, site, usage), number, other)
        for number, other in enumerate(site.edits)
        if _is_apart(other, edit) or _direction(other) == _direction(edit)
    ]
    wanted = sorted(one for one in smaller if one[0] < mine)
    return [other for _, _, other in wanted[:_MOST_FOLLOW_UPS]]


def _is_apart(one: SmallEdit, other: SmallEdit) -> bool:
    """Whether two edits are not both about the number at one place."""
    return one.kind not in _NUMERIC or other.kind not in _NUMERIC or one.begin != other.begin


def _direction(edit: SmallEdit) -> bool:
    """Whether a number becomes greater."""
    return edit.kind in _NUMERIC and float(edit.new) > float(edit.old)


def alternatives(edit: SmallEdit, site: EditSite, usage: Usage) -> list[SmallEdit]:
    """Other edits of the same line that change about as much."""
    most = cost_of(edit, site, usage) + 0.5
    others = [
        (cost_of(other, site, usage), number, other)
        for number, other in enumerate(site.edits)
        if other != edit and other.kind not in DROPPED
    ]
    return [other for cost, _, other in sorted(others)[:_MOST_FOLLOW_UPS] if cost <= most]


def _rareness(relation: str, usage: Usage) -> float:
    """How seldom a relation is meant; a model that uses it often uses it once more."""
    return max(0.0, (0.1 if relation in _COMMON else 0.4) - 0.05 * math.log1p(usage.counts[relation]))


def _is_demand(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a comparison is what a line demands, and neither a condition nor a truth value that is computed."""
    before = site.text[: edit.begin - site.begin]
    return site.text.endswith(";") and before.count("(") == before.count(")")


def _is_about_time(site: EditSite) -> bool:
    return any(word in _TIMES for word in _WORD.findall(site.text))


def _octaves(edit: SmallEdit) -> float:
    """By how many doublings a constant changes; one that changes its sign, or becomes 0, by many."""
    old, new = float(edit.old), float(edit.new)
    return abs(math.log2(new / old)) if old * new > 0.0 else 4.0
