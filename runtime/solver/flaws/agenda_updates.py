"""Agenda updates: candidates that the new part of the trails of plan and engine adds or moves."""

from runtime.constraints.domains.arrays import grow_rows
from runtime.constraints.domains.base_domain import is_base_single
from runtime.constraints.domains.narrow import is_single
from runtime.constraints.domains.tags import (
    TRAIL_CONSTRAINT,
    TRAIL_EDGE,
    TRAIL_NARROWING,
    TRAIL_RESTRICTION,
    TRAIL_VARIABLE,
)
from runtime.plan.tags import (
    ACTIVE,
    BRANCH_WAITING,
    END,
    FLAG_EFFECT,
    FLAG_REJECTABLE,
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
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.tags import NO_KEY, NONE, OPEN_CONDITION, THREAT, UNBOUND_VARIABLE

_ONE = 1
_LAST_BIT = 62  # of a mask: it stands for all variables from there on


def rebuild(agenda: Agenda) -> None:
    """Rebuild the agenda from every token and variable; levels count from here."""
    agenda.clear()
    agenda.plan.reserve_variables(agenda.engine.variables)
    for t in range(agenda.rows.token_count):
        if agenda.rows.status[t] == INACTIVE:
            _add_token(agenda, t, OPEN_CONDITION)
        elif agenda.rows.status[t] == ACTIVE:
            _add_threat(agenda, t)
    engine, rows, exact = agenda.engine, agenda.rows, agenda.exact
    kinds, constant, decided = engine.kind, engine.constant, engine.decided
    roles, owners = agenda.plan.variable_role, agenda.plan.variable_owner
    count = engine.variables
    v = 0
    while v < count:
        role = roles[v]
        if role == ROLE_INTERNAL or kinds[v] < 0 or constant[v]:
            v += 1
            continue
        first, after, mask = v, v + 1, _ONE  # which of the variables that stand side by side may be flaws
        if role == ROLE_TOKEN:
            t = owners[v]
            first, after = rows.var0[t], rows.var0[t] + rows.width[t]
            mask = _unbound_mask(agenda, t) if rows.status[t] == ACTIVE else 0
        elif role == ROLE_LOCAL and rows.status[owners[v]] != ACTIVE:
            mask = 0
        v = after
        if mask == 0:
            continue
        number = 0
        while mask and first + number < after:
            each = first + number
            # What is decided, which most are, is never a flaw.
            if mask & 1 and not decided[each] and kinds[each] >= 0 and not constant[each]:
                if exact or not is_single(engine, each) or not is_base_single(engine, each):
                    _add_variable(agenda, each)
            number += 1
            if number <= _LAST_BIT:
                mask >>= 1
    for s in range(agenda.rows.scope_count):
        if agenda.rows.scope_watch[s] >= 0 and agenda.rows.scope_branch[s] == BRANCH_WAITING:
            agenda.waiting_guards[0] += 1
    _begin(agenda)


def reopen(agenda: Agenda) -> None:
    """Offer again what the first selection after `rebuild` has dropped or deferred; nothing has changed since."""
    agenda.backtrack(0, agenda.dynamic_count, 0, 0)
    _begin(agenda)


def _begin(agenda: Agenda) -> None:
    """Read the trails from here on."""
    agenda.rows_seen = agenda.rows.trail_length if agenda.rows.level else 0  # the first mark empties that trail
    agenda.engine_seen = agenda.engine.trail_size


def update(agenda: Agenda, level: int) -> None:
    """Read the trails since the last time; all of it belongs to decision level `level`."""
    agenda.level = level
    agenda.reserve()
    rows = agenda.rows
    engine = agenda.engine
    at = agenda.engine_seen
    while at < engine.trail_size:
        code = engine.trail_key[at] & 15
        name = engine.trail_key[at] >> 4
        if code == TRAIL_VARIABLE:
            agenda.forget_waiting(name)
            agenda.variable_deferred[name] = 0
            agenda.watched[name] = 0
            agenda.variable_level[name] = level
            _forget_slots(agenda, name)
        else:
            _note_level(agenda, code, name, level)
        at += 1
    agenda.note_fired(level)
    at = agenda.rows_seen
    while at < rows.trail_length:
        if rows.trail_code[at] == UNDO_STATUS:
            _update_status(agenda, rows.trail_index[at])
        elif rows.trail_code[at] == UNDO_NEW_TOKEN:
            t = rows.trail_index[at]
            agenda.token_level[t] = level
            agenda.token_deferred[t] = 0
            for slot in range(t * agenda.managers, t * agenda.managers + agenda.managers):
                agenda.token_row[slot] = NONE  # a token that was undone may have had its number
                agenda.token_key[slot] = NO_KEY
            if rows.status[t] == INACTIVE:
                _add_token(agenda, t, OPEN_CONDITION)
        elif rows.trail_code[at] == UNDO_LINK and rows.trail_index[at] % LISTS == LIST_ORDER:
            agenda.order_level[rows.trail_index[at] // LISTS] = level
        at += 1
    agenda.rows_seen = at
    at = agenda.engine_seen
    while at < engine.trail_size:
        code = engine.trail_key[at] & 15
        name = engine.trail_key[at] >> 4
        if TRAIL_NARROWING >> code & 1:
            if agenda.watched[name]:
                _update_domain(agenda, name)
        elif code == TRAIL_VARIABLE and agenda.plan.variable_role[name] == ROLE_LOCAL:
            _add_variable(agenda, name)
        at += 1
    agenda.engine_seen = at


def note_levels(agenda: Agenda, level: int) -> None:
    """Read of a failed resolver only the guards that fired, and the edges, constraints and restrictions it posted."""
    agenda.level = level
    agenda.reserve()
    agenda.note_fired(level)
    engine = agenda.engine
    at = agenda.engine_seen
    while at < engine.trail_size:
        _note_level(agenda, engine.trail_key[at] & 15, engine.trail_key[at] >> 4, level)
        at += 1


def _note_level(agenda: Agenda, code: int, name: int, level: int) -> None:
    """Note the level of an edge, a constraint or a restriction that a trail entry tells of."""
    if code == TRAIL_EDGE:
        agenda.edge_level[name] = level
    elif code == TRAIL_CONSTRAINT:
        agenda.constraint_level[name] = level
    elif code == TRAIL_RESTRICTION:
        agenda.restriction_level[name] = level


def _forget_slots(agenda: Agenda, v: int) -> None:
    """Reset the slots of a new variable, whose id may have been in use."""
    for slot in range(v * agenda.managers, v * agenda.managers + agenda.managers):
        agenda.variable_row[slot] = NONE
        agenda.variable_key[slot] = NO_KEY


def _update_status(agenda: Agenda, t: int) -> None:
    """Update for a token with a new state."""
    if agenda.rows.status[t] == ACTIVE:
        agenda.active_level[t] = agenda.level
        _add_threat(agenda, t)
        first = agenda.rows.var0[t]
        for v in range(first, first + agenda.rows.width[t]):
            _add_variable(agenda, v)
    elif agenda.rows.status[t] == INACTIVE:
        _add_token(agenda, t, OPEN_CONDITION)


def _update_domain(agenda: Agenda, v: int) -> int:
    """Update for a domain that was narrowed."""
    role = agenda.plan.variable_role[v]
    if role == ROLE_INTERNAL:
        return 0
    if agenda.variable_deferred[v]:
        agenda.resume_variable(v)
    else:
        agenda.resize(v)
    if role == ROLE_TOKEN:
        t = agenda.plan.variable_owner[v]
        number = v - agenda.rows.var0[t]
        if number == START or number == END:
            if agenda.token_deferred[t]:
                agenda.resume_token(t)
            waiting = agenda.token_waiting[t]
            while waiting >= 0:
                after = agenda.waiting_next[waiting]
                agenda.forget_waiting(waiting)
                agenda.resume_variable(waiting)
                waiting = after
    return 0


def _kind_of(agenda: Agenda, t: int) -> int:
    """The kind of a token by predicate, parent, relation, name, and whether it may be rejected."""
    rows = agenda.rows
    if agenda.table.by_predicate and agenda.table.kind_of_predicate[rows.predicate[t]] != NONE:
        return agenda.table.kind_of_predicate[rows.predicate[t]]
    parent = rows.parent[t]
    asker = rows.predicate[parent] if parent >= 0 else NONE
    rejectable = rows.flags[t] & FLAG_REJECTABLE != 0
    return agenda.table.token_kind(rows.predicate[t], asker, rows.relation[t], rows.label[t], rejectable)


def _add_threat(agenda: Agenda, t: int) -> None:
    """Add an active token of a timeline as a threat."""
    is_ordered = agenda.rows.link_head[LISTS * t + LIST_ORDER] >= 0
    if not is_ordered and agenda.plan.predicate_timeline[agenda.rows.predicate[t]]:
        _add_token(agenda, t, THREAT)


def _add_token(agenda: Agenda, t: int, flaw: int) -> None:
    """Add a token as a flaw of some kind, an inactive one as an open condition."""
    kind = _kind_of(agenda, t)
    for manager in range(agenda.table.managers):
        if agenda.table.manager_kind[manager] == flaw:
            slot = t * agenda.managers + manager
            agenda.token_row[slot] = agenda.table.token_row(manager, kind)
            agenda.token_key[slot] = NO_KEY
            if agenda.token_row[slot] >= 0:
                if flaw == OPEN_CONDITION and agenda.rows.flags[t] & FLAG_EFFECT:
                    agenda.offer_effect(slot)
                agenda.offer_token(slot)


def _unbound_mask(agenda: Agenda, t: int) -> int:
    """Which variables of a token some manager decides when they are unbound, as bits; the last stands for the rest."""
    table, kind = agenda.table, _kind_of(agenda, t)
    if kind >= len(agenda.unbound_masks):
        grow_rows(agenda, "unbound_masks", 2 * kind + 64, NONE)
    if agenda.unbound_masks[kind] == NONE:
        mask = 0
        for number in range(agenda.rows.width[t]):
            for manager in range(table.managers):
                if table.manager_kind[manager] == UNBOUND_VARIABLE and table.variable_row(manager, kind, number) >= 0:
                    mask |= _ONE << min(number, _LAST_BIT)
        agenda.unbound_masks[kind] = mask
    return agenda.unbound_masks[kind]


def _add_variable(agenda: Agenda, v: int) -> int:
    """Add a variable as unbound, if it is one that a solver decides."""
    role = agenda.plan.variable_role[v]
    owner = agenda.plan.variable_owner[v]
    name = agenda.plan.variable_name[v]
    kind = 0  # of the token, or the class of the object
    if role == ROLE_TOKEN or role == ROLE_LOCAL:
        if agenda.rows.status[owner] != ACTIVE:
            return 0
    elif role != ROLE_GLOBAL and role != ROLE_MEMBER:
        return 0
    if agenda.is_decided(v):
        return 0
    if role == ROLE_TOKEN or role == ROLE_LOCAL:
        kind = _kind_of(agenda, owner)
    elif role == ROLE_MEMBER:
        kind = agenda.plan.object_class[owner]
    for manager in range(agenda.table.managers):
        if agenda.table.manager_kind[manager] != UNBOUND_VARIABLE:
            continue
        if role == ROLE_TOKEN:
            row = agenda.table.variable_row(manager, kind, v - agenda.rows.var0[owner])
        else:
            row = agenda.table.other_row(role, manager, kind, name)
        slot = v * agenda.managers + manager
        agenda.touched.add(v)
        agenda.variable_row[slot] = row
        agenda.variable_key[slot] = NO_KEY
        if row >= 0:
            agenda.offer_variable(slot)
    return 0
