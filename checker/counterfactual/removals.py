"""Changes of the line that failed by which it says no more what it was observed to fail of: a check taken away.

The line stays, and the mission passes; but it passes whatever the world does, which is no repair.
"""

import re
from collections.abc import Iterable

from checker.counterfactual.bounds import side_of
from checker.culprit import culprit_of
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind
from compiler.program import TOKEN_TIMES
from runtime.executive.outcome import Conflict, ElementKind

_WORD = re.compile(r"[A-Za-z_]\w*")


def forbidden_by(conflict: Conflict | None) -> frozenset[str]:
    """The parameters that were observed to be what the limit forbids at which a conflict gave way."""
    limit = culprit_of(conflict).element
    if conflict is None or limit is None:
        return frozenset()
    seen = [one for each in conflict.elements if each.kind is ElementKind.OBSERVATION for one in each.variables]
    return frozenset(one.name for one in limit.variables if one in seen and one.name not in TOKEN_TIMES)


def limited_between(names: Iterable[str], site: EditSite, sites: Iterable[EditSite]) -> frozenset[str]:
    """Of the names those that the line bounds on one side, and another line of its rule on the other."""
    others = [one for one in sites if (one.file, one.scope) == (site.file, site.scope) and one is not site]
    return frozenset(
        name
        for name in names
        if (side := side_of(site.text, name)) and any(side_of(one.text, name) == -side for one in others)
    )


def removes_check(edit: SmallEdit, site: EditSite, observed: frozenset[str], between: frozenset[str]) -> bool:
    """Whether the line says nothing more of what was `observed`, or bounds on one side alone what lies `between`."""
    after = site.after(edit)
    if edit.kind is EditKind.NAME and edit.old in observed:
        return edit.old not in _WORD.findall(after)
    is_turned = any(side_of(after, name) == -side_of(site.text, name) for name in between)
    return edit.kind is EditKind.COMPARISON and is_turned
