"""Two runs on common seeds in, what changed between them out: missions that flipped, McNemar's exact test."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from checker.statistics import DIGITS, Interval, exact_interval, mcnemar


class Lost(NamedTuple):
    """What missions cost: repairs of plans, goals given up (late ones among them), requests that were not delivered."""

    repairs: int = 0
    goals: int = 0
    undelivered: int = 0


_NOTHING_LOST = Lost()


@dataclass(frozen=True, slots=True)
class Trialled:
    """A mission of a run: its number, whether it failed, and why; `is_random` where no sampler chose its point."""

    number: int
    failed: bool
    code: str
    reason: str
    is_random: bool = True
    lost: Lost = _NOTHING_LOST


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
    """Missions that both runs flew with the same seed.

    `change` and `interval` are of the failure rate: they rest on the `counted` missions that no sampler chose, and are
    None where there are none.
    """

    missions: int
    failed_before: int
    failed_after: int
    flips: tuple[Flip, ...]
    chance: float  # of flips as uneven, if neither run is better
    counted: int
    change: float | None
    interval: Interval | None
    lost_before: Lost = _NOTHING_LOST
    lost_after: Lost = _NOTHING_LOST

    @property
    def is_worse(self) -> bool:
        """Whether more missions fail only in the second run than only in the first."""
        return 2 * sum(one.now_fails for one in self.flips) > len(self.flips)


Mission = tuple[int, str]  # seed, and the point as text: what makes two missions the same


def compare(before: Mapping[Mission, Trialled], after: Mapping[Mission, Trialled], confidence: float) -> Comparison:
    """Compare missions of the same seed and point.

    The interval joins exact ones of the rates of both kinds of flips, each at half the error (Bonferroni).
    """
    common = [key for key in before if key in after]
    flips = tuple(Flip(before[key], after[key], key[0]) for key in common if before[key].failed != after[key].failed)
    worse = sum(one.now_fails for one in flips)
    better = len(flips) - worse
    counted = sum(before[key].is_random for key in common)
    change, interval = _change(flips, counted, confidence)
    return Comparison(
        len(common),
        sum(before[key].failed for key in common),
        sum(after[key].failed for key in common),
        flips,
        mcnemar(worse, better),
        counted,
        change,
        interval,
        _together([before[key].lost for key in common]),
        _together([after[key].lost for key in common]),
    )


def _together(lost: Sequence[Lost]) -> Lost:
    return Lost(*(sum(column) for column in zip(*lost, strict=True)))


def _change(flips: tuple[Flip, ...], counted: int, confidence: float) -> tuple[float, Interval] | tuple[None, None]:
    """The change of the failure rate and its interval, from the missions that no sampler chose."""
    if not counted:
        return None, None
    worse = sum(one.now_fails for one in flips if one.before.is_random)
    better = sum(not one.now_fails for one in flips if one.before.is_random)
    half = 1.0 - (1.0 - confidence) / 2.0
    up, down = exact_interval(worse, counted, half), exact_interval(better, counted, half)
    interval = (round(up[0] - down[1], DIGITS), round(up[1] - down[0], DIGITS))
    return round((worse - better) / counted, DIGITS), interval
