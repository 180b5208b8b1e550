"""An abort in, its causal graph out: which draws and events led to it, and which lines rule out what was tried.

Events of the trace point at what they caused, across reactors; inside the reactor that gave up, `checker.culprit` looks
at the conflict. "Future work" of the founding paper, section 6.
"""

from collections import Counter, deque
from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass

from checker.culprit import culprit_of, own_elements
from checker.oracle import given_up
from compiler.program import TOKEN_TIMES
from runtime.executive.events import causes_of, heads_of, numbered
from runtime.executive.outcome import (
    Abort,
    Conflict,
    ConflictElement,
    Deadlock,
    ElementKind,
    Event,
    EventKind,
    OpenGoal,
    Outcome,
    Reason,
    ReasonKind,
)

ANSWERS = (EventKind.REFUSE, EventKind.REJECT)  # that what was asked for is not done
_MISSED = "F6"  # what its owner had refused or rejected
_MOST_EVENTS = 8  # of the way to the abort, the last ones


@dataclass(frozen=True, slots=True)
class Failed:
    """What is known of why a mission failed: what broke, and what a search has tried in vain.

    `conflict` is what `deadlock` comes to where nothing broke: the elements that rule out what was tried.
    """

    conflict: Conflict | None = None
    deadlock: Deadlock | None = None


def failed_by(outcome: Outcome | None) -> Failed:
    """What is known of an abort, else of the first goal that stayed open for a known reason.

    Of what was missed as its owner had refused it (F6), what made the owner do so comes first.
    """
    if outcome is None:
        return Failed()
    abort = given_up(outcome)
    ends: list[Event | Abort | OpenGoal] = (
        [*refusals(outcome), abort] if abort is not None else list(outcome.open_goals)
    )
    return next((failed_at(end) for end in ends if _is_explained(end)), Failed())


def goals_ruled_out(outcome: Outcome) -> list[tuple[tuple[OpenGoal, ...], Failed]]:
    """What is known of each goal that stayed open for a known reason; goals that the same lines rule out together."""
    found: dict[object, tuple[list[OpenGoal], Failed]] = {}  # by the lines, or what had no choice
    for goal in filter(_is_explained, outcome.open_goals):
        failed = failed_at(goal)
        lines = tuple(one.place for one in lines_that_rule_out(failed))
        ends = tuple(way[-1].flaw for way in dead_ends(failed.deadlock)) if not lines else ()
        found.setdefault((lines, ends), ([], failed))[0].append(goal)
    return [(tuple(goals), failed) for goals, failed in found.values()]


def _is_explained(end: "Event | Abort | OpenGoal") -> bool:
    return end.conflict is not None or end.deadlock is not None


def failed_at(end: "Event | Abort | OpenGoal") -> Failed:
    """What is known of an end; where only a search failed, the conflict that speaks for what it tried."""
    conflict = end.conflict
    if conflict is None and end.deadlock is not None:
        conflict = in_common(end.deadlock)
    return Failed(conflict, end.deadlock)


def dead_ends(deadlock: Deadlock | None) -> Iterator[tuple[Deadlock, ...]]:
    """The ways to flaws against which there was nothing to choose, such as a resource that one token overloads."""
    if deadlock is None:
        return
    if not deadlock.tried:
        yield (deadlock,)
    for one in deadlock.tried:
        yield from ((deadlock, *way) for way in dead_ends(one.leads_to))


def lines_that_rule_out(failed: Failed) -> list[ConflictElement]:
    """The elements with a place, one for each line: the culprit and what sets its limit first."""
    conflicts = [failed.conflict] if failed.conflict is not None else []
    conflicts += failed.deadlock.conflicts() if failed.deadlock is not None else ()
    culprit = culprit_of(failed.conflict)
    found = [element for conflict in conflicts for element in conflict.elements]
    found.sort(key=lambda one: 0 if one.place == culprit.place else 1 if one.place in culprit.limits else 2)
    lines: dict[tuple[str, int], ConflictElement] = {}
    for element in found:
        if element.place is not None:
            lines.setdefault((element.place.file, element.place.line), element)
    return list(lines.values())


def refusals(outcome: Outcome) -> tuple[Event, ...]:
    """The refusals and rejections that a failure follows from, the first cause first.

    An abort as something was missed (F6) follows from its owner's answer, and so does a goal that stayed open from
    what became of it; that in turn from what the owner was refused itself, where its conflict speaks of it.
    """
    events, abort = outcome.events, given_up(outcome)
    if abort is None:
        ends = [goal.event for goal in outcome.open_goals if goal.event >= 0]
    elif abort.code == _MISSED and 0 <= abort.event < len(events):
        ends = list(events[abort.event].causes)
    else:
        ends = []
    answers = [index for index in ends if events[index].kind in ANSWERS]
    senders = {event.request: event.reactor for event in events if event.kind is EventKind.REQUEST}
    refused = [(index, event) for index, event in numbered(events) if event.kind in ANSWERS]
    found: dict[int, None] = dict.fromkeys(answers)
    for index in found.copy():
        _note_behind(index, outcome, senders, refused, found)
    return tuple(events[index] for index in reversed(found))


def missed_after(outcome: Outcome | None) -> Event | None:
    """Of what was missed (F6), the answer of an owner that it began with; None for another end."""
    if outcome is None or given_up(outcome) is None:
        return None
    return next(iter(refusals(outcome)), None)


