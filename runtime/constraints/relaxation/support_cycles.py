"""Cycles among supports: bounds whose supports lead back to themselves instead of to restrictions."""

from runtime.constraints.domains.arrays import grow_rows
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_RESTRICTION
from runtime.constraints.explanation.reasons import collect_reasons

_ON_PATH = 1  # colours of the walk, beside the number of the retraction
_DONE = 2


def is_self_supporting(s: Store, v: int, side: int) -> bool:
    """Tell whether the supports of a bound lead into a cycle. Each bound is walked over once per retraction.

    Depth-first search with an explicit stack: `visit` holds the number of the retraction and a colour; a bound that is
    met on the path again closes a cycle. It stays on the path then, so that all who lead to it see a cycle.
    """
    start = v * 4 + side
    colour = s.visit[start] - 4 * s.visits_begun
    if colour == _DONE or colour == _ON_PATH:
        return colour == _ON_PATH
    depth = 0
    _push(s, depth, start)
    while depth >= 0:
        key = s.support_stack[depth]
        if key < 0:
            # All that supports it was walked over without a cycle.
            s.visit[-1 - key] = 4 * s.visits_begun + _DONE
            depth -= 1
            continue
        colour = s.visit[key] - 4 * s.visits_begun
        if colour == _DONE:
            depth -= 1
            continue
        if colour == _ON_PATH:
            return True
        s.visit[key] = 4 * s.visits_begun + _ON_PATH
        s.support_stack[depth] = -1 - key
        depth = _push_supports(s, depth, key >> 2, key & 3)
    return False


def _push(s: Store, depth: int, key: int) -> None:
    """Put a bound on the stack."""
    if depth >= len(s.support_stack):
        grow_rows(s, "support_stack", 2 * len(s.support_stack))
    s.support_stack[depth] = key


def _push_supports(s: Store, depth: int, v: int, side: int) -> int:
    """Put what supports a bound on the stack; a variable with a bit set hangs on all of its own supports."""
    if s.constant[v]:
        return depth
    if side != SIDE_UPPER:
        depth = _push_reasons(s, depth, s.lower_support[v], v, SIDE_LOWER)
    if side != SIDE_LOWER:
        depth = _push_reasons(s, depth, s.upper_support[v], v, SIDE_UPPER)
    if s.word[v] >= 0:
        entry = s.hole_head[v]
        while entry >= 0:
            depth = _push_reasons(s, depth, s.hole_support[entry], v, SIDE_HOLES)
            entry = s.hole_next[entry]
    return depth


def _push_reasons(s: Store, depth: int, support: int, v: int, side: int) -> int:
    """Put what one support read on the stack."""
    if support & 3 == SUPPORT_RESTRICTION or support < 0:
        return depth
    collect_reasons(s, support, v, side)
    for i in range(s.reason_count):
        depth += 1
        _push(s, depth, s.reasons[i])
    return depth
