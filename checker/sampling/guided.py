"""Coverage-guided sampling: missions near those that did something which few others did.

A feature is a rule that fired, a branch that was taken, a repair, or a kind of event on a timeline. A mission is worth
the more the rarer its rarest features are; its neighbours are flown, as in a greybox fuzzer's queue. Every fourth
mission is a plain random one, so that the failure rate is told all the same.
"""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from checker.sampling.sampler import RANDOM_POINT, MissionRole, SamplePoint, Trial, Unweighted
from checker.sampling.spread import is_kept_random

_GENERATION = 20
_BEST = 12  # missions whose neighbourhood is looked at
_WIDTHS = (0.02, 0.1, 0.3)


class Guided(Unweighted):
    """Follows behaviours that are rare so far."""

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """One generation; the first one spreads by chance."""
        setting, count = self._setting, min(count, _GENERATION)
        if not setting.axes:
            return [RANDOM_POINT] * count
        generator = setting.generator("guided", len(trials))
        queue = _worth_following(trials, len(setting.axes))
        points: list[SamplePoint] = []
        for number in range(len(trials), len(trials) + count):
            if is_kept_random(number):
                points.append(RANDOM_POINT)
                continue
            shares = generator.random(len(setting.axes))
            if queue:
                start = queue[int(generator.integers(len(queue)))]
                width = _WIDTHS[int(generator.integers(len(_WIDTHS)))]
                moved = np.abs(start + width * (2.0 * shares - 1.0))
                keep = generator.random(len(start)) < 0.5
                shares = np.where(keep, start, np.where(moved > 1.0, 2.0 - moved, moved))
            points.append(setting.point(shares, MissionRole.DESIGNED))
        return points


def _worth_following(trials: Sequence[Trial], axes: int) -> list[np.ndarray]:
    """The shares of the missions with the rarest features."""
    often = Counter(feature for trial in trials for feature in trial.behaviour)
    worth = []
    for number, trial in enumerate(trials):
        if len(trial.point.shares) == axes and trial.behaviour:
            rarest = sorted(often[feature] for feature in trial.behaviour)[:3]
            if rarest[0] <= max(1, len(trials) // 4):
                worth.append((rarest, number))
    return [np.array([share for _, share in trials[number].point.shares]) for _, number in sorted(worth)[:_BEST]]
