"""Events on the way to a failure: requests that a conflict speaks of, what was lost, what a property is about."""

from collections.abc import Iterator

from checker.batch.result import MissionResult
from checker.causes import ANSWERS, timed_requests
from checker.limits import Limit
from checker.oracle import Judgement
from checker.single_values import single_value
from runtime.executive.configuration import AgentConfiguration, PropertyKind, TokenPattern
from runtime.executive.events import events_on, numbered, single_events
from runtime.executive.outcome import Conflict, Event, EventKind, Outcome, ReasonKind

_MOST_PROMISED = 4  # requests for what a property promises, and their answers
_ASKED = (EventKind.REQUEST, EventKind.REFUSE, EventKind.REJECT, EventKind.RECALL)
_MOST_LOST = 12  # events that are told of a mission that lost too much


def sent_requests(outcome: Outcome, conflict: Conflict | None, until: int) -> Iterator[int]:
    """The last requests of reactors, up to a tick, for what the conflict says was asked for by some time."""
    for element in timed_requests(conflict.elements) if conflict is not None else ():
        if element.token is not None:
            wanted = element.token.predicate.rpartition(".")[2]
            sent = [
                index
                for index, event in numbered(outcome.events)
                if event.kind is EventKind.REQUEST and event.reactor and event.predicate == wanted
                if event.tick <= until
            ]
            yield from sent[-1:]


def lost_events(outcome: Outcome, limit: Limit) -> list[Event]:
    """The events in which a mission lost more than it may, the first ones."""
    wanted = (EventKind.RELAX,) if limit is Limit.REPAIRS else ANSWERS
    is_about_goals = limit in (Limit.REJECTED, Limit.LATE)
    found = [event for event in single_events(outcome.events) if event.kind in wanted]
    if limit is not Limit.REPAIRS:
        found = [one for one in found if (one.request is not None and one.request < 0) == is_about_goals]
    return found[:_MOST_LOST]


def promised_events(result: MissionResult, outcome: Outcome, agent: AgentConfiguration) -> list[Event]:
    """What a violated property is about: what it follows on, and what became of the requests for what it promises.

    Of these only those that were to come in time, and the first one after that, which was too late.
    """
    broken = result.judgement.broken
    kept = next((one for one in agent.properties if broken is not None and one.name == broken.name), None)
    if kept is None or kept.level is not None or broken is None:
        return []
    events = list(single_events(outcome.events))
    about = [one for one in events if one.kind is EventKind.OBSERVATION and one.timeline == kept.pattern.timeline]
    found = [one for one in about if one.tick == broken.tick and kept.kind is not PropertyKind.REACHED]
    wanted = kept.pattern if kept.kind is PropertyKind.REACHED else kept.then
    if wanted is not None:
        since = found[0].tick if found and kept.kind is PropertyKind.WITHIN else 0
        due = (broken.tick or 0) + (kept.ticks if kept.kind is PropertyKind.WITHIN else 0)
        asked = [one for one in events if one.kind in _ASKED and _may_match(one, wanted)]
        late = next((one for one in asked if one.kind is EventKind.REQUEST and one.tick > due), None)
        told = [one for one in asked if since <= one.tick <= due or one is late][-_MOST_PROMISED:]
        answered = {one.request for one in told if one.kind is not EventKind.REQUEST}
        found += [one for one in asked if one in told or (one.kind is EventKind.REQUEST and one.request in answered)]
    return found


def _may_match(event: Event, pattern: TokenPattern) -> bool:
    """Whether an event is about what a pattern says, as far as its arguments are known."""
    values = {name: single_value(domain) for name, domain in event.arguments}
    is_other = any(
        values.get(name) is not None and values[name] != wanted
        for name, wanted in pattern.parameters
        if not isinstance(wanted, tuple)
    )
    return event.timeline == pattern.timeline and pattern.predicate in ("", event.predicate) and not is_other


def failed_owner(judgement: Judgement, outcome: Outcome) -> list[Event]:
    """Where a timeline came to hold `Failed`, if that is why the mission fails."""
    reason = judgement.reason
    if reason is None or reason.kind is not ReasonKind.HELD_FAILED:
        return []
    said = (one for one in events_on(outcome.events, {reason.timeline}) if one.kind is EventKind.OBSERVATION)
    return [next(one for one in said if one.tick == reason.tick)]
