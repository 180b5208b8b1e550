"""How much may be tried to find causes: flights and seconds."""

from collections.abc import Callable
from dataclasses import dataclass, field

MOST_FLIGHTS = 40
MOST_SECONDS = 60.0


@dataclass(frozen=True, slots=True)
class Bounds:
    """How much may be tried; `is_cancelled` is asked before each flight."""

    flights: int = MOST_FLIGHTS
    seconds: float = MOST_SECONDS
    is_cancelled: Callable[[], bool] = field(default=lambda: False)
