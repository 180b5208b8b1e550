"""Turn a conflict of the engine into the outcome's: typed elements with their places in the model."""

from math import inf

from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import (
    FLAG_VALUES,
    HALF_INF,
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    KIND_OBJECT,
    KIND_STRING,
    OP_FREEZE,
    OP_PLUS,
    OP_SAMPLE,
    OP_TEMPORAL_DISTANCE,
    SIDE_UPPER,
)
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.minimisation.minimise import minimise
from runtime.constraints.propagators.operations import OPERATIONS
from runtime.executive.outcome import (
    Conflict,
    ConflictElement,
    ElementKind,
    Operand,
    SourcePlace,
    Term,
    TokenName,
    VariableName,
)
from runtime.executive.rendering import variable_name
from runtime.executive.view import SPAN_CLOCK, SPAN_EXECUTIVE, SPAN_MISSION, SPAN_OBSERVATION, SPAN_REQUEST
from runtime.executive.workbench import Workbench
from runtime.plan.tags import DURATION, END, FIRST_PARAMETER, OBJECT, ROLE_GLOBAL, ROLE_LOCAL, ROLE_TOKEN, START, STATE
from runtime.user.written import Written

NAMES = {code: name for name, code in reversed(OPERATIONS.items())}
NAMES |= {OP_FREEZE: "foreach", OP_PLUS: "addEq", OP_SAMPLE: "sampledParameter"}
BUILT_IN = {STATE: "state", OBJECT: "object", DURATION: "duration", START: "start", END: "end"}
KINDS = {KIND_INT: "int", KIND_FLOAT: "float", KIND_BOOL: "bool", KIND_OBJECT: "object", KIND_STRING: "string"}
NUMBERS = (KIND_INT, KIND_FLOAT, KIND_BOOL)
ORIGINS = {
    SPAN_OBSERVATION: ElementKind.OBSERVATION,
    SPAN_CLOCK: ElementKind.CLOCK,
    SPAN_EXECUTIVE: ElementKind.ORDER,
    SPAN_REQUEST: ElementKind.REQUEST,
    SPAN_MISSION: ElementKind.DECLARATION,
}


def conflict_of(bench: Workbench) -> Conflict | None:
    """The present conflict of a reactor's engine, shrunk to what is needed; None if there is none."""
    engine = bench.engine
    if engine.consistent:
        return None
    return conflict_from(bench, minimise(engine, engine.explain()))


def conflict_from(bench: Workbench, causes: list[Cause]) -> Conflict:
    """Causes of the engine as data that outlives it."""
    reader = ElementReader(bench)
    return Conflict(tuple(reader.element(cause) for cause in causes))


def latest(bench: Workbench, v: int) -> tuple[VariableName, Conflict]:
    """What sets the latest value of `v`, and that nothing ends it earlier: each link of the chain is used up.

    The root comes first; that a token lasts as long as it may comes right after the limit that it uses up.
    """
    reader = ElementReader(bench)
    elements: dict[ConflictElement, None] = {}
    tight: list[Term] = []
    for link in bench.engine.support_chain(v, SIDE_UPPER):
        element = reader.element(link.cause)
        if element in elements:
            continue
        elements[element] = None
        if link.side == SIDE_UPPER:
            tight += used_up(element)
    token = reader.token(bench.database.plan.variable_owner[v])
    policy = ConflictElement(ElementKind.LONGEST, None, "", token, None, tuple(dict.fromkeys(tight)))
    chain = list(reversed(elements))
    limits = [k for k, element in enumerate(chain) if any(term.name == "leq" for term in element.terms)]
    chain.insert(limits[-1] + 1 if limits else len(chain), policy)
    return reader.variable(v), Conflict(tuple(chain))


def used_up(element: ConflictElement) -> list[Term]:
    """Terms that say that an upper limit is reached: a difference is all its weight, `a <= b` leaves no whole step."""
    found = []
    for term in element.terms:
        match term.name, term.arguments:
            case "precedence", (source, target, int(weight)):
                found.append(Term("precedence", (target, source, -weight)))
            case "leq", (a, b):
                named = a if isinstance(a, VariableName) else VariableName(str(a), "int")
                more = VariableName(f"{named.name} + 1", "int", named.token, named.is_local, named.reactor)
                found += [Term("addEq", (a, 1, more)), Term("lt", (b, more))]
    return found


def place_of(span: Span) -> SourcePlace:
    """A span as data: file, line, column, and the text without line breaks."""
    line, column = span.source.locate(span.begin)
    return SourcePlace(span.source.name, line, column, " ".join(span.text.split()))


def _written_terms(written: Written, arguments: tuple[Operand, ...]) -> tuple[Term, ...]:
    """The terms of a modeler's own constraint, who is given variables by their names as texts."""
    names = {variable_name(one): one for one in arguments if isinstance(one, VariableName)}
    given = [variable_name(one) if isinstance(one, VariableName) else one for one in arguments]
    found = written.terms(given) or ()
    return tuple(Term(name, tuple(names.get(str(one), one) for one in operands)) for name, operands in found)


