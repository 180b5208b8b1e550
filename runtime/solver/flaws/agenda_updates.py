"""Feed the queues: read the new part of the trails of plan and engine, and put what is new or changed in its place."""

from runtime.constraints.domains.tags import (
    TRAIL_CONSTRAINT,
    TRAIL_EDGE,
    TRAIL_HOLES,
    TRAIL_REAL_UPPER,
    TRAIL_RESTRICTION,
    TRAIL_VARIABLE,
)
from runtime.plan.tags import (
    ACTIVE,
    BRANCH_WAITING,
    END,
    FLAG_EFFECT,
    INACTIVE,
    LIST_ORDER,
    LISTS,
    ROLE_GLOBAL,
    ROLE_INTERNAL,
    ROLE_LOCAL,
    ROLE_MEMBER,
    ROLE_TOKEN,
    START,
    UNDO_LINK,
    UNDO_NEW_TOKEN,
    UNDO_STATUS,
)
from runtime.solver.flaws.agenda import Queues
from runtime.solver.tags import NO_KEY, NONE, OPEN_CONDITION, THREAT, UNBOUND_VARIABLE


def fill(q: Queues) -> int:
    """Forget all queues and look at every token and variable once; levels count from here."""
    q.clear()
    q.level = 0
    for t in range(q.rows.token_count):
        if q.rows.status[t] == INACTIVE:
            add_open(q, t)
        elif q.rows.status[t] == ACTIVE:
            add_threat(q, t)
    for v in range(q.engine.variables):
        if q.engine.kind[v] >= 0 and not q.engine.constant[v]:
            add_variable(q, v)
    for s in range(q.rows.scope_count):
        if q.rows.scope_watch[s] >= 0 and q.rows.scope_branch[s] == BRANCH_WAITING:
            q.waiting_guards[0] += 1
    q.rows_seen = q.rows.trail_length if q.rows.level else 0  # the first mark empties that trail
    q.engine_seen = q.engine.trail_size
    return 0


