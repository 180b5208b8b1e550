"""The lines of models in; out: which variables make a mission easier where they are smaller, and which where larger.

What takes long is too late sooner than it is too early: a token's duration is better short, unless a line bounds it
below or another token lies within it; where a rule looks for one to lie within, it is better long. By the lines that
set one variable from others this goes back to constants, in other rules and reactors too: where `duration ==
ceil(span)` and `mulEq(span, rate, kbits)`, fewer `kbits` are better.
"""

import re
from collections import defaultdict
from collections.abc import Container, Iterator, Sequence

from checker.counterfactual.word_odds import compared
from checker.mutation.edits import EditSite

_Name = tuple[str, str]  # a rule and a variable, or "" and a constant
_TERM = re.compile(r"([-+*/(]?)\s*\(?\s*([A-Za-z_]\w*(?:\.\w+)*|\d[\d.]*)(?!\w*\s*\()")
_SET = re.compile(r"\s*([A-Za-z_][\w.]*)\s*==([^<>=!&|?]+);", re.DOTALL)
_SUM = re.compile(r"([^<>=!&|?()]*[-+][^<>=!&|?()]*)==\s*([A-Za-z_][\w.]*)\s*;")
_LIMIT = re.compile(r"([^<>=!&|?]+)(<=|<|>=|>)([^<>=!&|?]+);", re.DOTALL)
_TERNARY = re.compile(r"\s*(?:mulEq|addEq)\s*\(\s*([\w.]+)\s*,\s*([\w.]+)\s*,\s*([\w.]+)\s*\)\s*;")
_CHILD = re.compile(r"\s*(\w+\s+)?(\w+)\s*(?:\[[^\]]*\]\s*)*\(\s*([\w.]+)\s+(\w+)\s*\)")
_DURATION = "duration"
_TIMES = (_DURATION, "start", "end")
_HOLDING = ("contains", "starts_before_end", "contains_start", "contains_end")
_HELD = ("contained_by", "starts_during", "ends_during")
_OWN = "object"


class Demands:
    """Of variables and numbers, 1 where a larger one is better, -1 where a smaller one is, 0 where neither is known."""

    def __init__(self, sites: Sequence[EditSite], constants: Container[str]) -> None:
        self._constants = constants
        self._tokens: dict[tuple[str, tuple[int, int], str], str] = {}
        holding, held = set[str](), set[str]()
        for site in sites:
            child = _CHILD.match(site.text)
            if child is not None and site.rule:
                origin, relation, path, label = child.groups()
                owner, _, predicate = path.rpartition(".")
                own = site.rule.rpartition(".")[0]
                made = f"{own if owner in ('', _OWN) else owner}.{predicate}"
                self._tokens[site.file, site.scope, label] = made
                if relation in _HOLDING and origin is None:
                    holding.add(site.rule)
                if relation in _HELD:
                    held.add(made)
        self._wanted: dict[_Name, set[int]] = defaultdict(set)
        for site in sites:
            for name, way in self._limits(site):
                self._wanted[name].add(way)
        for rule in held:
            self._wanted[rule, _DURATION].add(1)
        for rule in {site.rule for site in sites if site.rule} - holding - held:
            if 1 not in self._wanted[rule, _DURATION]:
                self._wanted[rule, _DURATION].add(-1)
        self._given = {
            self._name(site, found.group(1)) for site in sites if (found := _SET.fullmatch(compared(site.text)))
        }
        self._follow([line for site in sites if (line := self._equation(site)) is not None])

    def of(self, name: str) -> int:
        """The same of a constant."""
        ways = self._wanted.get(("", name), set())
        return next(iter(ways)) if len(ways) == 1 else 0

    def at(self, site: EditSite, offset: int) -> int:
        """The same of a number that stands in a line."""
        found = _SET.fullmatch(compared(site.text))
        ways = self._wanted.get(self._name(site, found.group(1)), set()) if found is not None and site.rule else set()
        if found is None or len(ways) != 1:
            return 0
        signs = [sign for sign, _, at in _terms(found.group(2)) if found.start(2) + at == offset]
        return signs[0] * next(iter(ways)) if signs else 0

    def _follow(self, lines: Sequence[tuple[_Name, list[tuple[int, _Name]]]]) -> None:
        """Carry what is wanted of each variable to those that it is set from, until nothing changes."""
        changed = True
        while changed:
            changed = False
            for target, terms in lines:
                for sign, name in terms:
                    new = {sign * way for way in self._wanted[target]} - self._wanted[name]
                    self._wanted[name] |= new
                    changed = changed or bool(new)

    def _equation(self, site: EditSite) -> tuple[_Name, list[tuple[int, _Name]]] | None:
        """A variable and what it is set from, each with the sign that it has in it."""
        if not site.rule:
            return None
        if ternary := _TERNARY.fullmatch(site.text):
            one, other, result = (self._name(site, text) for text in ternary.groups())
            unknown = [name for name in (one, other) if name[0] and name not in self._given]
            target = unknown[0] if unknown else one
            return target, [(1, result), (-1, other if target == one else one)]
        if found := _SET.fullmatch(site.text):
            terms = _terms(found.group(2))
            names = [(sign, self._name(site, text)) for sign, text, _ in terms if not text[0].isdigit()]
            return self._name(site, found.group(1)), names
        if found := _SUM.fullmatch(site.text):
            terms = _terms(found.group(1))
            left = [(sign, self._name(site, text)) for sign, text, _ in terms if not text[0].isdigit()]
            targets = [one for one in left if one[1][0] and one[1] not in self._given]
            if targets:
                way, target = targets[0]
                others = [(-way * sign, name) for sign, name in left if name != target]
                return target, [(way, self._name(site, found.group(2))), *others]
        return None

    def _limits(self, site: EditSite) -> Iterator[tuple[_Name, int]]:
        found = _LIMIT.fullmatch(compared(site.text))
        if found is None or not site.rule:
            return
        is_most = found.group(2)[0] == "<"
        for side, way in ((found.group(1), -1 if is_most else 1), (found.group(3), 1 if is_most else -1)):
            for sign, text, _ in _terms(side):
                name = self._name(site, text)
                if not text[0].isdigit() and (not name[0] or name[1] in _TIMES):
                    yield name, sign * way  # a variable that bounds a duration may be how long the world takes

    def _name(self, site: EditSite, path: str) -> _Name:
        label, _, last = path.rpartition(".")
        if not label:
            return ("", path) if path in self._constants else (site.rule, path)
        return self._tokens.get((site.file, site.scope, label), f"{site.rule}/{label}"), last


def _terms(text: str) -> Iterator[tuple[int, str, int]]:
    """The names and numbers of an expression, each with its sign and where it stands."""
    for found in _TERM.finditer(text):
        yield -1 if found.group(1) in ("-", "/") else 1, found.group(2), found.start(2)
