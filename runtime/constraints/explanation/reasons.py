"""Say which bounds a support read when it narrowed a bound: the step of every walk back along supports."""

from runtime.constraints.domains.arrays import grow_rows
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    KIND_BOOL,
    KIND_FLOAT,
    MODE_DISTANCE,
    SIDE_HOLES,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_CONSTRAINT,
    SUPPORT_EDGE,
)
from runtime.constraints.propagators.registry import READS, READS_OWN
from runtime.constraints.propagators.row import (
    OWN_ALWAYS,
    OWN_AT_ONE,
    READS_ALL,
    READS_DISTANCE,
    READS_SAME_SIDE,
    READS_SUM_LAST,
)


def collect_reasons(s: Store, support: int, v: int, side: int) -> None:
    """Put the keys `u * 4 + side` that `support` read for this side of `v` into `reasons`.

    More than it truly read does no harm: explanations are shrunk afterwards, retraction relaxes a little more.
    """
    s.reason_count = 0
    kind = support & 3
    if support < 0 or kind > SUPPORT_CONSTRAINT:
        return
    if kind == SUPPORT_EDGE:
        if side == SIDE_UPPER:
            _add_reason(s, s.edge_source[support >> 2], SIDE_UPPER)
        else:
            _add_reason(s, s.edge_target[support >> 2], SIDE_LOWER)
        _collect_weight(s, support >> 2)
        return
    c = support >> 2
    first = s.first[c]
    last = first + s.arity[c]
    reads = READS[s.op[c]]
    if reads == READS_DISTANCE:
        _add_reason(s, s.slot_variable[first + 2], side)
        _add_reason(s, s.slot_variable[first], 1 - side)
    elif reads == READS_ALL or side == SIDE_HOLES:
        _collect_all(s, c, v, side)
    elif reads == READS_SAME_SIDE:
        for k in range(first, last):
            if s.slot_variable[k] != v:
                _add_reason(s, s.slot_variable[k], side)
    elif reads == READS_SUM_LAST:
        _collect_sum(s, v, side, s.slot_variable[last - 1], first, last - 1)
    else:
        _collect_sum(s, v, side, s.slot_variable[first], first + 1, last)


def _add_reason(s: Store, v: int, side: int) -> None:
    """Put one bound among the reasons; constants need none."""
    if s.constant[v]:
        return
    if s.reason_count == len(s.reasons):
        grow_rows(s, "reasons", 2 * len(s.reasons))
    s.reasons[s.reason_count] = v * 4 + side
    s.reason_count += 1


def collect_weight_reasons(s: Store, e: int) -> None:
    """Put into `reasons`, alone, the bound that the weight of an edge follows, if it does."""
    s.reason_count = 0
    _collect_weight(s, e)


def collect_all_reasons(s: Store, c: int) -> None:
    """Put into `reasons`, alone, every bound of all arguments of a constraint."""
    s.reason_count = 0
    _collect_all(s, c, -1, SIDE_HOLES)


def _collect_weight(s: Store, e: int) -> None:
    """Put the bound of the distance that the weight of an edge follows, if it does."""
    c = s.edge_link[e]
    if c >= 0 and s.mode[c] == MODE_DISTANCE:
        _add_reason(s, s.slot_variable[s.first[c] + 1], SIDE_UPPER if e == s.link_a[c] else SIDE_LOWER)


def _collect_sum(s: Store, v: int, side: int, total: int, first: int, last: int) -> None:
    """Put what a sum read for its total, or for one of its terms; a variable may stand on both sides."""
    is_term = False
    for k in range(first, last):
        if s.slot_variable[k] == v:
            is_term = True
        if v == total:
            _add_reason(s, s.slot_variable[k], side)
    if is_term:
        _add_reason(s, total, side)
        for k in range(first, last):
            if s.slot_variable[k] != v:
                _add_reason(s, s.slot_variable[k], 1 - side)


def _collect_all(s: Store, c: int, v: int, side: int) -> None:
    """Put every bound of all arguments but `v`, which may be -1, and those of `v` where the operation reads them."""
    first = s.first[c]
    for k in range(first, first + s.arity[c]):
        u = s.slot_variable[k]
        if u != v:
            _add_reason(s, u, SIDE_LOWER)
            _add_reason(s, u, SIDE_UPPER)
            if s.word[u] >= 0:
                _add_reason(s, u, SIDE_HOLES)
    if v >= 0 and _reads_itself(s, s.op[c], v, side):
        _add_reason(s, v, SIDE_LOWER)
        _add_reason(s, v, SIDE_UPPER)


def _reads_itself(s: Store, op: int, v: int, side: int) -> bool:
    """Tell whether an operation narrows `v` from where it stands: a value at the end is taken, a branch is chosen."""
    if s.kind[v] == KIND_BOOL:
        return False
    if READS_OWN[op] == OWN_AT_ONE:
        # A factor of what is not 0 is not 0: its bound steps from 0 to 1 or -1.
        return s.kind[v] != KIND_FLOAT and (s.lb[v] == 1 if side == SIDE_LOWER else s.ub[v] == -1)
    return READS_OWN[op] == OWN_ALWAYS
