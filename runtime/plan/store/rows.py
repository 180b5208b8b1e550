"""Rows of integers: tokens, scopes and what they hold, frames, lists of tokens; undone by a trail.

A scope is what one run of a body made: constraints, edges, variables and children hang on it, so that they can be
taken back together. A frame is a stretch of `cells`: a scope's variable slots, then its token slots.
While a mark is open every change is logged; without marks rows go to free lists and are used again.
"""

from array import array

from runtime.constraints.domains.arrays import blank, grow_rows, lengthen
from runtime.plan.tags import (
    FREED,
    INACTIVE,
    LISTS,
    NONE,
    SHORT,
    UNDO_BRANCH,
    UNDO_INPUTS,
    UNDO_MERGED,
    UNDO_NEW_CELLS,
    UNDO_NEW_HOLD,
    UNDO_NEW_PAIR,
    UNDO_NEW_SCOPE,
    UNDO_NEW_TOKEN,
    UNDO_STATUS,
)


def take_off(heads: "array[int]", following: "array[int]", owner: int, item: int) -> None:
    """Take an item off its owner's list, which leads from the owner's head on to what is `following`."""
    other = heads[owner]
    if other == item:
        heads[owner] = following[item]
    else:
        while following[other] != item:
            other = following[other]
        following[other] = following[item]


