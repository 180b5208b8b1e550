"""Post constraints, narrow, propagate, go back: the one object through which all other rooms reason."""

import math
from collections.abc import Sequence
from math import inf

from runtime.constraints.domains.base_domain import (
    base_high,
    base_low,
    base_set,
    in_order,
    insert_value,
    is_base_single,
)
from runtime.constraints.domains.narrow import high, is_single, low, raise_to, reduce_to, round_bounds
from runtime.constraints.domains.queries import has_finitely_many, listed, may_be, number_of_values
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    FLAG_DECISION,
    FLAG_FROZEN,
    FLAG_VALUES,
    FLOAT_TOLERANCE,
    KIND_FLOAT,
    SUPPORT_RESTRICTION,
)
from runtime.constraints.domains.variables import (
    add_restriction,
    clear_row,
    close_values,
    constant_interval,
    constant_set,
    copy_words,
    is_untouched_set,
    keep_values,
    start_interval,
    start_values,
    take_block,
    take_row,
)
from runtime.constraints.explanation.cause import Cause, Link
from runtime.constraints.explanation.explain import explain_bound, explain_conflict
from runtime.constraints.propagators.dispatch import propagate_constraint
from runtime.constraints.propagators.external import External
from runtime.constraints.propagators.opcodes import OP_ELEMENT, OP_EXTERNAL
from runtime.constraints.propagators.posting import post_constraint
from runtime.constraints.relaxation.retract import edges_of, follow_again, retract
from runtime.constraints.relaxation.trail import commit_trail, undo_to
from runtime.constraints.stn.network import insert_edge, propagate_edges
from runtime.constraints.stn.watch_lists import watchers_of

_COARSE_AFTER = 200  # runs of one constraint in one propagation, before steps of less than a hundredth are left out
_MOST_RUNS = 5000  # and before it is left out itself


