"""Keep sets of choices that cannot all hold: what an exhausted decision rested on is not explored a second time.

A choice is named by what it does, by way of names that are the same on every branch: a token of a rule by its parent
and the statement that asks for it. So a nogood says of the model that no plan has all of its choices, in whatever order
they are made; what was learned only for one order of decisions (`Decisions.is_local`) is not kept. Each nogood is
looked at when its watched choice is made, and watches another one that is not; the least used half goes when there are
too many.
"""

from typing import Any

from compiler.program import Guard, Instruction, NewObject, ObjectLoop, Program
from runtime.constraints.domains.tags import KIND_FLOAT
from runtime.plan.tags import ACTIVE, LIST_ORDER, LISTS, MERGED, NONE, OBJECT, ROLE_LOCAL, ROLE_TOKEN
from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.tags import EVERYTHING, OPEN_CONDITION, PRECEDES_ONLY, RESOURCE_THREAT, THREAT, UNBOUND_VARIABLE

MOST = 4000
LONGEST = 24


class Nogoods:
    """The store. It sleeps, and costs nothing, until the first decision is exhausted."""

    def __init__(self, program: Program, queues: Queues, stack: Decisions) -> None:
        self.queues = queues
        self.stack = stack
        # One name means many things in a loop, and where objects are made.
        self.is_usable = not any(has_any(rule.body, (ObjectLoop, NewObject)) for rule in program.rules)
        self.clear()

    def clear(self) -> None:
        """Forget everything, for the plan has changed from outside."""
        self.is_awake = False
        self.numbers: dict[Any, int] = {}
        self.made: list[int] = []  # the choice of each decision in force, NONE for one without a name
        self.level: dict[int, int] = {}
        self.sets: list[tuple[int, ...]] = []
        self.uses: list[int] = []
        self.watched: dict[int, list[int]] = {}

    # ---- names ----

    def token(self, t: int) -> Any:
        """A name for a token that it has on every branch; None if there is none."""
        rows = self.queues.rows
        if t < 0 or self.queues.token_level[t] == 0:
            return t
        parent = self.token(rows.parent[t]) if rows.parent[t] >= 0 else None
        return None if parent is None else (parent, rows.span[t], rows.predicate[t])

    def variable(self, v: int) -> Any:
        """A name for a variable; None if there is none."""
        plan, engine = self.queues.plan, self.queues.engine
        if self.queues.variable_level[v] == 0:
            return v
        owner = self.token(plan.variable_owner[v])
        if owner is None:
            return None
        if plan.variable_role[v] == ROLE_TOKEN:
            return (owner, v - self.queues.rows.var0[plan.variable_owner[v]])
        r = engine.restriction_head[v]
        if plan.variable_role[v] != ROLE_LOCAL or r < 0:
            return None
        while engine.restriction_next[r] >= 0:
            r = engine.restriction_next[r]
        return (owner, "local", plan.variable_name[v], engine.restriction_span[r])

    def choice(self, d: int) -> Any:
        """A name for the choice that decision `d` has made; None if there is none."""
        q, stack = self.queues, self.stack
        item, kind = stack.item[d], stack.kind[d]
        name: tuple[Any, ...] = (None,)
        if kind == UNBOUND_VARIABLE:
            value = q.engine.flo[item] if q.engine.kind[item] == KIND_FLOAT else q.engine.lb[item]
            name = (self.variable(item), value)
        elif kind == OPEN_CONDITION:
            way = self.token(q.rows.merged_into[item]) if q.rows.status[item] == MERGED else stack.cursor[d]
            if q.rows.status[item] == ACTIVE and q.supports.first[q.rows.predicate[item] + 1] > 0:
                return None  # an action that supports it has no name
            name = (self.token(item), q.rows.status[item], way)
        elif kind == THREAT:
            at = LISTS * item + LIST_ORDER
            before, after = q.rows.link_before[at], q.rows.link_after[at]
            name = (self.token(item), q.engine.lb[q.rows.var0[item] + OBJECT], self.token(before), self.token(after))
        elif kind == RESOURCE_THREAT and q.treatments.handler_constraint[stack.handler[d]] == PRECEDES_ONLY:
            at = stack.pool_first[d] + stack.cursor[d]
            name = (self.variable(stack.pool_before[at]), self.variable(stack.pool_after[at]))
        return None if None in name else (kind, name)

    def number(self, d: int) -> int:
        """The number of the choice of decision `d`, NONE if it has no name."""
        name = self.choice(d)
        return NONE if name is None else self.numbers.setdefault(name, len(self.numbers))

    # ---- while the search goes on ----

    def wake(self) -> None:
        """Begin to take note of choices; places that were taken before have no name, as neighbours may have come."""
        if self.is_usable and not self.is_awake:
            self.is_awake = True
            for d in range(self.stack.depth):
                self.take(d, NONE if self.stack.kind[d] == THREAT else self.number(d))

    def take(self, d: int, made: int) -> None:
        """Note the choice of decision `d`; those of later ones are undone."""
        while len(self.made) > d:
            undone = self.made.pop()
            if undone >= 0:
                del self.level[undone]
        if made in self.level:
            made = NONE
        self.made.append(made)
        if made >= 0:
            self.level[made] = d + 1

    def refuted(self, d: int) -> list[int] | None:
        """Note the choice of decision `d`; the levels of a nogood that now holds entirely, None if there is none."""
        made = self.number(d)
        self.take(d, made)
        if made < 0 or self.made[d] < 0:
            return None
        waiting = self.watched.pop(made, [])
        staying: list[int] = []
        found: list[int] | None = None
        for k in waiting:
            other = next((one for one in self.sets[k] if one not in self.level), NONE)
            if other >= 0:
                self.watched.setdefault(other, []).append(k)
                continue
            staying.append(k)
            if found is None:
                self.uses[k] += 1
                found = [self.level[one] for one in self.sets[k]]
        if staying:
            self.watched[made] = staying
        return found

    def record(self, d: int) -> None:
        """Learn from decision `d`, which has no choice left, what it rests on; the latest of that is undone next."""
        stack = self.stack
        reason = stack.reasons[d]
        if not self.is_awake or reason == EVERYTHING or stack.is_local[d]:
            return
        levels: list[int] = []
        while reason >= 0:
            levels.append(stack.reason_level[reason])
            reason = stack.reason_next[reason]
        made = [self.made[level - 1] for level in sorted(levels)]
        if not made or len(made) > LONGEST or NONE in made:
            return
        if len(self.sets) == MOST:
            self.forget()
        self.watched.setdefault(made[-1], []).append(len(self.sets))
        self.sets.append(tuple(made))
        self.uses.append(0)

    def forget(self) -> None:
        """Drop the half that was used least, the older of equals."""
        order = sorted(range(len(self.sets)), key=lambda k: (self.uses[k], k))
        kept = {k: place for place, k in enumerate(sorted(order[len(order) // 2 :]))}
        self.watched = {one: left for one, ks in self.watched.items() if (left := [kept[k] for k in ks if k in kept])}
        self.sets = [self.sets[k] for k in kept]
        self.uses = [self.uses[k] // 2 for k in kept]


def has_any(body: tuple[Instruction, ...], kinds: tuple[type, ...]) -> bool:
    """Whether a body, or a branch in it, has an instruction of one of these kinds."""
    for instruction in body:
        if isinstance(instruction, kinds):
            return True
        if isinstance(instruction, Guard) and has_any((*instruction.then, *instruction.otherwise), kinds):
            return True
    return False
