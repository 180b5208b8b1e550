"""The goals of the mission file: handed out and taken back at their ticks, as requests that nobody sent."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from runtime.executive.configuration import GoalConfiguration
from runtime.executive.messages import Request
from runtime.executive.outcome import EventKind, TimeBounds
from runtime.executive.trace import Trace

_NEVER = 2**62


class GoalPoster:
    """What is still to be handed out, or taken back; `due` is the tick at which the next is."""

    def __init__(
        self, goals: Sequence[tuple[int, Request]], configured: Sequence[GoalConfiguration], trace: Trace
    ) -> None:
        self.unsent = list(goals)
        self.recalls = {goals[k][1].number: one.recall for k, one in enumerate(configured) if one.recall is not None}
        self.sent: dict[int, Request] = {}  # those that may be taken back
        self.trace = trace
        self.due = 0

    def hand_out(self, tick: int, timelines: Collection[str]) -> Iterator[Request]:
        """Goals that are due on timelines that have an owner; each is put on record when it is given."""
        for goal in [one for one in self.unsent if one[0] <= tick]:
            request = goal[1]
            if request.timeline in timelines:
                self.unsent.remove(goal)
                bounds = TimeBounds(request.start, request.end, request.duration)
                what = (request.timeline, request.predicate, request.arguments)
                event = self.trace.record(EventKind.REQUEST, "", *what, request=request.number, bounds=bounds)
                request = self.sent[request.number] = replace(request, event=event)
                yield request
        times = [*(at for at, _ in self.unsent), *self.recalls.values()]
        self.due = min([at for at in times if at > tick], default=_NEVER)

    def take_back(self, tick: int) -> Iterator[int]:
        """The numbers of goals whose time has come to be taken back."""
        for number in [number for number, at in self.recalls.items() if at <= tick]:
            del self.recalls[number]
            if number in self.sent:
                request = self.sent[number]
                what = (request.timeline, request.predicate, request.arguments)
                self.trace.record(EventKind.RECALL, "", *what, (request.event,), request=number)
                yield number
