"""Let a constraint rest while a search goes on, where others say all that it says: nothing wakes it."""

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import MODE_DISTANCE, TRAIL_REST


def rest(s: Store, c: int) -> None:
    """Take a constraint off the lists of its variables until the search goes back, or is over.

    Its slots keep their neighbours: going back visits changes in reverse order, so that they fit again.
    """
    if s.marks == 0 or s.aux[c]:
        return
    s.aux[c] = 1
    s.resting += 1
    for slot in range(s.first[c], s.first[c] + s.arity[c]):
        after = s.slot_next[slot]
        if after != -2:
            before = s.slot_prev[slot]
            if before >= 0:
                s.slot_next[before] = after
            else:
                s.watch_head[s.slot_variable[slot]] = after
            if after >= 0:
                s.slot_prev[after] = before
    s.save(c, TRAIL_REST, 0, 0)


def relink(s: Store, c: int) -> None:
    """Put a constraint back where `rest` took it from."""
    s.aux[c] = 0
    s.resting -= 1
    slot = s.first[c] + s.arity[c]
    while slot > s.first[c]:
        slot -= 1
        after = s.slot_next[slot]
        if after != -2:
            before = s.slot_prev[slot]
            if before >= 0:
                s.slot_next[before] = slot
            else:
                s.watch_head[s.slot_variable[slot]] = slot
            if after >= 0:
                s.slot_prev[after] = slot


def waken(s: Store, c: int) -> None:
    """Put a constraint at the head of the lists of its variables, which have others since `rest` took it from them."""
    s.aux[c] = 0
    s.resting -= 1
    for slot in range(s.first[c], s.first[c] + s.arity[c]):
        if s.slot_next[slot] != -2:
            v = s.slot_variable[slot]
            after = s.watch_head[v]
            s.watch_head[v] = slot
            s.slot_prev[slot] = -1
            s.slot_next[slot] = after
            if after >= 0:
                s.slot_prev[after] = slot


def rest_distance(s: Store, distance: int) -> None:
    """Let the constraint rest that ties a token's duration to its times: they all equal those of another token."""
    slot = s.watch_head[distance]
    while slot >= 0:
        c = s.slot_constraint[slot]
        if s.mode[c] == MODE_DISTANCE and s.slot_variable[s.first[c]] == distance + 1:
            rest(s, c)
            return
        slot = s.slot_next[slot]
