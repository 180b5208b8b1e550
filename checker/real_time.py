"""The real-time clock of an agent: each tick begins when its time has come (T-REX 1.2)."""

import time
from collections.abc import Callable

from runtime.executive.clocks import FastClock


class RealTimeClock(FastClock):
    """The real-time clock: a tick lasts `period` seconds, of which planners may use a `share`.

    Ticks are not left out: where reactors took longer, the next one begins late; `latest` is the most, in seconds.
    `told` hears of each tick in which somebody has something to do.
    """

    is_metered = True

    def __init__(
        self,
        period: float,
        share: float = 1.0,
        told: Callable[[int], None] | None = None,
        now: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        super().__init__()
        self.period, self.share = period, share
        self.latest = 0.0
        self._told, self._now, self._sleep = told, now, sleep
        self._origin: float | None = None
        self._end = 0.0

    def begin(self, tick: int) -> None:
        """Wait until the tick begins."""
        if self._origin is None:
            self._origin = self._now() - tick * self.period
        due = self._origin + tick * self.period
        while (left := due - self._now()) > 0.0:
            self._sleep(left)
        self.latest = max(self.latest, -left)
        self._end = due + self.share * self.period
        super().begin(tick)
        if self._told is not None:
            self._told(tick)

    def is_free(self) -> bool:
        """Whether the planners' share of the tick is not over."""
        return self._now() < self._end
