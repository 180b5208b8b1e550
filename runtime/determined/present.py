# cython: boundscheck=False
"""What holds on each timeline of a determined reactor: current tokens, the bounds of their ends, what is to come.

The end of a token is a pair of bounds in a slot; tokens that end together share one. Orders of two ends are pairs of
timelines, valid while both tokens hold. All of it is in one array, so that a snapshot is one copy.

A present is steady while one timeline alone makes token after token of its own and nothing else can change what is due.
Then a tick touches that timeline and the ends that its token orders; whatever else a block does makes it unsteady.
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
    OWN_LEAST,
    OWN_MOST,
    OWNER,
    PAIRS,
    PREDICATE,
    SECTIONS,
    SLOT,
    START,
    WISH,
    WISH_END_FROM,
    WISH_END_UNTIL,
    WISH_FROM,
    WISH_LEAST,
    WISH_MOST,
    WISH_PREDICATE,
    WISH_UNTIL,
)


class Present:
    """The state of all timelines at a tick."""

    def __init__(self, lines: int) -> None:
        self.lines = lines
        self.pairs = SECTIONS * lines  # where orders of ends begin: their number, then four numbers each
        size = 8 * (SECTIONS * lines + 1 + 4 * PAIRS)
        self.state = array("q", bytes(size))
        self.kept = array("q", bytes(size))
        self.flags = array("q", bytes(8 * lines))
        self.is_used = array("q", bytes(8 * lines))  # timelines of other reactors
        self.now = 0
        self.reach = 1  # how many ticks ahead of its window a request is looked at
        self.changed = 0  # a bit for each timeline on which a token has started at this tick
        self.alone = NONE  # the only timeline to which something happens at the next event, if there is just one
        self.steady = NONE  # the timeline whose tokens follow each other, as long as nothing else happens
        self.rest = FAR  # the first tick at which something else may happen
        for i in range(lines):
            self.state[PREDICATE * lines + i] = NONE
            self.state[SLOT * lines + i] = i
            self.state[MOST * lines + i] = FAR
            self.state[FOLLOWER * lines + i] = NONE
            self.state[WISH * lines + i] = NONE
            self.state[BEFORE * lines + i] = NONE

    def begin_wish(self, i: int) -> int:
        """Bound the end of a token that somebody asked for, that starts now, and whose own rules have bound it."""
        n = self.lines
        now = self.now
        slot = self.state[SLOT * n + i]
        self.state[OWN_LEAST * n + i] = self.state[LEAST * n + slot]
        self.state[OWN_MOST * n + i] = self.state[MOST * n + slot]
        least = max(now + self.state[WISH_LEAST * n + i], self.state[WISH_END_FROM * n + i])
        most = min(now + self.state[WISH_MOST * n + i], self.state[WISH_END_UNTIL * n + i])
        self.state[LEAST * n + slot] = max(self.state[LEAST * n + slot], least)
        self.state[MOST * n + slot] = min(self.state[MOST * n + slot], most)
        return 0

    def coming(self, tick: int) -> int:
        """The next event, as long as nobody but the machine has changed anything since it was last asked for."""
        if self.steady >= 0:
            due = self.state[MOST * self.lines + self.steady]
            if tick < due < self.rest:
                return due
            self.steady = NONE
        return self.next_event(tick)

    def next_event(self, tick: int) -> int:
        """The first tick after `tick` at which something may end or start by itself."""
        n = self.lines
        found = FAR
        self.alone = NONE
        for i in range(n):
            if self.state[PREDICATE * n + i] < 0:
                if not self.is_used[i]:
                    self.alone = NONE
                    return tick + 1
                continue
            slot = self.state[SLOT * n + i]
            if self.state[MOST * n + slot] <= found:
                self.alone = i if self.state[MOST * n + slot] < found else NONE
                found = self.state[MOST * n + slot]
            if self.state[WISH * n + i] >= 0:
                # A wish is looked at as soon as the token before it may end.
                due = self.state[WISH_FROM * n + i]
                if due - self.reach > tick:
                    due -= self.reach
                elif self.state[LEAST * n + slot] > due:
                    due = self.state[LEAST * n + slot]
                if due <= found:
                    self.alone = NONE
                    found = due
        if found <= tick:
            self.alone = NONE
            return tick + 1
        return found

    def steps_alone(self, tick: int) -> bool:
        """Begin a tick at which a token of one timeline, `alone`, ends, with no other, and is followed by its own.

        False, and nothing done, if other tokens may have to end with it.
        """
        n = self.lines
        i = self.alone
        if self.steady >= 0:
            self.now = tick
            self.changed = 0
            self.state[DUE * n + i] = self.state[FOLLOWER * n + i]
            self.state[FOLLOWER * n + i] = NONE
            return True
        if i < 0 or self.is_used[i] or self.state[FOLLOWER * n + i] < 0 or self.state[OWNER * n + i] != i:
            return False
        if self.state[LEAST * n + self.state[SLOT * n + i]] > tick:
            return False
        for j in range(n):
            if j != i and self.state[FOLLOWER * n + j] >= 0 and self.state[OWNER * n + j] == i:
                return False
            if self.state[WISH * n + j] >= 0 and self.state[WISH_FROM * n + j] <= tick:
                return False
        pairs = self.pairs
        for k in range(self.state[pairs]):
            if self.state[pairs + 2 + 4 * k] == i and self.is_kept(pairs + 1 + 4 * k):
                return False
        self.now = tick
        self.changed = 0
        for j in range(n):
            self.state[ENDING * n + j] = 0
            self.state[DUE * n + j] = NONE
        self.state[ENDING * n + i] = 1
        self.state[DUE * n + i] = self.state[FOLLOWER * n + i]
        self.state[FOLLOWER * n + i] = NONE
        return True

    def begin_tick(self, tick: int) -> bool:
        """Find what ends at `tick`; false if something should and may not."""
        n = self.lines
        self.now = tick
        self.changed = 0
        self.alone = NONE
        self.steady = NONE
        for i in range(n):
            self.state[ENDING * n + i] = 0
            self.state[DUE * n + i] = NONE
        for i in range(n):
            if self.state[PREDICATE * n + i] >= 0 and not self.state[ENDING * n + i]:
                most = self.state[MOST * n + self.state[SLOT * n + i]]
                if most < tick or (most == tick and not self.end_with(i)):
                    return False
        for i in range(n):
            if self.state[WISH * n + i] >= 0 and self.state[WISH_FROM * n + i] <= tick:
                if self.state[WISH_UNTIL * n + i] < tick:
                    return False
                if self.state[PREDICATE * n + i] >= 0 and not self.state[ENDING * n + i] and not self.end_with(i):
                    if self.is_used[i]:
                        return False
        return True

    def end_with(self, i: int) -> bool:
        """End the token of a timeline now, with all that must end with it; false if it cannot."""
        n = self.lines
        # What has started at this tick (2) neither ends nor has others end.
        for j in range(n):
            self.flags[j] = 2 if self.changed >> j & 1 else self.state[ENDING * n + j]
        self.flags[i] = 1
        grows = True
        while grows:
            grows = False
            for j in range(n):
                if self.flags[j] == 1 and self.state[PREDICATE * n + j] >= 0:
                    slot = self.state[SLOT * n + j]
                    for k in range(n):
                        is_tied = self.state[SLOT * n + k] == slot and self.state[PREDICATE * n + k] >= 0
                        if is_tied and self.flags[k] == 0:
                            self.flags[k] = 1
                            grows = True
                elif (
                    self.flags[j] == 0
                    and self.state[FOLLOWER * n + j] >= 0
                    and self.flags[self.state[OWNER * n + j]] == 1
                ):
                    self.flags[j] = 1
                    grows = True
            for k in range(self.state[self.pairs]):
                at = self.pairs + 1 + 4 * k
                if self.flags[self.state[at + 1]] == 1 and self.flags[self.state[at]] == 0 and self.is_kept(at):
                    self.flags[self.state[at]] = 1
                    grows = True
        for j in range(n):
            if self.flags[j] == 1 and not self.state[ENDING * n + j] and self.state[PREDICATE * n + j] >= 0:
                if self.state[LEAST * n + self.state[SLOT * n + j]] > self.now:
                    return False
                # Unless another reactor has published something there now.
                if self.is_used[j] and (self.state[WISH * n + j] < 0 or self.state[WISH_FROM * n + j] != self.now):
                    return False
        for j in range(n):
            if self.flags[j] == 1:
                self.state[ENDING * n + j] = 1
        return True

    def is_kept(self, at: int) -> bool:
        """Whether an order of two ends still speaks of the tokens that hold."""
        n = self.lines
        first = self.state[START * n + self.state[at]]
        return bool(self.state[at + 2] == first and self.state[at + 3] == self.state[START * n + self.state[at + 1]])

    def end_tick(self, tick: int) -> bool:
        """Let ends that are ordered bound each other; something must hold on each timeline of the reactor."""
        n = self.lines
        pairs = self.pairs
        count = self.state[pairs]
        if self.steady >= 0 and self.stays_steady(tick):
            return True
        grows = True
        while grows:
            grows = False
            for k in range(count):
                at = pairs + 1 + 4 * k
                if self.is_kept(at) and self.order_ends(self.state[at], self.state[at + 1]):
                    grows = True
            for i in range(n):
                owner = self.state[OWNER * n + i]
                if self.state[FOLLOWER * n + i] >= 0 and owner != i and self.state[PREDICATE * n + i] >= 0:
                    if self.order_ends(i, owner):
                        grows = True
        for i in range(n):
            if self.state[PREDICATE * n + i] < 0:
                if not self.is_used[i]:
                    return False
                continue
            slot = self.state[SLOT * n + i]
            if self.state[LEAST * n + slot] > self.state[MOST * n + slot] or self.state[MOST * n + slot] <= tick:
                return False
            if self.state[ENDING * n + i] and not self.changed >> i & 1:
                return False
            if self.state[WISH * n + i] >= 0 and not self.has_room(i, tick):
                return False
        # An order whose first end is past has said what it has to say.
        left = 0
        for k in range(count):
            at = pairs + 1 + 4 * k
            slot = self.state[SLOT * n + self.state[at]]
            if self.is_kept(at) and self.state[LEAST * n + slot] != self.state[MOST * n + slot]:
                for j in range(4):
                    self.state[pairs + 1 + 4 * left + j] = self.state[at + j]
                left += 1
        self.state[pairs] = left
        self.steady = self.alone if self.becomes_steady(tick) else NONE
        return True

    def becomes_steady(self, tick: int) -> bool:
        """Whether only the timeline `alone` changes after `tick`, up to before `rest`."""
        n = self.lines
        i = self.alone
        if i < 0 or self.changed != 1 << i or self.state[self.pairs] or self.state[SLOT * n + i] != i:
            return False
        if self.state[FOLLOWER * n + i] < 0:
            return False
        self.rest = FAR
        for j in range(n):
            if self.state[FOLLOWER * n + j] >= 0 and self.state[OWNER * n + j] != j:
                return False
            if self.state[WISH * n + j] >= 0:
                if self.state[WISH_FROM * n + j] - self.reach <= tick:
                    return False
                self.rest = min(self.rest, self.state[WISH_FROM * n + j] - self.reach)
            if j != i and self.state[PREDICATE * n + j] >= 0:
                if self.state[SLOT * n + j] == i:
                    return False
                self.rest = min(self.rest, self.state[MOST * n + self.state[SLOT * n + j]])
        return True

    def stays_steady(self, tick: int) -> bool:
        """End a tick at which only the steady timeline has changed; false, and nothing lost, if there is more to do."""
        n = self.lines
        i = self.steady
        least = self.state[LEAST * n + i]
        if self.state[FOLLOWER * n + i] < 0 or least != self.state[MOST * n + i] or least <= tick:
            return False
        for k in range(self.state[self.pairs]):
            at = self.pairs + 1 + 4 * k
            slot = self.state[SLOT * n + self.state[at + 1]]
            if self.state[at] != i or self.state[MOST * n + slot] < least:
                return False
            if self.state[LEAST * n + slot] < least:
                self.state[LEAST * n + slot] = least
        self.state[self.pairs] = 0
        return True

    def has_room(self, i: int, tick: int) -> bool:
        """Whether what was asked for on a timeline can still start in its window, if it is time to look."""
        n = self.lines
        if self.state[WISH * n + i] < 0 or self.state[WISH_FROM * n + i] - self.reach > tick:
            return True
        least = self.state[LEAST * n + self.state[SLOT * n + i]] if self.state[PREDICATE * n + i] >= 0 else 0
        return bool(max(least, tick + 1) <= self.state[WISH_UNTIL * n + i])

    def order_ends(self, a: int, b: int) -> bool:
        """Let the end of `a` be no later than that of `b`; whether a bound has moved."""
        n = self.lines
        first = self.state[SLOT * n + a]
        second = self.state[SLOT * n + b]
        moved = False
        if self.state[MOST * n + first] > self.state[MOST * n + second]:
            self.state[MOST * n + first] = self.state[MOST * n + second]
            moved = True
        if self.state[LEAST * n + second] < self.state[LEAST * n + first]:
            self.state[LEAST * n + second] = self.state[LEAST * n + first]
            moved = self.state[MOST * n + second] >= self.state[LEAST * n + second]
        return moved

    def bound(self, i: int, duration: int, is_least: bool, is_most: bool) -> int:
        """Bound the duration of a token from below, from above, or both."""
        n = self.lines
        slot = self.state[SLOT * n + i]
        end = self.state[START * n + i] + duration
        if slot != self.steady:
            self.steady = NONE
        if is_least and end > self.state[LEAST * n + slot]:
            self.state[LEAST * n + slot] = end
        if is_most and end < self.state[MOST * n + slot]:
            self.state[MOST * n + slot] = end
        return 0

    def follow(self, i: int, owner: int, block: int) -> int:
        """Let a token of a block follow on a timeline as soon as the token of `owner` ends."""
        if i != self.steady or i != owner:
            self.steady = NONE
        self.state[FOLLOWER * self.lines + i] = block
        self.state[OWNER * self.lines + i] = owner
        return 0

    def tie(self, a: int, b: int) -> int:
        """Let the tokens of two timelines end together."""
        n = self.lines
        first = self.state[SLOT * n + a]
        second = self.state[SLOT * n + b]
        if first == second:
            return 0
        self.steady = NONE
        self.state[LEAST * n + first] = max(self.state[LEAST * n + first], self.state[LEAST * n + second])
        self.state[MOST * n + first] = min(self.state[MOST * n + first], self.state[MOST * n + second])
        for i in range(n):
            if self.state[SLOT * n + i] == second:
                self.state[SLOT * n + i] = first
        return 0

    def put_within(self, a: int, b: int) -> bool:
        """Let the token of `a` end no later than that of `b`; false if there is no room to remember that."""
        n = self.lines
        if self.state[SLOT * n + a] == self.state[SLOT * n + b]:
            return True
        count = self.state[self.pairs]
        if count == PAIRS:
            return False
        at = self.pairs + 1 + 4 * count
        self.state[at] = a
        self.state[at + 1] = b
        self.state[at + 2] = self.state[START * n + a]
        self.state[at + 3] = self.state[START * n + b]
        self.state[self.pairs] = count + 1
        return True

    def start(self, i: int, predicate: int) -> int:
        """Make a token of `predicate` the current one of a timeline."""
        n = self.lines
        if i != self.steady:
            self.steady = NONE
        is_alike = self.state[WISH * n + i] >= 0 and self.state[WISH_PREDICATE * n + i] == predicate
        if is_alike and self.state[WISH_FROM * n + i] <= self.now <= self.state[WISH_UNTIL * n + i]:
            self.state[WISH_UNTIL * n + i] = NONE  # the planner may merge both, so that there is no room for another
        self.state[BEFORE * n + i] = self.state[PREDICATE * n + i]
        self.state[PREDICATE * n + i] = predicate
        self.state[START * n + i] = self.now
        # Tokens that were tied to the one before have ended with it.
        self.state[SLOT * n + i] = i
        self.state[LEAST * n + i] = self.now + 1
        self.state[MOST * n + i] = FAR
        self.changed |= 1 << i
        return 0
