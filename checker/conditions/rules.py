"""Rule induction: labelled missions and literals in, the fewest short conjunctions that cover the failing ones out.

Sequential covering with a beam search over conjunctions (CN2: Clark and Niblett, 1989).
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from checker.conditions.condition import Conjunction, Feature, Literal, Row
from checker.conditions.flights import Ended
from checker.simplest import shortest_decimal

_BEAM = 16
_MOST_LITERALS = 6
_MOST_CONJUNCTIONS = 4
_PRICE = 0.01  # of a literal, in shares of the missions covered
_LEAST_GAIN = 0.04  # a further conjunction must cover so much of the failing missions
_Mask = NDArray[np.bool_]


def induce(rows: Sequence[tuple[Row, Ended]], edges: Sequence[Literal]) -> tuple[Conjunction, ...]:
    """The conjunctions that cover failing missions and few passing ones; none where no literal tells them apart."""
    counted = [(row, label) for row, label in rows if label is not Ended.OTHER]
    literals = list(dict.fromkeys(one for edge in edges for one in (edge, edge.negation)))
    if not literals or not counted:
        return ()
    truth = np.array([[literal.holds(row) for row, _ in counted] for literal in literals])
    fails = np.array([label is Ended.FAILS for _, label in counted])
    left, total = fails.copy(), int(fails.sum())
    found: list[Conjunction] = []
    while left.any() and len(found) < _MOST_CONJUNCTIONS:
        chosen = _conjunction(truth, left, ~fails)
        if not chosen:
            break
        covered = truth[list(chosen)].all(axis=0)
        if (covered & left).sum() < _LEAST_GAIN * total:
            break
        found.append(tuple(literals[number] for number in sorted(chosen)))
        left &= ~covered
    return tuple(found)


def _conjunction(truth: _Mask, positive: _Mask, negative: _Mask) -> tuple[int, ...]:
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
                    grown[key] = _worth(inside & truth[number], positive, negative, len(key))
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


def _worth(covered: _Mask, positive: _Mask, negative: _Mask, size: int) -> tuple[float, float]:
    """How promising a conjunction is while it grows, and how good it is as it stands (not above 0: no good)."""
    hits, misses = int((covered & positive).sum()), int((covered & negative).sum())
    if not hits:
        return -1.0, -1.0
    recall, fallout = hits / int(positive.sum()), misses / max(int(negative.sum()), 1)
    impurity = misses / (hits + misses)
    return recall - fallout - _PRICE * size, recall - 2.0 * impurity - _PRICE * size


def sample_cuts(rows: Sequence[tuple[Row, Ended]], features: Sequence[Feature]) -> list[Literal]:
    """The best cut of each feature between failing and passing samples. O(n log n) each."""
    cuts: list[Literal] = []
    for feature in features:
        marked = sorted((feature.value(row), label is Ended.FAILS) for row, label in rows if label is not Ended.OTHER)
        fails = sum(is_failing for _, is_failing in marked)
        best = (0.0, 0.0, True)
        failed = passed = 0
        for (value, is_failing), (after, _) in pairwise(marked):
            failed, passed = failed + is_failing, passed + (not is_failing)
            if value == after or not 0 < fails < len(marked):
                continue
            lean = failed / fails - passed / (len(marked) - fails)
            if abs(lean) > best[0]:
                best = (abs(lean), shortest_decimal(value, after), lean < 0.0)
        if best[0] > 0.0:
            cuts.append(Literal(feature, best[2], best[1]))
    return cuts
