"""Two runs on common seeds in, what changed between them out: missions that flipped, McNemar's exact test."""

from collections.abc import Mapping
from dataclasses import dataclass

from checker.statistics import DIGITS, Interval, exact_interval, mcnemar


@dataclass(frozen=True, slots=True)
class Trialled:
    """A mission of a run: its number, whether it failed, and why."""

    number: int
    failed: bool
    code: str
    reason: str


@dataclass(frozen=True, slots=True)
class Flip:
    """A mission that fails in one run and not in the other; `now_fails`: in the second."""

    before: Trialled
    after: Trialled
    seed: int

    @property
    def now_fails(self) -> bool:
        """Whether the second run has the failure."""
        return self.after.failed


@dataclass(frozen=True, slots=True)
class Comparison:
    """Missions that both runs flew with the same seed. `interval` is that of the change of the failure rate."""

    missions: int
    failed_before: int
    failed_after: int
    flips: tuple[Flip, ...]
    chance: float  # of flips as uneven, if neither run is better
    change: float
    interval: Interval


Mission = tuple[int, str]  # seed, and the point as text: what makes two missions the same


def compare(before: Mapping[Mission, Trialled], after: Mapping[Mission, Trialled], confidence: float) -> Comparison:
    """Compare missions of the same seed and point.

    The interval joins exact ones of the rates of both kinds of flips, each at half the error (Bonferroni).
    """
    common = [key for key in before if key in after]
    flips = tuple(Flip(before[key], after[key], key[0]) for key in common if before[key].failed != after[key].failed)
    worse = sum(one.now_fails for one in flips)
    better = len(flips) - worse
    half = 1.0 - (1.0 - confidence) / 2.0
    up, down = exact_interval(worse, len(common), half), exact_interval(better, len(common), half)
    change = (worse - better) / len(common) if common else 0.0
    return Comparison(
        len(common),
        sum(before[key].failed for key in common),
        sum(after[key].failed for key in common),
        flips,
        mcnemar(worse, better),
        round(change, DIGITS),
        (round(up[0] - down[1], DIGITS), round(up[1] - down[0], DIGITS)),
    )
