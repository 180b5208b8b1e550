"""A mission's outcome in, its verdict out: did it get to its end, and did it do what it had to?

The founding paper's oracle is premature end (section 4, "any premature mission end is a bug"); mandatory goals that
stay open are class F10 of the failure taxonomy (reference of T-REX, 1.10 and 1.11).
"""

from collections.abc import Container, Sequence
from dataclasses import dataclass
from enum import Enum

from checker.limits import Limit, Limits
from checker.losses import Exceeded, Losses, exceeded, losses_of
from runtime.executive.events import EventLog, numbered, single_events
from runtime.executive.outcome import Abort, Event, EventKind, Outcome, PropertyFate, Reason, ReasonKind

_GOALS_OPEN = "F10"
_NO_RECORD = "F7"
_BROKEN = "F11"
_DEAD = "F8"
_FAILED = "Failed"  # the predicate that a timeline holds whose owner is lost
_KILL, _OBSERVATION = EventKind.KILL, EventKind.OBSERVATION  # to look these up takes time
PROPERTY = "P1"
_LIMIT_CODES = {Limit.REJECTED: "L1", Limit.LATE: "L2", Limit.REPAIRS: "L3", Limit.UNDELIVERED: "L4"}
OUT_OF_TIME = "TIME"  # of an ERROR: the mission took longer than it may
HUNG = "HUNG"  # of an ERROR: it did not even say so
USER_CODE = "USER"  # of an ERROR: a constraint that the project wrote in Python failed

CODE_NAMES = {
    "F1": "an expected observation did not come in time",
    "F2": "an observation contradicts what is already fact",
    "F3": "no value fits a timeline now",
    "F4": "no plan is left",
    "F5": "the planner ran out of steps or time",
    "F6": "a request was refused or came too late",
    "F7": "a reactor could not start a tick",
    "F8": "the owner of a timeline died",
    "F9": "the model cannot hold, or its code failed",
    "F10": "the mission's time is over and a mandatory goal is open",
    "F11": "it ended well and did the wrong thing",
    "L1": "more goals were given up than [check] allows",
    "L2": "more goals were late than [check] allows",
    "L3": "plans were repaired more often than [check] allows",
    "P1": "a property of the mission was violated",
    "L4": "more requests were not delivered than [check] allows",
}


class Verdict(Enum):
    """The fate of a mission; ERROR is a failure of the tool, or of Python code that it was given; never counted."""

    PASS = "PASS"
    FAIL = "FAIL"
    ERROR = "ERROR"


@dataclass(frozen=True, slots=True)
class Judgement:
    """A verdict; `code` names the class of failure and `reason` says why it failed, both empty for a PASS.

    `message` is what the code said that failed in an ERROR; `exceeded` the limit of [check] that was not kept,
    `broken` the property, the first of the mission file; `also` are further ones that were violated.
    """

    verdict: Verdict
    code: str = ""
    reason: Reason | None = None
    message: str = ""
    exceeded: Exceeded | None = None
    broken: PropertyFate | None = None
    also: tuple[PropertyFate, ...] = ()


def judge(outcome: Outcome) -> Judgement:
    """Decide whether a finished mission holds what was promised."""
    end = given_up(outcome)
    if end is not None:
        return Judgement(Verdict.FAIL, end.code, end.reason)
    if (dead := _dead(outcome.events)) is not None:
        return Judgement(Verdict.FAIL, _DEAD, dead)
    if outcome.ended_early:
        reason = Reason(ReasonKind.NO_RECORD, tick=outcome.last_tick, limit=outcome.final_tick)
        return Judgement(Verdict.FAIL, _NO_RECORD, reason)
    if outcome.open_goals:
        return Judgement(Verdict.FAIL, _GOALS_OPEN, Reason(ReasonKind.GOALS_OPEN))
    broken = [one for one in outcome.properties if not one.is_kept]
    if broken:
        return Judgement(Verdict.FAIL, PROPERTY, broken=broken[0], also=tuple(broken[1:]))
    if outcome.breaches:
        return Judgement(Verdict.FAIL, _BROKEN, outcome.breaches[0])
    return Judgement(Verdict.PASS)


def judged_beside(judgement: Judgement, beside: Container[str]) -> Judgement:
    """The judgement of a mission that may violate some properties: it passes where it does no worse."""
    broken = [one for one in (judgement.broken, *judgement.also) if one is not None]
    return Judgement(Verdict.PASS) if broken and all(one.name in beside for one in broken) else judgement


def given_up(outcome: Outcome) -> Abort | None:
    """The abort, or the first reactor that was killed, told like one; None where nobody gave up."""
    if outcome.abort is not None:
        return outcome.abort
    if all(event.kind is not _KILL for event in single_events(outcome.events)):
        return None
    index, event = next(each for each in numbered(outcome.events) if each[1].kind is _KILL)
    assert event.reason is not None
    before = (one for at, one in numbered(outcome.events) if at < index and one.reactor == event.reactor)
    repairs = sum(one.kind is EventKind.RELAX for one in before)
    lines, deadlock = tuple(event.timeline.split(", ")), event.deadlock
    return Abort(
        event.code, event.tick, event.reactor, lines, event.reason, event.conflict, repairs, index, deadlock=deadlock
    )


def _dead(events: Sequence[Event]) -> Reason | None:
    """The first timeline that came to hold `Failed` though nobody was killed: an owner said so itself (T-REX 1.10)."""
    said = [one for one in single_events(events) if one.predicate == _FAILED and one.kind is _OBSERVATION]
    found = [(one.tick, one.timeline) for one in said]
    if isinstance(events, EventLog):
        found += events.first_in_runs(_FAILED)
    if not found:
        return None
    tick, timeline = min(found)
    return Reason(ReasonKind.HELD_FAILED, predicate=_FAILED, timeline=timeline, tick=tick)


def judge_within(outcome: Outcome, limits: Limits) -> Judgement:
    """The judgement of an outcome with the limits of [check] applied."""
    return judge_losses(judge(outcome), losses_of(outcome), limits)


def judge_losses(judgement: Judgement, losses: Losses, limits: Limits) -> Judgement:
    """The judgement with the limits of [check] applied: a mission that passed fails where it lost more."""
    over = exceeded(losses, limits) if judgement.verdict is Verdict.PASS else None
    return judgement if over is None else Judgement(Verdict.FAIL, _LIMIT_CODES[over.limit], exceeded=over)
