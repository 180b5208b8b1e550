"""How much may be tried to find causes: flights, and seconds of processor time.

Processor time hardly depends on what else a machine does, so causes do not either; the clock ends what is starved.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from checker.batch.processor import PATIENCE

MOST_FLIGHTS = 40
MOST_SECONDS = 60.0
_CHANGES = 1250  # that so many flights as were asked for are enough for
_MOST_TIMES = 3  # as many flights
_EVENTS = 240_000  # of all flights together: a long mission is flown no more often than was asked for


@dataclass(frozen=True, slots=True)
class Bounds:
    """How much may be tried; `is_cancelled` is asked before each flight.

    `seconds` are of processor time, as `spent` tells it: of this process, and of those that fly for it. Where `flights`
    have shown no change that mends, there are `further` ones.
    """

    flights: int = MOST_FLIGHTS
    seconds: float = MOST_SECONDS
    is_cancelled: Callable[[], bool] = field(default=lambda: False)
    spent: Callable[[], float] = time.process_time
    further: int = 0

    def grown(self, changes: int, events: int) -> "Bounds":
        """The bounds for so many changes that may be tried on a mission of so many events: a large model has more.

        What a large one has at once any other has as further flights.
        """
        most = min(_MOST_TIMES * self.flights, _EVENTS // max(events, 1))
        flights = max(self.flights, min(self.flights * changes // _CHANGES, most))
        return replace(self, flights=flights, further=max(most - flights, 0))

    def lengthened(self) -> "Bounds":
        """The bounds with the further flights."""
        return replace(self, flights=self.flights + self.further, further=0)


class Allowance:
    """Whether there still is processor time, or five times as much by the clock, since that was asked for first.

    Each search that is begun within `seconds` has `each` of its own.
    """

    def __init__(self, seconds: float, each: float, spent: Callable[[], float]) -> None:
        self._seconds, self._each, self._spent = seconds, each, spent
        self._watch: Stopwatch | None = None

    def __call__(self) -> bool:
        if self._watch is None:
            self._watch = Stopwatch(self._spent)
            return True
        return not self._watch.has_passed(self._seconds)

    def begin(self) -> Callable[[float], bool]:
        """Begin a search: a function that tells whether less than a share of its time is over."""
        watch = Stopwatch(self._spent)
        return lambda share: not watch.has_passed(share * self._each)


class Stopwatch:
    """Processor time and time by the clock since it was made."""

    def __init__(self, spent: Callable[[], float]) -> None:
        self._spent, self._begun, self._clock = spent, spent(), time.monotonic()

    @property
    def seconds(self) -> float:
        """Of processor time."""
        return self._spent() - self._begun

    def is_over(self, seconds: float) -> bool:
        """Whether so much processor time was used."""
        return self.seconds >= seconds

    def is_starved(self, seconds: float) -> bool:
        """Whether it was not, in many times as long by the clock."""
        return time.monotonic() - self._clock >= PATIENCE * seconds

    def has_passed(self, seconds: float) -> bool:
        """Whether so much processor time was used, or was not to be had."""
        return self.is_over(seconds) or self.is_starved(seconds)
