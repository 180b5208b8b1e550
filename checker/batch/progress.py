"""How far a batch has come: what is finished, at which rate, what failed, and how long the rest will take."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Progress:
    """A batch under way. `kept` missions were finished before it began; the rate is of those flown since."""

    planned: int
    done: int
    kept: int
    failures: int
    errors: int
    seconds: float
    most_seconds: float | None  # after which it ends
    has_interval: bool = True  # missions are plain random ones

    @property
    def rate(self) -> float:
        """Missions a second; 0 while nothing is known."""
        flown = self.done - self.kept
        return flown / self.seconds if flown and self.seconds > 0.0 else 0.0

    @property
    def seconds_left(self) -> float | None:
        """The time that is still needed at this rate, or given; None while nothing is known."""
        times = [(self.planned - self.done) / self.rate] if self.rate else []
        if self.most_seconds is not None:
            times.append(max(0.0, self.most_seconds - self.seconds))
        return min(times, default=None)
