"""The lines of models in; out: how usual it is that two operands are joined so, and that an argument stands there.

A model writes alike what is alike: `seconds * frames` in one line speaks against `seconds + frames` in another, and
`mulEq(rate, time, metres)` against `mulEq(metres, time, speed)`. A constant is multiplied by the variable whose name it
bears, and seldom added to it; to what is rounded something is added.
"""

import math
import re
from collections import Counter
from collections.abc import Container, Iterator, Sequence

from checker.counterfactual.affinity import is_kin
from checker.mutation.edits import EditSite, SmallEdit

_TOKEN = re.compile(r"[A-Za-z_][\w.]*|\d[\w.]*|[-+*/()]|[^\s\w]")
_CALL = re.compile(r"\s*(\w+)\s*\((.*)\)\s*;", re.DOTALL)
_QUOTIENT = re.compile(r"/\s*[\w.]+$")
_OPERAND = re.compile(r"[A-Za-z_][\w.]*|\d[\w.]*")
_ROUNDING = ("ceil", "floor", "round")
_OPERATORS = "+-*/"
_UNITS = (10.0, 24.0, 60.0, 100.0, 1000.0, 3600.0)
_PRODUCTS = ("mulEq", "multEq")
_SUM, _ROUND, _NUMBER, _CONSTANT, _NAME, _SCALE = "sum", "rounded", "number", "constant", "name", "scale"
_SCALING = re.compile(r"(?<![a-z])(?:rate|per|speed|factor|ratio|share|scale)(?![a-z])", re.IGNORECASE)
# How often operands of two sorts are joined, before any line of the model is read.
_USUAL = {
    _ROUND: {"+": 4.0, "-": 1.0, "*": 0.3, "/": 0.1},
    _CONSTANT: {"+": 2.0, "-": 1.5, "*": 2.0, "/": 0.7},
    _SCALE: {"+": 0.5, "-": 0.5, "*": 3.0, "/": 3.0},  # a rate or share is multiplied or divided
    _NUMBER: {"+": 2.0, "-": 1.5, "*": 3.0, "/": 1.0},
    _NAME: {"+": 2.0, "-": 1.5, "*": 2.0, "/": 1.0},
}
_SAME, _KIN = 3.0, 5.0  # what the same two names elsewhere count, and a constant beside the name that it bears
_PLACE = 0.5  # of an argument that stands nowhere else
_NEEDLESS = 2.0  # of parentheses that a line does not need: people write `DRIVE / (tonnes * friction)`
_MOST_SAID = 2.5  # by other lines for or against an expression

_Pair = tuple[str, str, str]


