"""Rule induction: labelled missions and literals in, the fewest short conjunctions that cover the failing ones out.

Sequential covering with a beam search over conjunctions (CN2: Clark and Niblett, 1989).
"""

from collections.abc import Container, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from checker.conditions.condition import Conjunction, Feature, Literal, Row
from checker.conditions.flights import Ended
from checker.simplest import shortest_decimal

_BEAM = 16
_MOST_LITERALS = 6
_MOST_CONJUNCTIONS = 4
_PRICE = 0.01  # of a literal of one parameter, in shares of the missions covered
_SUM_PRICE = 0.005  # more, of a sum: its weights are numbers too
_LEAST_GAIN = 0.04  # a further conjunction must cover so much of the failing missions
_CHOSEN = 0.02  # weight of a flight at a chosen point
_Mask = NDArray[np.bool_]
_Weights = NDArray[np.float64]


def induce(
    rows: Sequence[tuple[Row, Ended]], edges: Sequence[Literal], flown: Sequence[tuple[Row, Ended]] = ()
) -> tuple[Conjunction, ...]:
    """The conjunctions that cover failing missions and few passing ones; none where no literal tells them apart.

    `rows` are missions as they come; those `flown` at chosen points count for less: most of them lie at an edge.
    """
    counted = [(row, label) for row, label in (*rows, *flown) if label is not Ended.OTHER]
    ordinary = sum(label is not Ended.OTHER for _, label in rows)
    weights = np.array([1.0 if number < ordinary else _CHOSEN for number in range(len(counted))])
    literals = list(dict.fromkeys(one for edge in edges for one in (edge, edge.negation)))
    if not literals or not counted:
        return ()
    prices = np.array([_price(literal) for literal in literals])
    truth = np.array([[literal.holds(row) for row, _ in counted] for literal in literals])
    fails = np.array([label is Ended.FAILS for _, label in counted])
    left, total = weights * fails, float(weights[fails].sum())
    found: list[Conjunction] = []
    while left.sum() > 0.0 and len(found) < _MOST_CONJUNCTIONS:
        chosen = _conjunction(truth, prices, left, weights * ~fails)
        if not chosen:
            break
        covered = truth[list(chosen)].all(axis=0)
        if left[covered].sum() < _LEAST_GAIN * total:
            break
        found.append(tuple(literals[number] for number in sorted(chosen)))
        left = np.where(covered, 0.0, left)
    return tuple(found)


def _price(literal: Literal) -> float:
    """What a literal has to be worth: as much as limits of the parameters that it speaks of, a sum a little more."""
    return _PRICE * len(literal.feature.parameters) + _SUM_PRICE * (len(literal.feature.monomials) > 1)


def _conjunction(truth: _Mask, prices: _Weights, positive: _Weights, negative: _Weights) -> tuple[int, ...]:
    """The best conjunction of literals by number."""
    best: tuple[float, tuple[int, ...]] = (0.0, ())
    beam: list[tuple[int, ...]] = [()]
    for _ in range(_MOST_LITERALS):
        grown: dict[tuple[int, ...], tuple[float, float]] = {}
        for state in beam:
            inside = truth[list(state)].all(axis=0) if state else np.ones(truth.shape[1], dtype=bool)
            for number in range(len(truth)):
                if number in state:
                    continue
                key = tuple(sorted((*state, number)))
                if key not in grown:
                    grown[key] = _worth(inside & truth[number], positive, negative, float(prices[list(key)].sum()))
        if not grown:
            break
        ranked = sorted(grown.items(), key=lambda one: (-one[1][0], one[0]))
        beam = [key for key, _ in ranked[:_BEAM]]
        final = min(grown.items(), key=lambda one: (-one[1][1], one[0]))
        if final[1][1] <= best[0] + 1e-12:
            if best[1]:
                break
            continue
        best = (final[1][1], final[0])
    return best[1]


def _worth(covered: _Mask, positive: _Weights, negative: _Weights, price: float) -> tuple[float, float]:
    """How promising a conjunction is while it grows, and how good it is as it stands (not above 0: no good)."""
    hits, misses = float(positive[covered].sum()), float(negative[covered].sum())
    if hits <= 0.0:
        return -1.0, -1.0
    recall, fallout = hits / float(positive.sum()), misses / max(float(negative.sum()), 1e-9)
    impurity = misses / (hits + misses)
    return recall - fallout - price, recall - 2.0 * impurity - price


def sample_cuts(
    rows: Sequence[tuple[Row, Ended]], features: Sequence[Feature], stepped: Container[str] = ()
) -> list[Literal]:
    """The best cut of each feature between failing and passing samples. O(n log n) each.

    Of parameters that are `stepped` it is at a value that was seen: what no mission had may be on either side.
    """
    cuts: list[Literal] = []
    for feature in features:
        marked = sorted((feature.value(row), label is Ended.FAILS) for row, label in rows if label is not Ended.OTHER)
        fails = sum(is_failing for _, is_failing in marked)
        best = (0.0, 0.0, True)
        is_stepped = all(name in stepped for name in feature.parameters)
        failed = passed = 0
        for (value, is_failing), (after, _) in pairwise(marked):
            failed, passed = failed + is_failing, passed + (not is_failing)
            if value == after or not 0 < fails < len(marked):
                continue
            lean = failed / fails - passed / (len(marked) - fails)
            if abs(lean) > best[0]:
                is_above = lean < 0.0
                seen = after if is_above else value
                edge = seen if is_stepped else shortest_decimal(value, after)
                best = (abs(lean), edge, is_above)
        if best[0] > 0.0:
            cuts.append(Literal(feature, best[2], best[1], holds_at_edge=is_stepped))
    return cuts