def catch_up(q: Queues, level: int) -> int:
    """Read what the trails say since the last time; all of it belongs to decision number `level`."""
    q.level = level
    q.reserve()
    rows = q.rows
    engine = q.engine
    at = q.engine_seen
    while at < engine.trail_size:
        code = engine.trail_key[at] & 15
        name = engine.trail_key[at] >> 4
        if code == TRAIL_VARIABLE:
            q.forget_waiting(name)
            q.variable_parked[name] = 0
            q.stirs[name] = 0
            q.variable_level[name] = level
            forget_slots(q, name)
        elif code == TRAIL_EDGE:
            q.edge_level[name] = level
        elif code == TRAIL_CONSTRAINT:
            q.constraint_level[name] = level
        elif code == TRAIL_RESTRICTION:
            q.restriction_level[name] = level
        at += 1
    q.note_fired(level)
    at = q.rows_seen
    while at < rows.trail_length:
        if rows.trail_code[at] == UNDO_STATUS:
            see_status(q, rows.trail_index[at])
        elif rows.trail_code[at] == UNDO_NEW_TOKEN:
            t = rows.trail_index[at]
            q.token_level[t] = level
            q.token_parked[t] = 0
            for slot in range(t * q.managers, t * q.managers + q.managers):
                q.token_row[slot] = NONE  # a token that was undone may have had its number
                q.token_key[slot] = NO_KEY
            if rows.status[t] == INACTIVE:
                add_open(q, t)
        elif rows.trail_code[at] == UNDO_LINK and rows.trail_index[at] % LISTS == LIST_ORDER:
            q.order_level[rows.trail_index[at] // LISTS] = level
        at += 1
    q.rows_seen = at
    at = q.engine_seen
    while at < engine.trail_size:
        code = engine.trail_key[at] & 15
        name = engine.trail_key[at] >> 4
        if code <= TRAIL_REAL_UPPER or code == TRAIL_HOLES:
            if q.stirs[name]:
                see_change(q, name)
        elif code == TRAIL_VARIABLE and q.plan.variable_role[name] == ROLE_LOCAL:
            add_variable(q, name)
        at += 1
    q.engine_seen = at
    return 0


def note_levels(q: Queues, level: int) -> int:
    """Read of a failed attempt only which guards fired, and which edges, constraints and restrictions it posted."""
    q.reserve()
    q.note_fired(level)
    engine = q.engine
    at = q.engine_seen
    while at < engine.trail_size:
        code = engine.trail_key[at] & 15
        name = engine.trail_key[at] >> 4
        if code == TRAIL_EDGE:
            q.edge_level[name] = level
        elif code == TRAIL_CONSTRAINT:
            q.constraint_level[name] = level
        elif code == TRAIL_RESTRICTION:
            q.restriction_level[name] = level
        at += 1
    return 0


def forget_slots(q: Queues, v: int) -> int:
    """A variable is new: nothing that was known under its id holds."""
    for slot in range(v * q.managers, v * q.managers + q.managers):
        q.variable_row[slot] = NONE
        q.variable_key[slot] = NO_KEY
    return 0


def see_status(q: Queues, t: int) -> int:
    """A token has another state."""
    if q.rows.status[t] == ACTIVE:
        q.active_level[t] = q.level
        add_threat(q, t)
        first = q.rows.var0[t]
        for v in range(first, first + q.rows.width[t]):
            add_variable(q, v)
    elif q.rows.status[t] == INACTIVE:
        add_open(q, t)
    return 0


def see_change(q: Queues, v: int) -> int:
    """A domain has become smaller."""
    role = q.plan.variable_role[v]
    if role == ROLE_INTERNAL:
        return 0
    if q.variable_parked[v]:
        q.unpark_variable(v)
    else:
        q.resize(v)
    if role == ROLE_TOKEN:
        t = q.plan.variable_owner[v]
        place = v - q.rows.var0[t]
        if place == START or place == END:
            if q.token_parked[t]:
                q.unpark_token(t)
            waiting = q.token_waiting[t]
            while waiting >= 0:
                after = q.waiting_next[waiting]
                q.forget_waiting(waiting)
                q.unpark_variable(waiting)
                waiting = after
    return 0


def kind_of(q: Queues, t: int) -> int:
    """The kind that the configuration sees in a token."""
    rows = q.rows
    master = rows.parent[t]
    parent = rows.predicate[master] if master >= 0 else NONE
    return q.treatments.token_kind(rows.predicate[t], parent, rows.relation[t], rows.label[t])


def add_open(q: Queues, t: int) -> int:
    """Put an inactive token into the queues of open conditions."""
    kind = kind_of(q, t)
    for manager in range(q.treatments.managers):
        if q.treatments.manager_kind[manager] == OPEN_CONDITION:
            slot = t * q.managers + manager
            q.token_row[slot] = q.treatments.token_row(manager, kind)
            q.token_key[slot] = NO_KEY
            if q.token_row[slot] >= 0:
                if q.rows.flags[t] & FLAG_EFFECT:
                    q.offer_effect(slot)
                q.offer_token(slot)
    return 0


def add_threat(q: Queues, t: int) -> int:
    """Put an active token of a timeline into the queues of threats."""
    if not q.plan.predicate_timeline[q.rows.predicate[t]] or q.rows.link_head[LISTS * t + LIST_ORDER] >= 0:
        return 0
    kind = kind_of(q, t)
    for manager in range(q.treatments.managers):
        if q.treatments.manager_kind[manager] == THREAT:
            slot = t * q.managers + manager
            q.token_row[slot] = q.treatments.token_row(manager, kind)
            q.token_key[slot] = NO_KEY
            if q.token_row[slot] >= 0:
                q.offer_token(slot)
    return 0


def add_variable(q: Queues, v: int) -> int:
    """Put a variable into the queues of unbound variables, if it is one that a solver decides."""
    role = q.plan.variable_role[v]
    owner = q.plan.variable_owner[v]
    name = q.plan.variable_name[v]
    kind = NONE
    if role == ROLE_TOKEN or role == ROLE_LOCAL:
        if q.rows.status[owner] != ACTIVE:
            return 0
        kind = kind_of(q, owner)
    elif role != ROLE_GLOBAL and role != ROLE_MEMBER:
        return 0
    if q.is_decided(v):
        return 0
    for manager in range(q.treatments.managers):
        if q.treatments.manager_kind[manager] != UNBOUND_VARIABLE:
            continue
        if role == ROLE_TOKEN:
            row = q.treatments.variable_row(manager, kind, v - q.rows.var0[owner])
        elif role == ROLE_LOCAL:
            row = q.treatments.local_row(manager, kind, name)
        elif role == ROLE_GLOBAL:
            row = q.treatments.global_row(manager, name)
        else:
            row = q.treatments.member_row(manager, q.plan.object_class[owner], name)
        slot = v * q.managers + manager
        q.variable_row[slot] = row
        q.variable_key[slot] = NO_KEY
        if row >= 0:
            q.offer_variable(slot)
    return 0
