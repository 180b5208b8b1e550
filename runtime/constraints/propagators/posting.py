"""Keep constraints in rows and their arguments in slots; put them on the watch lists of their variables."""

from runtime.constraints.domains.arrays import lengthen
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    MODE_DISTANCE,
    MODE_EDGES,
    MODE_REAL,
    MODE_WHOLE,
    TRAIL_CONSTRAINT,
)
from runtime.constraints.propagators.opcodes import (
    OP_ADD_EQ,
    OP_EXTERNAL,
    OP_PLUS,
    OP_RAND,
    OP_TEMPORAL_DISTANCE,
)
from runtime.constraints.propagators.registry import (
    EDGES_UP_TO,
    IDEMPOTENT_UP_TO,
    POSTED_AS,
    PRIORITIES,
    TWINS,
    WAKES_BESIDE_EDGES,
    WAKES_FIRST,
    WAKES_OTHERS,
)
from runtime.constraints.stn.watch_lists import link_slot, unlink_slot

_MASK = 2**64 - 1


def _allocate_slots(s: Store, count: int) -> int:
    """Take `count` consecutive slots; blocks of up to 64 come back through free lists."""
    if count <= 64 and s.slot_free[count] >= 0:
        first = s.slot_free[count]
        s.slot_free[count] = s.slot_next[first]
        return first
    first = s.slots_used
    if first + count > len(s.slot_variable):
        lengthen(s, "slot_mask slot_key", "slot_variable slot_constraint slot_next slot_prev", first + count)
    s.slots_used = first + count
    return first


def _new_constraint(s: Store, op: int, arity: int, span: int, owner: int) -> int:
    """Make a constraint whose arguments are still to be filled in."""
    c = s.constraint_free
    if c >= 0:
        s.constraint_free = s.constraint_next[c]
    else:
        c = s.constraints_used
        if c == len(s.op):
            s.grow_constraints()
        s.constraints_used = c + 1
    s.op[c] = op
    s.mode[c] = MODE_WHOLE
    s.first[c] = _allocate_slots(s, arity)
    s.arity[c] = arity
    s.span[c] = span
    s.owner[c] = owner
    s.link_a[c] = -1
    s.link_b[c] = -1
    s.entailed[c] = 0
    s.priority[c] = PRIORITIES[op]
    s.scheduled[c] = 0
    s.run_epoch[c] = 0
    s.save(c, TRAIL_CONSTRAINT, 0, 0)
    return c


def _watch(s: Store, c: int, position: int, v: int, mask: int) -> None:
    """Fill in an argument and wake `c` at the events of `mask`; without any it is mute."""
    slot = s.first[c] + position
    s.slot_variable[slot] = v
    s.slot_constraint[slot] = c
    s.slot_mask[slot] = mask
    link_slot(s, slot)


def release_constraint(s: Store, c: int) -> None:
    """Take a constraint off all watch lists and free its row; its edges must be gone."""
    first = s.first[c]
    count = s.arity[c]
    for slot in range(first, first + count):
        unlink_slot(s, slot)
        s.slot_constraint[slot] = -1
    if 0 < count <= 64:
        s.slot_next[first] = s.slot_free[count]
        s.slot_free[count] = first
    if s.op[c] == OP_EXTERNAL:
        del s.externals[c]
    s.op[c] = -1
    s.constraint_next[c] = s.constraint_free
    s.constraint_free = c


def post_constraint(s: Store, op: int, arguments: list[int], span: int, owner: int) -> int:
    """Make a constraint, choose how it is carried out, put it on the lists of its variables, schedule it."""
    if s.relational and TWINS[op] >= 0:
        op = TWINS[op]
    if POSTED_AS[op] >= 0:
        op = POSTED_AS[op]
        arguments = [arguments[len(arguments) - 1], *arguments[: len(arguments) - 1]]
    elif op == OP_ADD_EQ and s.constant[arguments[0]] and not s.constant[arguments[1]]:
        arguments = [arguments[1], arguments[0], arguments[2]]
    c = _new_constraint(s, op, len(arguments), span, owner)
    has_real = _choose_mode(s, c, arguments)
    if op == OP_RAND:
        s.drawn[c] = _random_whole(s.seed, span, owner)
    for position in range(s.arity[c]):
        _watch(s, c, position, arguments[position], _events_of(s, c, position))
    # One run reaches its fixpoint, where no bound has to jump over holes and no real is rounded to a whole number.
    s.idempotent[c] = not has_real and s.arity[c] <= IDEMPOTENT_UP_TO[s.op[c]] and not _repeats(s, c)
    s.schedule(c)
    return c


def _repeats(s: Store, c: int) -> bool:
    """Tell whether a variable is an argument twice."""
    for k in range(s.first[c], s.first[c] + s.arity[c]):
        for j in range(s.first[c], k):
            if s.slot_variable[j] == s.slot_variable[k]:
                return True
    return False


def _events_of(s: Store, c: int, position: int) -> int:
    """Give the events of an argument that may let the constraint narrow another one."""
    op = s.op[c]
    if s.mode[c] == MODE_EDGES:
        return WAKES_BESIDE_EDGES[op]
    return WAKES_OTHERS[op] if position else WAKES_FIRST[op]


def _choose_mode(s: Store, c: int, arguments: list[int]) -> bool:
    """Have comparisons of ints, and sums of an int and a constant, carried out by edges; reals by doubles.

    Gives whether a real is among the arguments.
    """
    op = s.op[c]
    edges = s.arity[c] <= EDGES_UP_TO[op]
    has_real = False
    for v in arguments:
        if s.kind[v] == KIND_FLOAT:
            has_real = True
            s.mode[c] = MODE_REAL
        if s.kind[v] != KIND_INT or s.constant[v]:
            edges = False
    if op == OP_TEMPORAL_DISTANCE:
        s.mode[c] = MODE_DISTANCE
    elif op == OP_ADD_EQ:
        if _is_offset(s, arguments[0], arguments[1], arguments[2]):
            s.mode[c] = MODE_EDGES
            s.op[c] = OP_PLUS
    elif op == OP_PLUS or edges:
        s.mode[c] = MODE_EDGES
    return has_real


def _is_offset(s: Store, a: int, k: int, b: int) -> bool:
    """Tell whether a + k = b relates two ints by a constant whole number."""
    if s.kind[a] != KIND_INT or s.kind[b] != KIND_INT or s.constant[a] or s.constant[b] or not s.constant[k]:
        return False
    return (s.kind[k] == KIND_INT or s.kind[k] == KIND_BOOL) and s.lb[k] == s.ub[k]


def _random_whole(seed: int, span: int, owner: int) -> int:
    """Draw from 0 to 32767: a function of the seed and of where the constraint was posted (splitmix64)."""
    x = (seed * 1000003 + span * 8191 + owner + 2) & _MASK
    x = (x + 0x9E3779B97F4A7C15) & _MASK
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & _MASK
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & _MASK
    return (x ^ (x >> 31)) & 32767
