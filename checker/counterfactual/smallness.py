"""How likely an edit is the repair of a fault, before anything is known of it: its cost, and how soon it is tried.

Costs are negative logarithms of odds. An edit is the likelier the fewer lines and values there are for edits of its
kind, the more usual what it writes is (in models, and in this one), and the less usual what it takes away.
"""

import math
import re
from collections import Counter
from collections.abc import Container, Sequence
from dataclasses import dataclass

from checker.counterfactual.affinity import WORD, Affinity, is_kin
from checker.counterfactual.bounds import Directions, is_result_moved, sets_value
from checker.counterfactual.formulas import Formulas
from checker.counterfactual.mentions import Mentions, is_doubled, leaves_one
from checker.counterfactual.moments import TimeLimits, mixes_times, puts_times_right
from checker.counterfactual.numbers import NUMERIC, digits, is_farthest, is_raised, is_step, octaves
from checker.counterfactual.orders import Orders
from checker.counterfactual.siblings import Siblings
from checker.counterfactual.word_odds import EVENTS, SAMPLED, SIGNED, TRUTHS, is_asked_for, sign_of, sort_of, sum_of
from checker.mutation.edits import DROPPED, EditKind, EditSite, SmallEdit, inverse_of
from checker.mutation.missing_lines import is_namesake, said_of

_TWICE = re.compile(r"([A-Za-z_][\w.]*)\s*[+*]\s*\1")  # one name, added to itself or multiplied
_LABEL = re.compile(r"\s+(\w+)\s*\)")
_LOOSE = "any"  # the relation that demands nothing
_TERM, _TERM_SOON = 3.0, 0.9  # of a sum or product without a part, and when that is tried
_REPEATED, _REPEATED_SOON = 0.5, -0.2  # the same where both parts are one name
_ADDED, _ADDED_SOON, _ADDED_LATER = 2.0, -0.4, 0.1  # of what nothing reads, and when: if a line speaks of it, if not
_LINE, _LINE_SOON = 1.0, -0.4  # of a line that is missing, and when it is tried if no other can be meant there
_HANDED_ON, _TOLD = 0.5, 2.5  # of one that hands on what has the same name, and of one on what the owner tells
_SIBLING = 3.0  # of a name with which a line says of one axis what another says of another
_RECAST = 0.3  # how much later what no mutant makes is tried
_UNEQUAL, _EQUAL = "!=", "=="
_WORDED = (EditKind.RELATION, EditKind.COMPARISON, EditKind.SIGN)
_FEW = 3  # numbers so small that one more is much
_LATER = 0.7  # what is no number, where most missions pass
_SIDE = 0.1  # when it is tried whether a resource is consumed or produced: there is no third
_BETWEEN = 0.5  # when a number is tried twice or half as large, where it is not known which is better
_SWAPPED = 0.4  # when arguments change places: few lines have such
_LATE = 3.0  # later by so much: what is tried when all likelier edits have been
_DROP = 3.0
_KINDS = 0.5  # how much the number of lines counts at which an edit of the kind can be made
_UNUSUAL = 0.5  # how much the odds count that a word is meant
_OCTAVE = 0.15  # for each doubling of a constant
_DIGIT = 0.1  # for each digit that a constant has more
_IDLE = 2.5  # odds of a constant that nothing uses any more, or where the range of a draw is used as a number
_RANGE = 4.0  # and of such a range in place of a number
_KIN = 0.6  # odds for each point of affinity that a constant has more for a line than another
_LAST_USE = 2.0  # odds that a constant is not declared for nothing
_KIN_SOON = -0.2  # when a constant is tried that belongs better into a line
_TWIN = 1.0  # odds of a line that is then written as another line is
_TWIN_SOON = 0.6  # and how much sooner that is tried
_SENSE = 2.0  # odds that a line is not meant as it stands, which holds what cannot be compared
_LIMITED = 1.0  # how much the odds count of a time that is held to a bare constant
_NAMED = 2.0  # odds of the comparison that a constant's name asks for
_MIXED, _UNMIXED = 3.0, 0.5  # of a line that holds a moment to a duration, and of one that does so no more
_EDGE = 2.0  # odds that few missions fail for a number, not for what is wrong in all of them

