"""A failed mission in, candidates of its mission file out, the likeliest first: tried where no model line mends.

What a goal asks that the conflict speaks of is tried in any case, and so is when goals may come of a reactor whose
request set the time that the conflict speaks of. So are the times of goals whose rules fill a resource that the
conflict finds too empty, of goals that began as late as they had to and were not over when the mission was, of one
that is out of the order in which the others of its timeline are written, and of the one that leads to what a violated
property promises by some time, if none leaves less time for its beginning. Of what else goals ask for, those are tried
that lead to what changed a violated level, or to a broken plan, and the earliest goal that was not achieved; of a
property its ticks.
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

from checker.causes import ANSWERS, failed_by, timed_requests
from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.goals_behind import far_of, leading_goals, levelled_goals, promised_goals, under_way
from checker.counterfactual.promises import first_violated
from checker.mission import Mission
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.mission_edits import is_due, mission_sites
from checker.single_values import single_value
from compiler.program import DomainConstant, Program
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import real_path
from runtime.executive.configuration import GoalConfiguration, PropertyConfiguration
from runtime.executive.events import heads_of, single_events
from runtime.executive.messages import Arguments
from runtime.executive.outcome import ConflictElement, ElementKind, EventKind, Outcome

_SPOKEN, _DEAF, _BROKEN, _BEGUN, _LOST, _ABORTED, _ASKED, _OTHERS = 0.0, 0.0, 0.5, 0.5, 1.0, 2.0, 2.5, 3.0
_OWNER, _OTHER_OWNER = 0.5, 1.5  # of what a reactor in Python is given that owns what was given up
_MOST_ASKERS = 4  # goals behind a request, the most urgent first
_AMONG = 0.1  # of a number that lies among those of the other goals


def mission_lines(
    mission: Mission,
    outcome: Outcome,
    supplying: Collection[str] = (),
    findings: Sequence[Diagnostic] = (),
    programs: Sequence[Program] = (),
) -> list[Candidate]:
    """The times of goals that found no place, then what says how the reactors plan, that which ended first.

    `supplying` are the predicates whose rules fill the resource that the conflict finds too empty, or empty it. Times
    of a goal that lint says can never be achieved, by its `findings`, are tried before all else.
    """
    given_up = {(one.timeline, one.predicate) for one in single_events(outcome.events) if one.kind in ANSWERS}
    given_up |= {(one.timeline, one.predicate) for one in outcome.open_goals if one.conflict is not None}
    ended = outcome.abort.reactor if outcome.abort is not None else ""
    used = {line for one in mission.agent.reactors for line in one.external}
    conflict = failed_by(outcome).conflict
    elements = conflict.elements if conflict is not None else ()
    asked = [one.place for one in elements if one.kind is ElementKind.REQUEST and one.place is not None]
    is_judged = outcome.abort is None and not outcome.open_goals  # by its properties
    violated = first_violated(outcome) if is_judged else None
    broken = violated.name if violated is not None else ""
    behind = _behind_requests(mission, ended, elements, outcome)
    cut_off = _cut_off(mission, outcome)
    promised, shares = frozenset[int](), dict[int, float]()
    if is_judged:
        promised = promised_goals(outcome, mission.agent, programs)
        shares = levelled_goals(outcome, mission.agent, programs)
    late = cut_off | {one for one in promised if _is_narrowest(mission.agent.goals, one)}
    leading = leading_goals(outcome, mission.agent, programs)
    behind = (behind & leading) or behind
    begun = under_way(leading, outcome, mission.agent)
    lines = {(str(real_path(Path(one.span.source.name))), one.span.line) for one in findings}
    due = _due(mission, outcome)
    troubled = {line for line, _ in given_up} | set(outcome.abort.timelines if outcome.abort is not None else ())
    found = []
    for (table, number), sites in mission_sites(mission).items():
        if table == "goal":
            goal = mission.agent.goals[number]
            is_supply = goal.predicate in supplying
            is_lost = (goal.timeline, goal.predicate) in given_up
            sites = [_warned(one, lines) for one in sites]
            is_without_time = number in late or any(one.wanted or one.agreeing for one in sites)
            if not (is_lost or is_supply or broken or number in behind or is_without_time):
                continue
            far = _SPOKEN + _AMONG if is_supply else _LOST if is_lost or is_without_time else _OTHERS
            if number in promised:
                far = _BROKEN + _AMONG
                sites = [one if number in late else _as_usual(one) for one in sites]
        elif table == "asked":
            spoken = [one for one in sites if any(one.holds(one.file, place.line) for place in asked)]
            is_near = number in shares or number in begun
            sites = [one for one in sites if number == due or one.wanted or one in spoken or is_near]
            far = far_of(shares, number) if number in shares else _BEGUN if number in begun else _ASKED
        elif table == "setting":
            owned = set(mission.agent.coded[number].internal)
            far = _OWNER if owned & troubled else _OTHER_OWNER
        elif table == "property":
            kept = mission.agent.properties[number]
            if kept.name != broken:
                continue
            far = _BROKEN
            sites = [replace(one, edits=_due_still(one.edits, kept, outcome)) for one in sites]
        else:
            reactor = mission.agent.reactors[number]
            far = _ABORTED if reactor.name == ended else _OTHERS
            if reactor.lookahead == 0 and used & set(reactor.internal):
                far = _DEAF  # it is asked for nothing
        for site in sites:
            is_spoken = any(site.holds(site.file, place.line) for place in asked)
            if table == "goal" and not is_spoken:  # later where others were asked for it in time, or at any time
                is_spoken = number in behind
                site = replace(site, edits=site.edits[-1:] if is_spoken else site.edits[:-1] or site.edits)
                is_spoken = is_spoken or number in cut_off
            is_promised = table == "property" or (table == "asked" and number in shares)
            is_promised = is_promised or (table == "goal" and number in promised & late)
            source = Suspicion.CONFLICT if is_spoken or is_promised else Suspicion.TRACE
            nearest = _SPOKEN + _AMONG * bool(site.unlike)
            is_warned = table == "goal" and bool(site.wanted)
            far_off = nearest if is_spoken or site.wanted else far
            found.append(Candidate(site, far_off, source, is_linted=is_warned))
    return sorted(found, key=lambda one: one.far)


def _behind_requests(
    mission: Mission, ended: str, elements: Sequence[ConflictElement], outcome: Outcome
) -> frozenset[int]:
    """The goals, not achieved, of reactors that asked the one that ended for something by the time in the conflict."""
    if not timed_requests(elements):
        return frozenset()
    asking, known = {ended}, set[str]()
    while asking != known:
        known = set(asking)
        owned = {line for one in mission.agent.reactors if one.name in known for line in one.internal}
        asking |= {one.name for one in mission.agent.reactors if owned & set(one.external)}
    lines = {line for one in mission.agent.reactors if one.name in asking - {ended} for line in one.internal}
    done = {one.request for one in single_events(outcome.events) if one.kind is EventKind.ACHIEVED}
    found = [
        (latest, number)
        for number, goal in enumerate(mission.agent.goals)
        if goal.timeline in lines and -number - 1 not in done
        for latest in [min((one[1] for one in (goal.start, goal.end) if one is not None), default=math.inf)]
        if latest < math.inf
    ]
    return frozenset(number for _, number in sorted(found)[:_MOST_ASKERS])


def _warned(site: EditSite, lines: Collection[tuple[str, int]]) -> EditSite:
    """The site of a goal, its edits wanted where lint warns of one of its lines."""
    if not any(site.holds(*line) for line in lines):
        return site
    return replace(site, wanted=frozenset((one.begin, one.new) for one in site.edits))


def _is_narrowest(goals: Sequence[GoalConfiguration], number: int) -> bool:
    """Whether a goal leaves less time for its beginning than all others of the mission (8 of 11 mistaken windows)."""
    widths = {at: one.start[1] - one.start[0] for at, one in enumerate(goals) if one.start is not None}
    return number in widths and all(widths[number] < width for at, width in widths.items() if at != number)


def _as_usual(site: EditSite) -> EditSite:
    """The site of a goal whose times are as usual, so that others are hardly meant."""
    return replace(site, unlike=frozenset((one.begin, one.new) for one in site.edits))


def _cut_off(mission: Mission, outcome: Outcome) -> frozenset[int]:
    """The goals that began as soon as they might, or might not yet, and were not over when the mission was."""
    held = {timeline: (tick, predicate) for _, tick, timeline, predicate in heads_of(outcome.events)}
    latency = {line: one.latency for one in mission.agent.reactors for line in one.internal}
    unexplained = {(one.timeline, one.predicate) for one in outcome.open_goals if one.conflict is None}
    found = set()
    for number, goal in enumerate(mission.agent.goals):
        earliest = goal.start[0] if goal.start is not None else 0
        tick, predicate = held.get(goal.timeline, (0, ""))
        is_early = predicate == goal.predicate and tick <= earliest + latency.get(goal.timeline, 0) + 1
        if earliest > 0 and (goal.timeline, goal.predicate) in unexplained and outcome.abort is None:
            found |= {number} if is_early or earliest >= outcome.last_tick else set()
    return frozenset(found)


def _due_still(edits: Sequence[SmallEdit], kept: PropertyConfiguration, outcome: Outcome) -> tuple[SmallEdit, ...]:
    """The edits of a violated property with which what violated it is due before the mission is over."""
    broken = next(one.tick for one in outcome.properties if one.name == kept.name)
    return tuple(edit for edit in edits if is_due(edit, kept, broken, outcome.final_tick))


def _due(mission: Mission, outcome: Outcome) -> int:
    """The number of the earliest goal that was not achieved; -1 where there is none."""
    left = {(one.timeline, one.predicate, one.arguments) for one in outcome.open_goals}
    open_ones = [
        (goal.start[0] if goal.start is not None else 0, number)
        for number, goal in enumerate(mission.agent.goals)
        if any(_is_asked(goal, *one) for one in left)
    ]
    return min(open_ones)[1] if open_ones else -1


def _is_asked(goal: GoalConfiguration, timeline: str, predicate: str, arguments: Arguments) -> bool:
    """Whether a goal may be what was asked for."""
    asked = dict(arguments)
    same = all(_plain(asked.get(name, value)) == value for name, value in goal.parameters)
    return (goal.timeline, goal.predicate) == (timeline, predicate) and same


def _plain(value: object) -> object:
    """The one value of a domain, which is what a goal has that the planner gave up; anything else as it is."""
    return single_value(value) if isinstance(value, DomainConstant) else value
