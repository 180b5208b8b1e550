"""Lines of models in; out: how well a constant belongs into a line by its name, and whether a line has a twin.

Who writes a model chooses names: `DELIVERY_MAX` bounds a rule of `Deliver`, `SPEED` sets a `speed`; and what is written
twice is written alike. So a line speaks for or against a change of it before anything is flown.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Container, Sequence

from checker.mutation.edits import EditSite, SmallEdit

WORD = re.compile(r"[A-Za-z_]\w*")
_PART = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")
_LABELLED = re.compile(r"\(\s*([A-Za-z_][\w.]*)\s+(\w+)\s*\)")
_BOUNDING = re.compile(r"<=|>=|<|>")
_SETTING = re.compile(r"\s*(?:\w+\.)?(\w+)\s*==")
_TIMES = ("start", "end", "duration")
_LEAST_STEM = 3  # letters
_SUFFIX = 0.5  # share of the longer word that two words of one stem have in common
_MANY = 3
_LEAST_NAMES = 3  # of a formula that is written twice
_TOPIC, _COMPANY = 2.0, 1.0
# Words that say nothing of what a line is about.
_COMMON = frozenset(
    (
        *("any", "contains", "contained_by", "before", "after", "meets", "met_by", "starts", "ends", "equals"),
        *("if", "else", "foreach", "in", "object", "state", "start", "end", "duration", "int", "float", "bool"),
        *("string", "true", "false", "ceil", "floor", "abs", "max", "min", "eq", "neq", "leq", "lt", "addEq", "mulEq"),
        "sampledParameter",
    )
)
_MOST, _LEAST = frozenset(("max", "most", "limit", "latest")), frozenset(("min", "least", "earliest"))
_MEASURES = frozenset(("worst", "best", "total")) | _MOST | _LEAST


class Affinity:
    """The words of all lines, by the constants among them; `named` are the global variables."""

    def __init__(self, sites: Sequence[EditSite], named: Container[str]) -> None:
        self._named = named
        self._company: dict[str, Counter[str]] = defaultdict(Counter)
        self._texts = Counter(_plain(site.text) for site in sites)
        formulas = [(site, found) for site in sites if site.rule and (found := _formula(_plain(site.text)))]
        self._formulas = Counter(found for _, found in formulas)
        self._computed = {(site.file, site.scope, found) for site, found in formulas}
        self._in_rule = Counter((site.file, site.scope, _plain(site.text)) for site in sites if site.rule)
        self._tokens: dict[tuple[str, tuple[int, int], str], str] = {}  # what the label of a token in a rule stands for
        for site in sites:
            for predicate, label in _LABELLED.findall(site.text):
                self._tokens[site.file, site.scope, label] = predicate.rpartition(".")[2]
        bounding = {site: _BOUNDING.search(site.text) is not None for site in sites}
        uses = [(word, bounding[site]) for site in sites for word in WORD.findall(site.text) if word != site.named]
        self._bounds = {word for word, is_bound in uses if word in named and is_bound}  # what some line compares with
        self._bounds_only = self._bounds - {word for word, is_bound in uses if not is_bound}
        for site in sites:
            words = self._words(site)
            for name in set(WORD.findall(site.text)):
                if name in named and name != site.named:
                    self._company[name].update(words)

    def of(self, name: str, site: EditSite) -> float:
        """How well a constant belongs into a line: by its topic, and by the words that it stands with elsewhere."""
        words = self._words(site)
        own = name in WORD.findall(site.text)
        has_company = any(self._company[name][word] > own for word in words)
        return _TOPIC * self.is_about(name, site) + _COMPANY * has_company

    def is_about(self, name: str, site: EditSite) -> bool:
        """Whether a name and a line, or its rule, have a stem in common."""
        there = {stem for word in (*self._words(site), site.rule.rpartition(".")[2]) for stem in _stems(word)}
        return any(_is_kin(one, other) for one in _stems(name) for other in there)

    def kindred(self, edit: SmallEdit, site: EditSite) -> int:
        """1 where a new name has a stem in common with a constant beside it, less 1 where the old one has."""
        first, last = edit.begin - site.begin, edit.end - site.begin
        beside = [name for name in WORD.findall(site.text[:first] + " " + site.text[last:]) if name in self._named]
        names = ((1, edit.new), (-1, edit.old))
        return sum(way * _has_kin(name, beside) for way, name in names if name not in self._named)

    def shared(self, name: str, head: EditSite, sites: Sequence[EditSite]) -> int:
        """How many stems of a constant the lines of a rule have; those of three constants and more say nothing."""
        counts = Counter(stem for site in sites if site.is_number for stem in _stems(site.named))
        telling = [stem for stem in _stems(name) if counts[stem] < _MANY]
        words = {
            word for site in sites if site.rule == head.rule and site.file == head.file for word in self._words(site)
        }
        there = {stem for word in (*words, head.rule.rpartition(".")[2]) for stem in _stems(word)}
        return sum(any(_is_kin(one, other) for other in there) for one in telling)

    def has_twin(self, site: EditSite) -> bool:
        """Whether the line is written the same in another rule."""
        return self._elsewhere(site, _plain(site.text)) > (not site.rule)

    def is_repeated(self, site: EditSite) -> bool:
        """Whether the rule has the line twice: what both branches of a condition say needs no condition."""
        return self._in_rule[site.file, site.scope, _plain(site.text)] > 1

    def makes_twin(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether the line is then written as a line of another rule is."""
        text = _after(edit, site)
        return bool(text) and self._elsewhere(site, text) > 0

    def makes_formula(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a line then computes what a line of another rule computes for something else, and does not before.

        What its own rule computes in another branch needs no condition.
        """
        before, after = _formula(_plain(site.text)), _formula(_after(edit, site))
        is_apart = (site.file, site.scope, after) not in self._computed
        return bool(after) and is_apart and self._formulas[after] > 0 and self._formulas[before] <= 1

    def repeats(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether its rule then has the line twice."""
        text = _after(edit, site)
        return bool(text) and self._in_rule[site.file, site.scope, text] > 0

    def sign_of(self, edit: SmallEdit, site: EditSite) -> str:
        """The comparison that a constant's name asks for, such as `<=` before `LEG_MAX`; empty where none does."""
        signs = []
        for found in WORD.finditer(site.text):
            parts = {part.lower() for part in _PART.findall(found.group())}
            if found.group() in self._named and _is_limit(found.group()):
                is_after = found.start() >= edit.end - site.begin
                signs.append("<=" if bool(parts & _MOST) is is_after else ">=")
        return signs[0] if len(set(signs)) == 1 else ""

    def drops_limit(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether an edit takes a limit such as `WAIT_MAX` out of what a line sets by `==`, if that is no time."""
        left_out = (set(WORD.findall(edit.old)) - set(WORD.findall(edit.new))) & self._bounds
        sets = _SETTING.match(site.text)
        return sets is not None and sets.group(1) not in _TIMES and any(_is_limit(one) for one in left_out)

    def is_slack(self, name: str, edit: SmallEdit, site: EditSite) -> bool:
        """Whether an edit adds the most, or the least, of something where a line bounds a number by it: `+ GAP_MAX`."""
        bound = _BOUNDING.search(site.text)
        if bound is None or not _is_limit(name) or not edit.new.endswith(f"+ {name}"):
            return False
        is_after = edit.begin - site.begin > bound.start()
        return (bound.group()[0] == "<") == (is_after == _is_most(name))

    def is_limit(self, name: str) -> bool:
        """Whether a constant is compared with, and nothing else comes of it."""
        return name in self._bounds_only

    def _elsewhere(self, site: EditSite, text: str) -> int:
        return self._texts[text] - self._in_rule[site.file, site.scope, text]

    def _words(self, site: EditSite) -> set[str]:
        """What a line is about: its words but for constants and words of the language, and the tokens that it names."""
        words = set(WORD.findall(site.text)) - _COMMON
        tokens = {found for word in words if (found := self._tokens.get((site.file, site.scope, word)))}
        return {word for word in words if word not in self._named} | tokens


def _is_limit(name: str) -> bool:
    """Whether a name says that it is the most or the least of something."""
    return bool({part.lower() for part in _PART.findall(name)} & (_MOST | _LEAST))


def _is_most(name: str) -> bool:
    return bool({part.lower() for part in _PART.findall(name)} & _MOST)


def is_kin(one: str, other: str) -> bool:
    """Whether two names have a stem in common."""
    return _has_kin(one, [other])


def _has_kin(name: str, others: Sequence[str]) -> bool:
    return any(_is_kin(one, stem) for one in _stems(name) for other in others for stem in _stems(other))


def _after(edit: SmallEdit, site: EditSite) -> str:
    """A line as it is after an edit; empty where nothing is left of it, or the edit is of what it leads to."""
    first, last = edit.begin - site.begin, edit.end - site.begin
    is_inside = 0 <= first <= last <= len(site.text) and edit.new.strip()
    return _plain(site.after(edit)) if is_inside else ""


def _formula(text: str) -> str:
    """The right side of `==` in a line without blanks, if it computes something of several names; else empty."""
    side = text.partition("==")[2]
    return side if len(set(WORD.findall(side))) >= _LEAST_NAMES else ""


def _plain(text: str) -> str:
    return "".join(text.split())


def _stems(word: str) -> set[str]:
    """The parts of a name, in lower case; `FIX_HITS` has two."""
    parts = {part.lower() for part in _PART.findall(word)}
    return {part for part in parts if len(part) >= _LEAST_STEM} - _MEASURES


def _is_kin(one: str, other: str) -> bool:
    """Whether two words are of one stem: `firing` and `fire`, `delivery` and `deliver`."""
    common = next((k for k, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))
    shorter, longer = sorted((len(one), len(other)))
    return common >= max(_LEAST_STEM, shorter - 1) and common >= _SUFFIX * longer
