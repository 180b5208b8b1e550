"""Faults of 0.2 % that show by nothing until a mission fails: in how many batches of 300 missions a sampler meets them.

    python -m tests.checker.discovery_study 300              adaptive, 300 batches of six parameters
    python -m tests.checker.discovery_study 300 sobol 4      another sampler, four parameters

Until its first failure a batch is the same in every world, so each one is flown once and held against ten places of
each fault: other parameters, other ends, another position.
"""

import sys
from collections.abc import Callable
from math import gamma, pi

import numpy as np

from checker.sampling.sampler import Setting, ShareAxis, Trial
from nddlc.samplers import find_sampler

RATE = 0.002
_MISSIONS, _PLACES = 300, 10
Region = Callable[[np.ndarray], np.ndarray]  # rows of shares in, whether each fails
World = Callable[[np.random.Generator, int], Region]  # for a number of axes: the region at some place


def box(ends: int, inner: int = 0, width: float = 1.0) -> World:
    """`ends` parameters near an end, and `inner` ones within an interval of the width, somewhere."""
    reach = (RATE / width**inner) ** (1.0 / ends) if ends else 0.0
    width = width if ends else float(RATE ** (1.0 / inner))

    def place(dice: np.random.Generator, axes: int) -> Region:
        chosen, is_low = dice.permutation(axes)[: ends + inner], dice.random(ends) < 0.5
        lower = dice.random(inner) * (1.0 - width)

        def fails(rows: np.ndarray) -> np.ndarray:
            outer, middle = rows[:, chosen[:ends]], rows[:, chosen[ends:]]
            is_near = np.where(is_low, outer, 1.0 - outer) <= reach
            return np.asarray(is_near.all(axis=1) & ((middle >= lower) & (middle <= lower + width)).all(axis=1))

        return fails

    return place


def ball(over: int) -> World:
    """A ball of so many parameters, wholly within the box."""
    radius = float((RATE / (pi ** (over / 2) / gamma(over / 2 + 1))) ** (1.0 / over))

    def place(dice: np.random.Generator, axes: int) -> Region:
        chosen, centre = dice.permutation(axes)[:over], radius + (1.0 - 2.0 * radius) * dice.random(over)
        return lambda rows: np.asarray(((rows[:, chosen] - centre) ** 2).sum(axis=1) <= radius**2)

    return place


def beyond(over: int, combine: Callable[[np.ndarray], np.ndarray]) -> World:
    """What combines so many parameters is greater than a quantile of it."""
    drawn = np.sort(combine(np.random.default_rng(1).random((1_000_000, over))))
    limit = drawn[int(len(drawn) * (1.0 - RATE))]

    def place(dice: np.random.Generator, axes: int) -> Region:
        chosen, is_turned = dice.permutation(axes)[:over], dice.random(over) < 0.5
        return lambda rows: combine(np.where(is_turned, 1.0 - rows[:, chosen], rows[:, chosen])) >= limit

    return place


def of_two(fails: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> World:
    """A region of two parameters."""

    def place(dice: np.random.Generator, axes: int) -> Region:
        one, other = dice.permutation(axes)[:2]
        return lambda rows: fails(rows[:, one], rows[:, other])

    return place


_RING = RATE / (2.0 * pi * 0.3) / 2.0
WORLDS: dict[str, tuple[int, World]] = {
    **{f"corner of {count}": (count, box(count)) for count in (1, 2, 3, 4, 6)},
    "face, a half of 1": (2, box(1, 1, 0.5)),
    "face, a fifth of 1": (2, box(1, 1, 0.2)),
    "face, a third of 2": (3, box(1, 2, 0.35)),
    "edge, a third of 1": (3, box(2, 1, 0.33)),
    "edge, a third of 2": (4, box(2, 2, 0.3)),
    **{f"sum of {count}": (count, beyond(count, lambda rows: rows.sum(axis=1))) for count in (2, 4, 6)},
    "product of 3": (3, beyond(3, lambda rows: rows.prod(axis=1))),
    "exclusive or": (2, of_two(lambda one, other: (one < RATE / 2) ^ (other < RATE / 2))),
    "band": (2, of_two(lambda one, other: abs(one - other) < RATE / 2)),
    "ring": (2, of_two(lambda one, other: abs(np.hypot(one - 0.5, other - 0.5) - 0.3) < _RING)),
    **{f"pocket of {count}": (count, box(0, count)) for count in (1, 2, 3, 4, 6)},
    **{f"ball of {count}": (count, ball(count)) for count in (2, 4, 6)},
}


def unfailing_batch(name: str, axes: int, seed: int) -> np.ndarray:
    """The shares of a batch in which nothing fails, one mission per row."""
    named = tuple(ShareAxis(f"P{number}", 0.0, 1.0 - 2.0**-53) for number in range(axes))
    sampler, dice = find_sampler(name)[1](Setting(named, seed, _MISSIONS)), np.random.default_rng([seed, 7])
    trials: list[Trial] = []
    while len(trials) < _MISSIONS:
        left = _MISSIONS - len(trials)
        trials += [Trial(point, False) for point in sampler.choose(trials, left)[:left]]
    return np.array([[share for _, share in one.point.shares] or dice.random(axes) for one in trials])


def main(count: int, name: str = "adaptive", axes: int = 6) -> None:
    """Print of each world the share of batches that meet its fault."""
    batches = [unfailing_batch(name, axes, seed) for seed in range(count)]
    for number, (caption, (needed, world)) in enumerate(WORLDS.items()):
        if needed <= axes:
            found = [
                bool(world(np.random.default_rng([seed, place, number]), axes)(rows).any())
                for seed, rows in enumerate(batches)
                for place in range(_PLACES)
            ]
            print(f"{name}, {axes} parameters: {caption:19} met by {100.0 * np.mean(found):5.1f} %")


if __name__ == "__main__":
    _count, _name, _axes, *_ = (*sys.argv[1:], *("300", "adaptive", "6")[len(sys.argv) - 1 :])
    main(int(_count), _name, int(_axes))
