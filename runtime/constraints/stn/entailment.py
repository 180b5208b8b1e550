"""Entailment: take a constraint that others imply off the watch lists until backtracking."""

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import MODE_DISTANCE, TRAIL_ENTAILED
from runtime.constraints.stn.watch_lists import link_slot, restore_slot, unlink_slot


def entail(s: Store, c: int) -> None:
    """Take an entailed constraint off its watch lists until the search goes back, or is kept; not at level 0."""
    if s.marks and not s.entailed[c]:
        s.entailed[c] = 1
        s.entailed_count += 1
        for slot in range(s.first[c], s.first[c] + s.arity[c]):
            unlink_slot(s, slot)
        s.save(c, TRAIL_ENTAILED, 0, 0)


def entail_distance(s: Store, distance: int) -> None:
    """Entail the constraint that ties a token's duration to its times: they all equal those of another token."""
    slot = s.watch_head[distance]
    while slot >= 0:
        c = s.slot_constraint[slot]
        if s.mode[c] == MODE_DISTANCE and s.slot_variable[s.first[c]] == distance + 1:
            entail(s, c)
            break
        slot = s.slot_next[slot]


def undo_entailment(s: Store, c: int) -> None:
    """Put a constraint back where `entail` took it from, when the search goes back."""
    s.entailed[c] = 0
    s.entailed_count -= 1
    slot = s.first[c] + s.arity[c]
    while slot > s.first[c]:
        slot -= 1
        restore_slot(s, slot)


def revive(s: Store, c: int) -> None:
    """Put a constraint at the head of its watch lists, when the search is kept: these have grown meanwhile."""
    s.entailed[c] = 0
    s.entailed_count -= 1
    for slot in range(s.first[c], s.first[c] + s.arity[c]):
        link_slot(s, slot)
