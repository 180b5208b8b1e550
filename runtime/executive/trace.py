"""Record what happens in a mission, each event with the earlier events that caused it."""

from collections.abc import Callable

from runtime.executive.events import EventLog
from runtime.executive.messages import Arguments, draft_of
from runtime.executive.outcome import Conflict, Deadlock, Draw, Event, EventKind, Phase, Reason, RepairStage, TimeBounds
from runtime.executive.reactor import Watched
from runtime.plan.readout.names import TokenName

_Draft = draft_of(Event)


def as_it_is(conflict: Conflict, watches: tuple[Watched, ...]) -> Conflict:
    """A conflict of which nobody knows more."""
    return conflict


class Trace:
    """The events of one mission, in order; canonical: two runs of one mission record equal traces (T-REX 3.4)."""

    def __init__(self) -> None:
        self.events = EventLog()
        self.draws: list[Draw] = []
        self.tick = 0
        self.phase = Phase.START
        self._drawn: dict[tuple[str, int], int] = {}
        # a conflict, told on through the reactors that published what it hangs on; the agent knows these
        self.tell_on: Callable[[Conflict, tuple[Watched, ...]], Conflict] = as_it_is

    def record(
        self,
        kind: EventKind,
        reactor: str,
        timeline: str = "",
        predicate: str = "",
        arguments: Arguments = (),
        causes: tuple[int, ...] = (),
        *,
        token: TokenName | None = None,
        request: int | None = None,
        bounds: TimeBounds | None = None,
        draw: Draw | None = None,
        stage: RepairStage | None = None,
        code: str = "",
        reason: Reason | None = None,
        conflict: Conflict | None = None,
        deadlock: Deadlock | None = None,
    ) -> int:
        """Add an event at the present tick and phase; its index is what later events name as their cause."""
        event = _Draft()
        event.tick = self.tick
        event.phase = self.phase
        event.kind = kind
        event.reactor = reactor
        event.timeline = timeline
        event.predicate = predicate
        event.arguments = arguments
        event.causes = causes
        event.token = token
        event.request = request
        event.bounds = bounds
        event.draw = draw
        event.stage = stage
        event.code = code
        event.reason = reason
        event.conflict = conflict
        event.deadlock = deadlock
        event.__class__ = Event
        return self.events.append(event)

    def record_draw(self, reactor: str, draw: Draw) -> int:
        """Add a drawn value, once per parameter and date; the index of its event."""
        key = (draw.parameter, draw.tick)
        if key not in self._drawn:
            self.draws.append(draw)
            self._drawn[key] = self.record(EventKind.SAMPLE, reactor, draw=draw)
        return self._drawn[key]

    def draw_events(self, parameters: tuple[str, ...]) -> tuple[int, ...]:
        """The indices of the events in which one of `parameters` was drawn, in order."""
        return tuple(sorted(index for (name, _), index in self._drawn.items() if name in parameters))
