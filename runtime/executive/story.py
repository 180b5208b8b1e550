"""Turn a conflict of the engine into the outcome's: causes with places in the model, reasons in words, and terms."""

from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import (
    FLAG_VALUES,
    HALF_INF,
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    KIND_OBJECT,
    KIND_STRING,
    SIDE_UPPER,
)
from runtime.constraints.explanation.cause import Cause as EngineCause
from runtime.constraints.explanation.cause import CauseKind
from runtime.constraints.minimisation.minimise import minimise
from runtime.constraints.propagators.opcodes import OP_TEMPORAL_DISTANCE
from runtime.constraints.propagators.registry import BY_NAME, NAMES
from runtime.executive.outcome import Cause, Conflict, Place, Term, VariableInfo
from runtime.executive.view import SPAN_CLOCK, SPAN_EXECUTIVE, SPAN_MISSION, SPAN_OBSERVATION, SPAN_REQUEST
from runtime.executive.workbench import Workbench
from runtime.plan.tags import DURATION, END, FIRST_PARAMETER, OBJECT, ROLE_GLOBAL, ROLE_LOCAL, ROLE_TOKEN, START, STATE
from runtime.user.written import Written

BUILT_IN = {STATE: "state", OBJECT: "object", DURATION: "duration", START: "start", END: "end"}
KINDS = {KIND_INT: "int", KIND_FLOAT: "float", KIND_BOOL: "bool", KIND_OBJECT: "object", KIND_STRING: "string"}
REASONS = {
    SPAN_OBSERVATION: "observation",
    SPAN_CLOCK: "clock",
    SPAN_EXECUTIVE: "order",
    SPAN_REQUEST: "observation",
    SPAN_MISSION: "declaration",
}


def conflict_of(bench: Workbench) -> Conflict | None:
    """The present conflict of a reactor's engine, shrunk to what is needed; None if there is none."""
    engine = bench.engine
    if engine.consistent:
        return None
    return told(bench, minimise(engine, engine.explain()))


def told(bench: Workbench, causes: list[EngineCause]) -> Conflict:
    """Causes of the engine as data that outlives it."""
    teller = Teller(bench)
    return Conflict(tuple(teller.cause(cause) for cause in causes), tuple(teller.variables.values()))


def latest(bench: Workbench, v: int) -> tuple[str, Conflict]:
    """What sets the latest value of `v`, and that nothing ends it earlier: each link of the chain is used up.

    The root comes first; that a token lasts as long as it may is told right after the limit that it uses up.
    """
    teller = Teller(bench)
    engine = bench.engine
    causes: dict[Cause, None] = {}
    tight: list[Term] = []
    for link in engine.support_chain(v, SIDE_UPPER):
        told_cause = teller.cause(link.cause)
        if told_cause in causes:
            continue
        causes[told_cause] = None
        if link.side == SIDE_UPPER:
            tight += used_up(teller, told_cause)
    name = str(teller.argument(v))
    token = teller.token(bench.database.plan.variable_owner[v])
    words = f"{token} lasts as long as the model lets it"
    policy = Cause("model", None, "", token, words, tuple(dict.fromkeys(tight)))
    chain = list(reversed(causes))
    limits = [k for k, cause in enumerate(chain) if any(term.name == "leq" for term in cause.terms)]
    chain.insert(limits[-1] + 1 if limits else len(chain), policy)
    return name, Conflict(tuple(chain), tuple(teller.variables.values()))


def used_up(teller: "Teller", cause: Cause) -> list[Term]:
    """Terms that say that an upper limit is reached: a difference is all its weight, `a <= b` leaves no whole step."""
    found = []
    for term in cause.terms:
        if term.name == "precedence":
            source, target, weight = term.arguments
            found.append(Term("precedence", (target, source, -int(weight))))
        elif term.name == "leq":
            a, b = term.arguments
            more = f"{a}+1"
            teller.variables[more] = VariableInfo(more, "int")
            found += [Term("addEq", (a, 1, more)), Term("lt", (b, more))]
    return found


