"""A mission's outcome in, what it cost out, whether or not it passed: goals lost, plans repaired, requests not met.

A mission that came to its end may have dropped half of its goals on the way; the verdict alone would hide that.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

from checker.culprit import culprit_of
from checker.limits import Limit, Limits
from runtime.executive.events import single_events
from runtime.executive.outcome import Event, EventKind, Outcome, Reason, ReasonKind, SourcePlace

_FAILED = "Failed"  # what the timelines of a lost reactor hold
_OBSERVATION, _SAMPLE = EventKind.OBSERVATION, EventKind.SAMPLE  # most of a trace: to look these up takes time


class GoalFate(StrEnum):
    """What became of a goal of the mission file. LATE and REJECTED goals were given up."""

    ACHIEVED = "achieved"
    LATE = "late"  # its time was over before it could begin
    REJECTED = "rejected"  # for any other reason
    OPEN = "open"  # not sent, waiting or running when the mission ended
    RECALLED = "recalled"  # the mission file took it back before it was achieved


@dataclass(frozen=True, slots=True)
class GoalEnd:
    """The fate of goal `number` (from 0) of the mission file, when it was sealed, and why the goal was given up."""

    number: int
    fate: GoalFate
    tick: int
    reason: Reason | None = None


@dataclass(frozen=True, slots=True)
class Repairs:
    """Repairs of a reactor's plan for one reason at one line of the model; `first` is the tick of the first one."""

    reactor: str
    kind: ReasonKind | None
    place: SourcePlace | None
    count: int
    first: int


@dataclass(frozen=True, slots=True)
class Unmet:
    """Requests of a reactor that their owner refused, gave up, or did not live to meet."""

    sender: str
    timeline: str
    predicate: str
    kind: ReasonKind | None
    count: int
    first: int


@dataclass(frozen=True, slots=True)
class Losses:
    """What a mission cost. Goals of the mission file that were never sent are not among `goals`.

    `requests` counts what reactors asked of each other; `undelivered` is what its owner did not take, or did not live
    to carry out; `given_up` what it took and rejected.
    """

    goals: tuple[GoalEnd, ...] = ()
    repairs: tuple[Repairs, ...] = ()
    requests: int = 0
    undelivered: tuple[Unmet, ...] = ()
    given_up: tuple[Unmet, ...] = ()

    def count(self, fate: GoalFate) -> int:
        """How many goals ended so; open ones that were never sent are not counted."""
        return sum(goal.fate is fate for goal in self.goals)

    @property
    def repaired(self) -> int:
        """How many repairs there were."""
        return sum(each.count for each in self.repairs)

    @property
    def lost(self) -> int:
        """How many requests of reactors were not delivered."""
        return sum(each.count for each in self.undelivered)

    @property
    def dropped(self) -> int:
        """How many requests of reactors were taken and given up."""
        return sum(each.count for each in self.given_up)


NO_LOSSES = Losses()


@dataclass(frozen=True, slots=True)
class Exceeded:
    """A limit that a mission did not keep."""

    limit: Limit
    found: int
    most: int


def amount(losses: Losses, limit: Limit) -> int:
    """How much of what `limit` is about a mission had."""
    match limit:
        case Limit.REJECTED:
            return losses.count(GoalFate.REJECTED) + losses.count(GoalFate.LATE)
        case Limit.LATE:
            return losses.count(GoalFate.LATE)
        case Limit.REPAIRS:
            return losses.repaired
        case Limit.UNDELIVERED:
            return losses.lost


def exceeded(losses: Losses, limits: Limits) -> Exceeded | None:
    """The first limit that is not kept."""
    for limit, most in limits:
        found = amount(losses, limit)
        if found > most:
            return Exceeded(limit, found, most)
    return None


