"""Walk over supports: from bounds back to the edges, constraints and restrictions that they rest on.

The walk goes back in time: a support is asked what it read, and of each bound that it read the state before the support
acted counts, as the trail remembers it. Of what was committed only the last state is known, which is at least as tight.
Each change is visited once, so the walk ends. A subclass notes what it is after, and may end the walk sooner.
"""

from runtime.constraints.domains.arrays import blank, grow_rows, lengthen
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import SIDE_HOLES, SIDE_LOWER, SUPPORT_EDGE
from runtime.constraints.explanation.reasons import collect_reasons, collect_weight_reasons


class SupportWalk:
    """Breadth-first walk; `seen[i] == stamp` for the entries of the trail that were visited."""

    def __init__(self, engine: Store) -> None:
        self.engine = engine
        self.stamp = 0
        self.origin = 0  # what was changed before needs no reason; declarations have no time
        self.notes_sets = False
        self.seen = blank(256)
        self.asked_key = blank(256)  # bounds to explain, `v * 4 + side`, and the time before which their state counts
        self.asked_before = blank(256)
        self.asked_count = 0
        self.answered = 0
        # The state that was looked up last: its support, its time, the trail entry that overwrote it (-1: it stands).
        self.support = -1
        self.when = -1
        self.overwritten = -1

    def visit(self, support: int, v: int, side: int, when: int) -> bool:
        """Note that `support` changed a side of `v` at a time; True to go on to what it read.

        A walk that notes nothing goes back as far as the trail remembers.
        """
        return when >= self.engine.trail_base

    def visit_support(self, support: int) -> None:
        """Note an edge, constraint or restriction by itself."""

    def visit_set(self, v: int) -> None:
        """Note a variable with a bit set, where `notes_sets`: what it lacked from the start is in no log."""

    def ask_more(self) -> bool:
        """Ask for further bounds when all are answered; False if there are none."""
        return False

    def start(self) -> None:
        """Begin a walk: nothing is asked and nothing was visited."""
        self.stamp += 1
        self.asked_count = self.answered = 0
        if len(self.seen) < len(self.engine.trail_key):
            grow_rows(self, "seen", len(self.engine.trail_key))

    def ask(self, v: int, side: int, before: int) -> None:
        """Ask why a side of `v` was as it was before a time."""
        if self.asked_count == len(self.asked_key):
            lengthen(self, "asked_key asked_before")
        self.asked_key[self.asked_count] = v * 4 + side
        self.asked_before[self.asked_count] = before
        self.asked_count += 1

    def ask_reasons(self, support: int, v: int, side: int, before: int) -> None:
        """Ask for all bounds that a support read when it narrowed a side of `v`."""
        collect_reasons(self.engine, support, v, side)
        self.ask_collected(before)

    def ask_edge(self, e: int, before: int) -> None:
        """Note an edge, and ask for the bound of the distance that its weight follows, if it does."""
        self.visit_support(e * 4 + SUPPORT_EDGE)
        collect_weight_reasons(self.engine, e)
        self.ask_collected(before)

    def ask_collected(self, before: int) -> None:
        """Ask for all bounds among the collected reasons."""
        for k in range(self.engine.reason_count):
            self.ask(self.engine.reasons[k] >> 2, self.engine.reasons[k] & 3, before)

    def look_up(self, v: int, side: int, before: int) -> None:
        """Find support and time of a bound as it was before a time; of committed changes the last is known."""
        engine = self.engine
        support = engine.lower_support[v] if side == SIDE_LOWER else engine.upper_support[v]
        when = engine.lower_when[v] if side == SIDE_LOWER else engine.upper_when[v]
        at = -1
        while when >= before and when >= engine.trail_base:
            at = when - engine.trail_base
            support = engine.trail_support[at]
            when = engine.trail_when[at]
        self.support = support
        self.when = when
        self.overwritten = at

    def walk(self) -> None:
        """Answer all that was asked, and what that asks in turn, the nearest first."""
        engine = self.engine
        while self.answered < self.asked_count or self.ask_more():
            if self.answered == self.asked_count:
                continue
            v = self.asked_key[self.answered] >> 2
            side = self.asked_key[self.answered] & 3
            before = self.asked_before[self.answered]
            self.answered += 1
            if engine.constant[v]:
                continue
            if side != SIDE_HOLES:
                self.look_up(v, side, before)
                self.follow(self.support, v, side, self.when, before)
            if engine.word[v] >= 0:  # a bound of a set is rounded to a value that is no hole
                hole = engine.hole_head[v]
                while hole >= 0:
                    when = engine.hole_when[hole]
                    at = when - engine.trail_base
                    if at < 0 or (when < before and self.seen[at] != self.stamp):
                        self.follow(engine.hole_support[hole], v, SIDE_HOLES, when, before)
                    hole = engine.hole_next[hole]
                if self.notes_sets:
                    self.visit_set(v)

    def follow(self, support: int, v: int, side: int, when: int, before: int) -> int:
        """Visit a change, unless that was done, and ask for what it read."""
        if 0 <= when < self.origin:
            return 0
        at = when - self.engine.trail_base
        if at >= 0:
            if self.seen[at] == self.stamp:
                return 0
            self.seen[at] = self.stamp
        if support >= 0 and self.visit(support, v, side, when):
            # A change that was committed tells no time: what it read is taken as it was at the later step.
            self.ask_reasons(support, v, side, when if at >= 0 else before)
        return 0
