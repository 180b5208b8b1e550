"""Clocks of an agent: how many decisions planners make in a tick, and when the next one begins (T-REX 1.2).

A clock serves one mission. It counts the steps of those reactors that look more than one tick ahead: what the others do
is the world's part, and takes no step in register code.
"""

from collections.abc import Mapping

from runtime.executive.configuration import ClockConfiguration


class FastClock:
    """The fast clock: the next tick begins when nobody has work left.

    `counts` has the steps made, by tick, for each tick in which somebody wanted to make one. A step is a decision: who
    has nothing to decide takes none.
    """

    is_metered = False  # whether it may end a tick before nobody has work left

    def __init__(self) -> None:
        self.tick = 0
        self.counts: dict[int, int] = {}

    def begin(self, tick: int) -> None:
        """A tick begins; it may wait for that."""
        self.tick = tick

    def count(self, steps: int) -> None:
        """Count steps made in this tick; none where one was wanted and not granted."""
        self.counts[self.tick] = self.counts.get(self.tick, 0) + steps

    def is_free(self) -> bool:
        """Whether there is time for a step."""
        return True


class StepClock(FastClock):
    """The step clock: so many steps a tick and no more."""

    is_metered = True

    def __init__(self, steps: int) -> None:
        super().__init__()
        self.steps = steps

    def is_free(self) -> bool:
        """Whether fewer steps were made."""
        return self.counts.get(self.tick, 0) < self.steps


class LogClock(FastClock):
    """The log clock: in each tick as many steps as another flight made there, and none in a tick that it did not name.

    After the last tick of the log it is fast.
    """

    is_metered = True

    def __init__(self, counts: Mapping[int, int]) -> None:
        super().__init__()
        self.logged = counts
        self.last = max(counts, default=-1)

    def is_free(self) -> bool:
        """Whether the log has more steps in this tick."""
        return self.tick > self.last or self.counts.get(self.tick, 0) < self.logged.get(self.tick, 0)


def clock_of(configuration: ClockConfiguration) -> FastClock:
    """The clock by which a mission is flown wherever nobody asks for real time."""
    if configuration.counts is not None:
        return LogClock(dict(configuration.counts))
    return FastClock() if configuration.steps is None else StepClock(configuration.steps)
