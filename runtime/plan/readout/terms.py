"""Causes as terms: an edge, restriction or constraint of the engine in, names and numbers that outlive it out."""

from collections.abc import Callable
from math import inf, isfinite
from sys import float_info

from compiler.program import TOKEN_VARIABLES
from runtime.constraints.domains.tags import FLAG_VALUES, HALF_INF, KIND_FLOAT, KIND_INT
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.propagators.opcodes import OP_ELEMENT
from runtime.constraints.propagators.registry import EXACT_TWINS, NAMES
from runtime.plan import tags
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.statements import Argument, ResourceTerm, Term
from runtime.plan.resources.violation import Violation
from runtime.plan.store.domain_texts import domain_text, set_text, wide
from runtime.plan.tags import (
    END,
    FIRST_PARAMETER,
    FLAG_EVENT,
    ROLE_GLOBAL,
    ROLE_INTERNAL,
    ROLE_LOCAL,
    ROLE_MEMBER,
    ROLE_TOKEN,
    START,
)
from runtime.user.written import Written

_WAITING = {twin: code for code, twin in EXACT_TWINS.items()}


class TermReader:
    """Reads terms off a plan as it stands; `token_name` names tokens. A subclass may name arguments its own way."""

    def __init__(self, database: PlanDatabase, token_name: Callable[[int], str]) -> None:
        self.database = database
        self.plan = database.plan
        self.engine = database.engine
        self.token = token_name

    def term(self, cause: Cause) -> Term | ResourceTerm:
        """What a cause says."""
        match cause.kind:
            case CauseKind.EDGE:
                return self._edge(cause.id)
            case CauseKind.RESTRICTION:
                return self._restriction(cause.id)
            case CauseKind.CONSTRAINT:
                return self._constraint(cause.id)

    def variable(self, v: int) -> str:
        """The name of a variable (`a.start`, `a::local`, `a::rover.mode`, `GLOBAL`); without one, its domain."""
        plan, program = self.plan, self.database.program
        role, owner, name = plan.variable_role[v], plan.variable_owner[v], plan.variable_name[v]
        if role == ROLE_TOKEN:
            return f"{self.token(owner)}.{self.part(v, owner)}"
        if role == ROLE_GLOBAL:
            return program.globals[name][0]
        if role == ROLE_MEMBER:
            member = program.classes[plan.object_class[owner]].members[name].name
            return f"{self.database.objects.names[owner]}.{member}"
        if role == ROLE_LOCAL:
            return f"{self.token(owner)}::{self.database.names.text(name)}"
        if self.is_member_of_open_object(v):
            return f"{self.variable(plan.proxy_index[v])}.{self.open_member(v)}"
        return self.value(v)

    def is_member_of_open_object(self, v: int) -> bool:
        """Whether a variable stands for `a.b` where the object `a` was not known yet."""
        plan = self.plan  # which knows nothing of constants
        is_noted = not self.engine.constant[v] and plan.variable_role[v] == ROLE_INTERNAL
        return bool(is_noted and plan.proxy_index[v] >= 0)

    def open_member(self, v: int) -> str:
        """Of such a variable the name `b`."""
        return self.database.names.text(self.plan.proxy_member[v])

    def value(self, v: int) -> str:
        """The domain of a variable, without its type."""
        return domain_text(self.database.prototypes, self.engine, v, self.database.objects.names, None).brief

    def argument(self, v: int) -> Argument:
        """The name of a variable, or the value of a constant."""
        engine = self.engine
        if engine.constant[v] and engine.kind[v] in (KIND_INT, KIND_FLOAT) and engine.lower(v) == engine.upper(v):
            return _number(engine.lower(v), engine.kind[v])
        return self.variable(v)

    def part(self, v: int, owner: int) -> str:
        """The name of a token's variable without that of the token."""
        number = v - self.plan.rows.var0[owner]
        if number >= FIRST_PARAMETER:
            code = self.database.program.predicates[self.plan.rows.predicate[owner]]
            return str(code.parameters[number - FIRST_PARAMETER].name)
        is_time = self.plan.rows.flags[owner] & FLAG_EVENT and number in (START, END)
        return "time" if is_time else TOKEN_VARIABLES[number]

    def _edge(self, e: int) -> Term:
        engine = self.engine
        ends = self.argument(engine.edge_source[e]), self.argument(engine.edge_target[e])
        return Term("precedence", (*ends, int(engine.edge_weight[e])))

    def _restriction(self, r: int) -> Term:
        """The base domain that a declaration, an assignment or a decision gives."""
        engine = self.engine
        v = engine.restriction_variable[r]
        kind = engine.kind[v]
        lower, upper = engine.restriction_lo[r], engine.restriction_hi[r]
        members = list(engine.restriction_values[r]) if engine.restriction_flags[r] & FLAG_VALUES else []
        if len(members) == 1:
            lower = upper = members[0]
        elif not members and kind not in (KIND_INT, KIND_FLOAT):
            members = self._between(v, lower, upper)
        shown = [set_text(self.database.prototypes, kind, [x], self.database.objects.names)[1:-1] for x in members]
        if kind not in (KIND_INT, KIND_FLOAT):
            shown.sort()
        return Term("bounds", (self.argument(v), _number(lower, kind), _number(upper, kind)), tuple(shown))

    def _between(self, v: int, lower: float, upper: float) -> list[float]:
        """The values of a variable of no numbers within bounds; an open one is as the variable's others have it."""
        engine = self.engine
        r = engine.restriction_head[v]
        while r >= 0:
            listed = engine.restriction_values[r] if engine.restriction_flags[r] & FLAG_VALUES else []
            lower = lower if isfinite(lower) else min(listed, default=engine.restriction_lo[r])
            upper = upper if isfinite(upper) else max(listed, default=engine.restriction_hi[r])
            r = engine.restriction_next[r]
        is_known = isfinite(lower) and isfinite(upper)
        return [float(x) for x in range(int(lower), int(upper) + 1)] if is_known else []

    def _constraint(self, c: int) -> Term | ResourceTerm:
        engine = self.engine
        external = engine.externals.get(c)
        if isinstance(external, Violation):
            return self._violation(c, external)
        code = engine.op[c]
        if self.database.narrows_functions:
            code = _WAITING.get(code, code)
        arguments = tuple(self.argument(v) for v in engine.arguments(c))
        if code == OP_ELEMENT:
            return Term(NAMES[code], arguments, tuple(self.database.objects.names[o] for o in engine.keys(c)))
        return Term(external.name if isinstance(external, Written) else NAMES[code], arguments)

    def _violation(self, c: int, violation: Violation) -> ResourceTerm:
        users = tuple((self._user(t), amount) for t, amount in violation.charged if t >= 0)
        return ResourceTerm(
            self.database.objects.names[violation.resource],
            violation.wrong,
            violation.at,
            violation.until,
            violation.amount,
            violation.limit,
            violation.room,
            violation.helper != 0,
            violation.table is not None,
            users,
            self._demands(c, violation),
        )

    def _demands(self, c: int, violation: Violation) -> tuple[Term, ...]:
        """What a resource demands that is violated, the changes of its limits, and its uses."""
        name = self.database.objects.names[violation.resource]
        arguments = [self.argument(v) for v in self.engine.arguments(c)]
        limits = dict(zip(violation.limits, arguments, strict=False))
        match violation.wrong:
            case tags.TOO_LOW | tags.TOO_TIGHT:
                first = Term("levelAtLeast", (name, limits.get(tags.INITIAL, 0.0), limits.get(tags.MINIMUM, -inf)))
            case tags.TOO_HIGH:
                first = Term("levelAtMost", (name, limits.get(tags.INITIAL, 0.0), limits.get(tags.MAXIMUM, inf)))
            case tags.TOO_FAST:
                first = Term("rateAtMost", (name, *(limits.get(k, inf) for k in (tags.RATE, tags.PRODUCTION_RATE))))
            case _:
                first = Term("totalAtMost", (name, *(limits.get(k, inf) for k in (tags.TOTAL, tags.PRODUCTION_TOTAL))))
        found = [first]
        found += [Term("capacityFrom", (name, *step)) for step in violation.steps]
        found += [Term("levelFrom", (name, *step)) for step in violation.limit_steps]
        position = len(limits)
        for sign in violation.signs:
            count = min(2 + abs(sign), 4)
            kind = "use" if count > 3 else "consume" if sign < 0 else "produce"
            found.append(Term(kind, tuple(arguments[position : position + count])))
            position += 2 + abs(sign)
        return tuple(found)

    def _user(self, t: int) -> str:
        """The name of a token that uses something, with that of the token whose rule asks for it."""
        parent = self.plan.rows.parent[t]
        return f"{self.token(t)} of {self.token(parent)}" if parent >= 0 else self.token(t)


def _number(x: float, kind: int) -> float | int:
    """A bound as the model would write it; infinite where the engine counts it as infinite."""
    if abs(x) >= HALF_INF:
        return wide(x)
    if kind == KIND_FLOAT:
        return float(x) if abs(x) >= float_info.min else 0.0  # an open bound next to zero
    return int(x)
