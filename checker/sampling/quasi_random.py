"""Space-filling designs of scipy: Latin hypercube and scrambled Sobol points, as samplers.

Their missions are not independent: the observed rate is unbiased, but no interval of independent missions holds for it.
"""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.stats import qmc

from checker.sampling.sampler import RANDOM_POINT, MissionRole, SamplePoint, Setting, Trial, Unweighted

_MOST_AXES = 21_201  # of scipy's table of direction numbers


class LatinHypercube(Unweighted):
    """Each axis is cut into as many slices as there are missions; each slice has one mission (McKay et al. 1979)."""

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """The rows of the design that come next."""
        return _next_rows(self._setting, len(trials), count, self._rows)

    def _rows(self, axes: int, count: int) -> np.ndarray:
        return np.asarray(qmc.LatinHypercube(axes, rng=self._setting.generator("lhs")).random(count))


class Sobol(Unweighted):
    """Scrambled Sobol points (Owen): even over all axes together, whatever the number of missions."""

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """The rows of the design that come next."""
        return _next_rows(self._setting, len(trials), count, self._rows)

    def _rows(self, axes: int, count: int) -> np.ndarray:
        design = qmc.Sobol(min(axes, _MOST_AXES), scramble=True, rng=self._setting.generator("sobol"))
        return np.asarray(design.random_base2(max(0, (count - 1).bit_length())))[:count]


def _next_rows(setting: Setting, flown: int, count: int, design: Callable[[int, int], np.ndarray]) -> list[SamplePoint]:
    """Of a design of all planned missions those after the first `flown`; without axes they are plain random ones."""
    if not setting.axes:
        return [RANDOM_POINT] * count
    rows = design(len(setting.axes), max(setting.planned, flown + count))
    return [setting.point(row, MissionRole.DESIGNED) for row in rows[flown : flown + count]]
