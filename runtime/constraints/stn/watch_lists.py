"""Watch lists: doubly linked lists of the argument slots of each variable; slots without events are mute."""

from runtime.constraints.domains.store import Store


def link_slot(s: Store, slot: int) -> None:
    """Put a slot at the head of its list; constants have none."""
    v = s.slot_variable[slot]
    s.slot_prev[slot] = -1
    s.slot_next[slot] = -2 if s.constant[v] else s.watch_head[v] if s.slot_mask[slot] else s.mute_head[v]
    restore_slot(s, slot)


def unlink_slot(s: Store, slot: int) -> None:
    """Take a slot off its list; it keeps its neighbours."""
    after = s.slot_next[slot]
    if after != -2:
        _follow_up(s, slot, after)
        if after >= 0:
            s.slot_prev[after] = s.slot_prev[slot]


def restore_slot(s: Store, slot: int) -> None:
    """Put a slot between its neighbours: in reverse order of all changes they fit again (Knuth 2000, dancing links)."""
    after = s.slot_next[slot]
    if after != -2:
        _follow_up(s, slot, slot)
        if after >= 0:
            s.slot_prev[after] = slot


def watchers_of(s: Store, v: int) -> list[int]:
    """List the constraints on the lists of a variable, each as often as it stands there."""
    found = []
    for head in (s.watch_head[v], s.mute_head[v]):
        slot = head
        while slot >= 0:
            found.append(s.slot_constraint[slot])
            slot = s.slot_next[slot]
    return found


def _follow_up(s: Store, slot: int, after: int) -> None:
    """Have `after` follow what stands before a slot: another one, or the head of a list."""
    before = s.slot_prev[slot]
    if before >= 0:
        s.slot_next[before] = after
    elif s.slot_mask[slot]:
        s.watch_head[s.slot_variable[slot]] = after
    else:
        s.mute_head[s.slot_variable[slot]] = after
