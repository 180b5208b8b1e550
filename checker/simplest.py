"""Two numbers in, the simplest number between them out: what a person would write for an edge."""

from fractions import Fraction


def simplest_between(lower: Fraction, upper: Fraction) -> Fraction:
    """The fraction of least denominator in [lower, upper] (descent in the Stern-Brocot tree)."""
    if lower > upper:
        lower, upper = upper, lower
    if lower <= 0 <= upper:
        return Fraction(0)
    if upper < 0:
        return -simplest_between(-upper, -lower)
    whole = lower.numerator // lower.denominator
    if whole == lower:
        return Fraction(whole)
    if whole + 1 <= upper:
        return Fraction(whole + 1)
    return whole + 1 / simplest_between(1 / (upper - whole), 1 / (lower - whole))


def shortest_decimal(lower: float, upper: float) -> float:
    """The number of fewest decimals in [lower, upper]; of several, the one nearest to the middle."""
    low, high = Fraction(lower), Fraction(upper)
    for digits in range(16):
        scale = 10**digits
        first = -((-low.numerator * scale) // low.denominator)
        last = (high.numerator * scale) // high.denominator
        if first <= last:
            middle = round((low + high) / 2 * scale)
            return float(Fraction(min(max(middle, first), last), scale))
    return upper
