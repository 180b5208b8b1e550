"""The past that rules look back at: what is over stays, as a bare fact, where a rule may ask for it later.

Archiving and forgetting take a token out of the plan with all that its rules made. A rule of a token that begins later
may ask for one that was over before, and what has happened is no less true for having been archived.
"""

from collections.abc import Iterable
from math import inf
from typing import NamedTuple

from runtime.executive.messages import Arguments
from runtime.executive.outlines import forms_of
from runtime.executive.timelines import TimelineState
from runtime.executive.view import SPAN_OBSERVATION
from runtime.executive.workbench import Workbench
from runtime.plan.lifecycle import fire
from runtime.plan.store.links import link_by_key, unlink
from runtime.plan.tags import ACTIVE, LIST_PREDICATE, NONE, RESOURCE_CONSUMES, RESOURCE_PRODUCES
from runtime.plan.tokens.predicate_hierarchy import active_head, first_active, next_active
from runtime.plan.tokens.tokens import activation, restore_key, return_key

_MOST = 64  # of each predicate on each timeline: the plan stays small in long missions


class OverToken(NamedTuple):
    """What is kept of a token that is over, and the row that it had."""

    row: int
    key: int
    predicate: int
    object: int
    start: float
    end: float
    arguments: Arguments


class _OtherUses:
    """Relief while uses are put back one by one: others may come."""

    def may_come(self, o: int, sign: int) -> bool:
        """Whether the level of a resource is judged later."""
        return True


class Past:
    """What one reactor keeps of what is over."""

    def __init__(self, bench: Workbench) -> None:
        self.bench = bench
        self.predicates = forms_of(bench.database.program).looked_back
        self._tick = 0  # of archiving
        self._gone: list[OverToken] = []
        bench.recorder.witness = self._note
        self._kept: dict[tuple[int, int], list[tuple[int, int]]] = {}  # by timeline and predicate: rows and keys

    def archive(self, timelines: list[TimelineState], tick: int) -> int:
        """Take out of the plan what is over, but for what rules may look back at; how many tokens went."""
        self._tick = tick
        count = self.bench.archive(timelines, tick)
        if self._gone:
            self.keep(self._gone)
            self._gone = []
        return count

    def _note(self, tokens: list[int]) -> None:
        """Note what those of some tokens were that leave the plan and may be asked for."""
        if not self.predicates:
            return
        plan, rows = self.bench.plan, self.bench.rows
        heads = {active_head(plan, rows.predicate[t]) for t in tokens if rows.status[t] == ACTIVE}
        leaving = set(tokens)
        self._gone = [self._outline(t) for t in self._found(self._tick, heads) if t in leaving]

    def outlines(self, tick: int) -> list[OverToken]:
        """What is over by `tick` on shared timelines and may be asked for later."""
        return [self._outline(t) for t in self._found(tick)]

    def uses(self, tick: int) -> list[OverToken]:
        """What has been given to reservoirs and taken from them by `tick`: the levels of today come of it."""
        bench, kinds = self.bench, self.bench.plan.predicate_resource
        return [
            self._outline(t)
            for t in bench.all_tokens()
            if kinds[bench.predicate_of(t)] in (RESOURCE_PRODUCES, RESOURCE_CONSUMES)
            and bench.rows.status[t] == ACTIVE
            and not bench.is_kept(t)
            and bench.is_over(t, tick)
            and -inf < bench.started_at(t)
        ]

    def _found(self, tick: int, heads: set[int] | None = None) -> list[int]:
        """The tokens of `outlines`, by predicate and key; those on some lists of active tokens, if these are given."""
        bench = self.bench
        found: dict[int, None] = {}
        for predicate in self.predicates:
            if heads is not None and active_head(bench.plan, predicate) not in heads:
                continue
            t = first_active(bench.plan, predicate)
            while t >= 0:
                if not bench.is_kept(t) and bench.upper(bench.end(t)) <= tick and -inf < bench.started_at(t):
                    o = bench.object_of(t)
                    if o in bench.internal_objects or o in bench.external_objects:
                        found[t] = None
                t = next_active(bench.plan, t, predicate)
        return list(found)

    def _outline(self, t: int) -> OverToken:
        bench = self.bench
        start, end = bench.started_at(t), bench.upper(bench.end(t))
        return OverToken(t, bench.key(t), bench.predicate_of(t), bench.object_of(t), start, end, bench.arguments(t))

    def keep(self, outlines: Iterable[OverToken]) -> int:
        """Put back what has left the plan; of too many the oldest goes."""
        bench = self.bench
        for one in outlines:
            if not bench.is_alive(one.row, one.key):
                self.put_back(one)
        return 0

    def put_back(self, one: OverToken) -> None:
        """Put one token that has left the plan, or never was in it, back as a fact without rules."""
        bench = self.bench
        mark = bench.mark()
        t = self._made(one)
        holds = t >= 0 and bench.stand_alone(t, one.object)
        if not holds:
            bench.rewind_to(mark)
        bench.commit()
        if holds:
            return_key(bench.plan)
            bench.note_kept(t)
            self._forget_oldest(t, one)

    def put_back_uses(self, uses: Iterable[OverToken]) -> bool:
        """Put what was given to reservoirs and taken from them back, as facts; False if the plan does not bear it.

        Levels are those of all of them: one alone may be more than there is room for.
        """
        plan = self.bench.plan
        plan.resources.relief, holds = _OtherUses(), True
        for one in uses:
            t = self._made(one) if holds else NONE
            holds = t >= 0
            if holds:
                return_key(plan)
                self.bench.note_kept(t)
        plan.resources.relief = None
        return holds and fire(plan)

    def _made(self, one: OverToken) -> int:
        """A fact without rules, with what is known of the token that is over; NONE where that is inconsistent."""
        bench, plan = self.bench, self.bench.plan
        t = bench.new_token(one.predicate, one.object, True)
        restore_key(plan, t, one.key)
        is_active = bench.rows.status[t] == ACTIVE  # a use of a resource is from the beginning
        if is_active:
            unlink(plan.rows, t, LIST_PREDICATE)
            link_by_key(plan.rows, t, LIST_PREDICATE, active_head(plan, one.predicate))
        holds = (
            bench.fix(bench.start(t), one.start, SPAN_OBSERVATION, t)
            and bench.fix(bench.end(t), one.end, SPAN_OBSERVATION, t)
            and bench.restrict_parameters(t, one.arguments, SPAN_OBSERVATION)
        )
        if holds and not is_active:
            waiting = plan.stack_length
            activation(plan, t, SPAN_OBSERVATION)
            plan.stack_length = waiting  # its rules have had their say when it was executed
            holds = fire(plan)
        return t if holds else NONE

    def _forget_oldest(self, t: int, one: OverToken) -> None:
        """Of too many tokens of a predicate that stay on a timeline, take the oldest away; `t` is the newest."""
        bench = self.bench
        line = self._kept.setdefault((one.object, one.predicate), [])
        line.append((t, one.key))
        if len(line) > _MOST:
            oldest, key = line.pop(0)
            if bench.is_alive(oldest, key) and bench.rows.merged[oldest] < 0:
                bench.remove([oldest])
