"""Timelines of tokens that are listed one by one: where they plainly follow each other, and are what was published."""

from collections.abc import Mapping
from operator import itemgetter

from checker.judge.bench import Bench
from checker.judge.bulk_timelines import Publications, count_held
from checker.judge.values import hull
from compiler.program import PredicateCode
from runtime.executive.record import TokenRecord, Value

_START = itemgetter(TokenRecord._fields.index("start"))


class PlainTimelines:
    """The tokens that have begun on each timeline of a reactor, in the order of their starts."""

    def __init__(self, bench: Bench, timelines: frozenset[str]) -> None:
        self.bench = bench
        self.rows: dict[str, list[TokenRecord]] = {}
        self.observed: dict[Value, set[int]] = {}  # at which ticks something was, by timeline
        lines: dict[Value, list[TokenRecord]] = {}
        last = bench.last_tick
        for one in bench.tokens.by_key.values():
            state, start = one[3], one[5]
            is_active = state == "active"
            if not isinstance(start, int) or not (is_active or state == "merged"):
                continue
            if one[9] == "observation":
                self.observed.setdefault(one[2], set()).add(start)
            if is_active and start <= last and (start >= 0 or not _is_past(one)):
                lines.setdefault(one[2], []).append(one)
        for name, tokens in lines.items():
            if isinstance(name, str) and bench.members.get(name, ("",))[0] in timelines:
                self.rows[name] = sorted(tokens, key=_START)

    def is_in_order(self, timeline: str, is_shared: bool) -> bool:
        """Whether tokens plainly follow each other, on a shared timeline without a gap; if so it is counted."""
        tokens = self.rows[timeline]
        before: int | None = None
        for one in tokens:
            start, end = one[5], one[6]
            if one[10] == "cut" or not isinstance(start, int):
                return False
            if before is not None and (start != before if is_shared else start < before):
                return False
            if isinstance(end, int):
                if end < start:
                    return False
                before = end
            elif one is not tokens[-1]:
                return False
            else:
                before = None
        if is_shared:
            ends = hull(tokens[-1].end)
            if ends is None or ends[1] <= self.bench.last_tick:
                return False
        self.bench.judged += len(tokens)
        return True

    def is_told(self, timeline: str, published: Publications, codes: Mapping[str, PredicateCode], is_own: bool) -> bool:
        """Whether each token plainly began with what was published, and nothing else was; if so it is counted."""
        seen = None if is_own else self.observed.get(timeline, set())
        count = count_held(self.rows.get(timeline, []), published, self.bench.last_tick, codes, seen)
        self.bench.judged += max(count, 0)
        return count >= 0


def _is_past(one: TokenRecord) -> bool:
    """Whether a token is what the script tells of the time before the mission."""
    ends = hull(one.end)
    return ends is not None and ends[1] <= 0
