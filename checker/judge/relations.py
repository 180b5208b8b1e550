"""What each temporal relation demands of two tokens, from the definitions of the language (`origin NAME target`)."""

from math import inf

from checker.judge.values import ENDLESS

# Times of the origin and of the target; a demand is: lower <= second - first <= upper.
OS, OE, _TS, TE = range(4)
Demand = tuple[int, int, float, float]


def _same(first: int, second: int) -> Demand:
    return (first, second, 0, 0)


def _not_after(first: int, second: int) -> Demand:
    return (first, second, 0, inf)


def _earlier(first: int, second: int) -> Demand:
    return (first, second, 1, inf)


DEMANDS: dict[str, tuple[Demand, ...]] = {
    "any": (),
    "before": (_not_after(OE, _TS),),
    "after": (_not_after(TE, OS),),
    "meets": (_same(OE, _TS),),
    "met_by": (_same(TE, OS),),
    "starts": (_same(OS, _TS),),
    "ends": (_same(OE, TE),),
    "equals": (_same(OS, _TS), _same(OE, TE)),
    "contains": (_not_after(OS, _TS), _not_after(TE, OE)),
    "contained_by": (_not_after(_TS, OS), _not_after(OE, TE)),
    "parallels": (_not_after(OS, _TS), _not_after(OE, TE)),
    "paralleled_by": (_not_after(_TS, OS), _not_after(TE, OE)),
    "starts_before": (_earlier(OS, _TS),),
    "starts_after": (_earlier(_TS, OS),),
    "starts_before_end": (_earlier(OS, TE),),
    "starts_during": (_not_after(_TS, OS), _earlier(OS, TE)),
    "ends_before": (_earlier(OE, TE),),
    "ends_after": (_earlier(TE, OE),),
    "ends_after_start": (_earlier(_TS, OE),),
    "ends_during": (_earlier(_TS, OE), _not_after(OE, TE)),
    "contains_start": (_not_after(OS, _TS), _earlier(_TS, OE)),
    "contains_end": (_earlier(OS, TE), _not_after(TE, OE)),
}


def demands(relation: str, bounds: tuple[tuple[int, int], ...]) -> tuple[Demand, ...]:
    """The demands of a relation, with the bounds that were written behind it in place of its own."""
    found = []
    for k, (first, second, lower, upper) in enumerate(DEMANDS[relation]):
        if k < len(bounds):
            lower, upper = bounds[k]
        found.append((first, second, -inf if lower <= -ENDLESS else lower, inf if upper >= ENDLESS else upper))
    return tuple(found)
