"""The lines of a model in; out: how often they use each word, and so how well a word fits where another one stands."""

import math
import re
from collections import Counter, defaultdict
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field

from checker.counterfactual.affinity import WORD, Affinity, is_kin
from checker.counterfactual.bounds import Directions
from checker.counterfactual.dimensions import Dimensions
from checker.counterfactual.distinct import Distinct
from checker.counterfactual.flows import Flows
from checker.counterfactual.formulas import Formulas
from checker.counterfactual.mentions import Mentions, is_doubled
from checker.counterfactual.moments import TimeLimits
from checker.counterfactual.numbers import is_raised
from checker.counterfactual.orders import Orders
from checker.counterfactual.siblings import Siblings
from checker.counterfactual.word_odds import SAMPLED, TRUTHS, sign_of, sort_of, sum_of
from checker.mutation.comments import numbers_in
from checker.mutation.edits import EditSite, SmallEdit, inverse_of
from checker.mutation.kinds import EditKind
from checker.mutation.labels import Label

_LABEL = re.compile(r"\s+(\w+)\s*\)")
_MESSAGE = re.compile(r"(.*):\s*\"([^\"]*)\"\s*;\s*", re.DOTALL)
_OBJECT = re.compile(r"\s*[A-Z]\w*\s+(\w+)\s*;")
_EQUAL = re.compile(r"\s*([\w.]+)\s*==\s*([\w.]+)\s*;")
_MADE = re.compile(r"\bnew\s+\w+\s*\(([^()]*)\)")
_WORDED = (EditKind.RELATION, EditKind.COMPARISON, EditKind.SIGN)
_NAMED = 2.0  # odds of the comparison that a constant's name asks for
_MENTION, _ALIKE, _DOUBLED = 2.0, 1.5, 0.7  # odds that what lacks a mention is meant, or the same name on both sides
_KINDRED = 0.8  # of a name beside a constant that bears it: `bed * BED_SPACING`
_CALLED = 2.0  # of a predicate whose name a token bears: `Wind.Calm calm`
_PRESENT, _MOST_PRESENT = 0.2, 3  # for each line that speaks of a predicate, and how many count
_AGREES = 1.5  # odds that both sides of `==` are of one type
_TURNED = 2.5  # odds of a relation of two named tokens that says the same with the tokens swapped
_UNMEANT = -9.0  # and the range of a draw where a variable is, or a line gone that alone sets one
_MERGED = 2.5  # of two objects that have a member in common then, and of what only tells tokens apart and is compared
_SUM = 1.5  # how much the odds count of a sign that stands between the same words elsewhere
_RARE = 0.3  # all other words
# Odds of a change that puts the dimensions of a line right, and of one that makes them odd; other kinds tell nothing.
_RIGHT = {EditKind.LIMIT: 3.0, EditKind.NAME: 1.5}
_ODD = {EditKind.LIMIT: 2.0}
_MEASURED = (EditKind.LIMIT, EditKind.NAME, EditKind.OPERATOR, EditKind.FORMULA, EditKind.TERM, EditKind.MISSING)
_PUT_RIGHT, _MADE_ODD = 1.2, 1.0
_LEAST_ODDS = -0.7  # in conditions, where any comparison may be meant