_MENTION, _ALIKE, _DOUBLED = 2.0, 1.5, 0.7  # odds that what lacks a mention is meant, or the same name on both sides
_WISHED = 5.5  # of another wish: it is the user's
_KINDRED = 0.8  # of a name beside a constant that bears it: `bed * BED_SPACING`
_CALLED = 2.0  # of a predicate whose name a token bears: `Wind.Calm calm`
_PRESENT, _MOST_PRESENT = 0.2, 3  # for each line that speaks of a predicate, and how many count
_QUOTIENT = 3.0  # of a quotient the other way round: its unit would be another
_RESULT = 2.2  # of a result that changes places: other numbers by far come of it, and any limit is kept or none
_PROMISED = 4.5  # of another property: what it promises less always keeps
_AGREES = 1.5  # odds that both sides of `==` are of one type
_VALUE = 1.7  # of another value: few lines have one, so their number says little
_TURNED = 2.5  # odds of a relation of two named tokens that says the same with the tokens swapped
_CASE = 1.0  # odds that no two conditions of a rule ask for the same value
_LAST_CASE = 2.0  # odds that no value of an enumeration is for nothing, where all others have their use
_UNMEANT = -9.0  # and the range of a draw where a variable is, or a line gone that alone sets one
_FREED = 2.0  # odds that a line which alone says what a variable is says it with `==`
_FLOW = 2.0  # odds that a resource is both consumed and produced
_NOTHING = 1.0  # odds that a number which has a name is not 0
_SUM = 1.5  # how much the odds count of a sign that stands between the same words elsewhere
_RARE = 0.3  # all other words
_LEAST_ODDS = -0.7  # in conditions, where any comparison may be meant


@dataclass(frozen=True, eq=False, slots=True)
class Usage:
    """How often the lines of a model use each word; `named` are its global variables, `kinds` counts lines by edit.

    `meant` counts relations, comparisons and signs by the sort of line that they stand in, `sums` signs by what they
    stand between; `sampled` are the ranges of draws.
    `passing` is the share of missions of these models that pass.
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
    passing: float = 0.0

    def is_swapped(self, edit: SmallEdit) -> bool:
        """Whether a constant stands where another one is missed, or the range of a draw where a number is meant."""
        return edit.new not in self.sampled and (self.is_idle(edit.new) or edit.old in self.sampled)

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
        """Whether what an edit adds is a variable of the rule, or bears the name of what the line is about."""
        name = WORD.findall(edit.new)[-1]
        return name not in self.named or self.affinity.is_about(name, site)

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
        weight = _MENTION if edit.kind is EditKind.NAME else 0.5 * _MENTION
        gain = weight * self.mentions.gain(edit, site)
        gain += _AGREES * ((edit.begin, edit.new) in site.agreeing)
        gain += _KINDRED * self.affinity.kindred(edit, site)
        return gain + _ALIKE * self.mentions.likeness(edit, site) + _DOUBLED * is_doubled(edit, site)

    def is_fitting(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a line asks for a name: by a constant that bears it, the same on the other side, or a sibling."""
        is_fit = self.affinity.kindred(edit, site) > 0 or self.mentions.likeness(edit, site) > 0.0
        return is_fit or self.siblings.completes(edit, site)

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


def usage_of(sites: Sequence[EditSite], *, passing: float = 0.0, is_late: bool = True) -> Usage:
    """The usage of words in all lines; a line that sets a variable does not use it."""
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
    mentions = Mentions(sites, named, counts)
    directions = Directions(sites, named, is_late=is_late)
    lines = (Formulas(sites, named), Orders(sites), Siblings(sites), TimeLimits(sites))
    affinity = Affinity(sites, named)
    return Usage(counts, named, kinds, meant, sampled, affinity, sums, mentions, directions, *lines, passing)