class Engine(Store):
    """Variables, temporal edges and constraints, kept at their fixpoint, with undo and conflicts."""

    def __init__(self, relational: bool = False) -> None:
        super().__init__()
        self.relational = relational
        self.constants: dict[tuple[object, ...], int] = {}
        self.newest_edge = -1
        self.newest_restriction = -1
        self.coarse_after = _COARSE_AFTER
        self.most_runs = _MOST_RUNS
        self.creeping: set[int] = set()  # constraints that were slowed down; what they left out is not known

    # ------------------------------------------------------------------------------------------------ variables

    def reserve(self, count: int) -> int:
        """Have the next `count` variables take consecutive ids; give the first (-1 for a single one)."""
        if count == 1:
            return -1
        self.reserved_next = take_block(self, count)
        self.reserved_end = self.reserved_next + count
        return self.reserved_next

    def new_interval(self, kind: int, lo: float, hi: float, span: int, owner: int) -> int:
        """Make a variable between two bounds; infinities are `inf` or INF."""
        v = take_row(self)
        clear_row(self, v, kind)
        start_interval(self, v, lo, hi, add_restriction(self, v, lo, hi, 0, span, owner))
        return v

    def new_values(self, kind: int, values: list[float], span: int, owner: int) -> int:
        """Make a variable with a closed set of values, or ids."""
        v = take_row(self)
        clear_row(self, v, kind)
        values = in_order(values)
        lo = values[0] if values else 1
        hi = values[len(values) - 1] if values else 0
        r = add_restriction(self, v, lo, hi, FLAG_VALUES, span, owner)
        self.restriction_values[r] = values
        start_values(self, v, values, r)
        return v

    def new_like(self, other: int, span: int, owner: int) -> int:
        """Make a variable with the base domain of a closed one that nothing has narrowed; they share the list."""
        if not is_untouched_set(self, other):
            return self.new_values(self.kind[other], base_set(self, other) or [], span, owner)
        v = take_row(self)
        clear_row(self, v, self.kind[other])
        r = add_restriction(self, v, float(self.lb[other]), float(self.ub[other]), FLAG_VALUES, span, owner)
        self.restriction_values[r] = self.restriction_values[self.restriction_head[other]]
        start_interval(self, v, self.lb[other], self.ub[other], r)
        if self.word[other] >= 0:
            copy_words(self, v, other)
        return v

    def new_open(self, kind: int, values: list[float], span: int, owner: int) -> int:
        """Make a variable whose values are not all known; until `close` it is not narrowed by what is listed."""
        v = take_row(self)
        clear_row(self, v, kind)
        r = add_restriction(self, v, -inf, inf, FLAG_VALUES, span, owner)
        self.restriction_values[r] = in_order(values)
        start_interval(self, v, -inf, inf, r)
        self.is_open[v] = 1
        return v

    def add_value(self, v: int, value: float) -> None:
        """List a further value of an open domain; at level 0 only."""
        assert self.is_open[v] and (self.marks == 0 or self.trail_size == 0)
        r = self.restriction_head[v]
        while self.restriction_next[r] >= 0:
            r = self.restriction_next[r]
        insert_value(self.restriction_values[r], value)

    def close(self, v: int) -> bool:
        """End the growth of an open domain."""
        return bool(close_values(self, v))

    def new_constant(self, kind: int, lo: float, hi: float) -> int:
        """Give the shared variable of a constant value or interval; it never changes and never goes away."""
        key = (kind, float(lo), float(hi))
        v = self.constants.get(key, -1)
        if v < 0:
            v = self.constants[key] = constant_interval(self, kind, lo, hi)
        return v

    def new_constant_values(self, kind: int, values: list[float]) -> int:
        """Give the shared variable of a constant set."""
        values = sorted(set(values))
        key = (kind, tuple(values))
        v = self.constants.get(key, -1)
        if v < 0:
            v = self.constants[key] = constant_set(self, kind, values)
        return v

    # ------------------------------------------------------------------------------------- restricting, deciding

    def restrict_base(self, v: int, lo: float, hi: float, span: int, owner: int) -> bool:
        """Intersect the base domain with an interval; false if no value is left."""
        if self.kind[v] != KIND_FLOAT:
            lo = math.ceil(lo - FLOAT_TOLERANCE) if lo > -inf else lo
            hi = math.floor(hi + FLOAT_TOLERANCE) if hi < inf else hi
        r = add_restriction(self, v, lo, hi, 0, span, owner)
        self.newest_restriction = r
        support = r * 4 + SUPPORT_RESTRICTION
        return bool(self.consistent and raise_to(self, v, lo, support) and reduce_to(self, v, hi, support))

    def freeze_base(self, v: int, lo: float, hi: float, span: int, owner: int) -> None:
        """Restrict the base domain for good to what has happened; such a restriction is known by FLAG_FROZEN.

        It takes over the bounds: nothing is propagated anew, which could round large floats otherwise.
        """
        self.restrict_base(v, lo, hi, span, owner)
        r = self.newest_restriction
        self.restriction_flags[r] = FLAG_FROZEN
        if lo > -inf:
            self.lower_support[v], self.lower_when[v] = r * 4 + SUPPORT_RESTRICTION, -1
        if hi < inf:
            self.upper_support[v], self.upper_when[v] = r * 4 + SUPPORT_RESTRICTION, -1

    def restrict_base_values(self, v: int, values: list[float], span: int, owner: int) -> bool:
        """Intersect the base domain with a set; false if no value is left."""
        values = in_order(values)
        lo = values[0] if values else 1
        hi = values[len(values) - 1] if values else 0
        r = add_restriction(self, v, lo, hi, FLAG_VALUES, span, owner)
        self.restriction_values[r] = values
        self.newest_restriction = r
        return bool(self.consistent and keep_values(self, v, values, r * 4 + SUPPORT_RESTRICTION))

    def restrict_base_to(self, v: int, other: int, span: int, owner: int) -> bool:
        """Intersect the base domain with the base domain of another variable, as it is now."""
        values = base_set(self, other)
        if values is not None and base_low(self, other) > -inf:
            return self.restrict_base_values(v, values, span, owner)
        return self.restrict_base(v, base_low(self, other), base_high(self, other), span, owner)

    def decide(self, v: int, value: float, span: int, owner: int) -> bool:
        """Specify `v`: it takes the value and counts as decided; the base domain stays."""
        r = add_restriction(self, v, value, value, FLAG_DECISION, span, owner)
        self.newest_restriction = r
        self.set_decided(v, 1)
        if self.kind[v] == KIND_FLOAT and is_single(self, v) and self.contains(v, value):
            return bool(self.consistent)  # what holds the value goes on being its reason
        return bool(self.consistent and keep_values(self, v, [value], r * 4 + SUPPORT_RESTRICTION))

    # ---------------------------------------------------------------------------------------------------- asking

    def lower(self, v: int) -> float:
        """Give the lower bound; -inf where there is none."""
        return low(self, v)

    def upper(self, v: int) -> float:
        """Give the upper bound; inf where there is none."""
        return high(self, v)

    def is_singleton(self, v: int) -> bool:
        """Tell whether only one value is left."""
        return is_single(self, v)

    def is_decided(self, v: int) -> bool:
        """Tell whether `v` was decided, or has a base domain of one value."""
        return bool(self.decided[v] or is_base_single(self, v))

    def contains(self, v: int, value: float) -> bool:
        """Tell whether `v` may still take a value."""
        return may_be(self, v, value)

    def is_finite(self, v: int) -> bool:
        """Tell whether `v` is closed and has finitely many values."""
        return has_finitely_many(self, v)

    def size(self, v: int) -> int:
        """Count the values of a finite domain."""
        return number_of_values(self, v)

    def values_of(self, v: int) -> list[float]:
        """List the values of a finite domain in ascending order; of an open one, those listed that are possible."""
        return listed(self, v)

    def base_lower(self, v: int) -> float:
        """Give the lower bound of the base domain."""
        return base_low(self, v)

    def base_upper(self, v: int) -> float:
        """Give the upper bound of the base domain."""
        return base_high(self, v)

    def base_values(self, v: int) -> list[float] | None:
        """Give the values of a base domain that is a set, or was listed; None if it is an interval."""
        return base_set(self, v)

    def is_base_singleton(self, v: int) -> bool:
        """Tell whether the base domain is a single value."""
        return is_base_single(self, v)

    # ------------------------------------------------------------------------------------ constraints and edges

    def add_edge(self, source: int, target: int, weight: int, span: int, owner: int) -> bool:
        """Add `target - source <= weight` and propagate the network; false on a conflict."""
        self.newest_edge = insert_edge(self, source, target, weight, span, owner, -1)
        return bool(self.consistent)

    def post(self, op: int, arguments: list[int], span: int, owner: int) -> int:
        """Post a constraint, to be run by the next `propagate`; give its id."""
        return post_constraint(self, op, arguments, span, owner)

    def post_element(
        self, result: int, index: int, keys: list[int], variables: list[int], span: int, owner: int
    ) -> int:
        """Post: `result` equals the variable that stands beside the key which `index` takes."""
        if keys != sorted(keys):
            variables = [v for _, v in sorted(zip(keys, variables, strict=True))]
        c = post_constraint(self, OP_ELEMENT, [result, index, *variables], span, owner)
        for k, key in enumerate(sorted(keys)):
            self.slot_key[self.first[c] + 2 + k] = key
        return c

    def post_external(self, external: External, arguments: list[int], span: int, owner: int) -> int:
        """Post a constraint that an object decides; it runs after all others."""
        c = post_constraint(self, OP_EXTERNAL, arguments, span, owner)
        self.externals[c] = external
        return c

    def set_parent(self, value: int, parent: int) -> None:
        """Say that one object was created by the constructor of another, for `hasAncestor`."""
        self.object_parent[value] = parent

    def arguments(self, c: int) -> list[int]:
        """List the variables of a constraint."""
        return [self.slot_variable[self.first[c] + k] for k in range(self.arity[c])]

    def keys(self, c: int) -> list[int]:
        """List the keys of an element constraint."""
        return [self.slot_key[self.first[c] + k] for k in range(2, self.arity[c])]

    def constraints_of(self, v: int) -> list[int]:
        """List the constraints on a variable that is no constant."""
        found = watchers_of(self, v)
        return found if len(found) < 2 else list(dict.fromkeys(found))

    def edges_of(self, v: int) -> list[int]:
        """List the edges of a variable."""
        return edges_of(self, v)

    def restrictions_of(self, v: int) -> list[int]:
        """List the restrictions of a variable, the newest first."""
        found = []
        r = self.restriction_head[v]
        while r >= 0:
            found.append(r)
            r = self.restriction_next[r]
        return found

    # ----------------------------------------------------------------------------------------------- propagation

    def propagate(self) -> bool:
        """Run all queues to the fixpoint: edges, then rounding to sets, then cheap constraints, then dear ones."""
        if not self.consistent:
            return False
        self.epoch += 1
        while True:
            if self.edge_first != self.edge_last:
                if not propagate_edges(self, -1, -1, -1):
                    return False
            elif self.hull_first != self.hull_last:
                v = self.hull_queue[self.hull_first]
                self.hull_first = (self.hull_first + 1) & self.hull_mask
                self.queued[v] &= 3
                if not round_bounds(self, v, self.lower_support[v]):
                    return False
            elif self.cheap_first != self.cheap_last:
                c = self.cheap_queue[self.cheap_first]
                self.cheap_first = (self.cheap_first + 1) & self.cheap_mask
                if not self.run(c):
                    return False
            elif self.dear_first != self.dear_last:
                c = self.dear_queue[self.dear_first]
                self.dear_first = (self.dear_first + 1) & self.dear_mask
                if not self.run(c):
                    return False
            else:
                return True

    def run(self, c: int) -> bool:
        """Run one constraint once; false on a conflict."""
        self.scheduled[c] = 0
        self.runs += 1
        if self.run_epoch[c] != self.epoch:
            self.run_epoch[c] = self.epoch
            self.run_count[c] = 0
        self.run_count[c] += 1
        # A cycle that creeps is slowed down, then left alone: what is not narrowed away loses no solution.
        if self.run_count[c] > self.coarse_after:
            self.creeping.add(c)
            if self.run_count[c] > self.most_runs:
                return True
            self.coarse = True
        self.running = c if self.idempotent[c] else -1
        holding = propagate_constraint(self, c)
        self.coarse = False
        self.running = -1
        return holding

    # ------------------------------------------------------------------------------------------ time, explanations

    def mark(self) -> int:
        """Remember the present state, which must be a fixpoint; give what `rewind` takes, as often as wanted."""
        assert self.cheap_first == self.cheap_last and self.dear_first == self.dear_last
        assert self.edge_first == self.edge_last and self.hull_first == self.hull_last
        self.marks += 1
        return self.trail_size

    def rewind(self, mark: int) -> None:
        """Go back to a mark: everything since is undone, scheduled work is dropped, a conflict is forgotten."""
        undo_to(self, mark)

    def commit(self) -> None:
        """Forget all marks: what holds now is level 0."""
        commit_trail(self)
        self.marks = 0

    def retract(
        self,
        constraints: Sequence[int] = (),
        edges: Sequence[int] = (),
        restrictions: Sequence[int] = (),
        variables: Sequence[int] = (),
    ) -> bool:
        """Remove any of these at level 0, relax exactly what they held, and propagate; false on a conflict."""
        assert self.marks == 0 or self.trail_size == 0
        again = retract(self, list(constraints), list(edges), list(restrictions), list(variables))
        return follow_again(self, again) and self.propagate()

    def explain(self) -> list[Cause]:
        """Give the causes of the present conflict; `minimise.minimise` shrinks them."""
        return explain_conflict(self)

    def support_chain(self, v: int, side: int) -> list[Link]:
        """Tell why a bound (SIDE_LOWER, SIDE_UPPER) or a hole stands where it does, the nearest cause first."""
        return explain_bound(self, v, side)
