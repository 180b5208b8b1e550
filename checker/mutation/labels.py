"""Goals and the lines of models in; the parameters out that only tell tokens apart, such as the number of an order.

Where the goals on a timeline have the numbers 1, 2 and 3, or two of them 1 and 2, that says which is which, and no
quantity: nothing is computed from it. So it is with the parameters of other tokens that it is handed on to.
"""

import re
from collections import defaultdict
from collections.abc import Iterable, Sequence

from checker.mutation.edits import EditSite
from runtime.executive.configuration import GoalConfiguration

Label = tuple[str, str]  # a predicate, without its class, and a parameter

_SERIES = 3  # goals that each have a number of their own
_PAIR = {1, 2}  # or two that are the first and the second: 5 of 5 such pairs in right models are names
_LABELLED = re.compile(r"\(\s*([A-Za-z_][\w.]*)\s+(\w+)\s*\)")
_SAME = re.compile(
    r"\s*([A-Za-z_][\w.]*)\s*==\s*([A-Za-z_][\w.]*)\s*(?:\+\s*\d+\s*)?;"
)  # one more, or 100 more, is one too
_COMPUTES = re.compile(r"[-+*/<>]|\b(?!contains|any|starts|ends|meets|met_by|if)\w+\s*\(")
_NAME = re.compile(r"[A-Za-z_]\w*(?:\.\w+)*")


def labels_of(goals: Sequence[GoalConfiguration], sites: Iterable[EditSite]) -> frozenset[Label]:
    """The parameters by which goals are counted, and those that they are handed on to."""
    lines = [site for site in sites if site.rule]
    tokens: dict[object, dict[str, str]] = defaultdict(dict)
    for site in lines:
        for predicate, name in _LABELLED.findall(site.text):
            tokens[site.file, site.scope][name] = predicate.rpartition(".")[2]
    equal = [
        (_named(one, site, tokens), _named(other, site, tokens))
        for site in lines
        if (sides := _SAME.fullmatch(site.text)) is not None
        for one, other in (sides.groups(), sides.groups()[::-1])
    ]
    found = _counted(goals)
    grows = bool(found)
    while grows:
        more = {other for one, other in equal if one in found and other is not None} - found
        found |= more
        grows = bool(more)
    computed = {
        _named(name, site, tokens)
        for site in lines
        if not (site.is_rule or _SAME.fullmatch(site.text) or _LABELLED.search(site.text))
        and _COMPUTES.search(site.text)
        for name in _NAME.findall(site.text)
    }
    return frozenset(found - computed)


def _counted(goals: Sequence[GoalConfiguration]) -> set[Label]:
    """The parameters of which the goals of a predicate, or all on a timeline, have one whole number after the other."""
    values: dict[tuple[str, str], list[object]] = defaultdict(list)
    for goal in goals:
        for name, value in goal.parameters:
            values[goal.timeline, name].append(value)
            values[goal.predicate, name].append(value)
    counted = {key for key, said in values.items() if _is_series(said)}
    return {
        (goal.predicate, name)
        for goal in goals
        for name, _ in goal.parameters
        if not counted.isdisjoint({(goal.timeline, name), (goal.predicate, name)})
    }


def _is_series(values: Sequence[object]) -> bool:
    numbers = {one for one in values if isinstance(one, int) and not isinstance(one, bool)}
    is_whole = (len(values) >= _SERIES or numbers == _PAIR) and len(numbers) == len(values)
    return is_whole and max(numbers) - min(numbers) == len(values) - 1


def _named(name: str, site: EditSite, tokens: dict[object, dict[str, str]]) -> Label | None:
    """The parameter that a name in a rule stands for, of its own token or of one that it asks for."""
    token, _, parameter = name.rpartition(".")
    if not token:
        return site.rule.rpartition(".")[2], parameter
    predicate = tokens[site.file, site.scope].get(token)
    return (predicate, parameter) if predicate is not None else None