class Teller:
    """Names tokens, variables and places of one reactor."""

    def __init__(self, bench: Workbench) -> None:
        self.bench = bench
        self.engine = bench.engine
        self.plan = bench.database.plan
        self.variables: dict[str, VariableInfo] = {}

    def cause(self, cause: EngineCause) -> Cause:
        """One cause in words and terms."""
        match cause.kind:
            case CauseKind.EDGE:
                kind, because, terms = self.edge(cause)
            case CauseKind.RESTRICTION:
                kind, because, terms = self.restriction(cause)
            case CauseKind.CONSTRAINT:
                kind, because, terms = self.constraint(cause)
        token = self.token(cause.owner) if cause.owner >= 0 else ""
        rule = self.bench.predicate_name(self.bench.rows.predicate[cause.owner]) if cause.owner >= 0 else ""
        return Cause(kind, self.place(cause.span), rule, token, because, terms)

    def token(self, t: int) -> str:
        """The name of a token."""
        return self.bench.token_name(t)

    def place(self, number: int) -> Place | None:
        """Where in the model a span stands."""
        spans = self.bench.database.code.spans
        if not 0 <= number < len(spans):
            return None
        return place_of(spans[number])

    def edge(self, cause: EngineCause) -> tuple[str, str, tuple[Term, ...]]:
        """An edge between two times."""
        engine = self.engine
        source = self.argument(engine.edge_source[cause.id])
        target = self.argument(engine.edge_target[cause.id])
        weight = int(engine.edge_weight[cause.id])
        kind = "relation" if cause.span >= 0 else REASONS.get(cause.span, "order")
        if weight == 0:
            because = f"{target} <= {source}"
        elif weight > 0:
            because = f"{target} <= {source} + {weight}"
        else:
            because = f"{target} + {-weight} <= {source}"
        return kind, because, (Term("precedence", (source, target, weight)),)

    def restriction(self, cause: EngineCause) -> tuple[str, str, tuple[Term, ...]]:
        """A base domain: a declaration, an assignment, an observation, the clock."""
        engine = self.engine
        v = engine.restriction_variable[cause.id]
        name = self.argument(v)
        lower, upper = engine.restriction_lo[cause.id], engine.restriction_hi[cause.id]
        kind = REASONS.get(cause.span, "assignment" if cause.span >= 0 else "declaration")
        if engine.restriction_flags[cause.id] & FLAG_VALUES and len(engine.restriction_values[cause.id]) == 1:
            lower = upper = engine.restriction_values[cause.id][0]
        lowest = lower if abs(lower) < HALF_INF else -float("inf")
        highest = upper if abs(upper) < HALF_INF else float("inf")
        if engine.kind[v] != KIND_FLOAT:
            lowest = int(lowest) if abs(lowest) < HALF_INF else lowest
            highest = int(highest) if abs(highest) < HALF_INF else highest
        if lowest == highest:
            because = f"{name} = {lowest}"
        elif highest == float("inf"):
            because = f"{name} >= {lowest}" if lowest != -float("inf") else f"{name} may be anything"
        elif lowest == -float("inf"):
            because = f"{name} <= {highest}"
        else:
            because = f"{lowest} <= {name} <= {highest}"
        return kind, because, (Term("bounds", (name, lowest, highest)),)

    def constraint(self, cause: EngineCause) -> tuple[str, str, tuple[Term, ...]]:
        """A constraint on variables."""
        engine = self.engine
        name = NAMES.get(engine.op[cause.id], f"constraint {engine.op[cause.id]}")
        arguments = [self.argument(v) for v in engine.arguments(cause.id)]
        if isinstance(written := engine.externals.get(cause.id), Written):
            terms = written.terms(arguments) or ((written.name, tuple(arguments)),)
            return "constraint", worded(written.name, arguments), tuple(Term(*term) for term in terms)
        kind = "constraint"
        if name == "sampledParameter":
            kind = "sample"
            value = engine.arguments(cause.id)[-1]
            parameter = self.bench.sampled_name(cause.span)
            because = f"{arguments[0]} = {parameter} = {engine.lower(value)!r}"
            return kind, because, (Term(name, (arguments[0], parameter, engine.lower(value))),)
        if engine.op[cause.id] == OP_TEMPORAL_DISTANCE and cause.owner >= 0:
            kind = "duration"
        return kind, worded(name, arguments), (Term(name, tuple(arguments)),)

    def argument(self, v: int) -> str | float | int:
        """The name of a variable, or the value of a constant."""
        engine = self.engine
        if engine.constant[v] and engine.lower(v) == engine.upper(v):
            value = engine.lower(v)
            return value if engine.kind[v] == KIND_FLOAT else int(value)
        name = self.variable(v)
        self.variables[name] = VariableInfo(name, KINDS.get(engine.kind[v], "symbol"))
        return name

    def variable(self, v: int) -> str:
        """The name of a variable: `Gps.Active#7.duration`, `Gps.Active#7::rate`, or that of a global."""
        plan = self.plan
        role = plan.variable_role[v] if v < plan.variable_capacity else -1
        owner = plan.variable_owner[v] if v < plan.variable_capacity else -1
        name = plan.variable_name[v] if v < plan.variable_capacity else -1
        prefix = f"{self.bench.name}:"
        if role == ROLE_TOKEN and owner >= 0:
            if name in BUILT_IN:
                return f"{prefix}{self.token(owner)}.{BUILT_IN[name]}"
            code = self.bench.database.program.predicates[self.bench.rows.predicate[owner]]
            return f"{prefix}{self.token(owner)}.{code.parameters[name - FIRST_PARAMETER].name}"
        if role == ROLE_LOCAL and owner >= 0:
            return f"{prefix}{self.token(owner)}::{self.bench.database.names.text(name)}"
        if role == ROLE_GLOBAL:
            return prefix + self.global_name(v)
        return f"{prefix}_{v}" if owner < 0 else f"{prefix}{self.token(owner)}::_{v}"

    def global_name(self, v: int) -> str:
        """The name of a global variable."""
        for number, (name, _) in enumerate(self.bench.database.program.globals):
            if self.plan.globals[number] == v:
                return name
        return f"_{v}"


def worded(name: str, arguments: list[str | float | int]) -> str:
    """A constraint as a modeler writes it, without the names of reactors."""
    texts = [str(argument).partition(":")[2] if isinstance(argument, str) else repr(argument) for argument in arguments]
    infix = BY_NAME[name].infix if name in BY_NAME else ""
    return infix.format(*texts) if infix.count("{") == len(texts) else f"{name}({', '.join(texts)})"


def place_of(span: Span) -> Place:
    """A span as data: file, line, column, and the text without line breaks."""
    line, column = span.source.locate(span.begin)
    return Place(span.source.name, line, column, " ".join(span.text.split()))
