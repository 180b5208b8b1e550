"""The sky over the telescope: when a source is up, and how far the dish has to turn."""

from math import inf

from runtime.user.constraint import Constraint, View, function

RISES = {1: (20, 330), 2: (300, 640), 3: (600, 1000)}


class Up(Constraint):
    """`time` lies between rise and set of `source`."""

    name = "is_up"
    signature = "time:number source:number"
    meaning = "at this time the source is above the horizon"

    def propagate(self, view: View) -> bool:
        """Bound the time once the source is known."""
        if not view.is_single(1):
            return True
        rise, set_ = RISES.get(int(view.value(1)), (inf, -inf))
        if rise > set_:
            return view.fail()
        return view.raise_to(0, rise) and view.reduce_to(0, set_)


CONSTRAINTS = [
    Up(),
    function("azimuth_of", "source:number", "float", lambda source: 40.0 * source - 10.0, "where the source stands"),
]