def is_loosening(edit: SmallEdit, site: EditSite) -> bool:
    """Whether an edit takes a demand away altogether, or takes a variable away from the world's draws."""
    is_comparison = edit.kind is EditKind.COMPARISON
    return (
        edit.kind in DROPPED
        or (is_comparison and sign_of(edit.old) == _EQUAL and SAMPLED.search(site.text) is not None)
        or (edit.kind is EditKind.RELATION and edit.new == _LOOSE)
        or (is_comparison and sign_of(edit.new) == _UNEQUAL)
    )


def cost_of(edit: SmallEdit, site: EditSite, usage: Usage) -> float:
    """How unlikely an edit is the repair; what takes a demand away altogether costs most."""
    form = _DROP if is_loosening(edit, site) else _form(edit, site, usage) + _structural(edit, usage)
    form += _MIXED * mixes_times(edit, site)
    return form + _KINDS * math.log(max(usage.kinds[edit.kind], 1)) - _TWIN * usage.twins(edit, site)


def _structural(edit: SmallEdit, usage: Usage) -> float:
    """What a relation, a sign or a comparison costs where missions pass that it is a part of, too."""
    is_shared = edit.kind not in (*NUMERIC, EditKind.LIMIT, EditKind.VALUE)  # a value matters for some arguments only
    return _EDGE * usage.passing if is_shared else 0.0


def _form(edit: SmallEdit, site: EditSite, usage: Usage) -> float:
    match edit.kind:
        case EditKind.RELATION if usage.orders.rights(edit, site):
            return 0.0
        case EditKind.NAME | EditKind.POINT | EditKind.TOKEN | EditKind.SIGN if puts_times_right(edit, site):
            return _UNMIXED
        case EditKind.RELATION | EditKind.COMPARISON | EditKind.SIGN:
            freed = _FREED * usage.mentions.frees(edit, site)
            scale = _SENSE * (edit.kind is EditKind.SIGN and usage.formulas.adds_scale(edit, site))
            return 1.0 + scale + _UNUSUAL * usage.odds(edit, site) + freed
        case EditKind.LIMIT:
            belongs = _KIN * usage.gain(edit, site) - _LAST_USE * usage.strands(edit)
            belongs += _AGREES * ((edit.begin, edit.new) in site.agreeing)
            belongs -= _RANGE * (edit.new in usage.sampled)
            return 1.5 - _IDLE * usage.is_swapped(edit) - belongs
        case EditKind.CONSTANT | EditKind.OFF_BY_ONE:
            far = 0.0 if site.named and float(edit.old) == 0.0 else octaves(edit)  # who names a number has one
            nothing = _NOTHING * (bool(site.named) and float(edit.old) == 0.0)
            return 1.0 - nothing + _OCTAVE * far + _DIGIT * (digits(edit.new) - digits(edit.old))
        case EditKind.ARGUMENTS if usage.directions.is_put_in_order(edit, site) or usage.siblings.completes(edit, site):
            return 0.0
        case EditKind.PROMISE:
            return _PROMISED
        case EditKind.MISSION if edit.old == "0":
            return 0.0  # a reactor that is asked for nothing
        case EditKind.ARGUMENTS if is_result_moved(edit, site):
            return _RESULT + usage.formulas.place_odds(edit, site)
        case EditKind.GOAL:
            return _WISHED
        case EditKind.PREDICATE if edit.old in EVENTS:
            return 3.0 - _FLOW * (not usage.counts[edit.new])
        case EditKind.PREDICATE:
            return 3.0 - usage.presence(edit, site)
        case EditKind.ARGUMENTS if "/" in edit.old:
            return 1.0 + _QUOTIENT
        case EditKind.ARGUMENTS:
            return 1.0 + usage.formulas.place_odds(edit, site)
        case EditKind.OPERATOR | EditKind.FORMULA:
            return 3.0 + usage.formulas.odds(edit, site)
        case EditKind.MISSING:
            return _ADDED * (not usage.is_wanted(edit, site))
        case EditKind.LINE:
            told = _TOLD * usage.mentions.is_found_out(said_of(edit.new).strip(), site)
            return told + (_HANDED_ON if is_namesake(edit.new) else _LINE)
        case EditKind.MISSION:
            return 3.0
        case EditKind.TERM:
            if _TWICE.fullmatch(edit.old):
                return _REPEATED
            return _TERM - _ALIKE * usage.mentions.makes_alike(edit, site) - _DOUBLED * leaves_one(edit)
        case EditKind.VALUE:
            is_case = edit.old not in TRUTHS and not site.text.endswith(";")
            cases = _CASE * usage.mentions.case_gain(edit, site) if is_case else 0.0
            return _VALUE + _LAST_CASE * usage.strands_value(edit, site) - cases
        case EditKind.NAME | EditKind.POINT | EditKind.TOKEN:
            usual = _LIMITED * usage.limits.odds(edit, site)
            usual += _SENSE * (site.is_apart and (edit.begin, edit.new) in site.agreeing)
            return 2.0 - usage.fitness(edit, site) - _SIBLING * usage.siblings.completes(edit, site) - usual
        case _:
            return 1.0


