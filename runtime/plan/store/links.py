"""Ordered lists of tokens (open, threats, one per predicate, one per timeline), and the undo of all rows.

Lists are doubly linked through the rows of tokens; a token that leaves a list keeps its neighbours' names, so that
undoing in reverse order puts it back where it was (Knuth's dancing links).
"""

from runtime.constraints.domains.arrays import lengthen
from runtime.plan.store.rows import Rows
from runtime.plan.tags import (
    FREED,
    LISTS,
    NONE,
    SHORT,
    UNDO_BRANCH,
    UNDO_INPUTS,
    UNDO_LINK,
    UNDO_MERGED,
    UNDO_NEW_CELLS,
    UNDO_NEW_HOLD,
    UNDO_NEW_PAIR,
    UNDO_NEW_SCOPE,
    UNDO_NEW_TOKEN,
    UNDO_STATUS,
    UNDO_UNLINK,
)


def new_head(rows: Rows, head: int) -> None:
    """Make sure that list number `head` exists."""
    if head >= len(rows.head_length):
        lengthen(rows, "head_length", "head_first head_last", head + 1)


def link(rows: Rows, t: int, kind: int, head: int, after: int) -> None:
    """Put `t` on list `head` behind token `after` (NONE: in front)."""
    _attach(rows, t, kind, head, after)
    if rows.level:
        rows.log(UNDO_LINK, LISTS * t + kind, 0)


def link_by_key(rows: Rows, t: int, kind: int, head: int) -> None:
    """Put `t` on list `head`, which is in the order of keys."""
    after = rows.head_last[head]
    while after >= 0 and rows.key[after] > rows.key[t]:
        after = rows.link_before[LISTS * after + kind]
    link(rows, t, kind, head, after)


def unlink(rows: Rows, t: int, kind: int) -> None:
    """Take `t` off its list of that kind, if it is on one."""
    head = rows.link_head[LISTS * t + kind]
    if head >= 0:
        _detach(rows, t, kind)
        if rows.level:
            rows.log(UNDO_UNLINK, LISTS * t + kind, head)


def _attach(rows: Rows, t: int, kind: int, head: int, after: int) -> None:
    """Link without a trail."""
    at = LISTS * t + kind
    before = rows.head_first[head] if after < 0 else rows.link_after[LISTS * after + kind]
    rows.link_head[at] = head
    rows.link_before[at] = after
    rows.link_after[at] = before
    if after < 0:
        rows.head_first[head] = t
    else:
        rows.link_after[LISTS * after + kind] = t
    if before < 0:
        rows.head_last[head] = t
    else:
        rows.link_before[LISTS * before + kind] = t
    rows.head_length[head] += 1


def _detach(rows: Rows, t: int, kind: int) -> None:
    """Unlink without a trail; the names of the neighbours stay."""
    at = LISTS * t + kind
    head = rows.link_head[at]
    after = rows.link_before[at]
    before = rows.link_after[at]
    if after < 0:
        rows.head_first[head] = before
    else:
        rows.link_after[LISTS * after + kind] = before
    if before < 0:
        rows.head_last[head] = after
    else:
        rows.link_before[LISTS * before + kind] = after
    rows.link_head[at] = NONE
    rows.head_length[head] -= 1


def undo(rows: Rows, length: int) -> None:
    """Take back all that the trail holds beyond `length`."""
    at = rows.trail_length
    while at > length:
        at -= 1
        code = rows.trail_code[at]
        index = rows.trail_index[at]
        old = rows.trail_old[at]
        if code == UNDO_NEW_HOLD:
            rows.drop_hold(index)
        elif code == UNDO_LINK:
            _detach(rows, index // LISTS, index % LISTS)
        elif code == UNDO_UNLINK:
            _attach(rows, index // LISTS, index % LISTS, old, rows.link_before[index])
        elif code == UNDO_NEW_TOKEN:
            _undo_token(rows, index)
        elif code == UNDO_NEW_SCOPE:
            _undo_scope(rows, index)
        elif code == UNDO_NEW_CELLS:
            _undo_cells(rows, index, old)
        elif code == UNDO_NEW_PAIR:
            _undo_pair(rows, index)
        elif code == UNDO_STATUS:
            rows.status[index] = old
        elif code == UNDO_BRANCH:
            rows.scope_branch[index] = old
        elif code == UNDO_INPUTS:
            rows.scope_inputs[index] = NONE
            rows.forget_watch(index)
        elif code == UNDO_MERGED:
            rows.merged[old] = rows.merged_next[index]
            rows.merged_into[index] = NONE
            rows.merged_next[index] = NONE
    rows.trail_length = length


def _undo_token(rows: Rows, t: int) -> None:
    """Take back the making of `t`, the latest token."""
    parent = rows.parent[t]
    if parent >= 0:
        rows.children[parent] = rows.sibling[t]
    rows.status[t] = FREED
    rows.live -= 1
    rows.next_key -= 1
    if t == rows.token_count - 1:
        rows.token_count -= 1
    else:
        rows.sibling[t] = rows.free_token
        rows.free_token = t


def _undo_scope(rows: Rows, s: int) -> None:
    """Take back the making of `s`, the latest scope."""
    rows.forget_watch(s)
    if rows.scope_token[s] >= 0:
        rows.scopes[rows.scope_token[s]] = rows.scope_next[s]
    if s == rows.scope_count - 1:
        rows.scope_count -= 1
    else:
        rows.scope_next[s] = rows.free_scope
        rows.free_scope = s


def _undo_pair(rows: Rows, p: int) -> None:
    """Take back the making of pair `p`, the latest of both its tokens."""
    rows.pairs_out[rows.pair_first[p]] = rows.pair_next_out[p]
    rows.pairs_in[rows.pair_second[p]] = rows.pair_next_in[p]
    if p == rows.pair_count - 1:
        rows.pair_count -= 1
    else:
        rows.pair_next_out[p] = rows.free_pair
        rows.free_pair = p


def _undo_cells(rows: Rows, start: int, size: int) -> None:
    """Take back the taking of cells."""
    if start + size == rows.cell_count:
        rows.cell_count = start
    elif size < SHORT:
        rows.cells[start] = rows.free_cells[size]
        rows.free_cells[size] = start
