"""Read tokens out of a plan database into the record of the mission, before they leave it and when it ends."""

from collections.abc import Callable
from math import isinf

from compiler.program import FIRST_PARAMETER, OBJECT, START
from runtime.constraints.domains.tags import (
    HALF_INF,
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    KIND_OBJECT,
    KIND_STRING,
    KIND_SYMBOL,
)
from runtime.executive.messages import make_tuple
from runtime.executive.outlines import (
    LOOSE,
    SHAPE_BOOL,
    SHAPE_FLOAT,
    SHAPE_INT,
    SHAPE_OBJECT,
    SHAPE_STRING,
    SHAPE_SYMBOL,
    Outline,
    forms_of,
)
from runtime.executive.record import (
    NOBODY,
    BodyRun,
    GuardRun,
    ObjectRecord,
    OpenValues,
    ReactorRecord,
    TokenRecord,
    Value,
    ValueRange,
)
from runtime.plan.database import PlanDatabase
from runtime.plan.tags import (
    ACTIVE,
    BRANCH_THEN,
    BRANCH_WAITING,
    FLAG_FACT,
    FLAG_GOAL,
    FREED,
    HOLDS_VARIABLES,
    MERGED,
    ROLE_LOCAL,
    SCOPE_BRANCH,
    SCOPE_GUARD,
    SCOPE_RULE,
    STATE_NAMES,
)

_STATES = tuple([name.lower() for name in STATE_NAMES])
_OF_KIND = {
    KIND_BOOL: SHAPE_BOOL,
    KIND_INT: SHAPE_INT,
    KIND_FLOAT: SHAPE_FLOAT,
    KIND_SYMBOL: SHAPE_SYMBOL,
    KIND_OBJECT: SHAPE_OBJECT,
    KIND_STRING: SHAPE_STRING,
}


def _either(one: Value, other: Value) -> ValueRange:
    """The range of two times, each known or a range."""
    first = one if isinstance(one, ValueRange) else ValueRange(one, one)  # type: ignore[arg-type]
    second = other if isinstance(other, ValueRange) else ValueRange(other, other)  # type: ignore[arg-type]
    return ValueRange(min(first.lower, second.lower), max(first.upper, second.upper))


