"""What a reactor written in Python was asked for: what waits to begin, what holds, what is over or given up.

Beginning is publishing: the first command that waits for the predicate on that timeline, whose window is open and whose
arguments agree, has begun with it. It is over when something else is published there.
"""

from collections.abc import Mapping

from compiler.program import DomainConstant
from runtime.executive.messages import Arguments, Request
from runtime.executive.outcome import EventKind, OpenGoal, Reason, ReasonKind
from runtime.executive.reactor import Refusal
from runtime.executive.trace import Trace
from runtime.user.reactor import Argument, Command

_NEVER = 2**62


class Commands:
    """The requests to one reactor, by their numbers, from the asking to the end."""

    def __init__(self, name: str, trace: Trace) -> None:
        self.name = name
        self.trace = trace
        self.waiting: dict[int, Request] = {}
        self.holding: dict[str, tuple[Request, int]] = {}  # by timeline: what has begun there, and when
        self.taken_back: list[int] = []  # since the code was called last, or too late by then
        self.given_up: list[Refusal] = []
        self.lost: dict[int, OpenGoal] = {}  # mandatory goals that were given up
        self.has_news = False

    def add(self, request: Request) -> None:
        """Take a request; the code sees it at the next tick."""
        self.waiting[request.number] = request
        self.has_news = True

    def recall(self, number: int) -> None:
        """A request is taken back: what waits is forgotten, what has begun goes on, as far as the code lets it."""
        begun = next((line for line, (one, _) in self.holding.items() if one.number == number), None)
        if begun is not None:
            del self.holding[begun]
        elif self.waiting.pop(number, None) is None:
            return
        self.taken_back.append(number)
        self.has_news = True

    def next_call(self, tick: int) -> int:
        """The next tick at which the code is to be called for a command, or one of them is too late."""
        if self.has_news:
            return tick + 1
        times = [one.start[0] for one in self.waiting.values() if one.start[0] > tick]
        times += [one.start[1] + 1 for one in self.waiting.values()]
        return min(times, default=_NEVER)

    def expire(self, tick: int) -> None:
        """Give up what can begin no more."""
        for request in [one for one in self.waiting.values() if one.start[1] < tick]:
            self.give_up(request, EventKind.REJECT, Reason(ReasonKind.TOO_LATE, tick=tick))
            self.taken_back.append(request.number)
            self.has_news = True

    def calls(self, tick: int) -> bool:
        """Whether there is news of commands at a tick, or one may begin from now on."""
        return self.has_news or any(one.start[0] == tick for one in self.waiting.values())

    def told(self, arguments: Mapping[int, Mapping[str, Argument]]) -> tuple[tuple[Command, ...], frozenset[int]]:
        """What waits, the earliest first, and what was taken back: the code is told now."""
        waiting = tuple(
            Command(one.number, one.timeline, one.predicate, arguments[one.number], one.start, one.duration, one.end)
            for one in self._ordered()
        )
        taken_back = frozenset(self.taken_back)
        self.taken_back.clear()
        self.has_news = False
        return waiting, taken_back

    def _ordered(self) -> list[Request]:
        """What waits, the earliest start first, of equals what was asked for first."""
        order = {number: place for place, number in enumerate(self.waiting)}
        return sorted(self.waiting.values(), key=lambda one: (one.start[0], order[one.number]))

    def begin(self, tick: int, timeline: str, predicate: str, arguments: Arguments) -> tuple[int, ...]:
        """Something begins to hold: what held there is over, and what it answers has begun; the events behind it."""
        self.end(tick, timeline)
        for request in self._ordered():
            is_due = request.start[0] <= tick <= request.start[1]
            if (request.timeline, request.predicate) == (timeline, predicate) and is_due and _agree(request, arguments):
                del self.waiting[request.number]
                self.holding[timeline] = request, tick
                return (request.event,)
        return ()

    def end(self, tick: int, timeline: str) -> None:
        """What was asked for and holds on a timeline is over: achieved, if it kept the bounds of its end."""
        held = self.holding.pop(timeline, None)
        if held is None:
            return
        request, begun = held
        least, most = request.duration
        if request.end[0] <= tick <= request.end[1] and least <= tick - begun <= most:
            what = (request.timeline, request.predicate, request.arguments, (request.event,))
            self.trace.record(EventKind.ACHIEVED, self.name, *what, request=request.number)
        else:
            reason = Reason(ReasonKind.DECLINED, tick=tick, message="it ended at another time than was asked for")
            self.give_up(request, EventKind.REJECT, reason, is_done=True)

    def decline(self, number: int, why: str, tick: int) -> None:
        """The code does not do what waits."""
        reason = Reason(ReasonKind.DECLINED, tick=tick, message=why or "no reason given")
        self.give_up(self.waiting[number], EventKind.REFUSE, reason)

    def give_up(self, request: Request, kind: EventKind, reason: Reason, is_done: bool = False) -> None:
        """Record that a request is refused, or given up, and why."""
        self.waiting.pop(request.number, None)
        what = (request.timeline, request.predicate, request.arguments, (request.event,))
        event = self.trace.record(kind, self.name, *what, request=request.number, reason=reason)
        self.given_up.append(Refusal(request, event, is_done))
        if request.is_mandatory:
            self.lost[request.number] = OpenGoal(*what[:3], reason, event=event)

    def open_goals(self) -> list[OpenGoal]:
        """Mandatory goals that were not achieved."""
        open_now = [*self.waiting.values(), *(one for one, _ in self.holding.values())]
        left = [OpenGoal(one.timeline, one.predicate, one.arguments) for one in open_now if one.is_mandatory]
        return [*self.lost.values(), *left]


def _agree(request: Request, arguments: Arguments) -> bool:
    """Whether what is published is what was asked for, as far as both say."""
    said = dict(arguments)
    return all(name not in said or _meet(wanted, said[name]) for name, wanted in request.arguments)


def _meet(one: DomainConstant, other: DomainConstant) -> bool:
    """Whether two domains have a value in common."""
    if one.interval is not None and other.interval is not None:
        return max(one.interval[0], other.interval[0]) <= min(one.interval[1], other.interval[1])
    values = _values(one), _values(other)
    return values[0] is None or values[1] is None or bool(values[0] & values[1])


def _values(domain: DomainConstant) -> "set[object] | None":
    if domain.values is not None:
        return set(domain.values)
    lower, upper = domain.interval if domain.interval is not None else (0, 1)
    return {lower} if lower == upper else None
