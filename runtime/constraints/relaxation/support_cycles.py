"""Find bounds that hold themselves up: whose supports lead in a circle instead of back to restrictions."""

from runtime.constraints.domains.arrays import grown
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_RESTRICTION
from runtime.constraints.explanation.reasons import collect_reasons

ON_PATH = 1  # colours of the walk, beside the number of the retraction
DONE = 2


def holds_itself(s: Store, v: int, side: int) -> bool:
    """Tell whether the supports of a bound lead into a circle. Each bound is walked over once per retraction.

    A depth-first walk with an explicit stack: `visit` holds the number of the walk and a colour; a bound that is on
    the path again closes a circle. A bound below which a circle was found stays on the path, so that all who lead to
    it see one.
    """
    start = v * 4 + side
    colour = s.visit[start] - 4 * s.visits_begun
    if colour == DONE:
        return False
    if colour == ON_PATH:
        return True
    depth = 0
    push(s, depth, start)
    while depth >= 0:
        key = s.walk[depth]
        if key < 0:
            # All that supports it was walked over without a circle.
            s.visit[-1 - key] = 4 * s.visits_begun + DONE
            depth -= 1
            continue
        colour = s.visit[key] - 4 * s.visits_begun
        if colour == DONE:
            depth -= 1
            continue
        if colour == ON_PATH:
            return True
        s.visit[key] = 4 * s.visits_begun + ON_PATH
        s.walk[depth] = -1 - key
        depth = push_supports(s, depth, key >> 2, key & 3)
    return False


def push(s: Store, depth: int, key: int) -> None:
    """Put a bound on the stack of the walk."""
    if depth >= len(s.walk):
        s.walk = grown(s.walk, 2 * len(s.walk))
    s.walk[depth] = key


def push_supports(s: Store, depth: int, v: int, side: int) -> int:
    """Put what supports a bound on the stack; a variable with a bit set hangs on all of its own supports."""
    if s.constant[v]:
        return depth
    if side != SIDE_UPPER:
        depth = push_reasons(s, depth, s.lower_support[v], v, SIDE_LOWER)
    if side != SIDE_LOWER:
        depth = push_reasons(s, depth, s.upper_support[v], v, SIDE_UPPER)
    if s.word[v] >= 0:
        entry = s.hole_head[v]
        while entry >= 0:
            depth = push_reasons(s, depth, s.hole_support[entry], v, SIDE_HOLES)
            entry = s.hole_next[entry]
    return depth


def push_reasons(s: Store, depth: int, support: int, v: int, side: int) -> int:
    """Put what one support read on the stack."""
    if support & 3 == SUPPORT_RESTRICTION or support < 0:
        return depth
    collect_reasons(s, support, v, side)
    for i in range(s.reason_count):
        depth += 1
        push(s, depth, s.reasons[i])
    return depth