class ElementReader:
    """Names tokens, variables and places of one reactor."""

    def __init__(self, bench: Workbench) -> None:
        self.bench = bench
        self.engine = bench.engine
        self.database = bench.database
        self.plan = bench.database.plan

    def element(self, cause: Cause) -> ConflictElement:
        """One cause as data."""
        match cause.kind:
            case CauseKind.EDGE:
                return self._element(cause, *self._edge(cause))
            case CauseKind.RESTRICTION:
                return self._element(cause, *self._restriction(cause))
            case CauseKind.CONSTRAINT:
                return self._element(cause, *self._constraint(cause))

    def token(self, t: int) -> TokenName:
        """The name of a token."""
        return TokenName(self.bench.predicate_name(self.bench.predicate_of(t)), self.bench.key(t))

    def variable(self, v: int) -> VariableName:
        """The name of a variable."""
        plan, reactor = self.plan, self.bench.name
        kind = KINDS.get(self.engine.kind[v], "symbol")
        is_known = v < plan.variable_capacity
        role = plan.variable_role[v] if is_known else -1
        owner = plan.variable_owner[v] if is_known else -1
        name = plan.variable_name[v] if is_known else -1
        token = self.token(owner) if owner >= 0 and role != ROLE_GLOBAL else None
        if role == ROLE_TOKEN and token is not None:
            if name in BUILT_IN:
                return VariableName(BUILT_IN[name], kind, token, False, reactor)
            code = self.database.program.predicates[self.bench.predicate_of(owner)]
            return VariableName(code.parameters[name - FIRST_PARAMETER].name, kind, token, False, reactor)
        if role == ROLE_LOCAL and token is not None:
            return VariableName(self.database.names.text(name), kind, token, True, reactor)
        if role == ROLE_GLOBAL:
            return VariableName(self._global_name(v), kind, reactor=reactor)
        return VariableName(f"_{v}", kind, token, token is not None, reactor)

    def argument(self, v: int) -> Operand:
        """The name of a variable, or the value of a constant."""
        engine = self.engine
        if engine.constant[v] and engine.lower(v) == engine.upper(v):
            return self._value(v, engine.lower(v))
        return self.variable(v)

    def _element(self, cause: Cause, kind: ElementKind, says: Term, terms: tuple[Term, ...]) -> ConflictElement:
        spans = self.database.code.spans
        place = place_of(spans[cause.span]) if 0 <= cause.span < len(spans) else None
        if cause.owner < 0:
            return ConflictElement(kind, place, "", None, says, terms)
        token = self.token(cause.owner)
        return ConflictElement(kind, place, token.predicate, token, says, terms)

    def _edge(self, cause: Cause) -> tuple[ElementKind, Term, tuple[Term, ...]]:
        """An edge between two times."""
        engine, edge = self.engine, cause.id
        ends = self.argument(engine.edge_source[edge]), self.argument(engine.edge_target[edge])
        kind = ElementKind.RELATION if cause.span >= 0 else ORIGINS.get(cause.span, ElementKind.ORDER)
        term = Term("precedence", (*ends, int(engine.edge_weight[edge])))
        return kind, term, (term,)

    def _restriction(self, cause: Cause) -> tuple[ElementKind, Term, tuple[Term, ...]]:
        """A base domain: a declaration, an assignment, an observation, the clock."""
        engine, r = self.engine, cause.id
        v = engine.restriction_variable[r]
        written = ElementKind.ASSIGNMENT if cause.span >= 0 else ElementKind.DECLARATION
        kind = ORIGINS.get(cause.span, written)
        lower, upper = engine.restriction_lo[r], engine.restriction_hi[r]
        members = list(engine.restriction_values[r]) if engine.restriction_flags[r] & FLAG_VALUES else []
        if not members and engine.kind[v] not in NUMBERS and lower > -HALF_INF and upper < HALF_INF:
            members = [float(number) for number in range(int(lower), int(upper) + 1)]
        if engine.kind[v] in NUMBERS and len(members) == 1:
            lower = upper = members.pop()
        if members:
            term = Term("member", (self.argument(v), *(self._value(v, member) for member in members)))
        else:
            term = Term("bounds", (self.argument(v), self._bound(v, lower), self._bound(v, upper)))
        return kind, term, (term,)

    def _constraint(self, cause: Cause) -> tuple[ElementKind, Term, tuple[Term, ...]]:
        """A constraint on variables."""
        engine, c = self.engine, cause.id
        arguments = tuple(self.argument(v) for v in engine.arguments(c))
        if isinstance(written := engine.externals.get(c), Written):
            says = Term(written.name, arguments)
            return ElementKind.CONSTRAINT, says, _written_terms(written, arguments) or (says,)
        term = Term(NAMES.get(engine.op[c], f"constraint {engine.op[c]}"), arguments)
        if engine.op[c] == OP_SAMPLE:
            value = engine.lower(engine.arguments(c)[-1])
            term = Term(term.name, (arguments[0], self._parameter(cause.span), value))
            return ElementKind.SAMPLE, term, (term,)
        is_duration = engine.op[c] == OP_TEMPORAL_DISTANCE and cause.owner >= 0
        return ElementKind.DURATION if is_duration else ElementKind.CONSTRAINT, term, (term,)

    def _value(self, v: int, number: float) -> float | int | str:
        """A value as the model has it: a number, or the name of a symbol or an object, or a text."""
        kind, prototypes = self.engine.kind[v], self.database.prototypes
        if kind == KIND_FLOAT:
            return float(number)
        if kind in NUMBERS:
            return int(number)
        if kind == KIND_OBJECT:
            return str(self.database.objects.names[int(number)])
        return str((prototypes.texts if kind == KIND_STRING else prototypes.symbols).text(int(number)))

    def _bound(self, v: int, bound: float) -> float | int:
        if abs(bound) >= HALF_INF:
            return inf if bound > 0 else -inf
        return float(bound) if self.engine.kind[v] == KIND_FLOAT else int(bound)

    def _parameter(self, number: int) -> str:
        """The sampled parameter that is used at a span."""
        spans = self.database.code.spans
        if 0 <= number < len(spans):
            for site in self.database.program.sampled:
                if spans[number] in site.uses:
                    return site.name
        return "sampledParameter"

    def _global_name(self, v: int) -> str:
        for number, (name, _) in enumerate(self.database.program.globals):
            if self.plan.globals[number] == v:
                return name
        return f"_{v}"
