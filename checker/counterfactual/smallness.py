"""How likely an edit is the repair of a fault, before anything is known of it: its cost, and how soon it is tried.

Costs are negative logarithms of odds. An edit is the likelier the fewer lines and values there are for edits of its
kind, the more usual what it writes is (in models, and in this one), and the less usual what it takes away.
"""

import math
import re

from checker.counterfactual.bounds import is_result_moved, sets_value
from checker.counterfactual.formulas import divides_again, drops_number, drops_unit
from checker.counterfactual.mentions import leaves_one
from checker.counterfactual.moments import mixes_times, puts_times_right
from checker.counterfactual.numbers import (
    digits,
    is_farthest,
    is_of_formula,
    is_of_object,
    is_raised,
    is_step,
    is_whole,
    octaves,
)
from checker.counterfactual.orders import lets_go
from checker.counterfactual.usage import Usage
from checker.counterfactual.word_odds import EVENTS, SAMPLED, SIGNED, TRUTHS, is_asked_for, sign_of
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import DROPPED, NUMBERS, EditKind
from checker.mutation.missing_lines import is_namesake, said_of

_TWICE = re.compile(r"([A-Za-z_][\w.]*)\s*[+*]\s*\1")  # one name, added to itself or multiplied
_LOOSE = "any"  # the relation that demands nothing
_TERM, _TERM_SOON = 3.0, 0.9  # of a sum or product without a part, and when that is tried
_STRAY, _STRAY_SOON = 2.5, 1.2  # odds that a constant does not belong there which does elsewhere, and how much sooner
_OWN_USE = 1.0  # odds that a constant is meant where it has its only use
_BARE, _BARE_SOON = 1.0, 0.9  # the same of a bare number: of 11 faults with a part too much 9 had one too much
_UNIT_SOON = 0.5  # how much sooner where the number is one by which units differ
_REPEATED, _REPEATED_SOON = 0.5, -0.2  # the same where both parts are one name
_MISSED = 2.0  # of a term or factor: of 445 faults two left one out, and 17 of 59 right models have what nothing reads
_ADDED, _ADDED_SOON, _ADDED_LATER = 2.0, -0.4, 0.1  # of what nothing reads, and when: if a line speaks of it, if not
_TWICE_DIVIDED = 4.0  # of a quotient that is divided once more: of 378 products in right models none has this form
_LINE, _LINE_SOON = 1.0, -0.4  # of a line that is missing, and when it is tried if no other can be meant there
_HANDED_ON, _TOLD = 0.5, 2.5  # of one that hands on what has the same name, and of one on what the owner tells
_SIBLING = 3.0  # of a name with which a line says of one axis what another says of another
_RECAST = 0.3  # how much later what no mutant makes is tried
_UNEQUAL, _EQUAL = "!=", "=="
_FEW = 3  # numbers so small that one more is much
_LATER = 0.7  # what is no number, where most missions pass
_SIDE = 0.1  # when it is tried whether a resource is consumed or produced: there is no third
_BETWEEN = 0.5  # when a number is tried twice or half as large, where it is not known which is better
_OTHER_WAY = 0.9  # when a number is changed the way that demands more
_SWAPPED = 0.4  # when arguments change places: few lines have such
_TOLD_BY_TEXT = 1.5  # of what the text tells to be meant
_SWAP = 2.0  # of two lines that have changed places
_LATE = 3.0  # later by so much: what is tried when all likelier edits have been
_DROP = 3.0
_KINDS = 0.5  # how much the number of lines counts at which an edit of the kind can be made
_UNUSUAL = 0.5  # how much the odds count that a word is meant
_UNRELATED = 1.0  # and of a relation, where what is unusual is hardly ever meant
_OCTAVE = 0.15  # for each doubling of a constant
_DIGIT = 0.1  # for each digit that a constant has more
_IDLE = 2.5  # odds of a constant that nothing uses any more, or where the range of a draw is used as a number
_RANGE = 4.0  # and of such a range in place of a number
_FACTOR = 3.0  # odds that a product is not what one of its factors is called
_KIN = 0.6  # odds for each point of affinity that a constant has more for a line than another
_LAST_USE = 3.5  # odds that a constant is not declared for nothing
_KIN_SOON = -0.2  # when a constant is tried that belongs better into a line
_TWIN = 1.0  # odds of a line that is then written as another line is
_TWIN_SOON = 0.6  # and how much sooner that is tried
_MEASURED_SOON = 0.2  # how much sooner a change is tried, for the odds of the dimensions
_SENSE = 2.0  # odds that a line is not meant as it stands, which holds what cannot be compared
_LIMITED = 1.0  # how much the odds count of a time that is held to a bare constant
_NAMED = 2.0  # odds of the comparison that a constant's name asks for
_MIXED, _UNMIXED = 3.0, 0.5  # of a line that holds a moment to a duration, and of one that does so no more
_LIMIT = 0.3  # odds of a limit that mends alone: what is too slow by itself breaks other limits as well
_UNNAMED, _WHOLE = 0.6, 2.0  # of a number without a name that something is computed with; of the 1.0 of a share
_UNASKED = 1.5  # of a name for which nothing speaks: of 19 that faults had changed these were 4, of 300 in a model most
_OBJECT = 1.2  # of a number of an object: of 318 mistakes were in 18, of 387 numbers with a name in 123
_ARGUMENT = 1.0  # odds that who writes the name of a constant means no variable
_EDGE = 2.0  # odds that few missions fail for a number, not for what is wrong in all of them

