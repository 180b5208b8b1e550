"""Rows of integers: tokens, scopes and what they hold, frames, lists of tokens; undone by a trail.

A scope is what one run of a body made: constraints, edges, variables and children hang on it, so that they can be
taken back together. A frame is a stretch of `cells`: a scope's variable slots, then its token slots.
While a mark is open every change is logged; without marks rows go to free lists and are used again.
"""

from array import array

from runtime.constraints.domains.arrays import blank, grow_rows, grown, next_room
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
    UNDO_NEW_SCOPE,
    UNDO_NEW_TOKEN,
    UNDO_STATUS,
)


class Rows:
    """Tokens `t`, scopes `s` and holds `h` as rows of arrays; cells of frames; lists of tokens; the trail."""

    def __init__(self) -> None:
        self._make_tokens(64)
        self._make_scopes(64)
        self.hold_capacity = 256
        self.hold_count = 0
        self.free_hold = NONE
        self.hold_kind = blank(256)
        self.hold_id = blank(256)
        self.hold_extent = blank(256)
        self.hold_next = blank(256)
        self.pair_capacity = 64
        self.pair_count = 0
        self.free_pair = NONE
        self.pair_edge = blank(64)
        self.pair_first = blank(64)
        self.pair_second = blank(64)
        self.pair_next_out = blank(64)
        self.pair_next_in = blank(64)
        self.cells = blank(1024)
        self.cell_capacity = 1024
        self.cell_count = 0
        self.free_cells = array("q", [NONE] * SHORT)
        self.head_first = array("q", [NONE] * 64)
        self.head_last = array("q", [NONE] * 64)
        self.head_length = blank(64)
        self.head_capacity = 64
        self.level = 0
        self.trail_capacity = 1024
        self.trail_length = 0
        self.trail_code = blank(1024)
        self.trail_index = blank(1024)
        self.trail_old = blank(1024)

    # ---- tokens ----

    def _make_tokens(self, capacity: int) -> None:
        """Make the empty token table."""
        self.token_capacity = capacity
        self.token_count = 0
        self.free_token = NONE
        self.next_key = 0
        self.live = 0
        self.status = blank(capacity)
        self.predicate = blank(capacity)
        self.var0 = blank(capacity)
        self.width = blank(capacity)
        self.flags = blank(capacity)
        self.parent = blank(capacity)
        self.relation = blank(capacity)
        self.origin = blank(capacity)
        self.label = blank(capacity)
        self.key = blank(capacity)
        self.span = blank(capacity)
        self.creator = blank(capacity)
        self.scopes = blank(capacity)
        self.children = blank(capacity)
        self.sibling = blank(capacity)
        self.merged_into = blank(capacity)
        self.merged = blank(capacity)
        self.merged_next = blank(capacity)
        self.pairs_out = blank(capacity)
        self.pairs_in = blank(capacity)
        self.link_head = blank(capacity * LISTS)
        self.link_before = blank(capacity * LISTS)
        self.link_after = blank(capacity * LISTS)

    def _grow_tokens(self) -> None:
        """Lengthen the token table."""
        size = next_room(self.token_capacity)
        self.token_capacity = size
        grow_rows(
            self,
            "status predicate var0 width flags parent relation origin label key span creator scopes children "
            "sibling merged_into merged merged_next pairs_out pairs_in",
            size,
        )
        grow_rows(self, "link_head link_before link_after", size * LISTS)

    def new_token(self, predicate: int, flags: int, parent: int, creator: int, span: int) -> int:
        """Take a row for a token; its variables are for the caller to make."""
        t = self.free_token
        if t >= 0:
            self.free_token = self.sibling[t]
        else:
            if self.token_count == self.token_capacity:
                self._grow_tokens()
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

    def release_token(self, t: int) -> None:
        """Give the row of `t` back; nothing may name it any more (level 0)."""
        parent = self.parent[t]
        if parent >= 0:
            child = self.children[parent]
            if child == t:
                self.children[parent] = self.sibling[t]
            else:
                while self.sibling[child] != t:
                    child = self.sibling[child]
                self.sibling[child] = self.sibling[t]
        self.status[t] = FREED
        self.sibling[t] = self.free_token
        self.free_token = t
        self.live -= 1

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
        other = self.merged_into[t]
        if self.merged[other] == t:
            self.merged[other] = self.merged_next[t]
        else:
            previous = self.merged[other]
            while self.merged_next[previous] != t:
                previous = self.merged_next[previous]
            self.merged_next[previous] = self.merged_next[t]
        self.merged_into[t] = NONE
        self.merged_next[t] = NONE

    # ---- scopes ----

    def _make_scopes(self, capacity: int) -> None:
        """Make the empty scope table."""
        self.scope_capacity = capacity
        self.scope_count = 0
        self.free_scope = NONE
        self.scope_kind = blank(capacity)
        self.scope_token = blank(capacity)
        self.scope_rule = blank(capacity)
        self.scope_parent = blank(capacity)
        self.scope_frame = blank(capacity)
        self.scope_size = blank(capacity)
        self.scope_slots = blank(capacity)
        self.scope_holds = blank(capacity)
        self.scope_next = blank(capacity)
        self.scope_at = blank(capacity)
        self.scope_branch = blank(capacity)
        self.scope_watch = blank(capacity)
        self.scope_inputs = blank(capacity)

    def _grow_scopes(self) -> None:
        """Lengthen the scope table."""
        size = next_room(self.scope_capacity)
        self.scope_capacity = size
        grow_rows(
            self,
            "scope_kind scope_token scope_rule scope_parent scope_frame scope_size scope_slots scope_holds "
            "scope_next scope_at scope_branch scope_watch scope_inputs",
            size,
        )

    def new_scope(self, kind: int, token: int, rule: int, parent: int, slots: int, size: int) -> int:
        """Take a row for a scope of `token` with a frame of `size` cells, the first `slots` of them for variables.

        The cells are those of the parent's frame, as they are now, or NONE.
        """
        s = self.free_scope
        if s >= 0:
            self.free_scope = self.scope_next[s]
        else:
            if self.scope_count == self.scope_capacity:
                self._grow_scopes()
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
        if parent >= 0:
            source = self.scope_frame[parent]
            for offset in range(size):
                self.cells[frame + offset] = self.cells[source + offset]
        else:
            for offset in range(size):
                self.cells[frame + offset] = NONE
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
        self.scope_watch[s] = NONE
        self.scope_next[s] = self.free_scope
        self.free_scope = s

    def set_branch(self, s: int, branch: int) -> None:
        """Note which branch of a guard runs."""
        if self.level:
            self.log(UNDO_BRANCH, s, self.scope_branch[s])
        self.scope_branch[s] = branch

    def set_inputs(self, s: int, inputs: int, watch: int) -> None:
        """Note the variables that decide a guard, and the constraint that listens to them."""
        if self.level:
            self.log(UNDO_INPUTS, s, 0)
        self.scope_inputs[s] = inputs
        self.scope_watch[s] = watch

    def hold(self, s: int, kind: int, identity: int, extent: int) -> None:
        """Hang an edge, a constraint, variables or a decision on scope `s`."""
        h = self.free_hold
        if h >= 0:
            self.free_hold = self.hold_next[h]
        else:
            if self.hold_count == self.hold_capacity:
                self.hold_capacity *= 2
                self.hold_kind = grown(self.hold_kind, self.hold_capacity)
                self.hold_id = grown(self.hold_id, self.hold_capacity)
                self.hold_extent = grown(self.hold_extent, self.hold_capacity)
                self.hold_next = grown(self.hold_next, self.hold_capacity)
            h = self.hold_count
            self.hold_count += 1
        self.hold_kind[h] = kind
        self.hold_id[h] = identity
        self.hold_extent[h] = extent
        self.hold_next[h] = self.scope_holds[s]
        self.scope_holds[s] = h
        if self.level:
            self.log(UNDO_NEW_HOLD, s, 0)

    def drop_hold(self, s: int) -> None:
        """Give back the latest hold of `s`."""
        h = self.scope_holds[s]
        self.scope_holds[s] = self.hold_next[h]
        self.hold_next[h] = self.free_hold
        self.free_hold = h

    def grow_pairs(self) -> None:
        """Lengthen the table of pairs."""
        size = next_room(self.pair_capacity)
        self.pair_capacity = size
        grow_rows(self, "pair_edge pair_first pair_second pair_next_out pair_next_in", size)

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
            while self.cell_count + size > self.cell_capacity:
                self.cell_capacity *= 2
                self.cells = grown(self.cells, self.cell_capacity)
            start = self.cell_count
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
        if at == self.trail_capacity:
            self.trail_capacity *= 2
            self.trail_code = grown(self.trail_code, self.trail_capacity)
            self.trail_index = grown(self.trail_index, self.trail_capacity)
            self.trail_old = grown(self.trail_old, self.trail_capacity)
        self.trail_code[at] = code
        self.trail_index[at] = index
        self.trail_old[at] = old
        self.trail_length = at + 1