def losses_of(outcome: Outcome) -> Losses:
    """Read the losses of a mission from its trace."""
    goals: dict[int, GoalEnd] = {}
    waiting: dict[int, Event] = {}  # requests of reactors by number
    asked = 0
    undelivered: list[tuple[Event, Reason | None]] = []
    given_up: list[tuple[Event, Reason | None]] = []
    repairs: list[Event] = []
    killed: set[str] = set()
    lines: dict[int, str] = {}  # of goals
    for event in single_events(outcome.events):
        kind = event.kind
        if kind is _SAMPLE or (kind is _OBSERVATION and event.predicate != _FAILED):
            continue
        number = event.request
        match kind:
            case EventKind.REQUEST if number is not None and number < 0:
                goals[-1 - number] = GoalEnd(-1 - number, GoalFate.OPEN, event.tick)
                lines[-1 - number] = event.timeline
            case EventKind.REQUEST if number is not None:
                waiting[number] = event
                asked += 1
            case EventKind.ACHIEVED if number is not None:
                if -1 - number in goals:
                    goals[-1 - number] = GoalEnd(-1 - number, GoalFate.ACHIEVED, event.tick)
                waiting.pop(number, None)
            case EventKind.REFUSE | EventKind.REJECT if number is not None:
                if -1 - number in goals:
                    is_late = event.reason is not None and event.reason.kind is ReasonKind.TOO_LATE
                    fate = GoalFate.LATE if is_late else GoalFate.REJECTED
                    goals[-1 - number] = GoalEnd(-1 - number, fate, event.tick, event.reason)
                elif number in waiting:
                    into = undelivered if event.kind is EventKind.REFUSE else given_up
                    into.append((waiting.pop(number), event.reason))
            case EventKind.RECALL if number is not None:
                waiting.pop(number, None)
                if (goal := goals.get(-1 - number)) is not None and goal.fate is GoalFate.OPEN:
                    goals[goal.number] = GoalEnd(goal.number, GoalFate.RECALLED, event.tick)
            case EventKind.RELAX:
                repairs.append(event)
            case EventKind.KILL:
                killed.add(event.reactor)
            case EventKind.OBSERVATION if event.predicate == _FAILED and event.reactor in killed:
                why = Reason(ReasonKind.NO_OWNER, timeline=event.timeline)
                for request in [one for one in waiting.values() if one.timeline == event.timeline]:
                    assert request.request is not None
                    undelivered.append((waiting.pop(request.request), why))
                for goal in [one for one in goals.values() if lines[one.number] == event.timeline]:
                    if goal.fate is GoalFate.OPEN:
                        goals[goal.number] = GoalEnd(goal.number, GoalFate.REJECTED, event.tick, why)
            case _:
                pass
    return Losses(
        tuple(goals[number] for number in sorted(goals)),
        tuple(_repairs(repairs)),
        asked,
        tuple(_unmet(undelivered)),
        tuple(_unmet(given_up)),
    )


def _repairs(events: list[Event]) -> Iterator[Repairs]:
    """Repairs, those alike counted together, in the order of the first of each."""
    known: dict[tuple[object, ...], SourcePlace | None] = {}  # conflicts of one shape are about one line
    found: dict[tuple[str, ReasonKind | None, SourcePlace | None], list[int]] = {}
    for event in events:
        elements = event.conflict.elements if event.conflict is not None else ()
        shape = tuple((element.kind, element.place) for element in elements)
        if shape not in known:
            known[shape] = culprit_of(event.conflict).place
        kind = event.reason.kind if event.reason is not None else None
        found.setdefault((event.reactor, kind, known[shape]), []).append(event.tick)
    for (reactor, kind, place), ticks in found.items():
        yield Repairs(reactor, kind, place, len(ticks), ticks[0])


def _unmet(requests: list[tuple[Event, Reason | None]]) -> Iterator[Unmet]:
    found: dict[tuple[str, str, str, ReasonKind | None], list[int]] = {}
    for event, reason in requests:
        key = (event.reactor, event.timeline, event.predicate, reason.kind if reason is not None else None)
        found.setdefault(key, []).append(event.tick)
    for (sender, timeline, predicate, kind), ticks in found.items():
        yield Unmet(sender, timeline, predicate, kind, len(ticks), ticks[0])