class Rows:
    """Tokens `t`, scopes `s` and holds `h` as rows of arrays; cells of frames; lists of tokens; the trail."""

    def __init__(self) -> None:
        # Tokens.
        self.token_count = 0
        self.free_token = NONE
        self.next_key = 0
        self.live = 0
        self.status = blank(64)
        self.predicate = blank(64)
        self.var0 = blank(64)
        self.width = blank(64)
        self.flags = blank(64)
        self.parent = blank(64)
        self.relation = blank(64)
        self.origin = blank(64)
        self.label = blank(64)
        self.key = blank(64)
        self.span = blank(64)
        self.creator = blank(64)
        self.scopes = blank(64)
        self.children = blank(64)
        self.sibling = blank(64)
        self.merged_into = blank(64)
        self.merged = blank(64)
        self.merged_next = blank(64)
        self.pairs_out = blank(64)
        self.pairs_in = blank(64)
        self.link_head = blank(64 * LISTS)
        self.link_before = blank(64 * LISTS)
        self.link_after = blank(64 * LISTS)
        # Scopes.
        self.scope_count = 0
        self.free_scope = NONE
        self.scope_kind = blank(64)
        self.scope_token = blank(64)
        self.scope_rule = blank(64)
        self.scope_parent = blank(64)
        self.scope_frame = blank(64)
        self.scope_size = blank(64)
        self.scope_slots = blank(64)
        self.scope_holds = blank(64)
        self.scope_next = blank(64)
        self.scope_at = blank(64)
        self.scope_branch = blank(64)
        self.scope_watch = blank(64)
        self.scope_inputs = blank(64)
        # What scopes hold; pairs, cells, heads of lists; the trail.
        self.hold_count = 0
        self.free_hold = NONE
        self.hold_kind = blank(256)
        self.hold_id = blank(256)
        self.hold_next = blank(256)
        self.pair_count = 0
        self.free_pair = NONE
        self.pair_edge = blank(64)
        self.pair_first = blank(64)
        self.pair_second = blank(64)
        self.pair_next_out = blank(64)
        self.pair_next_in = blank(64)
        self.cells = blank(1024)
        self.cell_count = 0
        self.free_cells = array("q", [NONE] * SHORT)
        self.head_first = array("q", [NONE] * 64)
        self.head_last = array("q", [NONE] * 64)
        self.head_length = blank(64)
        self.level = 0
        self.trail_length = 0
        self.trail_code = blank(1024)
        self.trail_index = blank(1024)
        self.trail_old = blank(1024)

    # ---- tokens ----

    def set_flag(self, t: int, flag: int, is_set: bool) -> None:
        """Set or clear one of the flags of a token."""
        self.flags[t] = self.flags[t] | flag if is_set else self.flags[t] & ~flag

    def new_token(self, predicate: int, flags: int, parent: int, creator: int, span: int) -> int:
        """Take a row for a token; its variables are for the caller to make."""
        t = self.free_token
        if t >= 0:
            self.free_token = self.sibling[t]
        else:
            if self.token_count == len(self.status):
                lengthen(
                    self,
                    "status predicate var0 width flags parent relation origin label key span creator scopes children "
                    "sibling merged_into merged merged_next pairs_out pairs_in",
                )
                grow_rows(self, "link_head link_before link_after", len(self.status) * LISTS)
            t = self.token_count
            self.token_count += 1
        self.status[t] = INACTIVE
        self.predicate[t] = predicate
        self.flags[t] = flags
        self.parent[t] = parent
        self.creator[t] = creator
        self.span[t] = span
        self.var0[t] = NONE
        self.width[t] = 0
        self.relation[t] = NONE
        self.origin[t] = NONE
        self.label[t] = NONE
        self.scopes[t] = NONE
        self.children[t] = NONE
        self.merged_into[t] = NONE
        self.merged[t] = NONE
        self.merged_next[t] = NONE
        self.pairs_out[t] = NONE
        self.pairs_in[t] = NONE
        self.key[t] = self.next_key
        self.next_key += 1
        self.live += 1
        at = LISTS * t
        self.link_head[at] = NONE
        self.link_head[at + 1] = NONE
        self.link_head[at + 2] = NONE
        self.link_head[at + 3] = NONE
        self.sibling[t] = NONE
        if parent >= 0:
            self.sibling[t] = self.children[parent]
            self.children[parent] = t
        if self.level:
            self.log(UNDO_NEW_TOKEN, t, 0)
        return t

    def set_variables(self, t: int, first: int, width: int) -> None:
        """Note the variables of `t`: `width` of them from `first` on."""
        self.var0[t] = first
        self.width[t] = width

    def set_asking(self, t: int, label: int, relation: int, origin: int) -> None:
        """Note how a rule asked for `t`: its name there, and its relation to the token `origin`."""
        self.label[t] = label
        self.relation[t] = relation
        self.origin[t] = origin

    def release_token(self, t: int) -> None:
        """Give the row of `t` back; nothing may name it any more (level 0)."""
        if self.parent[t] >= 0:
            take_off(self.children, self.sibling, self.parent[t], t)
        self.status[t] = FREED
        self.sibling[t] = self.free_token
        self.free_token = t
        self.live -= 1

    def detach(self, t: int) -> None:
        """Let `t`, which a rule asked for, stand by itself: it no longer goes with its parent (level 0)."""
        take_off(self.children, self.sibling, self.parent[t], t)
        self.parent[t] = NONE
        self.creator[t] = NONE
        self.sibling[t] = NONE

    def set_status(self, t: int, status: int) -> None:
        """Change the state of `t`."""
        if self.level:
            self.log(UNDO_STATUS, t, self.status[t])
        self.status[t] = status

    def set_merged(self, t: int, other: int) -> None:
        """Note that `t` is merged into `other`."""
        if self.level:
            self.log(UNDO_MERGED, t, other)
        self.merged_into[t] = other
        self.merged_next[t] = self.merged[other]
        self.merged[other] = t

    def unset_merged(self, t: int) -> None:
        """Take `t` off the tokens merged into another (level 0)."""
        take_off(self.merged, self.merged_next, self.merged_into[t], t)
        self.merged_into[t] = NONE
        self.merged_next[t] = NONE

    # ---- scopes ----

    def new_scope(self, kind: int, token: int, rule: int, parent: int, slots: int, size: int) -> int:
        """Take a row for a scope of `token` with a frame of `size` cells, the first `slots` of them for variables.

        The cells are those of the parent's frame, as they are now, or NONE.
        """
        s = self.free_scope
        if s >= 0:
            self.free_scope = self.scope_next[s]
        else:
            if self.scope_count == len(self.scope_kind):
                lengthen(
                    self,
                    "scope_kind scope_token scope_rule scope_parent scope_frame scope_size scope_slots scope_holds "
                    "scope_next scope_at scope_branch scope_watch scope_inputs",
                )
            s = self.scope_count
            self.scope_count += 1
        frame = self.new_cells(size)
        self.scope_kind[s] = kind
        self.scope_token[s] = token
        self.scope_rule[s] = rule
        self.scope_parent[s] = parent
        self.scope_frame[s] = frame
        self.scope_size[s] = size
        self.scope_slots[s] = slots
        self.scope_holds[s] = NONE
        self.scope_at[s] = NONE
        self.scope_branch[s] = 0
        self.scope_watch[s] = NONE
        self.scope_inputs[s] = NONE
        source = self.scope_frame[parent] if parent >= 0 else NONE
        for offset in range(size):
            self.cells[frame + offset] = self.cells[source + offset] if parent >= 0 else NONE
        if token >= 0:
            self.scope_next[s] = self.scopes[token]
            self.scopes[token] = s
        if self.level:
            self.log(UNDO_NEW_SCOPE, s, 0)
        return s

    def release_scope(self, s: int) -> None:
        """Give back the row, the frame and the inputs of `s`, which is on its token's list no more (level 0)."""
        self._release_cells(self.scope_frame[s], self.scope_size[s])
        inputs = self.scope_inputs[s]
        if inputs >= 0:
            self._release_cells(inputs, self.cells[inputs] + 2)
        self.forget_watch(s)
        self.scope_next[s] = self.free_scope
        self.free_scope = s

    def set_branch(self, s: int, branch: int) -> None:
        """Note which branch of a guard runs."""
        if self.level:
            self.log(UNDO_BRANCH, s, self.scope_branch[s])
        self.scope_branch[s] = branch

    def set_guard(self, s: int, at: int, inputs: int, watch: int) -> None:
        """Note a guard's instruction, the variables that decide it, and the constraint that listens to them."""
        if self.level:
            self.log(UNDO_INPUTS, s, 0)
        self.scope_at[s] = at
        self.scope_inputs[s] = inputs
        self.scope_watch[s] = watch

    def forget_watch(self, s: int) -> None:
        """Note that no constraint listens for scope `s` any more."""
        self.scope_watch[s] = NONE

    def set_slot(self, s: int, slot: int, value: int) -> None:
        """Put a variable or a token into a slot of the frame of `s`."""
        self.cells[self.scope_frame[s] + slot] = value

    def hold(self, s: int, kind: int, identity: int) -> int:
        """Hang an edge, a constraint, variables or a decision on scope `s`; nothing hangs on that of the script."""
        if self.scope_token[s] < 0:
            return 0
        h = self.free_hold
        if h >= 0:
            self.free_hold = self.hold_next[h]
        else:
            if self.hold_count == len(self.hold_kind):
                lengthen(self, "hold_kind hold_id hold_next")
            h = self.hold_count
            self.hold_count += 1
        self.hold_kind[h] = kind
        self.hold_id[h] = identity
        self.hold_next[h] = self.scope_holds[s]
        self.scope_holds[s] = h
        if self.level:
            self.log(UNDO_NEW_HOLD, s, 0)
        return 0

    def drop_hold(self, s: int) -> None:
        """Give back the latest hold of `s`."""
        h = self.scope_holds[s]
        self.scope_holds[s] = self.hold_next[h]
        self.hold_next[h] = self.free_hold
        self.free_hold = h

    def take_hold(self, s: int, h: int) -> None:
        """Give back one hold of `s` (level 0)."""
        take_off(self.scope_holds, self.hold_next, s, h)
        self.hold_next[h] = self.free_hold
        self.free_hold = h

    # ---- pairs ----

    def new_pair(self, first: int, second: int, edge: int) -> None:
        """Note the edge that puts one token in front of another."""
        p = self.free_pair
        if p >= 0:
            self.free_pair = self.pair_next_out[p]
        else:
            if self.pair_count == len(self.pair_edge):
                lengthen(self, "pair_edge pair_first pair_second pair_next_out pair_next_in")
            p = self.pair_count
            self.pair_count += 1
        self.pair_edge[p] = edge
        self.pair_first[p] = first
        self.pair_second[p] = second
        self.pair_next_out[p] = self.pairs_out[first]
        self.pairs_out[first] = p
        self.pair_next_in[p] = self.pairs_in[second]
        self.pairs_in[second] = p
        if self.level:
            self.log(UNDO_NEW_PAIR, p, 0)

    def drop_pair(self, p: int) -> None:
        """Give back a pair (level 0)."""
        take_off(self.pairs_out, self.pair_next_out, self.pair_first[p], p)
        take_off(self.pairs_in, self.pair_next_in, self.pair_second[p], p)
        self.pair_next_out[p] = self.free_pair
        self.free_pair = p

    # ---- cells ----

    def new_cells(self, size: int) -> int:
        """Take `size` consecutive cells."""
        start = NONE
        if size < SHORT:
            start = self.free_cells[size]
        if size == 0:
            return 0
        if start >= 0:
            self.free_cells[size] = self.cells[start]
        else:
            start = self.cell_count
            if start + size > len(self.cells):
                lengthen(self, "cells", need=start + size)
            self.cell_count += size
        if self.level:
            self.log(UNDO_NEW_CELLS, start, size)
        return start

    def _release_cells(self, start: int, size: int) -> None:
        """Give cells back."""
        if 0 < size < SHORT:
            self.cells[start] = self.free_cells[size]
            self.free_cells[size] = start

    # ---- the trail ----

    def log(self, code: int, index: int, old: int) -> None:
        """Put one entry on the trail."""
        at = self.trail_length
        if at == len(self.trail_code):
            lengthen(self, "trail_code trail_index trail_old")
        self.trail_code[at] = code
        self.trail_index[at] = index
        self.trail_old[at] = old
        self.trail_length = at + 1