@dataclass(frozen=True, eq=False, slots=True)
class Usage:
    """How often the lines of a model use each word; `named` are its global variables, `kinds` counts lines by edit.

    `meant` counts relations, comparisons and signs by the sort of line that they stand in, `sums` signs by what they
    stand between; `sampled` are the ranges of draws.
    `passing` is the share of missions of these models that pass, `is_late` whether those fail for what took too long.
    """

    counts: Counter[str]
    named: Container[str]
    kinds: Counter[EditKind]
    meant: Counter[tuple[object, str]]
    sampled: Container[str]
    affinity: Affinity
    sums: Counter[tuple[str, str, str]]
    mentions: Mentions
    directions: Directions
    formulas: Formulas
    orders: Orders
    siblings: Siblings
    limits: TimeLimits
    distinct: Distinct
    dimensions: Dimensions
    flows: Flows
    made: Container[str] = ()  # the numbers and names that objects are made of
    chosen: Container[str] = ()  # the parameters that lines hold equal to a member of an object
    messages: Mapping[str, Container[float]] = field(default_factory=dict)  # numbers, by constants of the same line
    passing: float = 0.0
    is_late: bool = False

    def is_of_object(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether objects are made of what an edit writes, and none of what stood there, and lines hold these equal."""
        is_made = edit.new.strip('"') in self.made and edit.old.strip('"') not in self.made
        return is_made and site.text.partition("=")[0].strip() in self.chosen

    def is_stated(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a comment, or what a line that reads a constant says where it fails, names the number as it is."""
        return edit.begin in site.stated or float(edit.old) in self.messages.get(site.named, ())

    def is_swapped(self, edit: SmallEdit) -> bool:
        """Whether a constant stands where another one is missed, or the range of a draw where a number is meant."""
        return edit.new not in self.sampled and (self.is_idle(edit.new) or edit.old in self.sampled)

    def is_exchanged(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a variable takes the place of a constant that has a name, without a word for it in the line."""
        is_asked = (edit.begin, edit.new) in site.agreeing or self.affinity.kindred(edit, site) > 0
        return edit.old in self.named and edit.new not in self.named and not is_asked

    def is_freed(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether another number demands less."""
        return self.directions.of(edit, site) == (1 if is_raised(edit) else -1)

    def is_idle(self, name: str) -> bool:
        """Whether nothing uses a variable that somebody declared: another may have taken its place."""
        return name in self.named and not self.counts[name]

    def presence(self, edit: SmallEdit, site: EditSite) -> float:
        """How much likelier a predicate is meant that other lines speak of, or that its token is called by."""
        called = _LABEL.match(site.text, edit.end - site.begin)
        label = called.group(1) if called is not None else ""
        bears = is_kin(label, edit.new) - is_kin(label, edit.old)
        return _PRESENT * min(self.counts[edit.new], _MOST_PRESENT) + _CALLED * bears

    def is_wanted(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether an edit adds a variable of the rule, a slack, or what bears the name of what the line is about."""
        name = WORD.findall(edit.new)[-1]
        return name not in self.named or self.is_slack(edit, site) or self.affinity.is_about(name, site)

    def is_slack(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether an edit adds a slack to a limit: `+ GAP_MAX`."""
        return self.affinity.is_slack(WORD.findall(edit.new)[-1], edit, site)

    def gain(self, edit: SmallEdit, site: EditSite) -> float:
        """How much better the new constant of a line belongs there than the old one."""
        return self.affinity.of(edit.new, site) - self.affinity.of(edit.old, site)

    def strands(self, edit: SmallEdit) -> bool:
        """Whether a change leaves a declared constant without any use."""
        return edit.old in self.named and edit.old not in self.sampled and self.counts[edit.old] == 1

    def strands_value(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a change leaves one value of an enumeration without a line, where lines speak of all others.

        Of truth values nothing is known.
        """
        others = {one.new for one in site.rivals(edit, EditKind.VALUE)}
        is_last = edit.new not in TRUTHS and self.counts[edit.old.rpartition(".")[2]] == 1
        return is_last and all(self.counts[other] for other in others)

    def strays(self, edit: SmallEdit, site: EditSite) -> int:
        """1 where an edit leaves out a constant that belongs into other lines only, or keeps it elsewhere in its line.

        -1 where it has its only use here. Of the constants that lines of right models add or multiply with, one in 36
        is such a stray.
        """
        left_out = Counter(WORD.findall(edit.old)) - Counter(WORD.findall(edit.new))
        if not left_out or any(name not in self.named or count > 1 for name, count in left_out.items()):
            return 0
        if any(self.counts[name] == 1 for name in left_out):
            return -1
        kept = WORD.findall(site.after(edit))
        return int(all(name in kept or self.affinity.of(name, site) == 0.0 for name in left_out))

    def twins(self, edit: SmallEdit, site: EditSite) -> int:
        """1 for a change after which a line is written as one of another rule, less 1 for a line that is so already.

        The other way round within a rule.
        """
        own = self.affinity.is_repeated(site) - self.affinity.repeats(edit, site)
        return self.affinity.makes_twin(edit, site) - self.affinity.has_twin(site) + own

    def fitness(self, edit: SmallEdit, site: EditSite) -> float:
        """How much better a name fits into a line than the old one: by what lacks a mention, and by likeness."""
        if edit.new in self.sampled or self.mentions.unsets(edit, site):
            return _UNMEANT
        if self.mentions.merges(edit, site) or self.mentions.compares_label(edit, site):
            return -_MERGED
        weight = _MENTION if edit.kind is EditKind.NAME else 0.5 * _MENTION
        gain = weight * self.mentions.gain(edit, site)
        gain += _AGREES * ((edit.begin, edit.new) in site.agreeing)
        gain += _KINDRED * self.affinity.kindred(edit, site)
        return gain + _ALIKE * self.mentions.likeness(edit, site) + _DOUBLED * is_doubled(edit, site)

    def measure(self, edit: SmallEdit, site: EditSite) -> float:
        """How much likelier a change is by the dimensions of the line before and after; a range is no quantity."""
        if edit.kind not in _MEASURED:
            return 0.0
        gain = self.dimensions.gain(edit, site) if edit.new not in self.sampled else -1
        if gain > 0:
            return _RIGHT.get(edit.kind, _PUT_RIGHT)
        return -_ODD.get(edit.kind, _MADE_ODD) if gain < 0 else 0.0

    def is_fitting(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a line asks for a name: by a constant or argument that bears it, its other side, or a sibling."""
        is_fit = self.affinity.kindred(edit, site) > 0 or self.mentions.likeness(edit, site) > 0.0
        return is_fit or (edit.begin, edit.new) in site.wanted or self.siblings.completes(edit, site)

    def odds(self, edit: SmallEdit, site: EditSite) -> float:
        """Logarithm of how much likelier the old word of a relation or comparison is meant than the new one."""
        sort, prior = sort_of(edit, site)
        old, new = sign_of(edit.old), sign_of(edit.new)
        before = prior.get(old, _RARE) + self.meant[sort, old] - 1  # but for this very line
        odds = math.log(before / (prior.get(new, _RARE) + self.meant[sort, new]))
        wanted = self.affinity.sign_of(edit, site) if edit.kind is EditKind.COMPARISON else ""
        if edit.kind is EditKind.SIGN:
            odds += _SUM * math.log(
                max(self.sums[sum_of(edit, site)], 1) / (1 + self.sums[sum_of(edit, site, edit.new)])
            )
        if sort == "between" and edit.new == inverse_of(edit.old):
            odds -= _TURNED
        odds += _NAMED * ((old[:1] == wanted[:1]) - (new[:1] == wanted[:1])) if wanted else 0.0
        return max(odds, _LEAST_ODDS) if sort == "condition" else odds


def usage_of(
    sites: Sequence[EditSite], *, passing: float = 0.0, is_late: bool = True, labels: Container[Label] = ()
) -> Usage:
    """The usage of words in all lines; a line that sets a variable does not use it. `labels` need no line."""
    counts: Counter[str] = Counter()
    kinds: Counter[EditKind] = Counter()
    meant: Counter[tuple[object, str]] = Counter()
    sums: Counter[tuple[str, str, str]] = Counter()
    for site in sites:
        counts.update(word for word in WORD.findall(site.text) if word != site.named)
        kinds.update({edit.kind for edit in site.edits})
        words = {edit.begin: edit for edit in site.edits if edit.kind in _WORDED}
        meant.update((sort_of(edit, site)[0], sign_of(edit.old)) for edit in words.values())
        sums.update(sum_of(edit, site) for edit in words.values() if edit.kind is EditKind.SIGN)
    sampled = {name for site in sites for name in SAMPLED.findall(site.text)}
    named = {site.named for site in sites if site.named}
    mentions = Mentions(sites, named, counts, labels)
    directions = Directions(sites, named, is_late=is_late)
    made = {one.strip(' "') for site in sites for found in _MADE.findall(site.text) for one in found.split(",")}
    messages: dict[str, set[float]] = defaultdict(set)
    for site in sites:
        if (said := _MESSAGE.fullmatch(site.text)) is not None:
            for name in WORD.findall(said.group(1)):
                messages[name] |= numbers_in(said.group(2))
    lines = (Formulas(sites, named), Orders(sites), Siblings(sites), TimeLimits(sites), Distinct(sites))
    affinity, dimensions = Affinity(sites, named), Dimensions(sites, named)
    return Usage(
        counts,
        named,
        kinds,
        meant,
        sampled,
        affinity,
        sums,
        mentions,
        directions,
        *lines,
        dimensions,
        Flows(sites),
        made,
        _chosen_by(sites),
        messages,
        passing,
        is_late,
    )


def _chosen_by(sites: Sequence[EditSite]) -> set[str]:
    """The names that lines hold equal to a member of an object that a rule chooses, and those equal to these."""
    objects = {(one.file, one.scope, found.group(1)) for one in sites if (found := _OBJECT.fullmatch(one.text))}
    pairs: list[tuple[str, str]] = []
    chosen: set[str] = set()
    for site in sites:
        if (sides := _EQUAL.fullmatch(site.text)) is None:
            continue
        names = [side.rpartition(".")[2] for side in sides.groups()]
        pairs += [(names[0], names[1]), (names[1], names[0])]
        if any((site.file, site.scope, side.partition(".")[0]) in objects for side in sides.groups()):
            chosen |= set(names)
    while fresh := {other for one, other in pairs if one in chosen} - chosen:
        chosen |= fresh
    return chosen
