"""The satellite receiver: how many hits it collects, and in what time."""

from collections.abc import Sequence
from math import ceil

from runtime.user.constraint import Constraint, Value, near


class Collects(Constraint):
    """In `need` ticks there is time for `hits` hits of `rate` seconds each."""

    name = "collects"
    signature = "need:number hits:number rate:number"
    meaning = "in so many ticks the receiver collects so many hits"

    def holds(self, values: Sequence[Value]) -> bool:
        """The hits that the time is worth are those that were asked for, but for rounding."""
        need, hits, rate = values
        assert not isinstance(need, str) and not isinstance(hits, str) and not isinstance(rate, str)
        span = rate * hits
        return ceil(span) <= need and near(span / rate, hits)


CONSTRAINTS = [Collects()]
