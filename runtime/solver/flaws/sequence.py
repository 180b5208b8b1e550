"""The sequence of a timeline, and exact tests of its times against those of one token."""

from runtime.constraints.domains.arrays import blank, grow_rows, lengthen
from runtime.constraints.stn.reach import Reach
from runtime.plan.store.plan import Plan
from runtime.plan.tags import END, LIST_ORDER, LISTS, START
from runtime.solver.tags import NONE


class TimelineSequence:
    """The tokens of the timeline looked at last; the reaches hold until the plan changes."""

    def __init__(self, plan: Plan, exact: bool) -> None:
        self.plan = plan
        self.rows = plan.rows
        self.from_start = Reach(plan.engine, exact)
        self.to_start = Reach(plan.engine, exact)
        self.from_end = Reach(plan.engine, exact)
        self.to_end = Reach(plan.engine, exact)
        self.tokens = blank(64)
        self.index_of = blank(64)  # by token, for the object of the range
        self.range_object = NONE  # on which tokens are known that may coincide with the one looked around from
        self.range_first = self.range_end = 0  # between these indices only

    def take(self, o: int) -> int:
        """Copy the tokens of timeline `o` into `tokens`; how many there are."""
        count = 0
        t = self.rows.head_first[self.plan.object_head[o]]
        while t >= 0:
            if count == len(self.tokens):
                lengthen(self, "tokens")
            self.tokens[count] = t
            count += 1
            t = self.rows.link_after[LISTS * t + LIST_ORDER]
        return count

    def look_around(self, t: int) -> None:
        """Have the reaches answer for the times of token `t`."""
        v = self.rows.var0[t]
        self.from_start.begin(v + START, True)
        self.to_start.begin(v + START, False)
        self.from_end.begin(v + END, True)
        self.to_end.begin(v + END, False)
        self.range_object = NONE

    def note_range(self, o: int, count: int, first: int, end: int) -> None:
        """Of the `count` tokens of timeline `o` only those from `first` to before `end` may coincide."""
        if len(self.index_of) < len(self.rows.status):
            grow_rows(self, "index_of", len(self.rows.status))
        self.range_object = o
        self.range_first = first
        self.range_end = end
        for index in range(count):
            self.index_of[self.tokens[index]] = index