_ALIKE, _DOUBLED = 1.5, 0.7  # odds of a part that leaves the same name on both sides, or one name once
_WISHED = 5.5  # of another wish: it is the user's
_UNKNOWN = 3.0  # odds of a wish for what an object is made of, where none is made of what was wished
_EXCHANGED = 2.0  # of operands that change places: of 505 faults by hand one difference and one quotient
_SIGN = 1.5  # of a sign between operands: of 505 faults by hand four
_QUOTIENT = 3.0  # of a quotient the other way round: its unit would be another
_RESULT = 3.2  # of a result that changes places: other numbers by far come of it, and any limit is kept or none
_PROMISED = 4.5  # of another property: what it promises less always keeps
_AGREES = 1.5  # odds that both sides of `==` are of one type
_VALUE = 1.7  # of another value: few lines have one, so their number says little
_CASE = 1.0  # odds that no two conditions of a rule ask for the same value
_LAST_CASE = 2.0  # odds that no value of an enumeration is for nothing, where all others have their use
_FREED = 2.0  # odds that a line which alone says what a variable is says it with `==`
_LET_GO = 1.0  # odds that a token waits for the end of one it asks for, where something took too long
_WRITTEN = 1.0  # odds that tokens come in the order in which a rule asks for them
_AMONG = 0.4  # odds of each of so many constants for none of which anything speaks
_OUT_OF_ORDER = 2.0  # of the time of a goal by which it is not where the others of its timeline would have it
_UNLIKE = 1.5  # odds that a whole number is not mistaken for a real one, and a wish lies among those of its kind
_NOTED = 1.7  # odds of a number that a comment names: 2 of 205 changed ones, 2 of 1,711 right ones
_STATED = 2.0  # odds that a number is right which a comment names: 19 of 2,001 right ones, and no changed one
_CONFUSED = 2.0  # odds that two numbers of one variable are not the same
_DENIED = 2.0  # odds that two lines that agree on an order of tokens are right
_FLOW = 2.0  # odds that a resource is both consumed and produced
_NOTHING = 1.0  # odds that a number which has a name is not 0


def is_loosening(edit: SmallEdit, site: EditSite) -> bool:
    """Whether an edit takes a demand away altogether, or takes a variable away from the world's draws."""
    if (edit.begin, edit.new) in site.wanted:
        return False
    is_comparison = edit.kind is EditKind.COMPARISON
    return (
        edit.kind in DROPPED
        or (is_comparison and sign_of(edit.old) == _EQUAL and SAMPLED.search(site.text) is not None)
        or (edit.kind is EditKind.RELATION and edit.new == _LOOSE)
        or (is_comparison and sign_of(edit.new) == _UNEQUAL and not site.is_check)
    )


def sets_no_more(edit: SmallEdit) -> bool:
    """Whether an edit makes a bound of what was set: of 501 faults by hand none had put `==` for that."""
    return edit.kind is EditKind.COMPARISON and sign_of(edit.old) == _EQUAL and sign_of(edit.new) != _EQUAL


def cost_of(edit: SmallEdit, site: EditSite, usage: Usage) -> float:
    """How unlikely an edit is the repair; what takes a demand away altogether costs most."""
    if _is_told(edit, site, usage):
        return _TOLD_BY_TEXT
    form = _DROP if is_loosening(edit, site) else _form(edit, site, usage) + _structural(edit, usage)
    form += _MIXED * mixes_times(edit, site) - usage.measure(edit, site)
    rivals = EditKind.CONSTANT if edit.kind is EditKind.SETTING else edit.kind  # a setting is one number of many
    return form + _KINDS * math.log(max(usage.kinds[rivals], 1)) - _TWIN * usage.twins(edit, site)


