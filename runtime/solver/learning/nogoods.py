"""Nogoods: sets of choices that cannot all hold, learned from dead ends.

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
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.tags import EVERYTHING, OPEN_CONDITION, PRECEDES_ONLY, RESOURCE_THREAT, THREAT, UNBOUND_VARIABLE

_MOST = 4000
_LONGEST = 24


class Nogoods:
    """The store. It records nothing, and costs nothing, before the first dead end."""

    def __init__(self, program: Program, agenda: Agenda, stack: Decisions) -> None:
        self.agenda = agenda
        self.stack = stack
        # One name means many things in a loop, and where objects are made.
        self.is_usable = not any(has_any(rule.body, (ObjectLoop, NewObject)) for rule in program.rules)
        self.is_recording = True
        self.clear()

    def clear(self) -> None:
        """Forget everything: the plan was changed from outside."""
        if not self.is_recording:
            return  # there is nothing
        self.is_recording = False
        self.numbers: dict[Any, int] = {}
        self.made: list[int] = []  # the choice of each decision in force, NONE for one without a name
        self.level: dict[int, int] = {}
        self.sets: list[tuple[int, ...]] = []
        self.uses: list[int] = []
        self.watched: dict[int, list[int]] = {}

    # ---- names ----

    def _token(self, t: int) -> Any:
        """A name for a token that it has on every branch; None if there is none."""
        rows = self.agenda.rows
        if t < 0 or self.agenda.token_level[t] == 0:
            return t
        parent = self._token(rows.parent[t]) if rows.parent[t] >= 0 else None
        return None if parent is None else (parent, rows.span[t], rows.predicate[t])

    def _variable(self, v: int) -> Any:
        """A name for a variable; None if there is none."""
        plan, engine = self.agenda.plan, self.agenda.engine
        if self.agenda.variable_level[v] == 0:
            return v
        owner = self._token(plan.variable_owner[v])
        if owner is None:
            return None
        if plan.variable_role[v] == ROLE_TOKEN:
            return (owner, v - self.agenda.rows.var0[plan.variable_owner[v]])
        r = engine.restriction_head[v]
        if plan.variable_role[v] != ROLE_LOCAL or r < 0:
            return None
        while engine.restriction_next[r] >= 0:
            r = engine.restriction_next[r]
        return (owner, "local", plan.variable_name[v], engine.restriction_span[r])

    def _choice(self, d: int) -> Any:
        """A name for the choice that decision `d` has made; None if there is none."""
        agenda, stack = self.agenda, self.stack
        item, kind = stack.item[d], stack.kind[d]
        name: tuple[Any, ...] = (None,)
        if kind == UNBOUND_VARIABLE:
            value = agenda.engine.flo[item] if agenda.engine.kind[item] == KIND_FLOAT else agenda.engine.lb[item]
            name = (self._variable(item), value)
        elif kind == OPEN_CONDITION:
            way = self._token(agenda.rows.merged_into[item]) if agenda.rows.status[item] == MERGED else stack.cursor[d]
            if agenda.rows.status[item] == ACTIVE and agenda.supports.first[agenda.rows.predicate[item] + 1] > 0:
                return None  # an action that supports it has no name
            name = (self._token(item), agenda.rows.status[item], way)
        elif kind == THREAT:
            at = LISTS * item + LIST_ORDER
            before, after = agenda.rows.link_before[at], agenda.rows.link_after[at]
            name = (
                self._token(item),
                agenda.engine.lb[agenda.rows.var0[item] + OBJECT],
                self._token(before),
                self._token(after),
            )
        elif kind == RESOURCE_THREAT and agenda.table.handler_constraint[stack.handler[d]] == PRECEDES_ONLY:
            at = stack.pool_first[d] + stack.cursor[d]
            name = (self._variable(stack.pool_before[at]), self._variable(stack.pool_after[at]))
        return None if None in name else (kind, name)

    def _number(self, d: int) -> int:
        """The number of the choice of decision `d`, NONE if it has no name."""
        name = self._choice(d)
        return NONE if name is None else self.numbers.setdefault(name, len(self.numbers))

    # ---- while the search goes on ----

    def start(self) -> None:
        """Begin to record choices; insertions made before have no name, as neighbours may have come."""
        if self.is_usable and not self.is_recording:
            self.is_recording = True
            for d in range(self.stack.depth):
                self._take(d, NONE if self.stack.kind[d] == THREAT else self._number(d))

    def _take(self, d: int, made: int) -> None:
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
        """Note the choice of decision `d`; the levels of a nogood that is now complete, None if there is none."""
        made = self._number(d)
        self._take(d, made)
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
        """Learn the conflict set of decision `d`, a dead end; the latest of it is undone next."""
        stack = self.stack
        reason = stack.reasons[d]
        if not self.is_recording or reason == EVERYTHING or stack.is_local[d]:
            return
        levels: list[int] = []
        while reason >= 0:
            levels.append(stack.reason_level[reason])
            reason = stack.reason_next[reason]
        made = [self.made[level - 1] for level in sorted(levels)]
        if not made or len(made) > _LONGEST or NONE in made:
            return
        if len(self.sets) == _MOST:
            self._forget()
        self.watched.setdefault(made[-1], []).append(len(self.sets))
        self.sets.append(tuple(made))
        self.uses.append(0)

    def _forget(self) -> None:
        """Drop the half that was used least, the older of equals."""
        order = sorted(range(len(self.sets)), key=lambda k: (self.uses[k], k))
        kept = {k: index for index, k in enumerate(sorted(order[len(order) // 2 :]))}
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
