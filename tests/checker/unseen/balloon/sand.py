"""How much sand a climb costs."""

from math import inf

from runtime.user.constraint import function

PER_METRE = 0.1  # kilograms a metre


def sand_for(metres: float) -> float:
    """A tenth of a kilogram for each metre, and two to get going."""
    return 2.0 + PER_METRE * metres


CONSTRAINTS = [function("sand_for", "metres:number", "float", sand_for, "the ballast that a climb takes")]
