"""Edits of numbers in; out: by how much, which way, and between which others each changes its number."""

import math
import re
from dataclasses import replace

from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import NUMBERS, EditKind
from checker.named_objects import RESOURCES

_COMPUTED = re.compile(r"\s*[A-Za-z_][\w.]*\s*==.*[A-Za-z_)].*;", re.DOTALL)
_MADE = re.compile(r"\bnew\s+(\w+)\s*\(")
_TWICE = 2.0  # octaves


def is_doubling(edit: SmallEdit) -> bool:
    """Whether a number becomes twice or half as large."""
    return edit.kind is EditKind.CONSTANT and float(edit.new) in (2.0 * float(edit.old), 0.5 * float(edit.old))


def between(edit: SmallEdit, site: EditSite) -> list[SmallEdit]:
    """Where a number changes by far, a doubling or halving of it in the same direction, and twice that."""
    if edit.kind is not EditKind.CONSTANT or octaves(edit) <= _TWICE or float(edit.new) * float(edit.old) <= 0.0:
        return []
    doubled = [one for one in _same_way(edit, site) if is_doubling(one)]
    return [*doubled, *(replace(one, new=_twice(one)) for one in doubled)]


def _twice(edit: SmallEdit) -> str:
    """A number that changes as much again as an edit changes it."""
    number = float(edit.new) * float(edit.new) / float(edit.old)
    return repr(round(number, 12)) if "." in edit.old else str(round(number))


def is_step(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a number is a 1 that is added or taken away."""
    return edit.old == "1" and site.text[: edit.begin - site.begin].rstrip().endswith(("+", "-"))


def is_whole(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a number is the 1.0 of which a share is taken away, or to which one is added: `1.0 - dust`."""
    before, after = site.text[: edit.begin - site.begin].rstrip(), site.text[edit.end - site.begin :].lstrip()
    return edit.old == "1.0" and after.startswith(("-", "+")) and before.endswith(("(", "=", "*", "/"))


def is_of_formula(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a number without a name is a part of what a line computes by `==`."""
    return not site.named and _COMPUTED.match(site.text) is not None


def is_of_object(edit: SmallEdit, site: EditSite) -> bool:
    """Whether an object is made of a number, but for how much a resource has: a place, a size, a window."""
    made = _MADE.search(site.text[: edit.begin - site.begin])
    return made is not None and made.group(1) not in RESOURCES


def is_farthest(edit: SmallEdit, site: EditSite) -> bool:
    """Whether no edit changes the number more in this direction without a change of its sign."""
    same = [one for one in _same_way(edit, site) if float(one.new) * float(one.old) >= 0.0]
    return octaves(edit) >= max((octaves(one) for one in same if float(one.new) != 0.0), default=0.0)


def _same_way(edit: SmallEdit, site: EditSite) -> list[SmallEdit]:
    """The edits that give the same number another value, greater or less as this one does."""
    rivals = site.rivals(edit, EditKind.CONSTANT)
    return [one for one in rivals if is_raised(one) == is_raised(edit)]


def is_raised(edit: SmallEdit) -> bool:
    """Whether a number becomes greater."""
    return edit.kind in NUMBERS and float(edit.new) > float(edit.old)


def octaves(edit: SmallEdit) -> float:
    """By how many doublings a constant changes; one that changes its sign, or becomes 0, by many."""
    old, new = float(edit.old), float(edit.new)
    return abs(math.log2(new / old)) if old * new > 0.0 else 4.0


def digits(number: str) -> int:
    """Significant digits: people choose round numbers."""
    return len(number.lstrip("-").replace(".", "").strip("0")) if "." in number else len(number.lstrip("-").rstrip("0"))


def is_apart(one: SmallEdit, other: SmallEdit) -> bool:
    """Whether two edits are not both about the number at one place."""
    return one.kind not in NUMBERS or other.kind not in NUMBERS or one.begin != other.begin
