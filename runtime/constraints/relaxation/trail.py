"""Go back in time: undo every change since a mark, in reverse order, at a cost of the number of changes."""

from math import inf

from runtime.constraints.domains.bitset import detach_words, restore_bits
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    CONFLICT_NONE,
    TRAIL_CONSTRAINT,
    TRAIL_DECIDED,
    TRAIL_EDGE,
    TRAIL_ENTAILED,
    TRAIL_HOLES,
    TRAIL_LINK,
    TRAIL_LOWER,
    TRAIL_OPEN,
    TRAIL_REAL_LOWER,
    TRAIL_REAL_UPPER,
    TRAIL_RESTRICTION,
    TRAIL_UPPER,
    TRAIL_VARIABLE,
    TRAIL_WEIGHT,
    TRAIL_WORDS,
)
from runtime.constraints.domains.variables import drop_restriction, drop_variable
from runtime.constraints.propagators.posting import release_constraint
from runtime.constraints.stn.entailment import revive, undo_entailment
from runtime.constraints.stn.network import detach_edge, free_edge


def clear_queues(s: Store) -> None:
    """Forget what was scheduled; each entry costs its own flag only."""
    while s.edge_first != s.edge_last:
        s.queued[s.edge_queue[s.edge_first] >> 1] = 0
        s.edge_first = (s.edge_first + 1) & s.edge_mask
    while s.hull_first != s.hull_last:
        s.queued[s.hull_queue[s.hull_first]] = 0
        s.hull_first = (s.hull_first + 1) & s.hull_mask
    while s.cheap_first != s.cheap_last:
        s.scheduled[s.cheap_queue[s.cheap_first]] = 0
        s.cheap_first = (s.cheap_first + 1) & s.cheap_mask
    while s.dear_first != s.dear_last:
        s.scheduled[s.dear_queue[s.dear_first]] = 0
        s.dear_first = (s.dear_first + 1) & s.dear_mask
    s.clear_woken()
    s.running = -1


def undo_to(s: Store, size: int) -> None:
    """Undo trail entries until `size` are left; queues are cleared and the conflict is forgotten."""
    clear_queues(s)
    i = s.trail_size
    while i > size:
        i -= 1
        key = s.trail_key[i]
        name = key >> 4
        code = key & 15
        if code == TRAIL_LOWER:
            s.lb[name] = s.trail_value[i]
            s.lower_support[name] = s.trail_support[i]
            s.lower_when[name] = s.trail_when[i]
        elif code == TRAIL_UPPER:
            s.ub[name] = s.trail_value[i]
            s.upper_support[name] = s.trail_support[i]
            s.upper_when[name] = s.trail_when[i]
        elif code == TRAIL_EDGE:
            detach_edge(s, name)
            free_edge(s, name)
        elif code == TRAIL_WEIGHT:
            s.edge_weight[name] = s.trail_value[i]
        elif code == TRAIL_CONSTRAINT:
            release_constraint(s, name)
        elif code == TRAIL_LINK:
            s.link_a[name] = -1
            s.link_b[name] = -1
        elif code == TRAIL_ENTAILED:
            undo_entailment(s, name)
        elif code == TRAIL_REAL_LOWER:
            s.real_bounds_used = s.trail_value[i]
            s.flo[name] = s.real_bounds[s.trail_value[i]]
            s.lower_support[name] = s.trail_support[i]
            s.lower_when[name] = s.trail_when[i]
        elif code == TRAIL_REAL_UPPER:
            s.real_bounds_used = s.trail_value[i]
            s.fhi[name] = s.real_bounds[s.trail_value[i]]
            s.upper_support[name] = s.trail_support[i]
            s.upper_when[name] = s.trail_when[i]
        elif code == TRAIL_HOLES:
            restore_bits(s, name)
        elif code == TRAIL_WORDS:
            detach_words(s, name)
        elif code == TRAIL_DECIDED:
            s.decided[name] = s.trail_value[i]
        elif code == TRAIL_VARIABLE:
            drop_variable(s, name)
        elif code == TRAIL_RESTRICTION:
            drop_restriction(s, name)
        elif code == TRAIL_OPEN:
            s.is_open[name] = 1
            s.restriction_lo[s.trail_support[i]] = -inf
            s.restriction_hi[s.trail_support[i]] = inf
    s.trail_size = size
    s.consistent = True
    if s.suspects:
        s.suspects.clear()
    s.conflict_kind = CONFLICT_NONE


def commit_trail(s: Store) -> None:
    """Forget how to go back; time stamps go on counting, also past those of what `retract` wrote without a trail."""
    i = s.trail_size
    while s.entailed_count:  # entailed for a search, which is over
        i -= 1
        if s.trail_key[i] & 15 == TRAIL_ENTAILED:
            revive(s, s.trail_key[i] >> 4)
    s.trail_base += s.trail_size + 1
    s.trail_size = 0
    s.real_bounds_used = 0
