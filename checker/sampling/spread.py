"""Samplers that spread: corners first, and adaptive random testing by distance or by partition.

Every fourth mission is a plain random one, whatever was flown before, so that the failure rate is told all the same.
"""

from collections.abc import Sequence
from itertools import product

import numpy as np

from checker.sampling.sampler import RANDOM_POINT, MissionRole, SamplePoint, Setting, Trial, Unweighted

_CANDIDATES = 10  # Chen, Leung, Mak 2004: more of them gain little
_EVERY = 4
_MOST_CORNERS = 12  # axes of which all corners are flown; of more a selection


def is_kept_random(number: int) -> bool:
    """Whether mission `number` (from 0) is a plain random one."""
    return number % _EVERY == _EVERY - 1


class Corners(Unweighted):
    """The middle and the corners of the box first, then random missions.

    At most half of the missions are corners; of more corners an even selection by chance.
    """

    def __init__(self, setting: Setting) -> None:
        super().__init__(setting)
        self._corners = self._chosen()

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """What comes next in one fixed list."""
        numbers = range(len(trials), len(trials) + count)
        return [self._corners[number] if number < len(self._corners) else RANDOM_POINT for number in numbers]

    def _chosen(self) -> list[SamplePoint]:
        setting = self._setting
        axes = setting.axes
        if not axes:
            return []
        generator = setting.generator("corners")
        if len(axes) <= _MOST_CORNERS:
            signs = np.array(list(product((False, True), repeat=len(axes))))
            signs = signs[generator.permutation(len(signs))]
        else:
            signs = generator.random((2**_MOST_CORNERS, len(axes))) < 0.5
        low, high = np.array([axis.low for axis in axes]), np.array([axis.high for axis in axes])
        rows = [np.full(len(axes), 0.5), *np.where(signs, high, low)]
        return [setting.point(row, MissionRole.DESIGNED) for row in rows[: max(1, setting.planned // 2)]]


class AdaptiveRandom(Unweighted):
    """Adaptive random testing by distance: of ten random candidates the one farthest from all missions so far."""

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """Depends on where was flown, not on what came of it."""
        setting = self._setting
        if not setting.axes:
            return [RANDOM_POINT] * count
        flown = [[share for _, share in trial.point.shares] for trial in trials if trial.point.shares]
        rows = np.array(flown).reshape(len(flown), len(setting.axes))
        chosen: list[SamplePoint] = []
        for number in range(len(trials), len(trials) + count):
            if is_kept_random(number):
                chosen.append(RANDOM_POINT)
                continue
            candidates = setting.generator("art", number).random((_CANDIDATES, len(setting.axes)))
            best = candidates[0]
            if len(rows):
                nearest = ((candidates[:, None, :] - rows[None, :, :]) ** 2).sum(axis=2).min(axis=1)
                best = candidates[int(nearest.argmax())]
            rows = np.vstack([rows, best])
            chosen.append(setting.point(best, MissionRole.DESIGNED))
        return chosen


class AdaptivePartition(Unweighted):
    """Adaptive random testing by bisection (Chen, Merkel, Wong, Eddy 2004): the box is halved, axis by axis.

    Each part that holds no mission gets one before any part is halved again.
    """

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """Depends on where was flown, not on what came of it; what was flown is gone through again."""
        setting, total = self._setting, len(trials) + count
        if not setting.axes:
            return [RANDOM_POINT] * count
        dimension = len(setting.axes)
        generator = setting.generator("partition")
        rows: list[np.ndarray] = []
        cuts = 0
        while len(rows) < total:
            sides = np.array([2 ** (cuts // dimension + (axis < cuts % dimension)) for axis in range(dimension)])
            taken = {tuple((row * sides).astype(int)) for row in rows}
            parts = _empty_parts(sides, taken, generator, total - len(rows))
            rows += [(part + generator.random(dimension)) / sides for part in parts]
            cuts += 1
        designed = iter(rows)
        points = [
            RANDOM_POINT if is_kept_random(number) else setting.point(next(designed), MissionRole.DESIGNED)
            for number in range(total)
        ]
        return points[len(trials) :]


def _empty_parts(
    sides: np.ndarray, taken: set[tuple[int, ...]], generator: np.random.Generator, most: int
) -> list[np.ndarray]:
    """At most `most` parts of the grid without a mission, in an order of chance."""
    total = int(np.prod(sides.astype(float))) if np.prod(sides.astype(float)) < 1e15 else 10**15
    if total <= 4 * (len(taken) + most):
        every = np.array(np.unravel_index(generator.permutation(total), sides)).T
        return [part for part in every if tuple(part) not in taken][:most]
    found: dict[tuple[int, ...], np.ndarray] = {}
    while len(found) < most:  # most parts are empty: chance meets one at once
        part = (generator.random(len(sides)) * sides).astype(int)
        if tuple(part) not in taken:
            found.setdefault(tuple(part), part)
    return list(found.values())
