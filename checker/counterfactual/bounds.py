"""The lines of models in; out: whether a larger number demands more or less of the world, or neither is known.

`duration <= LEG_MAX;` demands less where the limit is larger: what loosens a demand is tried before what tightens it.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Container, Sequence

from checker.counterfactual.demands import Demands
from checker.counterfactual.word_odds import compared
from checker.mutation.edits import EditSite, SmallEdit
from nddl_lang.semantics.constraints import CONSTRAINTS

_WORD = re.compile(r"[A-Za-z_]\w*")
_COMPARED = re.compile(r"([^<>=!&|?]+)(<=|<|>=|>)([^<>=!&|?]+);", re.DOTALL)
_RESERVOIR = re.compile(r"\bnew\s+Reservoir\s*\(")
_LEAST, _MOST = 1, 2  # of the arguments of a reservoir
_NEW = re.compile(r"\bnew\s+(?!Reservoir\b)(\w+)\s*\(([^()]*)\)")
_NUMBER = re.compile(r"-?\d+\.?\d*")
_Order = tuple[str, int, int, bool]
_LEVELS = re.compile(r"\bnew\s+Reservoir\s*\(\s*(-?[\d.]+)\s*,\s*(-?[\d.]+)\s*,\s*(-?[\d.]+)\s*\)")


class Directions:
    """Of each constant, whether it loosens by growing (1) or by shrinking (-1), if all lines that use it agree.

    What other lines make of it counts where missions fail for what is late, not for what does not happen (`is_late`).
    """

    def __init__(self, sites: Sequence[EditSite], constants: Container[str], *, is_late: bool) -> None:
        found: dict[str, set[int]] = defaultdict(set)
        for site in sites:
            for name in _WORD.finditer(site.text):
                if name.group() in constants and name.group() != site.named:
                    found[name.group()].add(_direction(site.text, name.start()))
        self._orders: Counter[_Order] = Counter()  # of all objects, each in how many
        for site in sites:
            self._orders.update(_orders(site.text))
        self._demands = Demands(sites if is_late else (), constants)
        self._of = {name: ways.pop() for name, ways in found.items() if len(ways) == 1}

    def is_put_in_order(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether two numbers that an object is made of change places, and are then in order.

        As all other objects of its class have them, or the level of a reservoir between the least and the most.
        """
        after = site.after(edit)
        if _is_in_order(after) and not _is_in_order(site.text):
            return True
        before = [
            one for one in _orders(site.text) if _turned(one) in _orders(after) and _is_swap(one, site.text, after)
        ]
        return any(self._orders[one] == 1 and self._orders[_turned(one)] > 0 for one in before)

    def of(self, edit: SmallEdit, site: EditSite) -> int:
        """1 where a larger number demands less, -1 where a smaller one does, 0 where that is not known."""
        at = edit.begin - site.begin
        if reservoir := _RESERVOIR.search(site.text):
            argument = site.text.count(",", reservoir.end(), max(at, 0))
            return {_LEAST: -1, _MOST: 1}.get(argument, 0)
        if site.named:
            return self._of.get(site.named, 0) or self._demands.of(site.named)
        return _direction(site.text, at) or self._demands.at(site, at)


def sets_value(demand: str) -> bool:
    """Whether a demand gives a variable its value: without it that would be open, and the mission fail all the same."""
    row = CONSTRAINTS.get(demand.partition("(")[0].strip())
    return "==" in demand or (row is not None and (row.result is not None or row.name == "eq"))


def is_result_moved(edit: SmallEdit, site: EditSite) -> bool:
    """Whether two arguments of a constraint change places, of which one may be its result."""
    name, is_call, _ = site.text.partition("(")
    row = CONSTRAINTS.get(name.strip())
    return bool(is_call) and row is not None and row.result is not None and edit.begin > site.begin


def _made(text: str) -> tuple[str, list[str]]:
    """The class of an object that a line makes, and what of."""
    found = _NEW.search(text)
    return ("", []) if found is None else (found.group(1), [one.strip() for one in found.group(2).split(",")])


def _orders(text: str) -> set[_Order]:
    """Of each two numbers that an object is made of: its class, their places, and whether the first is the smaller."""
    name, arguments = _made(text)
    numbers = [(at, float(one)) for at, one in enumerate(arguments) if _NUMBER.fullmatch(one)]
    return {(name, at, to, one < other) for at, one in numbers for to, other in numbers if at < to and one != other}


def _turned(order: _Order) -> _Order:
    return *order[:3], not order[3]


def _is_swap(order: _Order, before: str, after: str) -> bool:
    """Whether two arguments have changed places."""
    (_, old), (_, new), (_, at, to, _) = _made(before), _made(after), order
    return float(old[at]) == float(new[to]) and float(old[to]) == float(new[at])


def _is_in_order(text: str) -> bool:
    found = _LEVELS.search(text)
    if found is None:
        return False
    level, least, most = map(float, found.groups())
    return least <= level <= most


def side_of(text: str, name: str) -> int:
    """1 where a line says what a variable is at most, -1 where at least, 0 where it compares something else."""
    sides = _COMPARED.fullmatch(compared(text))
    if sides is None:
        return 0
    left, right = sides.group(1).strip() == name, sides.group(3).strip() == name
    if left == right:
        return 0
    return 1 if (sides.group(2)[0] == "<") == left else -1


def _direction(text: str, at: int) -> int:
    """The same of what stands at an offset of a line."""
    sides = _COMPARED.fullmatch(compared(text))
    if sides is None:
        return 0
    is_right = at >= sides.start(3)
    side = sides.group(3) if is_right else sides.group(1)
    before = side[: at - sides.start(3 if is_right else 1)]
    if "/" in side or "(" in side:
        return 0
    sign = -1 if before.rstrip().endswith("-") else 1
    return sign * (1 if (sides.group(2)[0] == "<") == is_right else -1)
