"""Explanations: the causes that the present conflict, or a bound, rests on."""

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    CONFLICT_CYCLE,
    CONFLICT_DOMAIN,
    FLAG_VALUES,
    KIND_BOOL,
    KIND_FLOAT,
    SIDE_HOLES,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_EDGE,
    SUPPORT_RESTRICTION,
)
from runtime.constraints.explanation.cause import Cause, CauseKind, Link
from runtime.constraints.explanation.reasons import collect_all_reasons
from runtime.constraints.explanation.support_walk import SupportWalk
from runtime.constraints.propagators.opcodes import OP_EXTERNAL


def cause_of(s: Store, support: int) -> Cause | None:
    """Name what a support stands for; constants and what the engine itself holds have no cause."""
    name = support >> 2
    if support < 0:
        return None
    if support & 3 == SUPPORT_EDGE:
        if s.edge_link[name] < 0:
            return Cause(CauseKind.EDGE, name, s.edge_span[name], s.edge_owner[name])
        name = s.edge_link[name]
    elif support & 3 == SUPPORT_RESTRICTION:
        if s.constant[s.restriction_variable[name]]:
            return None
        return Cause(CauseKind.RESTRICTION, name, s.restriction_span[name], s.restriction_owner[name])
    return Cause(CauseKind.CONSTRAINT, name, s.span[name], s.owner[name])


class _CauseWalk(SupportWalk):
    """The visitor that collects causes, and the links of a chain, those nearest to the start first."""

    def __init__(self, engine: Store) -> None:
        super().__init__(engine)
        self.notes_sets = True
        self.found: dict[Cause, None] = {}
        self.links: list[Link] = []
        self.committed: set[tuple[int, int, int]] = set()
        self.start()

    def visit(self, support: int, v: int, side: int, when: int) -> bool:
        """Collect the cause of a change, with its link; constants and what the engine itself holds are none."""
        if when < self.engine.trail_base:
            if (v, side, when) in self.committed:
                return False
            self.committed.add((v, side, when))
        cause = cause_of(self.engine, support)
        if cause is None:
            return False
        self.found[cause] = None
        self.links.append(Link(cause, v, side, self.value(v, side)))
        return True

    def visit_support(self, support: int) -> None:
        """Collect the cause that a support stands for."""
        cause = cause_of(self.engine, support)
        if cause is not None:
            self.found[cause] = None

    def visit_set(self, v: int) -> None:
        """Collect the declaration and the listings of a variable: they left values out from the start.

        That is more than what was read, where the values left out do not matter.
        """
        s = self.engine
        r = s.restriction_head[v]
        while r >= 0:
            if s.restriction_flags[r] & FLAG_VALUES or s.restriction_next[r] < 0:
                self.visit_support(r * 4 + SUPPORT_RESTRICTION)
            r = s.restriction_next[r]

    def value(self, v: int, side: int) -> float:
        """Value of the bound that was looked up last; holes have none."""
        s = self.engine
        if side == SIDE_HOLES:
            return 0.0
        is_real = s.kind[v] == KIND_FLOAT
        if self.overwritten >= 0:
            value = s.trail_value[self.overwritten]
            return float(s.real_bounds[value] if is_real else value)
        if side == SIDE_LOWER:
            return float(s.flo[v] if is_real else s.lb[v])
        return float(s.fhi[v] if is_real else s.ub[v])

    def ask_conflict(self) -> int:
        """Ask for all that the present conflict was derived from."""
        s = self.engine
        now = s.trail_base + s.trail_size
        support = s.conflict_support
        v = s.conflict_variable
        side = s.conflict_side
        if s.conflict_kind == CONFLICT_CYCLE:
            self.ask_cycle(now)
            return 0
        self.visit_support(support)
        if s.conflict_kind == CONFLICT_DOMAIN:
            self.ask_reasons(support, v, side, now)
            # The last value of a bool is taken from where it stands, so both of its bounds count.
            if side != SIDE_UPPER or s.kind[v] == KIND_BOOL:
                self.ask(v, SIDE_UPPER, now)
            if side != SIDE_LOWER or s.kind[v] == KIND_BOOL:
                self.ask(v, SIDE_LOWER, now)
            return 0
        collect_all_reasons(s, support >> 2)
        self.ask_collected(now)
        if s.op[support >> 2] == OP_EXTERNAL:
            for e in s.externals[support >> 2].edges:
                self.ask_edge(e, now)
        return 0

    def ask_cycle(self, now: int) -> None:
        """Collect the edges of a negative cycle, and ask for the distances that their weights follow."""
        s = self.engine
        e = s.conflict_support >> 2
        side = s.conflict_side
        time = now
        self.ask_edge(e, time)
        while e != s.conflict_edge:
            self.look_up(s.edge_source[e] if side == SIDE_UPPER else s.edge_target[e], side, time)
            assert self.support & 3 == SUPPORT_EDGE
            time = self.when
            e = self.support >> 2
            self.ask_edge(e, time)


def explain_conflict(s: Store) -> list[Cause]:
    """Give the causes of the present conflict, those nearest to it first."""
    walk = _CauseWalk(s)
    walk.ask_conflict()
    walk.walk()
    return list(walk.found)


def explain_bound(s: Store, v: int, side: int) -> list[Link]:
    """Give the chain of causes that holds one side of a domain where it is, the nearest first."""
    walk = _CauseWalk(s)
    walk.ask(v, side, s.trail_base + s.trail_size)
    walk.walk()
    return walk.links
