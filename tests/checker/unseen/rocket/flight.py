"""Where a sounding rocket comes down: the range is what the elevation and the payload make of it."""

from math import inf

from runtime.user.constraint import Constraint, View, function


class InsideRange(Constraint):
    """impact + margin <= limit."""

    name = "inside_range"
    signature = "impact:number margin:number limit:number"
    meaning = "the rocket comes down so far inside the limit"

    def propagate(self, view: View) -> bool:
        """Bound each by the others."""
        impact, margin, limit = view.lower(0), view.lower(1), view.upper(2)
        if impact > -inf and margin > -inf and not view.raise_to(2, impact + margin):
            return False
        if limit < inf and margin > -inf and not view.reduce_to(0, limit - margin):
            return False
        return not (limit < inf and impact > -inf) or view.reduce_to(1, limit - impact)


CONSTRAINTS = [
    InsideRange(),
    function(
        "impact_km",
        "elevation:number payload:number",
        "float",
        lambda elevation, payload: (90 - elevation) * 6.0 - 0.1 * payload,
        "where it comes down",
    ),
]