def _is_told(edit: SmallEdit, site: EditSite, usage: Usage) -> bool:
    """Whether the text itself tells what is meant: of a copy, a swapped line, a wait, a formula."""
    is_wanted = (edit.begin, edit.new) in site.wanted or usage.orders.counts_from_end(edit, site)
    return is_wanted or usage.affinity.makes_formula(edit, site)


def _structural(edit: SmallEdit, usage: Usage) -> float:
    """What a relation, a sign or a comparison costs where missions pass that it is a part of, too."""
    is_shared = edit.kind not in (*NUMBERS, EditKind.LIMIT, EditKind.VALUE)  # a value matters for some arguments only
    return _EDGE * usage.passing if is_shared else 0.0


def _form(edit: SmallEdit, site: EditSite, usage: Usage) -> float:
    match edit.kind:
        case EditKind.RELATION if usage.orders.rights(edit, site):
            return 0.0
        case EditKind.NAME | EditKind.POINT | EditKind.TOKEN | EditKind.SIGN if puts_times_right(edit, site):
            return _UNMIXED
        case EditKind.RELATION | EditKind.COMPARISON | EditKind.SIGN:
            freed = _FREED * usage.mentions.frees(edit, site) + _DENIED * usage.orders.denies(edit, site)
            freed -= _WRITTEN * usage.orders.as_written(edit, site)
            freed += _LET_GO * (usage.is_late and lets_go(edit, site))
            scale = _SENSE * (edit.kind is EditKind.SIGN and usage.formulas.adds_scale(edit, site))
            scale += _SIGN * (edit.kind is EditKind.SIGN and edit.old in SIGNED["sum"])  # few write one below zero
            unusual = _UNRELATED if edit.kind is EditKind.RELATION else _UNUSUAL
            return 1.0 + scale + unusual * usage.odds(edit, site) + freed
        case EditKind.LIMIT:
            belongs = _KIN * usage.gain(edit, site) - _LAST_USE * (usage.strands(edit) and not usage.is_swapped(edit))
            belongs += _AGREES * ((edit.begin, edit.new) in site.agreeing)
            belongs -= _RANGE * (edit.new in usage.sampled) + _FACTOR * usage.formulas.repeats_factor(edit, site)
            if belongs <= 0.0 and not usage.is_swapped(edit):
                belongs -= _AMONG * math.log(len(site.rivals(edit, EditKind.LIMIT)))
            return 1.5 - _IDLE * usage.is_swapped(edit) - belongs
        case EditKind.CONSTANT | EditKind.OFF_BY_ONE:
            far = 0.0 if site.named and float(edit.old) == 0.0 else octaves(edit)  # who names a number has one
            nothing = _NOTHING * (bool(site.named) and float(edit.old) == 0.0)
            nothing -= _CONFUSED * usage.distinct.confuses(edit, site)
            nothing -= _WHOLE * is_whole(edit, site) + _UNNAMED * is_of_formula(edit, site)
            nothing -= _OBJECT * is_of_object(edit, site)
            nothing += _NOTED * ((edit.begin, edit.new) in site.noted) - _STATED * usage.is_stated(edit, site)
            nothing += _LIMIT * (usage.affinity.is_limit(site.named) and usage.is_freed(edit, site))
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
            return (
                _WISHED - _UNKNOWN * usage.is_of_object(edit, site) + _UNLIKE * ((edit.begin, edit.new) in site.unlike)
            )
        case EditKind.PREDICATE if usage.flows.asks_for(edit, site):
            return 0.0
        case EditKind.PREDICATE if edit.old in EVENTS:
            return 3.0 - _FLOW * (not usage.counts[edit.new])
        case EditKind.PREDICATE:
            return 3.0 - usage.presence(edit, site)
        case EditKind.ARGUMENTS if "/" in edit.old:
            return 1.0 + _QUOTIENT
        case EditKind.ARGUMENTS:
            return _EXCHANGED + usage.formulas.place_odds(edit, site) + _OBJECT * is_of_object(edit, site)
        case EditKind.OPERATOR | EditKind.FORMULA:
            return 3.0 + usage.formulas.odds(edit, site)
        case EditKind.MISSING:
            missed = _MISSED * (not usage.is_slack(edit, site)) + _TWICE_DIVIDED * divides_again(edit)
            return missed + _ADDED * (not usage.is_wanted(edit, site))
        case EditKind.LINE:
            told = _TOLD * usage.mentions.is_found_out(said_of(edit.new).strip(), site)
            return told + (_HANDED_ON if is_namesake(edit.new) else _LINE)
        case EditKind.MISSION if (edit.begin, edit.new) in site.agreeing:
            return _OUT_OF_ORDER
        case EditKind.MISSION:
            return 3.0 + _UNLIKE * ((edit.begin, edit.new) in site.unlike)
        case EditKind.SETTING:
            return 1.0 + _OCTAVE * octaves(edit) + _DIGIT * (digits(edit.new) - digits(edit.old))
        case EditKind.SWAP:
            return _SWAP
        case EditKind.TURN:
            return 1.0 - _WRITTEN * usage.orders.as_written(edit, site)
        case EditKind.TERM:
            if _TWICE.fullmatch(edit.old):
                return _REPEATED
            odd = _NAMED * usage.affinity.drops_limit(edit, site)
            strays = usage.strays(edit, site)
            odd += _STRAY if strays > 0 else _OWN_USE * strays
            odd += _BARE * drops_number(edit)
            return _TERM - odd - _ALIKE * usage.mentions.makes_alike(edit, site) - _DOUBLED * leaves_one(edit)
        case EditKind.VALUE:
            is_case = edit.old not in TRUTHS and not site.text.endswith(";")
            cases = _CASE * usage.mentions.case_gain(edit, site) if is_case else 0.0
            return _VALUE + _LAST_CASE * usage.strands_value(edit, site) - cases
        case EditKind.NAME | EditKind.POINT | EditKind.TOKEN:
            usual = _LIMITED * usage.limits.odds(edit, site)
            usual -= _ARGUMENT * usage.is_exchanged(edit, site)
            usual += _SENSE * (site.is_apart and (edit.begin, edit.new) in site.agreeing)
            usual -= _UNLIKE * ((edit.begin, edit.new) in site.unlike)
            fitness = usage.fitness(edit, site)
            usual -= _UNASKED * (edit.kind is EditKind.NAME and fitness <= 0.0)
            return 2.0 - fitness - _SIBLING * usage.siblings.completes(edit, site) - usual
        case _:
            return 1.0


