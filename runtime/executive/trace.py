"""Record what happens in a mission, each event with the earlier events that caused it."""

from runtime.executive.outcome import Draw, Event


class Trace:
    """The events of one mission, in order; canonical: two runs of one mission record equal traces (T-REX 3.4)."""

    def __init__(self) -> None:
        self.events: list[Event] = []
        self.draws: list[Draw] = []
        self.tick = 0
        self.phase = "start"
        self._drawn: dict[tuple[str, int], int] = {}

    def record(self, kind: str, reactor: str, timeline: str, text: str, causes: tuple[int, ...] = ()) -> int:
        """Add an event at the present tick and phase; its index is what later events name as their cause."""
        self.events.append(Event(self.tick, self.phase, kind, reactor, timeline, text, causes))
        return len(self.events) - 1

    def record_draw(self, reactor: str, draw: Draw) -> int:
        """Add a drawn value, once per parameter and date; the index of its event."""
        key = (draw.parameter, draw.tick)
        if key not in self._drawn:
            self.draws.append(draw)
            clipped = "" if draw.raw == draw.value else f" (drawn {draw.raw!r})"
            self._drawn[key] = self.record("sample", reactor, "", f"{draw.parameter} = {draw.value!r}{clipped}")
        return self._drawn[key]