class Recorder:
    """The record of one reactor while its mission is flown."""

    def __init__(self, database: PlanDatabase, name: str) -> None:
        self.database = database
        self.name = name
        self.plan = database.plan
        self.rows = database.plan.rows
        self.engine = database.engine
        self.forms = forms_of(database.program)
        self.tokens: dict[int, TokenRecord] = {}
        self.requests: dict[int, int] = {}  # token -> key; shared with the workbench
        self.synchronised = NOBODY  # the last tick at which the plan agreed with the present
        self.agreed: dict[int, TokenRecord] | None = None  # what had begun, as the plan last agreed with the present
        self.is_lost = False  # no repair has helped: the plan as the last one left it is nobody's
        self.kept: dict[int, None] = {}  # keys of tokens that are recorded, and in the plan again without their rules
        self.gone: dict[tuple[int, int], int] = {}  # (key of a parent, row of a child that left before it) -> its key
        self.gone_of: dict[tuple[int, int], list[int]] = {}  # (key of a parent, scope) -> keys of those that it made
        self.witness: Callable[[list[int]], None] | None = None  # is told of tokens before they leave
        self.script_tokens = self._script_tokens()
        self.predicate_names = [predicate.name for predicate in database.program.predicates]
        self.object_names = database.objects.names

    # ---- when ----

    def leave(self, tokens: list[int], tick: int) -> None:
        """Record tokens that are over and leave the plan."""
        if self.witness is not None:
            self.witness(tokens)
        rows = self.rows
        leaving = set(tokens)
        for t in tokens:
            parent = rows.parent[t]
            if parent >= 0 and parent not in leaving:
                self._part(t, parent)
            self.tokens[rows.key[t]] = self._token(t, "over", tick)

    def detach(self, t: int) -> None:
        """Note a child that stands by itself from now on, or leaves before its parent."""
        parent = self.rows.parent[t]
        if parent >= 0:
            self._part(t, parent)

    def _part(self, t: int, parent: int) -> None:
        rows = self.rows
        self.gone[rows.key[parent], t] = rows.key[t]
        self.gone_of.setdefault((rows.key[parent], rows.creator[t]), []).append(rows.key[t])

    def cut(self) -> None:
        """Record what has begun before a repair or a recall takes things away; what stays is recorded again later."""
        rows, engine = self.rows, self.engine
        found = {
            rows.key[t]: self._token(t, "cut", self.synchronised)
            for t in range(rows.token_count)
            if rows.status[t] in (ACTIVE, MERGED)
            and engine.upper(rows.var0[t] + START) <= self.synchronised
            and rows.key[t] not in self.kept
        }
        self.tokens |= found
        if self.agreed is None:
            self.agreed = found

    def close(self) -> ReactorRecord:
        """Record what the plan holds when the mission has ended."""
        rows, tick = self.rows, self.synchronised
        for t in range(rows.token_count):
            if rows.status[t] != FREED and rows.key[t] not in self.kept:
                self.tokens[rows.key[t]] = self._token(t, "end", tick)
        for key, one in (self.agreed or {}).items() if self.is_lost else ():
            left = self.tokens[key]
            if (left.state, left.start) != (one.state, one.start):
                self.tokens[key] = one
            elif left.end != one.end:  # of the tick that was lost it is not known whether it went on
                length = _either(left.duration, one.duration)
                self.tokens[key] = left._replace(end=_either(left.end, one.end), duration=length)
        plan, forms, program = self.plan, self.forms, self.database.program
        things = []
        for o, name in enumerate(self.database.objects.names):
            number, first = plan.object_class[o], plan.object_var0[o]
            members = tuple([self.value(first + k, shape) for k, shape in enumerate(forms.members[number])])
            things.append(ObjectRecord(name, program.classes[number].name, members))
        worlds = tuple([self.value(plan.globals[k], shape) for k, shape in enumerate(forms.globals)])
        tokens = tuple([self.tokens[key] for key in sorted(self.tokens)])
        return ReactorRecord(self.name, tick, worlds, tuple(things), self.script_tokens, tokens)

    # ---- what ----

    def _script_tokens(self) -> tuple[int, ...]:
        """The keys of the tokens of the script, by slot."""
        rows, program = self.rows, self.database.program
        first = rows.scope_frame[self.database.script.scope] + program.script_slots
        found = [int(rows.cells[first + slot]) for slot in range(program.script_tokens)]
        return tuple([NOBODY if t < 0 else int(rows.key[t]) for t in found])

    def _token(self, t: int, fate: str, tick: int) -> TokenRecord:
        rows = self.rows
        first = rows.var0[t]
        number = rows.predicate[t]
        status = rows.status[t]
        shapes = self.forms.parameters[number]
        runs: tuple[BodyRun, ...] = ()
        if status == ACTIVE and rows.scopes[t] >= 0:
            runs = self._runs(t, rows.key[t])
        arguments: tuple[Value, ...] = ()
        if shapes:
            arguments = tuple([self.value(first + FIRST_PARAMETER + k, shape) for k, shape in enumerate(shapes)])
        fields = (
            rows.key[t],
            self.predicate_names[number],
            self.value(first + OBJECT, SHAPE_OBJECT),
            _STATES[status],
            self.value(first + OBJECT + 1, SHAPE_INT),
            self.value(first + START, SHAPE_INT),
            self.value(first + START + 1, SHAPE_INT),
            arguments,
            rows.key[rows.merged_into[t]] if status == MERGED else NOBODY,
            self._origin(t),
            fate,
            tick,
            runs,
        )
        return make_tuple(TokenRecord, fields)

    def _origin(self, t: int) -> str:
        rows = self.rows
        flags = rows.flags[t]
        if rows.parent[t] >= 0:
            return "rule"
        is_written = rows.span[t] >= 0
        if flags & FLAG_FACT:
            return "fact" if is_written else "observation"
        if flags & FLAG_GOAL:
            return "goal" if is_written else "request"
        return "rule" if is_written else "own"

    def _runs(self, t: int, key: int) -> tuple[BodyRun, ...]:
        """The runs of the rules of `t`, in the order in which they fired."""
        rows = self.rows
        scopes: list[int] = []
        s = rows.scopes[t]
        while s >= 0:
            scopes.append(s)
            s = rows.scope_next[s]
        scopes.reverse()  # the latest stands first
        inner: dict[int, list[int]] = {}
        tops: list[int] = []
        for s in scopes:
            kind = rows.scope_kind[s]
            if kind == SCOPE_RULE:
                tops.append(s)
            elif kind in (SCOPE_GUARD, SCOPE_BRANCH):
                inner.setdefault(rows.scope_parent[s], []).append(s)
        return tuple([self._run(s, key, self.forms.rules[rows.scope_rule[s]], inner) for s in tops])

    def _run(self, s: int, key: int, form: Outline, inner: dict[int, list[int]]) -> BodyRun:
        rows = self.rows
        named: tuple[Value, ...] = ()
        children: tuple[int, ...] = ()
        if form.has_loop:
            named = self._made_locals(s)
            children = self._made_children(s, key)
        else:
            frame, cells = rows.scope_frame[s], rows.cells
            if form.locals:
                named = tuple([self.value(cells[frame + slot], shape) for slot, shape in form.locals])
            if form.children:
                first = frame + rows.scope_slots[s]
                children = tuple([self._child(cells[first + slot], s, key) for slot in form.children])
        guards: tuple[GuardRun, ...] = ()
        if s in inner:
            guards = tuple([self._guard(g, key, form, k, inner) for k, g in enumerate(inner[s])])
        return BodyRun(rows.scope_rule[s], named, children, guards)

    def _guard(self, g: int, key: int, form: Outline, k: int, inner: dict[int, list[int]]) -> GuardRun:
        branch = self.rows.scope_branch[g]
        if branch == BRANCH_WAITING:
            return GuardRun("waiting", self._is_decided(g), None)
        sides = (LOOSE, LOOSE) if form.has_loop else form.guards[k]
        ran = [self._run(b, key, sides[0 if branch == BRANCH_THEN else 1], inner) for b in inner.get(g, ())]
        return GuardRun("then" if branch == BRANCH_THEN else "else", True, ran[len(ran) - 1] if ran else None)

    def _is_decided(self, g: int) -> bool:
        """Whether everything that decides a guard is given."""
        rows, engine = self.rows, self.engine
        inputs = rows.scope_inputs[g]
        given = range(inputs + 2, inputs + 2 + rows.cells[inputs])
        return not [i for i in given if not engine.is_decided(rows.cells[i])]

    def _child(self, t: int, s: int, key: int) -> int:
        # The row of a child that is gone may be free, or by now another child's.
        if t >= 0 and self.rows.creator[t] == s and self.rows.status[t] != FREED:
            return int(self.rows.key[t])
        return self.gone.get((key, t), NOBODY)

    def _made_locals(self, s: int) -> tuple[Value, ...]:
        """The named variables that a scope holds, in the order of their making."""
        rows, plan = self.rows, self.plan
        found: list[Value] = []
        h = rows.scope_holds[s]
        while h >= 0:
            v = rows.hold_id[h]
            if rows.hold_kind[h] == HOLDS_VARIABLES and plan.variable_role[v] == ROLE_LOCAL:
                found.append(self.value(v, self._shape(v)))
            h = rows.hold_next[h]
        return tuple(reversed(found))

    def _shape(self, v: int) -> int:
        """The shape of a local variable."""
        return _OF_KIND[self.engine.kind[v]]

    def _made_children(self, s: int, key: int) -> tuple[int, ...]:
        """The children that a scope of the token `key` made, in that order, those that left before it as well."""
        rows = self.rows
        found = set(self.gone_of.get((key, s), ()))
        child = rows.children[rows.scope_token[s]]
        while child >= 0:
            if rows.creator[child] == s:
                found.add(int(rows.key[child]))
            child = rows.sibling[child]
        return tuple(sorted(found))

    def value(self, v: int, shape: int) -> Value:
        """What is known of a variable."""
        engine = self.engine
        lower, upper = engine.lower(v), engine.upper(v)
        if lower == upper:
            return self._scalar(lower, shape)
        if shape == SHAPE_FLOAT:
            if engine.is_singleton(v):
                return lower + (upper - lower) * 0.5
            return ValueRange(lower, upper)
        if shape == SHAPE_INT:
            return ValueRange(_bound(lower), _bound(upper))
        if not engine.is_finite(v) and (isinf(lower) or isinf(upper)):
            return ValueRange(lower, upper)
        return OpenValues(tuple([self._scalar(each, shape) for each in engine.values_of(v)]))

    def _scalar(self, number: float, shape: int) -> float | int | bool | str:
        if shape == SHAPE_FLOAT:
            return number
        if isinf(number):
            return number
        whole = int(number)
        if shape == SHAPE_INT:
            return whole
        if shape == SHAPE_BOOL:
            return bool(whole)
        if shape == SHAPE_OBJECT:
            return self.object_names[whole]
        names = self.database.prototypes.texts if shape == SHAPE_STRING else self.database.prototypes.symbols
        return str(names.text(whole))


def _bound(number: float) -> float:
    """A bound of whole numbers; NDDL's infinity is infinite."""
    if number >= HALF_INF:
        return float("inf")
    return float("-inf") if number <= -HALF_INF else number