def delay_of(edit: SmallEdit, site: EditSite, usage: Usage) -> float | None:
    """How late an edit is tried at its line; None: only if another edit of the line has helped.

    What loosens most comes first: where it does not help, smaller ones seldom do.
    """
    if _is_told(edit, site, usage):
        return -1.0  # seen without any flight
    delay = _delay(edit, site, usage)
    if delay is not None and mixes_times(edit, site):
        return _LATE
    if delay is None or edit.kind is EditKind.VALUE:  # what is asked once is not asked again
        return delay
    return delay - _TWIN_SOON * usage.twins(edit, site) - _MEASURED_SOON * usage.measure(edit, site)


def first_edits(site: EditSite, usage: Usage) -> list[tuple[float, SmallEdit]]:
    """The edits of a line that are tried whether or not others help, the soonest first."""
    delays = [(delay_of(edit, site, usage), number, edit) for number, edit in enumerate(site.edits)]
    wanted = sorted((delay, number, edit) for delay, number, edit in delays if delay is not None)
    return [(delay, edit) for delay, _, edit in wanted]


def _delay(edit: SmallEdit, site: EditSite, usage: Usage) -> float | None:
    match edit.kind:
        case EditKind.MISSION if (edit.begin, edit.new) in site.agreeing:
            return _KIN_SOON
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
        case EditKind.LIMIT if edit.new in usage.sampled or usage.formulas.repeats_factor(edit, site):
            return _LATE
        case EditKind.LIMIT if (edit.begin, edit.new) in site.agreeing:
            return _KIN_SOON - 0.1 * usage.gain(edit, site)
        case EditKind.LIMIT if usage.measure(edit, site) > 0.0 and not usage.strands(edit):
            return _KIN_SOON
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
        case EditKind.FORMULA if usage.formulas.divides_by_scale(edit):
            return _KIN_SOON
        case EditKind.OPERATOR | EditKind.FORMULA:
            rare = _RECAST * (edit.kind is EditKind.FORMULA and len(edit.old) == 1)
            return 0.5 + rare + _UNUSUAL * usage.formulas.odds(edit, site) + _LATER * usage.passing
        case EditKind.LINE if usage.mentions.is_found_out(said_of(edit.new).strip(), site):
            return _LATE
        case EditKind.LINE:
            others = [one for one in site.rivals(edit, edit.kind) if said_of(one.new) == said_of(edit.new)]
            alike = 0.0 if is_namesake(edit.new) else math.log(len(others))
            return _LINE_SOON + _UNUSUAL * alike + _LATER * usage.passing
        case EditKind.MISSING if divides_again(edit):
            return _LATE
        case EditKind.MISSING:
            return _ADDED_SOON if usage.is_wanted(edit, site) else _ADDED_LATER
        case EditKind.TERM if usage.affinity.drops_limit(edit, site):
            return -1.0  # seen without any flight
        case EditKind.TERM:
            is_alike = usage.mentions.makes_alike(edit, site) or _TWICE.fullmatch(edit.old)
            soon = _TERM_SOON - _DOUBLED * leaves_one(edit) - _STRAY_SOON * (usage.strays(edit, site) > 0)
            soon -= _BARE_SOON * drops_number(edit) + _UNIT_SOON * drops_unit(edit)
            return _REPEATED_SOON if is_alike else soon + _LATER * usage.passing
        case EditKind.NAME if usage.mentions.says_the_same(edit, site):
            return _LATE
        case EditKind.NAME if site.is_apart and (edit.begin, edit.new) in site.agreeing:
            return -1.0 - 0.1 * usage.fitness(edit, site)
        case EditKind.NAME:
            fitness = usage.fitness(edit, site)
            is_set = usage.mentions.is_set_by(edit, site)
            neutral = _LATE if edit.new in usage.named or is_set else 0.7
            fitness -= _UNLIKE * ((edit.begin, edit.new) in site.unlike)
            return 0.5 - 0.6 * fitness if fitness > 0.0 else neutral - fitness
        case EditKind.VALUE:
            alike = len(site.rivals(edit, EditKind.VALUE))
            return -0.4 + _LATER * usage.passing + _UNUSUAL * math.log(alike)  # one of many is meant less often each
        case EditKind.PREDICATE if usage.flows.asks_for(edit, site):
            return -1.0  # seen without any flight
        case EditKind.PREDICATE if edit.old in EVENTS:
            return _SIDE
        case EditKind.POINT | EditKind.TOKEN:
            usual = usage.fitness(edit, site) + _LIMITED * usage.limits.odds(edit, site)
            return 0.5 - 0.5 * usual + _LATER * usage.passing
        case EditKind.PREDICATE:
            return 0.5 - usage.presence(edit, site) + _LATER * usage.passing
        case EditKind.SETTING:
            return _BETWEEN if octaves(edit) <= 1.0 else -0.3
        case EditKind.DROPPED_CONSTRAINT:
            return _LATE if sets_value(edit.old) and not site.is_check else 0.3
        case EditKind.DROPPED_BRANCH:
            return 1.0
        case EditKind.SWAP | EditKind.TURN:
            return _SWAPPED + _LATER * usage.passing
        case EditKind.RELATION if usage.orders.rights(edit, site):
            return -1.0  # seen without any flight
        case EditKind.RELATION:
            if edit.new == _LOOSE:
                return 0.3
            return 0.6 + _UNUSUAL * usage.odds(edit, site) + _LATER * usage.passing
        case EditKind.COMPARISON if sign_of(edit.new) == _UNEQUAL and not site.is_check:
            return _LATE
        case EditKind.COMPARISON if is_asked_for(edit, usage.affinity.sign_of(edit, site)):
            return _KIN_SOON
        case EditKind.COMPARISON:
            return 0.6 + _UNUSUAL * usage.odds(edit, site) + _LATER * usage.passing
        case EditKind.CONSTANT:
            if float(edit.new) <= 0.0 < float(edit.old) or is_whole(edit, site):
                return _LATE
            way = usage.directions.of(edit, site)
            between = _BETWEEN if way == 0 else _OTHER_WAY  # too much may be as bad as too little
            if not is_farthest(edit, site):
                return between if octaves(edit) >= 1.0 else None
            # A zero in a rule seldom stands for a number, nor does the 1 of a count: `next.k == k + 1`.
            is_telling = site.named or (float(edit.old) != 0.0 and not is_step(edit, site))
            return _OTHER_WAY if way == (-1 if is_raised(edit) else 1) else -0.3 if is_telling else _BETWEEN
        case EditKind.OFF_BY_ONE:
            return 0.4 if abs(float(edit.old)) <= _FEW else None


def is_probe(edit: SmallEdit, site: EditSite) -> bool:
    """Whether an edit leaves out a limit or a relation: a value that is not set would fail all the same."""
    is_limit = edit.kind is EditKind.DROPPED_CONSTRAINT and (site.is_check or not sets_value(edit.old))
    return is_limit or (edit.kind is EditKind.RELATION and edit.new == _LOOSE)
