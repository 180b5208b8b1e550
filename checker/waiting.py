"""A mission that went to its end with goals open in; out: what each goal waited for, down to what did not come.

From the timeline of a goal the way leads to what its owner uses: what it has asked for there and what is not over, in
that reactor and in those behind it. The same of what a reactor had under way at some tick.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from checker.causes import ANSWERS
from checker.oracle import given_up
from runtime.executive.configuration import AgentConfiguration, CodeConfiguration, PropertyKind, ReactorConfiguration
from runtime.executive.events import heads_of, single_events
from runtime.executive.outcome import Abort, ElementKind, Event, EventKind, Outcome, PropertyFate, ReasonKind

_MOST = 8  # steps that are told
_MOST_ANSWERS = 2
_MOST_UNDER_WAY = 3
_OVER = (EventKind.ACHIEVED, EventKind.RECALL, *ANSWERS)


@dataclass(frozen=True, slots=True)
class Waiting:
    """What was asked for and was not over at the end, `asked` at a tick by a reactor, or by the mission file ("").

    It had begun at `since`, or not at all (None). `holding` is what timelines held at the end, each since a tick: its
    own where it had not begun, and those that its owner uses where that waited for nothing else.
    """

    sender: str
    asked: int
    timeline: str
    predicate: str
    since: int | None
    owner: str
    holding: tuple[tuple[str, str, int], ...] = ()


def waited_for(outcome: Outcome, agent: AgentConfiguration) -> tuple[Waiting, ...]:
    """The requests that were not over at the end, from open goals for no known reason on, each before what it needs."""
    if given_up(outcome) is not None:
        return ()
    open_goals = {(goal.timeline, goal.predicate) for goal in outcome.open_goals if goal.reason is None}

    def is_open(event: Event) -> bool:
        return not event.reactor and (event.timeline, event.predicate) in open_goals

    return _not_over(outcome, agent, is_open, outcome.last_tick)


def beside(end: Event | Abort, outcome: Outcome, agent: AgentConfiguration) -> tuple[Waiting, ...]:
    """What a reactor had under way beside the observed token that went on longer than its plan allows.

    None where the conflict tells what made that last.
    """
    reason, conflict = end.reason, end.conflict
    if reason is None or reason.kind is not ReasonKind.GOES_ON or reason.token is None or conflict is None:
        return ()
    if any(one.kind is ElementKind.SHARED_END for one in conflict.elements):
        return ()
    found = _under_way(outcome, agent, end.reactor, reason.since or 0, end.tick)
    return tuple(one for one in found if one.predicate != reason.token.predicate.rpartition(".")[2])


def held_up(
    violated: PropertyFate | None, broken: Event | None, outcome: Outcome, agent: AgentConfiguration
) -> Iterator[tuple[int, Waiting]]:
    """What was going on, each with the tick, when a violated property was due, or when a reactor gave up.

    The latter where no plan is told of that broke before.
    """
    abort = given_up(outcome)
    if violated is not None and violated.tick is not None:
        yield from ((violated.tick, one) for one in _late(violated.name, violated.tick, outcome, agent))
    if abort is not None and broken is None:
        yield from ((abort.tick, one) for one in beside(abort, outcome, agent))


def _late(name: str, due: int, outcome: Outcome, agent: AgentConfiguration) -> tuple[Waiting, ...]:
    """What the owner of a timeline had under way when that was to have reached what a property promises."""
    kept = next((one for one in agent.properties if one.name == name), None)
    if kept is None or kept.kind is not PropertyKind.REACHED:
        return ()
    owner = _owners(agent).get(kept.pattern.timeline)
    return _under_way(outcome, agent, owner.name, 0, due) if owner is not None else ()


def _under_way(outcome: Outcome, agent: AgentConfiguration, reactor: str, since: int, tick: int) -> tuple[Waiting, ...]:
    """What a reactor had asked for from a tick on, and was going on at another one, each before what it needs."""
    found = _not_over(outcome, agent, lambda event: event.reactor == reactor and event.tick >= since, tick)
    return tuple(one for one in found if one.since is not None)[:_MOST_UNDER_WAY]


def _owners(agent: AgentConfiguration) -> dict[str, ReactorConfiguration | CodeConfiguration]:
    owners: dict[str, ReactorConfiguration | CodeConfiguration] = {}
    owners |= {timeline: each for each in agent.reactors for timeline in each.internal}
    return owners | {timeline: each for each in agent.coded for timeline in each.internal}


def _not_over(
    outcome: Outcome, agent: AgentConfiguration, is_first: Callable[[Event], bool], until: int
) -> tuple[Waiting, ...]:
    """The requests that were not over at a tick, from the first ones on, each before what it needs."""
    events = [event for event in single_events(outcome.events) if event.tick <= until]
    over = {event.request for event in events if event.kind in _OVER}
    pending = [one for one in events if one.kind is EventKind.REQUEST and one.request not in over]
    heads = {timeline: (predicate, tick) for _, tick, timeline, predicate in heads_of(outcome.events) if tick <= until}
    owners = _owners(agent)
    waiting = [one for one in pending if is_first(one)]
    found: dict[int, Waiting] = {}
    while waiting and len(found) < _MOST:
        one = waiting.pop(0)
        owner = owners.get(one.timeline)
        if owner is None or one.request is None or one.request in found:
            continue
        behind = list({event.timeline: event for event in pending if event.reactor == owner.name}.values())
        held, tick = heads.get(one.timeline, ("", 0))
        since = tick if held == one.predicate and tick > one.tick else None
        shown = [one.timeline] if since is None else [] if behind else owner.external
        holding = tuple((timeline, *heads[timeline]) for timeline in shown if timeline in heads)
        found[one.request] = Waiting(one.reactor, one.tick, one.timeline, one.predicate, since, owner.name, holding)
        waiting[:0] = behind
    return tuple(found.values())


def kept_open_by(outcome: Outcome, agent: AgentConfiguration) -> list[Event]:
    """The refusals and rejections of what the owners of open goals asked for, and have not asked for again."""
    owners = {one.owner for one in waited_for(outcome, agent)}
    senders: dict[int | None, str] = {}
    last: dict[tuple[str, str, str], Event] = {}
    for event in single_events(outcome.events):
        if event.kind is EventKind.REQUEST:
            senders[event.request] = event.reactor
        if event.kind in (EventKind.REQUEST, *ANSWERS):
            last[senders.get(event.request, ""), event.timeline, event.predicate] = event
    answers = [event for (sender, *_), event in last.items() if sender in owners and event.kind in ANSWERS]
    return sorted(answers, key=lambda one: one.tick)[:_MOST_ANSWERS]
