"""A mission that went to its end with goals open in; out: what each goal waited for, down to what did not come.

From the timeline of a goal the way leads to what its owner uses: what it has asked for there and what is not over, in
that reactor and in those behind it.
"""

from dataclasses import dataclass

from checker.causes import ANSWERS
from checker.oracle import given_up
from runtime.executive.configuration import AgentConfiguration, CodeConfiguration, ReactorConfiguration
from runtime.executive.events import heads_of, single_events
from runtime.executive.outcome import Event, EventKind, Outcome

_MOST = 8  # steps that are told
_MOSTANSWERS = 2
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
    events = single_events(outcome.events)
    over = {event.request for event in events if event.kind in _OVER}
    pending = [one for one in events if one.kind is EventKind.REQUEST and one.request not in over]
    heads = {timeline: (predicate, tick) for _, tick, timeline, predicate in heads_of(outcome.events)}
    owners: dict[str, ReactorConfiguration | CodeConfiguration] = {}
    owners |= {timeline: each for each in agent.reactors for timeline in each.internal}
    owners |= {timeline: each for each in agent.coded for timeline in each.internal}
    open_goals = {(goal.timeline, goal.predicate) for goal in outcome.open_goals if goal.reason is None}
    waiting = [one for one in pending if not one.reactor and (one.timeline, one.predicate) in open_goals]
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
    return sorted(answers, key=lambda one: one.tick)[:_MOSTANSWERS]
