"""Trials in, causes out as plain data, ranked: what a story, a report and the yardstick of mutants show.

First come small changes that mend every failed mission that they were tried on, without a goal lost. Where there are
none, a line may be missing: what one branch of a condition sets alone, or a constant that nothing reads, comes before
what only takes a demand away or mends some, variables that too few lines speak of after it. Where Python raised, the
line that did so stands in their place. A constant that is read and
has no value is second at least. Where a branch lacks what the other sets, what leads around it shows no more.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from checker.counterfactual.candidates import Candidate
from checker.counterfactual.damage import HEAVY
from checker.counterfactual.remarks import Remark
from checker.counterfactual.tried import LineTrial, Loose, Trials, TrialsEnd
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind
from checker.names import relative_name
from runtime.executive.outcome import SourcePlace

_MOST_LOOSE = 3
_WORD = re.compile(r"[A-Za-z_]\w*")
_LEAST_DOUBT = 4.0  # of a loose end that comes after all that has been flown


class Claim(StrEnum):
    """What is known of a line; all but a loose end have been flown."""

    MENDS = "mends"  # a small change makes the missions pass
    LOOSENS = "loosens"  # without what it demands, or with much less of it, they pass
    CODED = "coded"  # the same of a call of the project's Python, of which nothing smaller can be tried
    PARTLY = "partly"  # some of them pass, or others that passed fail
    EVADES = "evades"  # they pass, but goals are lost, or what happens in all other missions does not
    ASLEEP = "asleep"  # Python of the project published there what nothing calls it to end
    RAISED = "raised"  # Python of the project raised there, and no change of a model keeps it from that
    LOOSE_END = "loose end"  # a line may be missing: nothing was flown
    UNEVEN = "uneven branches"  # the same, by what one branch of a condition sets and the other does not
    UNREAD = "unread"  # the same, by a constant that nothing reads
    UNSET = "unset"  # the same, by one that is read and has no value


@dataclass(frozen=True, slots=True)
class RankedLine:
    """One line with its claim: the smallest `change` that helped, on how many of the failed missions it was tried on.

    `among` is how many missions failed so.

    `spoilt` missions that passed fail with it. Of a loose end, `variable` is what too few lines speak of, or none
    reads. `rule` is what the line is a part of.
    """

    place: SourcePlace
    rule: str
    claim: Claim
    change: SmallEdit | None = None
    helped: int = 0
    missions: int = 0
    spoilt: int = 0
    variable: str = ""  # of a call of Python, the constraint that is called
    among: int = 0


@dataclass(frozen=True, slots=True)
class Causes:
    """Why missions of one fault fail, the likeliest cause first; `tried` lines were tried in so many flights.

    Properties that were left `aside` are violated as well, and may be so with each change; so may those that all
    missions violate `beside` this failure.
    """

    ranked: tuple[RankedLine, ...] = ()
    tried: int = 0
    flights: int = 0
    ended: TrialsEnd = TrialsEnd.COMPLETE
    flown: int = 0  # the number of the failed mission
    remarks: tuple[Remark, ...] = ()  # what lint says of the models
    aside: tuple[str, ...] = ()
    beside: tuple[str, ...] = ()
    beyond: int = 0  # of the flights, those beyond the usual, until a change helped in all missions

    @property
    def is_sought(self) -> bool:
        """Whether anything was tried, or would have been with more time."""
        return self.flights > 0 or self.ended is not TrialsEnd.COMPLETE

    def among(self, failed: int) -> "Causes":
        """The same, where so many missions failed."""
        return replace(self, ranked=tuple(replace(one, among=failed) for one in self.ranked))

    def is_all_of(self, flights: int) -> bool:
        """Whether so many flights would show no more."""
        ended = self.is_sought and self.ended is TrialsEnd.COMPLETE
        return ended or (self.ended is TrialsEnd.FLIGHTS and self.flights - self.beyond >= flights)

    @property
    def first(self) -> RankedLine | None:
        """The line to look at, if a trial or a loose end speaks for it."""
        return self.ranked[0] if self.ranked else None


NO_CAUSES = Causes()
CANCELLED = Causes(ended=TrialsEnd.CANCELLED)  # a signal came before anything was tried


def rank(trials: Trials, root: Path, raised: RankedLine | None = None, asleep: Sequence[RankedLine] = ()) -> Causes:
    """All causes of a fault in order, each line once; where Python has `raised`, that line, and no line is missing.

    Where Python is `asleep` that is to end what broke the plan, no change of a model wakes it: its line is the first.
    """
    uneven = {one.candidate.site for one in trials.loose if one.is_uneven}
    mending = [one for one in trials.causes if _claim(one) is Claim.MENDS]
    small = [one for one in mending if one.edit.kind is not EditKind.VALUE or one.candidate.site not in uneven]
    small += [one for one in trials.causes if _claim(one) is Claim.CODED]
    large = [one for one in trials.causes if one not in small]
    likeliest: dict[EditSite, Loose] = {}
    for each in trials.loose:
        if likeliest.setdefault(each.candidate.site, each).variable == each.variable:
            likeliest[each.candidate.site] = each
    loose = list(likeliest.values())[:_MOST_LOOSE] if raised is None else []
    told = [] if raised is None else [raised]
    tried = [_tried(one, root) for one in large if _claim(one) is not Claim.EVADES]
    evading = [_tried(one, root) for one in large if _claim(one) is Claim.EVADES]
    likely = [] if small else [one for one in loose if one.doubt <= _LEAST_DOUBT]
    telling = [_loose(one, root) for one in likely if _is_telling(one)]
    faint = [_loose(one, root) for one in likely if not _is_telling(one)]
    brought = " ".join(one.edit.new for one in small)
    missing = [_loose(one, root) for one in loose if not small or (_is_telling(one) and not _is_read(one, brought))]
    unset = [_loose(one, root) for one in loose if one.is_unset and one.doubt <= _LEAST_DOUBT]
    mended = [_tried(one, root) for one in small]
    causes = [*asleep, *mended[:1], *unset, *mended[1:], *telling, *tried, *told, *faint, *evading, *missing]
    lines: dict[tuple[str, int], RankedLine] = {}
    for cause in causes:
        lines.setdefault((cause.place.file, cause.place.line), cause)
    return Causes(tuple(lines.values()), trials.lines, trials.flights, trials.ended, beyond=trials.beyond)


def _is_read(loose: Loose, brought: str) -> bool:
    """Whether a constant that nothing reads is what a change brings in that mends: then no other line is missing."""
    return loose.is_unread and loose.variable in _WORD.findall(brought)


def _is_telling(loose: Loose) -> bool:
    """Whether a loose end is worth its words beside changes that make all missions pass."""
    return (loose.is_unread or loose.is_uneven or loose.is_unset) and loose.doubt <= _LEAST_DOUBT


def _claim(trial: LineTrial) -> Claim:
    if trial.damage >= HEAVY or trial.is_evasive:
        return Claim.EVADES
    if trial.helped < trial.missions or trial.spoilt:
        return Claim.PARTLY
    if not trial.takes_away:
        return Claim.MENDS
    return Claim.CODED if trial.candidate.site.coded else Claim.LOOSENS


def _tried(trial: LineTrial, root: Path) -> RankedLine:
    site, edit = trial.candidate.site, trial.edit
    place = _place(trial.candidate, edit.line, root)
    return RankedLine(place, site.rule, _claim(trial), edit, trial.helped, trial.missions, trial.spoilt, site.coded)


def _loose(loose: Loose, root: Path) -> RankedLine:
    site = loose.candidate.site
    claims = {Claim.UNREAD: loose.is_unread, Claim.UNEVEN: loose.is_uneven, Claim.UNSET: loose.is_unset}
    claim = next((claim for claim, holds in claims.items() if holds), Claim.LOOSE_END)
    return RankedLine(_place(loose.candidate, site.first, root), site.rule, claim, variable=loose.variable)


def _place(candidate: Candidate, line: int, root: Path) -> SourcePlace:
    site = candidate.site
    column = site.column if line == site.first else 1
    return SourcePlace(relative_name(site.file, root), line, column, " ".join(site.text.split()))