class Formulas:
    """How all lines join operands, and where they have their arguments; `constants` are the global variables."""

    def __init__(self, sites: Sequence[EditSite], constants: Container[str]) -> None:
        self._constants = constants
        self._rates = {site.named for site in sites if site.is_rate}  # by their comments
        lines = [list(self._pairs(site.text)) for site in sites]
        self._same = Counter(_plain(*pair) for pairs in lines for pair in pairs)
        self._sorts = Counter((self._sort(pair), pair[1]) for pairs in lines for pair in pairs)
        self._places = Counter(place for site in sites for place in _places(site.text))

    def odds(self, edit: SmallEdit, site: EditSite) -> float:
        """Logarithm of how much likelier a line is meant as it is than as an edit leaves it, within bounds."""
        return _within(self._joined(edit, site))

    def adds_scale(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether an edit writes a sign beside a rate or share, which is hardly added but to get another one."""
        after = self._pairs(site.after(edit))
        return not _sets_scale(site.text) and any(self._sort(one) == _SCALE and one[1] == edit.new for one in after)

    def divides_by_scale(self, edit: SmallEdit) -> bool:
        """Whether an edit divides by a rate that its line multiplies with: it belongs on the other side of `==`."""
        factor, _, other = edit.old.partition("*")
        name = factor.strip()
        is_moved = edit.new == f"{other.strip()} / {name}" and name in self._constants
        return is_moved and self._is_scale(name)

    def repeats_factor(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a product of something with a name becomes what has that name too: `mulEq(speed, time, SPEED)`."""
        call = _CALL.fullmatch(site.after(edit))
        if call is None or call.group(1) not in _PRODUCTS:
            return False
        *factors, product = (one.strip().rpartition(".")[2] for one in call.group(2).split(","))
        return product == edit.new and any(is_kin(one, product) for one in factors)

    def place_odds(self, edit: SmallEdit, site: EditSite) -> float:
        """The same of the order of arguments or operands, by their places in other calls, too."""
        before, after = set(_places(site.text)), set(_places(site.after(edit)))
        old = sum(math.log(_PLACE + self._places[one] - 1) for one in before - after)
        new = sum(math.log(_PLACE + self._places[one]) for one in after - before)
        return _within(old - new + self._joined(edit, site))

    def _joined(self, edit: SmallEdit, site: EditSite) -> float:
        before, after = list(self._pairs(site.text)), list(self._pairs(site.after(edit)))
        kept = Counter(before) & Counter(after)
        old, new = (Counter(one) - kept for one in (before, after))
        idle = _NEEDLESS * (_needless(site.after(edit)) - _needless(site.text))
        sets = _sets_scale(site.text)
        known = sum(self._weight(one, 1, sets) for one in old.elements())
        return idle + known - sum(self._weight(one, 0, sets) for one in new.elements())

    def _weight(self, pair: _Pair, own: int, sets_scale: bool) -> float:
        """Logarithm of the share of an operator among those that join such operands, its `own` mention left out."""
        left, operator, right = pair
        sort = counted = self._sort(pair)
        if sort == _SCALE and sets_scale:
            sort = _CONSTANT
        is_kin_pair = {self._kind(left), self._kind(right)} == {_CONSTANT, _NAME} and is_kin(
            left.rpartition(".")[2], right.rpartition(".")[2]
        )
        counts = {}
        for one in _OPERATORS:
            mine = own * (one == operator)
            named = self._same[_plain(left, one, right)] - mine if left and right else 0
            usual = _USUAL[sort][one] + self._sorts[sort, one] - mine * (sort == counted)
            counts[one] = usual + _SAME * named + _KIN * (is_kin_pair and one == "*")
        return math.log(counts[operator] / sum(counts.values()))

    def _pairs(self, text: str) -> Iterator[_Pair]:
        """Each operator of a line with what stands beside it: a name, a number, or a sort in place of a call or sum."""
        tokens = _TOKEN.findall(text)
        opened: list[int] = []
        calls: dict[int, str] = {}
        for at, token in enumerate(tokens):
            if token == "(":
                opened.append(at)
            elif token == ")" and opened:
                calls[at] = tokens[opened.pop() - 1]
        for at, token in enumerate(tokens[1:-1], 1):
            left, right = tokens[at - 1], tokens[at + 1]
            if token not in _OPERATORS or not (left[0].isalnum() or left[0] in "_)"):
                continue
            if left == ")":
                left = _ROUND if calls.get(at - 1) in _ROUNDING else _SUM
            if right == "(" or tokens[at + 2 : at + 3] == ["("]:
                right = _ROUND if right in _ROUNDING else _SUM
            yield left, token, right

    def _sort(self, pair: _Pair) -> str:
        kinds = {self._kind(pair[0]), self._kind(pair[2])}
        sort = next(one for one in (_ROUND, _NUMBER, _CONSTANT, _NAME) if one in kinds)
        is_scale = self._is_scale(pair[0]) or self._is_scale(pair[2])
        return _SCALE if is_scale and sort in (_CONSTANT, _NAME) else sort

    def _is_scale(self, name: str) -> bool:
        return name in self._rates or _SCALING.search(name) is not None

    def _kind(self, word: str) -> str:
        if word in (_ROUND, _SUM):
            return _ROUND if word == _ROUND else _NAME
        return _NUMBER if word[0].isdigit() else _CONSTANT if word in self._constants else _NAME


def drops_number(edit: SmallEdit) -> bool:
    """Whether an edit leaves out a number without a name, and nothing else: `degrees` for `10 * degrees`; no step."""
    left_out = Counter(_OPERAND.findall(edit.old)) - Counter(_OPERAND.findall(edit.new))
    return left_out.total() == 1 and all(one[0].isdigit() and one != "1" for one in left_out)


def drops_unit(edit: SmallEdit) -> bool:
    """Whether that number is one by which units differ: minutes and seconds, tonnes and kilograms."""
    numbers = Counter(_OPERAND.findall(edit.old)) - Counter(_OPERAND.findall(edit.new))
    return drops_number(edit) and all(float(one) in _UNITS for one in numbers)


def divides_again(edit: SmallEdit) -> bool:
    """Whether an edit divides a quotient once more: `metres / pace / litres`."""
    return _QUOTIENT.search(edit.old) is not None and edit.new.startswith(f"{edit.old} /")


def _sets_scale(text: str) -> bool:
    """Whether a line says what a rate or share is."""
    found = re.match(r"\s*([\w.]+)\s*==", text)
    return found is not None and _SCALING.search(found.group(1)) is not None


def _needless(text: str) -> int:
    """How many parentheses of a line say nothing: they are no call's, and no operator beside them needs them."""
    tokens = ["", *_TOKEN.findall(text), ""]
    opened: list[int] = []
    found = 0
    for at, token in enumerate(tokens):
        if token == "(":
            opened.append(at)
        elif token == ")" and opened:
            first = opened.pop()
            before, after = tokens[first - 1], tokens[at + 1]
            depth, signs = 0, set[str]()
            for one in tokens[first + 1 : at]:
                depth += (one == "(") - (one == ")")
                signs |= {one} if depth == 0 and one in "+-*/<>" else set()
            is_scaled = before in ("*", "/", "-") or after in ("*", "/")
            is_needed = before == "/" or (is_scaled and signs & {"+", "-"}) or signs & {"<", ">"} or not signs
            found += not (before[:1].isalnum() or before[:1] == "_" or is_needed) and before in ("+", "-", "*")
    return found


def _within(odds: float) -> float:
    return max(min(odds, _MOST_SAID), -_MOST_SAID)


def _plain(left: str, operator: str, right: str) -> _Pair:
    """Two operands by their names alone, in an order of their own where it does not matter."""
    names = [one.rpartition(".")[2] for one in (left, right)]
    first, last = sorted(names) if operator in "+*" else names
    return first, operator, last


def _places(text: str) -> Iterator[tuple[str, int, str]]:
    """The arguments of a call, each with its place."""
    if (call := _CALL.fullmatch(text)) is not None:
        for at, argument in enumerate(call.group(2).split(",")):
            yield call.group(1), at, argument.strip().rpartition(".")[2]
