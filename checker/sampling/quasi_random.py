"""Space-filling designs of scipy: Latin hypercube and scrambled Sobol points, as samplers.

Their missions are not independent: the observed rate is unbiased, but no interval of independent missions holds for it.
"""

from collections.abc import Sequence

import numpy as np
from scipy.stats import qmc

from checker.sampling.sampler import MissionRole, SamplePoint, Setting, Trial

_MOST_AXES = 21_201  # of scipy's table of direction numbers


class _Design:
    """A design of all planned missions, made at once."""

    has_weights = False
    most_weight = 1.0

    def __init__(self, setting: Setting) -> None:
        self._setting = setting

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """The rows of the design that come next; without axes missions are plain random ones."""
        setting = self._setting
        if not setting.axes:
            return [SamplePoint()] * count
        rows = self._rows(len(setting.axes), max(setting.planned, len(trials) + count))
        chosen = rows[len(trials) : len(trials) + count]
        return [setting.point(row, MissionRole.DESIGNED) for row in chosen]

    def _rows(self, axes: int, count: int) -> np.ndarray:
        raise NotImplementedError


class LatinHypercube(_Design):
    """Each axis is cut into as many slices as there are missions; each slice has one mission (McKay et al. 1979)."""

    def _rows(self, axes: int, count: int) -> np.ndarray:
        return np.asarray(qmc.LatinHypercube(axes, rng=self._setting.generator("lhs")).random(count))


class Sobol(_Design):
    """Scrambled Sobol points (Owen): even over all axes together, whatever the number of missions."""

    def _rows(self, axes: int, count: int) -> np.ndarray:
        design = qmc.Sobol(min(axes, _MOST_AXES), scramble=True, rng=self._setting.generator("sobol"))
        return np.asarray(design.random_base2(max(0, (count - 1).bit_length())))[:count]
