"""Candidates in, causes out: each line is changed a little, in memory, and the same mission is flown again.

A change counts where the mission then passes, with the same draws, and the judge agrees. Trials go from the likeliest
to the least likely and end after so many flights or seconds: what could not be tried is told, not guessed.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace

from checker.batch.interruption import InterruptedSearch
from checker.batch.result import MissionResult
from checker.causes import failed_by
from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.damage import (
    HEAVY,
    collapsed_of,
    course_of,
    is_cut_short,
    is_farther,
    is_worse,
    strayed_of,
    violated_of,
    voided_of,
)
from checker.counterfactual.effort import Bounds, Stopwatch
from checker.counterfactual.follow_ups import alternatives, follow_ups
from checker.counterfactual.missions import Missions
from checker.counterfactual.numbers import between, is_doubling, is_raised
from checker.counterfactual.orders import is_order_turned
from checker.counterfactual.smallness import cost_of, delay_of, first_edits, is_probe, sets_no_more
from checker.counterfactual.tried import LineTrial, Trials, TrialsEnd
from checker.counterfactual.turns import Turns
from checker.counterfactual.usage import Usage
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import NUMBERS, EditKind
from checker.oracle import Verdict

_NEARNESS = 0.3  # of the distance, beside how late an edit is tried at its line
_REACH = 0.4  # the same of a constant, of which there are many
_TURN, _PLACE = 0.3, 0.1  # how much later each further edit of one line is tried, at one place and at another
_MOST_OUTSIDE = 8  # changes of the mission file
_TOLD = 3  # small changes of models beside which a goal is not doubted
_NAMESAKE = 0.2  # how much later a name is tried at each further line of a rule: what lacks a mention lacks it at one
_CONFIRMED = 3  # causes that are tried on other missions too
_KEPT = 0.3  # of the flights, at most, for that
_PATCHED = 1.0  # what it counts that a mission passes after repairs alone
_SOONER = 1.0  # how much sooner a line is tried that lint warns of
_NEAR, _SEARCHED = 0.25, 0.5  # distance of what a conflict speaks of, and of what ruled out a choice of a search
_PROBE = -0.1  # when such a line is left out: where that helps, it is at fault or what it compares is
_TURNED = 0.0  # and when the order of two of its tokens is turned round
_OTHER_WAY = 0.3  # when the number where it breaks is doubled or halved, whichever looks worse
_CONSTANT = 1.0  # how much nearer a constant counts: it stands for its number in the line that reads it
_SLOW = 8.0  # times the slowest flight before that passed or failed: a change may leave a search without an end
_LEAST_SECONDS = 3.0  # that a flight may take
_MODELS = 0.75  # of the time for changes of models, where the mission file is to be tried too
_SHARE = 0.25  # of the time that is left, for one flight
_LESS = 0.3  # how much later a number is changed less where a large change makes the mission fail in another way
_FOLLOWED = 0.35  # how much likelier a change of a line is once another change of that line has helped

# A change, a mission and how many seconds it may take in; how the mission ends with that change out.
Try = Callable[[SmallEdit, MissionResult, float], MissionResult]


def try_out(
    candidates: Sequence[Candidate],
    missions: Missions,
    usage: Usage,
    fly: Try,
    bounds: Bounds,
    last: Sequence[Candidate] = (),
    beside: Callable[[EditSite], Collection[EditSite]] = lambda _: (),
) -> Trials:
    """Try changes of the candidates on the first of the failed missions, and the best ones on the other missions.

    What is to be tried `last` is where no small change of others has helped, or where the conflict speaks of it. Lines
    `beside` one that has helped are tried sooner.
    """
    failed = missions.failed
    trials = _Trials(missions, fly, bounds)
    turns = Turns(beside)
    named: Counter[tuple[str, tuple[int, int], str]] = Counter()
    for candidate in (*last, *candidates):
        earlier: Counter[tuple[int, bool]] = Counter()
        is_spoken = _is_spoken(candidate)
        far = max(candidate.far - candidate.nearer - _CONSTANT * candidate.site.is_number, 0.0)
        for delay, edit in first_edits(candidate.site, usage):
            if is_probe(edit, candidate.site) and is_spoken:
                delay = min(delay, _PROBE)
            if is_doubling(edit) and _is_culprit(candidate):
                delay = min(delay, _OTHER_WAY)
            at = (_REACH if candidate.site.is_number else _NEARNESS) * far + delay - candidate.told
            at -= _SOONER * candidate.is_linted
            if is_spoken and is_order_turned(edit, candidate.site):
                at = min(at, _TURNED)
            elif edit.kind is not EditKind.SWAP:
                is_apart = edit.kind is EditKind.TERM or (edit.kind is EditKind.SETTING and is_raised(edit))
                way = edit.begin, is_apart  # either way of a setting may be right; a term is more than where it begins
                at += _TURN * earlier[way] + _PLACE * len(earlier) * (edit.kind is not EditKind.VALUE)
                earlier[way] += 1
            if edit.kind is EditKind.NAME and not usage.is_fitting(edit, candidate.site):
                at += _NAMESAKE * named[candidate.site.file, candidate.site.scope, edit.new]
                named[candidate.site.file, candidate.site.scope, edit.new] += 1
            turns.add(at, candidate, edit)
    others = len(failed) - 1 + len(missions.passed)
    course = course_of(failed[0])
    is_told = failed_by(failed[0].outcome).deadlock is None  # what rules out a plan may do so before a line counts
    best: dict[EditSite, LineTrial] = {}
    helping: dict[EditSite, list[LineTrial]] = defaultdict(list)
    tried: set[tuple[EditSite, SmallEdit]] = set()
    outside = _by_turns(last)
    outside = [one for one in outside if delay_of(one[1], one[0].site, usage) is None][:_MOST_OUTSIDE]
    spoken = sum(candidate.source is Suspicion.CONFLICT for candidate, _ in outside)
    share = _MODELS if outside else 1.0
    while turns:
        kept = _reserve(len(best) + bool(spoken), others, trials.bounds) + (spoken if _small(best) else len(outside))
        if not trials.may_go_on(kept, share) and (_small(best) or not trials.lengthen()):
            break
        at, candidate, edit = turns.pop()
        site = candidate.site
        cost = cost_of(edit, site, usage)
        known = best.get(site)
        is_costly = known is not None and known.toll <= cost and not _is_gain(edit, known)
        if (site, edit) in tried or is_costly:
            continue
        tried.add((site, edit))
        result = trials.fly(edit, failed[0])
        if result.verdict is not Verdict.PASS:
            if trials.is_lost:
                turns.avoid(edit)
            if trials.is_lost or (is_told and course_of(result) == course):
                turns.doubt(site, None if is_probe(edit, site) else edit.begin)
            if result.verdict is Verdict.FAIL and is_farther(result, failed[0]):
                turns.encourage(site)
            if edit.kind in NUMBERS and is_worse(result, failed[0]):
                turns.turn_round(site, edit)
            turns.tire(site)
            if result.verdict is Verdict.FAIL and course_of(result) != course:
                for step, other in enumerate(between(edit, site), 1):
                    turns.add(at + step * _LESS, candidate, other)
            continue
        trial = trials.read(candidate, edit, cost, result)
        if trial.damage < HEAVY:
            turns.favour(site)
        helping[site].append(trial)
        if known is None or trial.order < known.order:
            best[site] = trial
        for other in follow_ups(edit, site, usage) if trial.damage < HEAVY else ():
            turns.add(at * _FOLLOWED, candidate, other)
    trials.resume()
    small = _small(best)
    for candidate, edit in outside:
        is_wanted = candidate.source is Suspicion.CONFLICT or small < (_TOLD if edit.kind is EditKind.GOAL else 1)
        if is_wanted and trials.may_go_on(_reserve(len(best), others, trials.bounds)):
            tried.add((candidate.site, edit))
            result = trials.fly(edit, failed[0])
            if result.verdict is Verdict.PASS:
                trial = trials.read(candidate, edit, cost_of(edit, candidate.site, usage), result)
                known = best.get(candidate.site)
                if known is None or trial.order < known.order:
                    best[candidate.site] = trial
    trials.resume()
    ranked = sorted(best.values(), key=lambda one: one.weight)
    confirmed: list[LineTrial] = []
    while ranked and sum(one.is_clean for one in confirmed) < _CONFIRMED and not trials.is_over:
        trial = ranked.pop(0)
        trials.resume()  # what was kept for it is left
        confirmed.append(trials.confirmed(trial, helping[trial.candidate.site], usage))
        trials.is_confirmed |= confirmed[-1].is_clean and confirmed[-1].is_small
    ranked = sorted([*confirmed, *ranked], key=lambda one: one.weight)
    ended = trials.ended or trials.cut or (TrialsEnd.FLIGHTS if turns else TrialsEnd.COMPLETE)
    lines = len({site for site, _ in tried})
    beyond = max(trials.flights - bounds.flights, 0) if trials.has_more else 0
    return Trials(tuple(ranked), tuple(candidates), lines, trials.flights, ended, beyond=beyond)


def _by_turns(last: Sequence[Candidate]) -> list[tuple[Candidate, SmallEdit]]:
    """The changes of the mission file in order; of what goals ask for that is equally near, one of each by turns."""
    found = [(candidate, edit, turn) for candidate in last for turn, edit in enumerate(candidate.site.edits)]
    found.sort(key=lambda one: (one[0].far, one[2] if one[1].kind is EditKind.GOAL else 0))
    return [(candidate, edit) for candidate, edit, _ in found]


def _reserve(causes: int, others: int, bounds: Bounds) -> int:
    """Flights that are kept for the other missions: for each cause that is known, and for one more."""
    return min(min(causes + 1, _CONFIRMED) * others, int(_KEPT * bounds.flights))


def _is_culprit(candidate: Candidate) -> bool:
    """Whether a line, or the constant that it compares with, is where the conflict gave way."""
    return candidate.source is Suspicion.CONFLICT and candidate.far == 0.0


def _is_spoken(candidate: Candidate) -> bool:
    """Whether the conflict that ended the mission speaks of a line, or what a search tried in vain."""
    is_searched = candidate.source is Suspicion.SEARCH and candidate.far <= _SEARCHED
    return is_searched or (candidate.source is Suspicion.CONFLICT and candidate.far <= _NEAR)


def _is_gain(edit: SmallEdit, known: LineTrial) -> bool:
    """Whether an edit takes no demand away where the one that helped does."""
    return known.takes_away and not known.candidate.takes_away(edit)


def _small(best: Mapping[EditSite, LineTrial]) -> int:
    """How many lines make the mission pass with all its goals, by a change that takes no demand away."""
    return sum(one.is_small for one in best.values())


class _Trials:
    """Flies trials as long as the bounds allow it."""

    def __init__(self, missions: Missions, fly: Try, bounds: Bounds) -> None:
        self.missions, self._fly, self.bounds = missions, fly, bounds
        self.flights = 0
        self.is_lost = False  # whether the last flight was given up
        self.ended: TrialsEnd | None = None
        self.cut: TrialsEnd | None = None  # where time was over for a part of the trials
        self.is_doubted = self.is_confirmed = False  # a cause does not help all missions, or does
        self.has_more = False  # there are flights beyond the usual, to find one that does
        self._watch = Stopwatch(bounds.spent)
        self._slowest: float | None = None

    def may_go_on(self, reserve: int = 0, share: float = 1.0) -> bool:
        """Whether one more flight is allowed, with `reserve` flights left for others, within a share of the time."""
        if self.ended is None:
            if self.bounds.is_cancelled():
                self.ended = TrialsEnd.CANCELLED
            elif self.flights + reserve >= self.bounds.flights:
                self.ended = TrialsEnd.FLIGHTS
            elif self._watch.is_over(share * self.bounds.seconds):
                self.ended = self.cut = TrialsEnd.SECONDS
            elif self._watch.is_starved(share * self.bounds.seconds):
                self.ended = self.cut = TrialsEnd.CLOCK
        return self.ended is None

    def lengthen(self) -> bool:
        """Whether the flights that have ended the trials are not all that there may be: then let the others be made."""
        if self.ended is not TrialsEnd.FLIGHTS or not self.bounds.further:
            return False
        self.bounds, self.ended = self.bounds.lengthened(), None
        return True

    @property
    def is_over(self) -> bool:
        """Whether flights beyond the usual have shown what they were made for."""
        return self.has_more and self.is_confirmed

    def _may_confirm(self, reserve: int = 0) -> bool:
        """The same for flights of other missions; where one change did not help in all, until another one has."""
        if self.may_go_on(reserve) or self.is_confirmed or not self.is_doubted or not self.lengthen():
            return self.ended is None
        self.has_more = True
        return True

    def resume(self) -> None:
        """Let flights that were kept for others be made, in the time that is left."""
        if self.ended is not TrialsEnd.CANCELLED:
            self.ended = None

    def fly(self, edit: SmallEdit, mission: MissionResult) -> MissionResult:
        """One trial."""
        self.flights, begun = self.flights + 1, self._watch.seconds
        most = max(_SHARE * (self.bounds.seconds - begun), _LEAST_SECONDS)
        if self._slowest is not None:
            most = min(most, max(_SLOW * self._slowest, _LEAST_SECONDS))
        try:
            result = self._fly(edit, mission, most)
        except InterruptedSearch:
            self.ended = TrialsEnd.CANCELLED
            return replace(mission, judgement=replace(mission.judgement, verdict=Verdict.ERROR))
        taken = self._watch.seconds - begun
        self.is_lost = result.verdict is Verdict.ERROR and taken >= most
        if result.verdict is not Verdict.ERROR:
            self._slowest = max(self._slowest or 0.0, taken)
        return result

    def read(self, candidate: Candidate, edit: SmallEdit, cost: float, result: MissionResult) -> LineTrial:
        """What a flight of the first failed mission tells that passes with an edit."""
        failed = self.missions.failed[0]
        lost = sum(of(result, failed) for of in (strayed_of, collapsed_of, voided_of)) + violated_of(result)
        damage = lost + self.missions.damage_of(result, failed) + _PATCHED * self.missions.is_patched(result)
        is_freed = sets_no_more(edit) and is_cut_short(result, failed, candidate.site.rule.rpartition(".")[2])
        evades = self.missions.is_evasive(result)
        return LineTrial(candidate, edit, damage, cost, is_evasive=evades, is_freed=is_freed)

    def confirmed(self, trial: LineTrial, helping: Sequence[LineTrial], usage: Usage) -> LineTrial:
        """The trial with what it does to the other missions; of its line, the likeliest edit that helps all, if any.

        Tried are those that were `helping` the first mission already, and others that change about as much.
        """
        if not self._may_confirm():
            return trial
        found, against = self._on_others(trial)
        if against is None:
            return found
        site = trial.candidate.site
        known = {one.edit: one for one in helping if one.edit != trial.edit}
        others = dict.fromkeys((*known, *alternatives(trial.edit, site, usage)))
        for edit in sorted(others, key=lambda one: (trial.candidate.takes_away(one), cost_of(one, site, usage))):
            if not self._may_confirm(0 if edit in known else 1) or self.fly(edit, against).verdict is not Verdict.PASS:
                continue
            other = known.get(edit)
            if other is None and (result := self.fly(edit, self.missions.failed[0])).verdict is Verdict.PASS:
                other = self.read(trial.candidate, edit, cost_of(edit, site, usage), result)
            if other is not None:
                again, _ = self._on_others(other, against)
                if again.is_clean:
                    return again
        return found

    def _on_others(
        self, trial: LineTrial, known: MissionResult | None = None
    ) -> tuple[LineTrial, MissionResult | None]:
        """The trial after flights of the other missions, but for one `known` to pass; the first that fails with it."""
        helped, missions, damage, against = 1, 1, trial.damage, None
        trial = replace(trial, is_untried=False)
        for mission in self.missions.passed:
            if mission is known:
                continue
            if not self._may_confirm():
                break
            if self.fly(trial.edit, mission).verdict is not Verdict.PASS:
                self.is_doubted = True
                return replace(trial, spoilt=1), mission
        for mission in self.missions.failed[1:]:
            if mission is known:
                helped, missions = helped + 1, missions + 1
            elif self._may_confirm():
                result = self.fly(trial.edit, mission)
                missions += 1
                if result.verdict is Verdict.PASS:
                    helped += 1
                    less = strayed_of(result, mission) + voided_of(result, mission)
                    damage = max(damage, self.missions.damage_of(result, mission) + less)
                else:
                    against, self.is_doubted = against or mission, True
        return replace(trial, damage=damage, helped=helped, missions=missions), against
