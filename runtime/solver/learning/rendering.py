"""Put tokens, variables and causes of a conflict into the words of the model."""

from dataclasses import dataclass

from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import FLAG_DECISION, FLAG_VALUES, HALF_INF, KIND_FLOAT
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.propagators.opcodes import OP_TEMPORAL_DISTANCE
from runtime.constraints.propagators.registry import NAMES
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.provenance import span_of
from runtime.plan.readout.readout import live_tokens, token_names
from runtime.plan.resources.violation import Excess
from runtime.plan.store.domain_texts import base_text, domain_text
from runtime.plan.tags import END, FIRST_PARAMETER, FLAG_EVENT, ROLE_GLOBAL, ROLE_LOCAL, ROLE_MEMBER, ROLE_TOKEN, START
from runtime.solver.configuration.handler_matching import BUILT_IN
from runtime.user.written import Written


@dataclass(frozen=True, slots=True)
class Line:
    """One thing that holds: where the model says it, for which token's rule (empty: in the script), what it comes to.

    What has no place was `declared` with a variable, or `decided` by the search, or is `so` because of the others.
    """

    span: Span | None
    owner: str
    text: str
    how: str = "decided"


class Wording:
    """Names as the plan stands now; ask for a new one after it has changed."""

    def __init__(self, database: PlanDatabase) -> None:
        self.database = database
        self.plan = database.plan
        self.engine = database.engine
        self.tokens = token_names(database, live_tokens(database))

    def token(self, t: int) -> str:
        """The name of a token."""
        return self.tokens.get(t, f"token {t}")

    def user(self, t: int) -> str:
        """The name of a token that uses something, with that of the token whose rule asks for it."""
        master = self.plan.rows.master[t]
        return f"{self.token(t)} of {self.token(master)}" if master >= 0 else self.token(t)

    def variable(self, v: int) -> str:
        """The name of a variable; a constant is its value."""
        plan, program = self.plan, self.database.program
        role, owner, name = plan.variable_role[v], plan.variable_owner[v], plan.variable_name[v]
        if role == ROLE_TOKEN:
            place = v - plan.rows.var0[owner]
            code = program.predicates[plan.rows.predicate[owner]]
            if place >= FIRST_PARAMETER:
                return f"{self.token(owner)}.{code.parameters[place - FIRST_PARAMETER].name}"
            if plan.rows.flags[owner] & FLAG_EVENT and place in (START, END):
                return f"{self.token(owner)}.time"
            return f"{self.token(owner)}.{BUILT_IN[place]}"
        if role == ROLE_GLOBAL:
            return program.globals[name][0]
        if role == ROLE_MEMBER:
            member = program.classes[plan.object_class[owner]].members[name].name
            return f"{self.database.objects.names[owner]}.{member}"
        if role == ROLE_LOCAL:
            return f"{self.token(owner)}::{self.database.names.text(name)}"
        return self.value(v)

    def value(self, v: int) -> str:
        """The domain of a variable, without its type."""
        text = domain_text(self.database.prototypes, self.engine, v, self.database.objects.names, "x")
        text = text.removesuffix(" open").removesuffix(" x").rpartition(" ")[0] or text.removesuffix(" x")
        return text[1:-1] if text.startswith("{") and "," not in text else text

    def line(self, cause: Cause) -> Line:
        """A cause as a line of the model."""
        owner = self.token(cause.owner) if cause.owner >= 0 else ""
        match cause.kind:
            case CauseKind.EDGE:
                text = self.edge(cause.id)
            case CauseKind.RESTRICTION:
                text = self.restriction(cause.id)
            case CauseKind.CONSTRAINT:
                text = self.constraint(cause.id)
        if cause.kind is CauseKind.CONSTRAINT and isinstance(self.engine.externals.get(cause.id), Excess):
            return Line(None, "", text, "so")
        is_declared = cause.kind is CauseKind.RESTRICTION and not self.is_decision(cause.id)
        return Line(span_of(self.database, cause.span), owner, text, "declared" if is_declared else "decided")

    def is_decision(self, r: int) -> bool:
        """Whether a restriction gives a variable its value by decision."""
        return bool(self.engine.restriction_flags[r] & FLAG_DECISION)

    def edge(self, e: int) -> str:
        """What a temporal edge says."""
        engine = self.engine
        source, target = self.variable(engine.edge_source[e]), self.variable(engine.edge_target[e])
        weight = int(engine.edge_weight[e])
        if weight < 0:
            return f"{target} + {-weight} <= {source}"
        return f"{target} <= {source}" if weight == 0 else f"{target} <= {source} + {weight}"

    def restriction(self, r: int) -> str:
        """What an assignment, a declaration or a decision says."""
        engine = self.engine
        v = engine.restriction_variable[r]
        name = self.variable(v)
        low, high = engine.restriction_lo[r], engine.restriction_hi[r]
        if engine.restriction_flags[r] & FLAG_VALUES or (
            engine.kind[v] != KIND_FLOAT and low == high and not self.is_decision(r)
        ):
            text = base_text(self.database.prototypes, engine, v, self.database.objects.names)
            return f"{name} in {text}" if text[:1] in "{[" else f"{name} = {text}"
        if low == high:
            return f"{name} = {number(low, engine.kind[v])}"
        if low <= -HALF_INF:
            return f"{name} <= {number(high, engine.kind[v])}"
        if high >= HALF_INF:
            return f"{name} >= {number(low, engine.kind[v])}"
        return f"{name} in [{number(low, engine.kind[v])}, {number(high, engine.kind[v])}]"

    def constraint(self, c: int) -> str:
        """What a constraint says, with the values that its variables may have."""
        engine = self.engine
        arguments = list(engine.arguments(c))
        if engine.op[c] == OP_TEMPORAL_DISTANCE and len(arguments) == 3:
            names = [self.variable(v) for v in arguments]
            return f"{names[0]} + {names[1]} = {names[2]}, {names[1]} is {self.value(arguments[1])}"
        external = engine.externals.get(c)
        if isinstance(external, Excess):
            return external.words(self.database.objects.names[external.resource], self.user)
        name = external.name if isinstance(external, Written) else NAMES.get(engine.op[c], "constraint")
        return f"{name}({', '.join(self.variable(v) for v in arguments)})"


def number(x: float, kind: int) -> str:
    """A number as the model would write it."""
    return repr(float(x)) if kind == KIND_FLOAT else str(int(x))
