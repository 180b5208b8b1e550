"""Round numbers along an axis: the bounds of what is drawn in, ticks out."""

from math import ceil, floor, inf, log10

_FACTORS = (1, 2, 5)


def _round_step(least: float) -> float:
    """The smallest of 1, 2 or 5 times a power of ten that is no less than `least`."""
    if not 0.0 < least < inf:
        return 1.0
    power = 10.0 ** floor(log10(least))
    return next((factor * power for factor in _FACTORS if factor * power >= least * 0.999), 10.0 * power)


def whole_ticks(first: int, last: int, least: float) -> range:
    """Multiples of a round number from `first` to `last`, at least `least` and 1 apart."""
    step = max(1, int(_round_step(least)))
    return range(-(-first // step) * step, last + 1, step)


def ticks(lower: float, upper: float, least: float) -> list[float]:
    """Multiples of a round number from `lower` to `upper`, at least `least` apart."""
    step = _round_step(least)
    first, last = ceil(lower / step - 1e-9), floor(upper / step + 1e-9)
    return [round(count * step, 12) for count in range(first, last + 1)]
