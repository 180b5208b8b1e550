"""Minimal explanations: check that a set of causes is itself inconsistent, and shrink it, in a scratch engine.

What propagation finds depends on what is known: a function that waits for its arguments says nothing before, so all
that makes them known seems needed. Therefore a second pass leaves out what is not needed by what the constraints mean:
there functions narrow intervals at once (a relational engine), and a few values are tried (`case_split`).
"""

from collections.abc import Sequence

from runtime.constraints.domains.base_domain import is_listing
from runtime.constraints.domains.tags import (
    FLAG_VALUES,
    KIND_BOOL,
    MODE_EDGES,
)
from runtime.constraints.engine import Engine
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.minimisation.case_split import Budget, fails_in_all_cases
from runtime.constraints.propagators.external import External
from runtime.constraints.propagators.opcodes import OP_ELEMENT, OP_EXTERNAL, OP_RAND, OP_WATCH
from runtime.constraints.propagators.registry import BY_OP
from runtime.limits import TIME_LIMIT

_MOST_STEPS = 3000  # causes carried out while looking for what can be left out; a case counts as several
_MOST_LATE = 20_000  # causes carried out when the time of the mission is over


def minimise(engine: Engine, causes: Sequence[Cause]) -> list[Cause]:
    """Leave a set of causes of which none can be left out (QuickXplain, Junker 2004: O(k log(n / k)) propagations).

    What propagation alone cannot refute stays as it is; so does what is left when the time of a mission is over.
    """
    scratch = Scratch(engine)
    if not scratch.refutes(causes):
        return list(causes)
    return _without_spare(engine, scratch.shrunk([], list(causes), False))


def _without_spare(engine: Engine, causes: list[Cause]) -> list[Cause]:
    """Leave out, the last first, each cause without which the others still contradict each other by what they mean."""
    if all(cause.kind is not CauseKind.CONSTRAINT or engine.mode[cause.id] == MODE_EDGES for cause in causes):
        return causes  # of differences and bounds propagation sees all
    scratch = Scratch(engine, Budget(_MOST_STEPS))
    for cause in reversed(causes):
        if scratch.is_late():
            break
        others = [other for other in causes if other is not cause]
        if scratch.refutes(others):
            causes = others
    return causes


class Scratch:
    """An empty engine with copies of another one's variables, into which subsets of its causes are posted.

    With a budget of steps it goes by what constraints mean for values, whatever is known, as far as that lasts.
    """

    def __init__(self, engine: Engine, budget: Budget | None = None) -> None:
        self.engine = engine
        self.budget = budget
        self.steps = 0  # causes carried out so far
        self.copy = Engine(relational=budget is not None)
        self.copy.holes = engine.holes
        self.copy.object_parent = engine.object_parent
        self.copy.tick_seconds = engine.tick_seconds
        self.copy.tick_epoch = engine.tick_epoch
        self.variables: dict[int, int] = {}
        self.rows: dict[int, tuple[Cause, list[int]]] = {}  # by identity: hashing a cause takes longer than posting it

    def variable(self, v: int) -> int:
        """Give the copy of a variable: the same constant, or the widest domain of its kind."""
        w = self.variables.get(v, -1)
        if w < 0:
            engine = self.engine
            kind = engine.kind[v]
            if engine.constant[v]:
                values = engine.base_values(v)
                if values is not None:
                    w = self.copy.new_constant_values(kind, values)
                else:
                    w = self.copy.new_constant(kind, engine.base_lower(v), engine.base_upper(v))
            elif kind == KIND_BOOL:
                w = self.copy.new_interval(kind, 0, 1, -1, -1)
            else:
                w = self.copy.new_interval(kind, float("-inf"), float("inf"), -1, -1)
            self.variables[v] = w
            self.copy.commit()
        return w

    def is_late(self) -> bool:
        """Whether it has taken long, and the time of the mission is over."""
        return self.steps > _MOST_LATE and TIME_LIMIT.is_over()

    def refutes(self, causes: Sequence[Cause]) -> bool:
        """Tell whether propagation, or with a budget a case split too, finds a set of causes inconsistent."""
        if self.budget is not None and self.budget.is_spent(len(causes)):
            return False
        self.steps += len(causes)
        for cause in causes:
            self.copies(cause)  # before the mark: they stay
        mark = self.copy.mark()
        holds = True
        for cause in causes:
            holds = holds and self.carry_out(cause)
        holds = holds and self.copy.propagate()
        if holds and self.budget is not None:
            variables = list(dict.fromkeys(v for cause in causes for v in self.copies(cause)))
            holds = not fails_in_all_cases(self.copy, variables, self.budget)
        self.copy.rewind(mark)
        return not holds

    def arguments(self, cause: Cause) -> list[int]:
        """List the variables of a cause."""
        engine = self.engine
        if cause.kind is CauseKind.EDGE:
            return [engine.edge_source[cause.id], engine.edge_target[cause.id]]
        if cause.kind is CauseKind.RESTRICTION:
            return [engine.restriction_variable[cause.id]]
        return engine.arguments(cause.id)

    def copies(self, cause: Cause) -> list[int]:
        """List the copies of a cause's variables."""
        row = self.rows.get(id(cause))
        if row is None:
            row = self.rows[id(cause)] = (cause, [self.variable(v) for v in self.arguments(cause)])
        return row[1]

    def carry_out(self, cause: Cause) -> bool:
        """Post one cause on the copies."""
        engine, copy, k = self.engine, self.copy, cause.id
        variables = self.copies(cause)
        if cause.kind is CauseKind.EDGE:
            return copy.add_edge(variables[0], variables[1], engine.edge_weight[k], cause.span, cause.owner)
        if cause.kind is CauseKind.RESTRICTION:
            if engine.restriction_flags[k] & FLAG_VALUES:
                if is_listing(engine, k):
                    return True
                return copy.restrict_base_values(variables[0], engine.restriction_values[k], cause.span, cause.owner)
            lo, hi = engine.restriction_lo[k], engine.restriction_hi[k]
            return copy.restrict_base(variables[0], lo, hi, cause.span, cause.owner)
        op = engine.op[k]
        if op == OP_WATCH or (self.budget is not None and BY_OP[op].is_of_domains):
            return True
        if op == OP_ELEMENT:
            keys = engine.keys(k)
            copy.post_element(variables[0], variables[1], keys, variables[2:], cause.span, cause.owner)
        elif op == OP_EXTERNAL:
            external = engine.externals[k]
            assert isinstance(external, External)
            if external.is_repeatable:
                copy.post_external(external, variables, cause.span, cause.owner)
        else:
            c = copy.post(op, variables, cause.span, cause.owner)
            if op == OP_RAND:
                copy.drawn[c] = engine.drawn[k]
        return True

    def shrunk(self, background: list[Cause], causes: list[Cause], is_changed: bool) -> list[Cause]:
        """Give a smallest part of `causes` that is refuted together with the background (QuickXplain)."""
        if is_changed and self.refutes(background):
            return []
        if len(causes) == 1 or self.is_late():
            return causes
        half = len(causes) // 2
        left, right = causes[:half], causes[half:]
        needed_right = self.shrunk(background + left, right, True)
        needed_left = self.shrunk(background + needed_right, left, bool(needed_right))
        return needed_left + needed_right
