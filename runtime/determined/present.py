"""What holds on each timeline of a determined reactor: current tokens, the bounds of their ends, what is to come.

The end of a token is a pair of bounds in a slot; tokens that end together share one. Orders of two ends are pairs of
timelines, valid while both tokens hold. All of it is in one array, so that a snapshot is one copy.
"""

from array import array

from runtime.determined.tags import (
    BEFORE,
    DUE,
    ENDING,
    FAR,
    FOLLOWER,
    LEAST,
    MOST,
    NONE,
    OWNER,
    PAIRS,
    PREDICATE,
    SECTIONS,
    SLOT,
    START,
    WISH,
    WISH_FROM,
    WISH_UNTIL,
)


class Present:
    """The state of all timelines at a tick."""

    def __init__(self, lines: int) -> None:
        self.lines = lines
        self.before = BEFORE * lines
        self.pairs = SECTIONS * lines  # where orders of ends begin: their number, then four numbers each
        self.state = array("q", bytes(8 * (SECTIONS * lines + 1 + 4 * PAIRS)))
        self.kept = array("q", self.state)
        self.flags = array("q", bytes(8 * lines))
        self.is_used = array("q", bytes(8 * lines))  # timelines of other reactors
        self.now = 0
        self.changed = 0  # a bit for each timeline on which a token has started at this tick
        self.clear()

    def clear(self) -> int:
        """Nothing holds yet."""
        n = self.lines
        for k in range(len(self.state)):
            self.state[k] = 0
        for i in range(n):
            self.state[PREDICATE * n + i] = NONE
            self.state[SLOT * n + i] = i
            self.state[MOST * n + i] = FAR
            self.state[FOLLOWER * n + i] = NONE
            self.state[WISH * n + i] = NONE
            self.state[BEFORE * n + i] = NONE
        return 0

    def next_event(self, tick: int) -> int:
        """The first tick after `tick` at which something may end or start by itself."""
        n = self.lines
        state = self.state
        found = FAR
        for i in range(n):
            if state[PREDICATE * n + i] < 0:
                if not self.is_used[i]:
                    return tick + 1
                continue
            slot = state[SLOT * n + i]
            if state[MOST * n + slot] < found:
                found = state[MOST * n + slot]
            if state[WISH * n + i] >= 0:
                # A wish is looked at as soon as the token before it may end.
                due = max(state[WISH_FROM * n + i], state[LEAST * n + slot])
                if due < found:
                    found = due
        return max(found, tick + 1)

    def begin_tick(self, tick: int) -> bool:
        """Find what ends at `tick`; false if something should and may not."""
        n = self.lines
        state = self.state
        self.now = tick
        self.changed = 0
        for i in range(n):
            state[ENDING * n + i] = 0
            state[DUE * n + i] = NONE
        for i in range(n):
            if state[PREDICATE * n + i] >= 0 and not state[ENDING * n + i]:
                most = state[MOST * n + state[SLOT * n + i]]
                if most < tick or (most == tick and not self.end_with(i)):
                    return False
        for i in range(n):
            if state[WISH * n + i] >= 0 and state[WISH_FROM * n + i] <= tick:
                if state[WISH_UNTIL * n + i] < tick:
                    return False
                if state[PREDICATE * n + i] >= 0 and not state[ENDING * n + i] and not self.end_with(i):
                    if self.is_used[i]:
                        return False
        return True

    def end_with(self, i: int) -> bool:
        """End the token of a timeline now, with all that must end with it; false if one of these may not."""
        n = self.lines
        state = self.state
        flags = self.flags
        # What has started at this tick (2) neither ends nor has others end.
        for j in range(n):
            flags[j] = 2 if self.changed >> j & 1 else state[ENDING * n + j]
        flags[i] = 1
        grows = True
        while grows:
            grows = False
            for j in range(n):
                if flags[j] == 1 and state[PREDICATE * n + j] >= 0:
                    for k in range(n):
                        if (
                            flags[k] == 0
                            and state[SLOT * n + k] == state[SLOT * n + j]
                            and state[PREDICATE * n + k] >= 0
                        ):
                            flags[k] = 1
                            grows = True
                elif flags[j] == 0 and state[FOLLOWER * n + j] >= 0 and flags[state[OWNER * n + j]] == 1:
                    flags[j] = 1
                    grows = True
            for k in range(state[self.pairs]):
                at = self.pairs + 1 + 4 * k
                if flags[state[at + 1]] == 1 and flags[state[at]] == 0 and self.is_kept(at):
                    flags[state[at]] = 1
                    grows = True
        for j in range(n):
            if flags[j] == 1 and not state[ENDING * n + j] and state[PREDICATE * n + j] >= 0:
                if state[LEAST * n + state[SLOT * n + j]] > self.now:
                    return False
                if self.is_used[j] and not self.is_news(j):
                    return False
        for j in range(n):
            if flags[j] == 1:
                state[ENDING * n + j] = 1
        return True

    def is_news(self, i: int) -> bool:
        """Whether another reactor has published something on a timeline now."""
        n = self.lines
        return self.state[WISH * n + i] >= 0 and self.state[WISH_FROM * n + i] == self.now

    def is_kept(self, at: int) -> bool:
        """Whether an order of two ends still speaks of the tokens that hold."""
        n = self.lines
        state = self.state
        first = state[START * n + state[at]]
        return bool(state[at + 2] == first and state[at + 3] == state[START * n + state[at + 1]])

    def end_tick(self, tick: int) -> bool:
        """Let ends that are ordered bound each other; something must hold on each timeline of the reactor."""
        n = self.lines
        state = self.state
        pairs = self.pairs
        count = state[pairs]
        grows = True
        while grows:
            grows = False
            for k in range(count):
                at = pairs + 1 + 4 * k
                if self.is_kept(at) and self.order_ends(state[at], state[at + 1]):
                    grows = True
            for i in range(n):
                if state[FOLLOWER * n + i] >= 0 and state[OWNER * n + i] != i and state[PREDICATE * n + i] >= 0:
                    if self.order_ends(i, state[OWNER * n + i]):
                        grows = True
        for i in range(n):
            if state[PREDICATE * n + i] < 0:
                if not self.is_used[i]:
                    return False
                continue
            slot = state[SLOT * n + i]
            if state[LEAST * n + slot] > state[MOST * n + slot] or state[MOST * n + slot] <= tick:
                return False
            if state[ENDING * n + i] and not self.changed >> i & 1:
                return False
        # An order whose first end is settled has said what it has to say.
        left = 0
        for k in range(count):
            at = pairs + 1 + 4 * k
            slot = state[SLOT * n + state[at]]
            if self.is_kept(at) and state[LEAST * n + slot] != state[MOST * n + slot]:
                for j in range(4):
                    state[pairs + 1 + 4 * left + j] = state[at + j]
                left += 1
        state[pairs] = left
        return True

    def order_ends(self, a: int, b: int) -> bool:
        """Let the end of `a` be no later than that of `b`; whether a bound has moved."""
        n = self.lines
        state = self.state
        first = state[SLOT * n + a]
        second = state[SLOT * n + b]
        moved = False
        if state[MOST * n + first] > state[MOST * n + second]:
            state[MOST * n + first] = state[MOST * n + second]
            moved = True
        if state[LEAST * n + second] < state[LEAST * n + first]:
            state[LEAST * n + second] = state[LEAST * n + first]
            moved = state[MOST * n + second] >= state[LEAST * n + second]
        return moved

    def tie(self, a: int, b: int) -> int:
        """Let the tokens of two timelines end together."""
        n = self.lines
        state = self.state
        first = state[SLOT * n + a]
        second = state[SLOT * n + b]
        if first == second:
            return 0
        state[LEAST * n + first] = max(state[LEAST * n + first], state[LEAST * n + second])
        state[MOST * n + first] = min(state[MOST * n + first], state[MOST * n + second])
        for i in range(n):
            if state[SLOT * n + i] == second:
                state[SLOT * n + i] = first
        return 0

    def put_within(self, a: int, b: int) -> bool:
        """Let the token of `a` end no later than that of `b`; false if there is no room to remember that."""
        n = self.lines
        state = self.state
        if state[SLOT * n + a] == state[SLOT * n + b]:
            return True
        count = state[self.pairs]
        if count == PAIRS:
            return False
        at = self.pairs + 1 + 4 * count
        state[at] = a
        state[at + 1] = b
        state[at + 2] = state[START * n + a]
        state[at + 3] = state[START * n + b]
        state[self.pairs] = count + 1
        return True

    def start(self, i: int, predicate: int) -> int:
        """Make a token of `predicate` the current one of a timeline."""
        n = self.lines
        state = self.state
        state[BEFORE * n + i] = state[PREDICATE * n + i]
        state[PREDICATE * n + i] = predicate
        state[START * n + i] = self.now
        # Tokens that were tied to the one before have ended with it.
        state[SLOT * n + i] = i
        state[LEAST * n + i] = self.now + 1
        state[MOST * n + i] = FAR
        self.changed |= 1 << i
        return 0
