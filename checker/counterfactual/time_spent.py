"""A mission that was too late in; out: what its time went on, the share of each predicate.

Where a conflict rests on a time that the mission file gives, or the mission's time was over, all that was asked for and
done before counts: what took twice the time is twice as likely to be what took too long. Where a token lasted longer
than it may, so does what was done since it began.
"""

from collections.abc import Container
from dataclasses import dataclass

from checker.causes import failed_by
from checker.culprit import culprit_of
from compiler.program import TOKEN_TIMES
from runtime.executive.events import events_on, heads_of, single_events
from runtime.executive.messages import Arguments
from runtime.executive.outcome import ElementKind, Event, EventKind, Outcome, SourcePlace

_MOMENTS = TOKEN_TIMES[:2]
_LEAST = 0.25  # of the time of a token that is a large part


@dataclass(frozen=True, slots=True)
class LongPart:
    """What a timeline held from a tick on for so many of the ticks of a token, `whole`, which lasted for `total`.

    `asked` are the lines by which the rule of the whole asks for what that hangs on.
    """

    timeline: str
    predicate: str
    arguments: Arguments
    since: int
    ticks: int
    whole: str
    begun: int
    total: int
    asked: tuple[SourcePlace, ...] = ()


def time_spent(outcome: Outcome) -> dict[str, float]:
    """The share of the time until the end that each predicate held that was asked for, where that was longest.

    Nothing where the mission was not too late by the clock.
    """
    if not _is_late_by_clock(outcome) or outcome.last_tick < 1:
        return {}
    return _shares(outcome, 0)


def parts_of_limited(outcome: Outcome, children: Container[str]) -> list[LongPart]:
    """The parts of the token that `limited_token` names, of some predicates, that took a quarter of its time.

    Those are left out of which the conflict tells how long they last.
    """
    whole = limited_token(outcome)
    begun = _last_begun(outcome, whole)
    total = outcome.last_tick - begun
    asked = {(one.timeline, one.predicate) for one in single_events(outcome.events) if one.kind is EventKind.REQUEST}
    conflict = failed_by(outcome).conflict
    variables = conflict.variables if conflict is not None else ()
    told = {one.token.predicate.rpartition(".")[2] for one in variables if one.token and one.name == TOKEN_TIMES[2]}
    seen = [one for one in events_on(outcome.events, {timeline for timeline, _ in asked}) if _is_seen(one)]
    found: list[LongPart] = []
    until: dict[str, int] = {}  # when each timeline held something else
    for one in reversed(seen if total else ()):
        if one.tick < begun:
            break
        ticks = until.get(one.timeline, outcome.last_tick) - one.tick
        until[one.timeline] = one.tick
        is_part = one.predicate in children and (one.timeline, one.predicate) in asked and one.predicate not in told
        if is_part and ticks >= _LEAST * total:
            found.append(LongPart(one.timeline, one.predicate, one.arguments, one.tick, ticks, whole, begun, total))
    return found[::-1]


def _is_seen(event: Event) -> bool:
    return event.kind is EventKind.OBSERVATION


def time_inside(outcome: Outcome) -> dict[str, float]:
    """The share of the time of a token that each predicate held that was asked for, where `limited_token` names one."""
    begun = _last_begun(outcome, limited_token(outcome))
    return _shares(outcome, begun) if begun < outcome.last_tick else {}


def _last_begun(outcome: Outcome, predicate: str) -> int:
    """The tick at which a predicate was last observed to begin; the last one of the mission where it never was."""
    name = predicate.rpartition(".")[2]
    ticks = [tick for _, tick, _, seen in heads_of(outcome.events) if seen == name]
    return ticks[-1] if ticks else outcome.last_tick


def limited_token(outcome: Outcome) -> str:
    """The predicate of the token that a mission broke on as a line limits how long it lasts; empty where none does."""
    element = culprit_of(failed_by(outcome).conflict).element
    variables = element.variables if element is not None and element.kind is ElementKind.CONSTRAINT else ()
    times = {(one.token.predicate, one.name) for one in variables if one.token is not None and one.name in TOKEN_TIMES}
    predicates, names = ({each[at] for each in times} for at in (0, 1))
    is_length = len(predicates) == 1 and names in ({TOKEN_TIMES[2]}, set(_MOMENTS))
    return predicates.pop() if is_length else ""


def _shares(outcome: Outcome, since: int) -> dict[str, float]:
    """The share of the time from a tick to the end that each predicate held that was asked for, where longest."""
    asked = {one.predicate for one in single_events(outcome.events) if one.kind is EventKind.REQUEST}
    held: dict[tuple[str, str], int] = {}
    now: dict[str, tuple[str, int]] = {}
    for _, tick, timeline, predicate in heads_of(outcome.events):
        if timeline in now:
            _add(held, timeline, now[timeline], tick)
        now[timeline] = (predicate, max(tick, since))
    for timeline, last in now.items():
        _add(held, timeline, last, outcome.last_tick)
    found: dict[str, float] = {}
    for (_, predicate), ticks in held.items():
        if predicate in asked and ticks > 0:
            found[predicate] = max(found.get(predicate, 0.0), ticks / (outcome.last_tick - since))
    return found


def _add(held: dict[tuple[str, str], int], timeline: str, begun: tuple[str, int], until: int) -> None:
    key = timeline, begun[0]
    held[key] = held.get(key, 0) + max(until - begun[1], 0)


def _is_late_by_clock(outcome: Outcome) -> bool:
    """Whether a mission failed by a moment that the mission file gives, or as its time was over."""
    conflict = failed_by(outcome).conflict
    if conflict is None:
        return outcome.abort is None and bool(outcome.open_goals)
    return any(
        one.kind is ElementKind.REQUEST
        and one.place is not None
        and any(each.name in _MOMENTS for each in one.variables)
        for one in conflict.elements
    )