def _note_behind(
    answer: int,
    outcome: Outcome,
    senders: dict[int | None, str],
    refused: Sequence[tuple[int, Event]],
    found: dict[int, None],
) -> None:
    """Note the last refusals of what an answer's reactor asked for and its conflict speaks of, the nearest first."""
    event = outcome.events[answer]
    repairs = [one for cause in event.causes if (one := outcome.events[cause]).kind is EventKind.RELAX]
    spoken = {name for one in (event, *repairs) for name in _predicates_in(one)}
    last = {
        (one.timeline, one.predicate): index
        for index, one in refused
        if index < answer and senders.get(one.request) == event.reactor and one.predicate in spoken
    }
    behind = [index for index in sorted(last.values(), reverse=True) if index not in found]
    found |= dict.fromkeys(behind)
    for index in behind:
        _note_behind(index, outcome, senders, refused, found)


def _predicates_in(event: Event) -> set[str]:
    """The predicates, without their classes, of the tokens that an event's conflicts speak of."""
    conflicts = [event.conflict] if event.conflict is not None else []
    conflicts += event.deadlock.conflicts() if event.deadlock is not None else ()
    tokens = {variable.token for conflict in conflicts for variable in conflict.variables}
    if event.reason is not None:
        tokens.add(event.reason.token)
    return {token.predicate.rpartition(".")[2] for token in tokens if token is not None}


def in_common(deadlock: Deadlock) -> Conflict | None:
    """The conflict that speaks for what was tried in vain: the one whose lines rule out the most, of equals the first.

    A line is the same for every token that it is posted for. Lines by which another reactor asked do not count: those
    stand behind one conflict alone.
    """
    conflicts = list(deadlock.conflicts())
    places = [{element.place for element in own_elements(one) if element.place is not None} for one in conflicts]
    counts = Counter(place for each in places for place in each)
    weights = [sum(counts[place] for place in each) / max(len(each), 1) for each in places]
    return conflicts[weights.index(max(weights))] if conflicts else None


def _ways_to(target: int, events: Sequence[Event]) -> dict[int, int]:
    """Each event that has led to one, with the next on a shortest way from it; by index."""
    causes = tuple(causes_of(events))
    following = dict.fromkeys(causes[target], target)
    reached = deque(following)
    while reached:
        event = reached.popleft()
        for cause in causes[event]:
            if cause not in following:
                following[cause] = event
                reached.append(cause)
    return following


def events_to_abort(outcome: Outcome, parameters: tuple[str, ...]) -> tuple[int, ...]:
    """Indices of the events on the way from a draw to the abort, in order, the abort left out.

    Without an abort, those to what became of the first goal that stayed open for a known reason, with that event.
    From the draw of the first of `parameters` that is connected with the abort; else from whatever draw is; else the
    latest cause of each event, backwards from the beginning of what goes on, if that is why, else from the abort. Of a
    long way, its root and its end.
    """
    target = decided_at(outcome)
    if target < 0 or not outcome.events:
        return ()
    following = _ways_to(target, outcome.events)
    draws = {index: name for index, name in reversed(_drawn(outcome.events)) if index in following}
    wanted = [index for name in parameters for index, drawn in draws.items() if drawn == name]
    wanted += draws
    way: list[int] = []
    current = target
    if wanted:
        current = wanted[0]
        while current != target:
            way.append(current)
            current = following[current]
    else:
        abort = given_up(outcome)
        if abort is not None and (begun := beginning_of(abort.reason, abort.timelines, outcome)) is not None:
            current = begun
            way.append(begun)
        while causes := outcome.events[current].causes:
            current = max(causes)
            way.insert(0, current)
    if given_up(outcome) is None:
        way.append(target)
    return tuple(way if len(way) <= _MOST_EVENTS else [way[0], *way[1 - _MOST_EVENTS :]])


def beginning_of(reason: Reason, timelines: Container[str], outcome: Outcome) -> int | None:
    """The index of the observation by which that began which goes on longer than planned; None where nothing does."""
    if reason.kind is not ReasonKind.GOES_ON or reason.token is None:
        return None
    wanted = reason.token.predicate.rpartition(".")[2]
    return next(
        (
            index
            for index, tick, timeline, predicate in heads_of(outcome.events)
            if (tick, predicate) == (reason.since, wanted) and timeline in timelines
        ),
        None,
    )


def decided_at(outcome: Outcome) -> int:
    """The index of the abort, or else of the event in which a goal was given up for a known reason; -1 if none."""
    abort = given_up(outcome)
    if abort is not None:
        return abort.event
    return next((goal.event for goal in outcome.open_goals if goal.reason is not None), -1)


def draws_behind(outcome: Outcome) -> tuple[str, ...]:
    """The parameters that the abort depends on by the conflict's terms, or, failing those, by the trace."""
    conflict = failed_by(outcome).conflict
    names, abort = conflict.parameters if conflict is not None else (), given_up(outcome)
    if names or abort is None or not outcome.events:
        return names
    led_there = _ways_to(abort.event, outcome.events)
    return tuple(dict.fromkeys(name for index, name in _drawn(outcome.events) if index in led_there))


def _drawn(events: Sequence[Event]) -> list[tuple[int, str]]:
    """The indices of draws, in order, with their parameters."""
    return [(index, event.draw.parameter) for index, event in numbered(events) if event.draw is not None]


def timed_requests(elements: Sequence[ConflictElement]) -> list[ConflictElement]:
    """What of a conflict another reactor asked for by, or until, some time."""
    return [
        one
        for one in elements
        if one.kind is ElementKind.REQUEST
        and one.place is None
        and any(variable.name in TOKEN_TIMES for variable in one.variables)
    ]
