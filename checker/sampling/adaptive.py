"""Adaptive importance sampling: missions near failures and near distress, with weights that keep the rate right.

Each generation is drawn from a mixture of known density: a third as the mission file says, a part from product
densities that explore (near corners, near edges, and in the middle of the box, where a region of several parameters
must reach if it touches no edge), and a part around what failed or came near to it (a kernel density, as in Zhang 1996
and in the cross-entropy method). A mission counts with 1 / density; no weight is above `most_weight`, and given all
before it each has the failure rate as its mean. docs/study.md has what this finds, and the bound on any sampler.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from checker.sampling.sampler import RANDOM_POINT, MissionRole, SamplePoint, Setting, Trial

_UNIFORM = 0.35  # kept elsewhere
_SOUGHT = 0.30  # where distress is followed; 0.10 once something has failed
_GENERATION = 20
_FINEST, _NEAR = 1e-4, 0.1  # least and greatest distance from an edge
_ELITE = 0.1  # of the missions that did not fail, those in most distress
_MOST_KERNELS = 60


@dataclass(frozen=True, slots=True)
class _ProductMixture:
    """Product densities: each axis alone lies between margin and 1 - margin with chance `inner`, else near an end.

    The distance from the end is log-uniform between `_FINEST` and `_NEAR`. One row per product; `share` is that of the
    missions that explore.
    """

    inner: np.ndarray
    margin: np.ndarray
    share: np.ndarray

    def draw(self, generator: np.random.Generator, count: int, axes: int) -> np.ndarray:
        """Points, one per row."""
        product = generator.choice(len(self.share), size=count, p=self.share)
        inner, margin = self.inner[product, None], self.margin[product, None]
        place, side, distance, which = generator.random((4, count, axes))
        distance = _FINEST * (_NEAR / _FINEST) ** distance
        near = np.where(side < 0.5, distance, 1.0 - distance)
        return np.asarray(np.where(which < inner, margin + (1.0 - 2.0 * margin) * place, near))

    def density(self, rows: np.ndarray) -> np.ndarray:
        """At each row."""
        distance = np.minimum(rows, 1.0 - rows)
        is_near = (distance >= _FINEST) & (distance <= _NEAR)
        near = np.where(is_near, 0.5 / (np.maximum(distance, _FINEST) * np.log(_NEAR / _FINEST)), 0.0)
        inner, margin = self.inner[:, None, None], self.margin[:, None, None]
        middle = np.where(distance >= margin, inner / (1.0 - 2.0 * margin), 0.0)
        return np.asarray(self.share @ (middle + (1.0 - inner) * near).prod(axis=2))


# Corners; edges and what lies between them, all of it and the better part; the middle.
EXPLORING = _ProductMixture(
    inner=np.array([0.0, 0.5, 0.5, 1.0, 1.0]),
    margin=np.array([0.0, 0.0, 0.15, 0.2, 0.3]),
    share=np.array([0.06, 0.40, 0.38, 0.05, 0.11]),
)


@dataclass(frozen=True, slots=True)
class _Kernels:
    """Boxes of a width per axis around centres, each folded at the edges of the box, so that no mass is lost."""

    centres: np.ndarray
    widths: np.ndarray

    def draw(self, generator: np.random.Generator, count: int) -> np.ndarray:
        """Points, one per row."""
        centres = self.centres[generator.integers(len(self.centres), size=count)]
        shares = np.abs(centres + (2.0 * generator.random(centres.shape) - 1.0) * self.widths)
        return np.asarray(np.where(shares > 1.0, 2.0 - shares, shares))

    def density(self, rows: np.ndarray) -> np.ndarray:
        """Of the folded boxes, at each row: a share is reached directly, and by reflection at 0 and at 1."""
        total = np.zeros((len(rows), *self.centres.shape))
        for image in (rows, -rows, 2.0 - rows):
            total += np.abs(image[:, None, :] - self.centres) <= self.widths
        return np.asarray((total / (2.0 * self.widths)).prod(axis=2).mean(axis=1))


class Adaptive:
    """Samples where missions fail, or nearly do; see the head of this file."""

    most_weight = 1.0 / _UNIFORM

    def __init__(self, setting: Setting) -> None:
        self._setting = setting

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """One generation: the first, and missions without axes, are plain random ones of weight 1."""
        setting = self._setting
        count = min(count, _GENERATION)
        if not setting.axes:
            return [RANDOM_POINT] * count
        generator = setting.generator("adaptive", len(trials))
        kernels = _kernels_of(trials, len(setting.axes))
        has_failed = any(trial.failed for trial in trials)
        exploring = 0.0 if not trials else 0.10 if has_failed else _SOUGHT
        local = 0.0 if kernels is None else 1.0 - _UNIFORM - exploring
        if kernels is None and exploring:
            exploring = 1.0 - _UNIFORM
        component = generator.random(count)
        rows = generator.random((count, len(setting.axes)))
        rows = np.where((component < local + exploring)[:, None], EXPLORING.draw(generator, *rows.shape), rows)
        if kernels is not None:
            rows = np.where((component < local)[:, None], kernels.draw(generator, count), rows)
        density = 1.0 - local - exploring + exploring * EXPLORING.density(rows)
        if kernels is not None:
            density += local * kernels.density(rows)
        return [
            setting.point(row, MissionRole.WEIGHTED, 1.0 / float(at)) for row, at in zip(rows, density, strict=True)
        ]


def _kernels_of(trials: Sequence[Trial], axes: int) -> _Kernels | None:
    """Boxes around what failed; while nothing has, around the missions in most distress. None: nothing stands out."""
    placed = [trial for trial in trials if len(trial.point.shares) == axes and trial.failed is not None]
    failing = [trial for trial in placed if trial.failed]
    chosen = failing
    if not chosen:
        worst = sorted((trial.distress for trial in placed), reverse=True)
        level = worst[int(len(worst) * _ELITE)] if worst else 0.0
        calm = worst[len(worst) // 2] if worst else 0.0
        chosen = [trial for trial in placed if trial.distress >= level > calm]
    if not chosen:
        return None
    chosen = chosen[-_MOST_KERNELS:]
    centres = np.array([[share for _, share in trial.point.shares] for trial in chosen])
    others = np.array([[share for _, share in trial.point.shares] for trial in placed if not trial.failed])
    return _Kernels(centres, _widths(centres, others.reshape(-1, axes)))


def _widths(centres: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Per axis a few times the gap between neighbouring centres: narrow where these lie close together.

    An axis along which the centres lie as evenly as all missions do has nothing to do with failing: it is drawn whole.
    """
    count = len(centres)
    if count < 3:
        return np.full(centres.shape[1], 0.15)
    widths = np.empty(centres.shape[1])
    for axis in range(centres.shape[1]):
        values = np.sort(centres[:, axis])
        steps = np.arange(1, count + 1) / count
        gap = max(np.abs(values - steps).max(), np.abs(values - steps + 1.0 / count).max())
        is_even = gap * np.sqrt(count) < 1.36  # Kolmogorov's bound at 5 %
        spacing = np.median(np.diff(values)) if count > 1 else 0.5
        widths[axis] = 1.0 if is_even and count >= 8 else min(0.5, max(0.01, 4.0 * float(spacing), 0.5 * count**-0.8))
    return widths