def delay_of(edit: SmallEdit, site: EditSite, usage: Usage) -> float | None:
    """How late an edit is tried at its line; None: only if another edit of the line has helped.

    What loosens most comes first: where it does not help, smaller ones seldom do.
    """
    delay = _delay(edit, site, usage)
    if delay is not None and mixes_times(edit, site):
        return _LATE
    if delay is None or edit.kind is EditKind.VALUE:  # what is asked once is not asked again
        return delay
    return delay - _TWIN_SOON * usage.twins(edit, site)


def _delay(edit: SmallEdit, site: EditSite, usage: Usage) -> float | None:
    match edit.kind:
        case EditKind.MISSION:
            return -1.0 if edit.old == "0" else None  # tried last
        case EditKind.NAME | EditKind.POINT | EditKind.TOKEN | EditKind.SIGN if puts_times_right(edit, site):
            return -1.0  # seen without any flight
        case EditKind.NAME | EditKind.LIMIT | EditKind.ARGUMENTS if usage.siblings.completes(edit, site):
            return -1.0
        case EditKind.GOAL | EditKind.PROMISE:
            return None
        case EditKind.LIMIT if usage.is_swapped(edit):
            return -1.0
        case EditKind.LIMIT if edit.new in usage.sampled:
            return _LATE
        case EditKind.LIMIT if (edit.begin, edit.new) in site.agreeing:
            return _KIN_SOON - 0.1 * usage.gain(edit, site)
        case EditKind.LIMIT:
            return _KIN_SOON if usage.gain(edit, site) > 0.0 and not usage.strands(edit) else _LATE
        case EditKind.SIGN if edit.new not in SIGNED["sum"]:
            return 0.0  # few write a number below zero
        case EditKind.SIGN:
            scale = _SENSE * usage.formulas.adds_scale(edit, site)
            return 0.5 + scale + _UNUSUAL * usage.odds(edit, site) + _LATER * usage.passing
        case EditKind.ARGUMENTS if usage.directions.is_put_in_order(edit, site):
            return -1.0  # seen without any flight
        case EditKind.ARGUMENTS:
            odds = _UNUSUAL * usage.formulas.place_odds(edit, site)
            return _SWAPPED + _LATER * usage.passing + 0.5 * ("/" in edit.old) + odds
        case EditKind.OPERATOR | EditKind.FORMULA:
            rare = _RECAST * (edit.kind is EditKind.FORMULA and len(edit.old) == 1)
            return 0.5 + rare + _UNUSUAL * usage.formulas.odds(edit, site) + _LATER * usage.passing
        case EditKind.LINE if usage.mentions.is_found_out(said_of(edit.new).strip(), site):
            return _LATE
        case EditKind.LINE:
            others = [one for one in site.rivals(edit, edit.kind) if said_of(one.new) == said_of(edit.new)]
            alike = 0.0 if is_namesake(edit.new) else math.log(len(others))
            return _LINE_SOON + _UNUSUAL * alike + _LATER * usage.passing
        case EditKind.MISSING:
            return _ADDED_SOON if usage.is_wanted(edit, site) else _ADDED_LATER
        case EditKind.TERM:
            is_alike = usage.mentions.makes_alike(edit, site) or _TWICE.fullmatch(edit.old)
            soon = _TERM_SOON - _DOUBLED * leaves_one(edit)
            return _REPEATED_SOON if is_alike else soon + _LATER * usage.passing
        case EditKind.NAME if usage.mentions.says_the_same(edit, site):
            return _LATE
        case EditKind.NAME if site.is_apart and (edit.begin, edit.new) in site.agreeing:
            return -1.0 - 0.1 * usage.fitness(edit, site)
        case EditKind.NAME:
            fitness = usage.fitness(edit, site)
            is_set = usage.mentions.is_set_by(edit, site)
            neutral = _LATE if edit.new in usage.named or is_set else 0.7
            return 0.5 - 0.6 * fitness if fitness > 0.0 else neutral - fitness
        case EditKind.VALUE:
            alike = len(site.rivals(edit, EditKind.VALUE))
            return -0.4 + _LATER * usage.passing + _UNUSUAL * math.log(alike)  # one of many is meant less often each
        case EditKind.PREDICATE if edit.old in EVENTS:
            return _SIDE
        case EditKind.POINT | EditKind.TOKEN:
            usual = usage.fitness(edit, site) + _LIMITED * usage.limits.odds(edit, site)
            return 0.5 - 0.5 * usual + _LATER * usage.passing
        case EditKind.PREDICATE:
            return 0.5 - usage.presence(edit, site) + _LATER * usage.passing
        case EditKind.DROPPED_CONSTRAINT:
            return _LATE if sets_value(edit.old) else 0.3
        case EditKind.DROPPED_BRANCH:
            return 1.0
        case EditKind.RELATION if usage.orders.rights(edit, site):
            return -1.0  # seen without any flight
        case EditKind.RELATION:
            if edit.new == _LOOSE:
                return 0.3
            return 0.6 + _UNUSUAL * usage.odds(edit, site) + _LATER * usage.passing
        case EditKind.COMPARISON if sign_of(edit.new) == _UNEQUAL:
            return _LATE
        case EditKind.COMPARISON if is_asked_for(edit, usage.affinity.sign_of(edit, site)):
            return _KIN_SOON
        case EditKind.COMPARISON:
            return 0.6 + _UNUSUAL * usage.odds(edit, site) + _LATER * usage.passing
        case EditKind.CONSTANT:
            if float(edit.new) <= 0.0 < float(edit.old):
                return _LATE
            way = usage.directions.of(edit, site)
            between = _BETWEEN if way == 0 else 1.2  # too much may be as bad as too little
            if not is_farthest(edit, site):
                return between if octaves(edit) >= 1.0 else None
            # A zero in a rule seldom stands for a number, nor does the 1 of a count: `next.k == k + 1`.
            is_telling = site.named or (float(edit.old) != 0.0 and not is_step(edit, site))
            return 1.2 if way == (-1 if is_raised(edit) else 1) else -0.3 if is_telling else _BETWEEN
        case EditKind.OFF_BY_ONE:
            return 0.4 if abs(float(edit.old)) <= _FEW else None


def is_probe(edit: SmallEdit) -> bool:
    """Whether an edit leaves out a limit or a relation: a value that is not set would fail all the same."""
    is_limit = edit.kind is EditKind.DROPPED_CONSTRAINT and not sets_value(edit.old)
    return is_limit or (edit.kind is EditKind.RELATION and edit.new == _LOOSE)
