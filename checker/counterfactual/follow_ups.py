"""A change that helped in, out: other changes of its line, smaller ones and those that change about as much."""

from checker.counterfactual.numbers import is_apart, is_raised
from checker.counterfactual.smallness import cost_of
from checker.counterfactual.usage import Usage
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import DROPPED, EditKind

_MOST_FOLLOW_UPS = 3


def follow_ups(edit: SmallEdit, site: EditSite, usage: Usage) -> list[SmallEdit]:
    """Smaller edits of the same line, where this one has helped; the smallest first."""
    mine = cost_of(edit, site, usage)
    smaller = [
        (cost_of(other, site, usage), number, other)
        for number, other in enumerate(site.edits)
        if is_apart(other, edit) or is_raised(other) == is_raised(edit)
    ]
    wanted = sorted(one for one in smaller if one[0] < mine)
    kinds: dict[EditKind, SmallEdit] = {}
    for _, _, other in wanted:
        kinds.setdefault(other.kind, other)
    each = list(kinds.values()) if edit.kind in DROPPED else [other for _, _, other in wanted]
    return each[:_MOST_FOLLOW_UPS]


def alternatives(edit: SmallEdit, site: EditSite, usage: Usage) -> list[SmallEdit]:
    """Other edits of the same line that change about as much."""
    most = cost_of(edit, site, usage) + 0.5
    others = [
        (cost_of(other, site, usage), number, other)
        for number, other in enumerate(site.edits)
        if other != edit and other.kind not in DROPPED
        if is_apart(other, edit) or is_raised(other) == is_raised(edit)
    ]
    return [other for cost, _, other in sorted(others)[:_MOST_FOLLOW_UPS] if cost <= most]
