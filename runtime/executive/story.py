"""Turn a conflict of the engine, or the failure log of a search, into the outcome's typed data, with source places."""

from math import inf

from compiler.program import NewGlobal, NewObject
from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import (
    HALF_INF,
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    KIND_OBJECT,
    KIND_STRING,
    SIDE_UPPER,
)
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.minimisation.minimise import minimise
from runtime.constraints.propagators.opcodes import OP_SAMPLE, OP_TEMPORAL_DISTANCE
from runtime.executive.outcome import (
    Conflict,
    ConflictElement,
    Deadlock,
    ElementKind,
    FailedChoice,
    SourcePlace,
)
from runtime.executive.view import SPAN_CLOCK, SPAN_EXECUTIVE, SPAN_MISSION, SPAN_OBSERVATION, SPAN_REQUEST
from runtime.executive.workbench import Workbench
from runtime.limits import TIME_LIMIT
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import Argument, ResourceTerm, Term
from runtime.plan.readout.terms import TermReader
from runtime.plan.script.natives import FILLED
from runtime.plan.tags import NONE, ROLE_INTERNAL, ROLE_LOCAL, ROLE_TOKEN
from runtime.solver.learning.attempts import Attempt, CauseOrigin, FailedFlaw, FoundCause
from runtime.solver.learning.failure_log import FailureLog
from runtime.solver.search import Solver
from runtime.user.written import Written

_DEEPEST_TOLD, _MOST_ENDS = 40, 20  # levels of a search in vain, and what ended deeper ones
_KINDS = {KIND_INT: "int", KIND_FLOAT: "float", KIND_BOOL: "bool", KIND_OBJECT: "object", KIND_STRING: "string"}
_ORIGINS = {
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
    reader = _ElementReader(bench)
    return Conflict(tuple(reader.element(cause) for cause in minimise(engine, engine.explain())))


def bounded(bench: Workbench, v: int, side: int) -> tuple[VariableName, Conflict]:
    """What sets a bound of `v`, the root first."""
    reader = _ElementReader(bench)
    links = bench.engine.support_chain(v, side)
    return reader.name(v), Conflict(tuple(dict.fromkeys(reader.element(link.cause) for link in reversed(links))))


def latest(bench: Workbench, v: int) -> tuple[VariableName, Conflict]:
    """What sets the latest value of `v`, and that nothing ends it earlier: each link of the chain is used up.

    The root comes first; that a token lasts as long as it may comes right after the limit that it uses up. `latest`
    terms say what value was reached, each followed by the terms from which it follows.
    """
    reader = _ElementReader(bench)
    elements: dict[ConflictElement, None] = {}
    tight: list[Term] = []
    reached: list[Term] = []
    for link in bench.engine.support_chain(v, SIDE_UPPER):
        element = reader.element(link.cause)
        if element in elements:
            continue
        elements[element] = None
        if link.side == SIDE_UPPER:
            tight += _used_up(element)
            reached += _reached(element)
    most = bench.engine.upper(v)
    if most >= HALF_INF:  # nothing ends it: it outlasts every tick
        tight = [Term("bounds", (reader.name(v), HALF_INF, inf))]
    elif tight:
        tight += reached
    else:  # something that is no difference ends it, such as `ceil`
        tight += [Term("latest", (reader.name(v), int(most))), *(one for each in elements for one in each.terms)]
    token = bench.name_of(bench.database.plan.variable_owner[v])
    policy = ConflictElement(ElementKind.LONGEST, None, "", token, None, tuple(dict.fromkeys(tight)))
    chain = list(reversed(elements))
    limits = [k for k, element in enumerate(chain) if any(term.name == "leq" for term in element.terms)]
    chain.insert(limits[-1] + 1 if limits else len(chain), policy)
    return reader.name(v), Conflict(tuple(chain))


def _reached(element: ConflictElement) -> list[Term]:
    """Terms that say that the upper end of a range is reached."""
    found = []
    for term in element.terms:
        match term.name, term.arguments:
            case "bounds", (VariableName() as variable, lower, int(upper)) if lower != upper and upper < HALF_INF:
                found += [Term("latest", (variable, upper)), term]
            case _:
                pass
    return found


def _used_up(element: ConflictElement) -> list[Term]:
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


class _ElementReader(TermReader):
    """Reads elements of conflicts off the plan of one reactor as it stands."""

    def __init__(self, bench: Workbench) -> None:
        super().__init__(bench.database, lambda t: str(self.token_name(t)))
        self.bench = bench
        self.tokens: dict[str, TokenName] = {}  # those that were named, by their texts

    def token_name(self, t: int) -> TokenName:
        """The name of a token, kept for who only has its text."""
        name = self.bench.name_of(t)
        self.tokens[str(name)] = name
        return name

    def element(self, cause: Cause) -> ConflictElement:
        """One cause as data."""
        found = self.term(cause)
        terms: tuple[Term, ...] = ()
        written = self.engine.externals.get(cause.id) if cause.kind is CauseKind.CONSTRAINT else None
        if isinstance(written, Written) and isinstance(found, Term):
            terms = _written_terms(written, found.arguments)
        kind = _element_kind(found, cause.span, is_declared=cause.span < 0)
        if cause.kind is CauseKind.CONSTRAINT and self.engine.op[cause.id] == OP_TEMPORAL_DISTANCE and cause.owner >= 0:
            kind = ElementKind.DURATION
        spans = self.database.code.spans
        place = _place_of(spans[cause.span]) if 0 <= cause.span < len(spans) else None
        token = self.token_name(cause.owner) if cause.owner >= 0 else None
        place = self.place_beyond(found, cause.span, kind, token) or place
        return _element(kind, place, token, found, terms)

    def place_beyond(
        self, found: Term | ResourceTerm, span: int, kind: ElementKind, token: TokenName | None
    ) -> SourcePlace | None:
        """Where something is written that no line of a rule says; None where it is not.

        `token` is what brought it: of a request, the token that was asked for, whatever it is merged with.
        """
        if span == SPAN_REQUEST:
            return self._asked(found, token)
        return self._declared(found) if span == NONE and kind is ElementKind.DECLARATION else None

    def _declared(self, found: Term | ResourceTerm) -> SourcePlace | None:
        """Where the global variable is declared, or the resource made, whose value a term without a place tells."""
        about = found.arguments[0] if isinstance(found, Term) and found.arguments else None
        if not isinstance(about, VariableName) or about.token is not None:
            return None
        thing, _, member = about.name.rpartition(".")
        for made in self.database.program.script:
            if isinstance(made, NewGlobal) and made.name == about.name and made.domain is not None:
                return _place_of(made.span)
            if isinstance(made, NewObject) and made.name == thing and thing:
                given = FILLED.get((made.class_name, len(made.arguments)), ())
                return _place_of(made.span) if member in given else None
        return None

    def _asked(self, found: Term | ResourceTerm, token: TokenName | None) -> SourcePlace | None:
        """Where the mission file bounds a time or parameter of a goal."""
        about = found.arguments[0] if isinstance(found, Term) and found.arguments else None
        if not isinstance(about, VariableName) or about.token is None:
            return None
        number = self.bench.goal_numbers.get((token or about.token).key)
        return None if number is None else dict(self.bench.goals[number].places).get(about.name)

    def term(self, cause: Cause) -> Term | ResourceTerm:
        """What a cause says; of a draw, the name of its parameter and the value."""
        found = super().term(cause)
        if isinstance(found, Term) and found.name == "sampledParameter" and self.engine.op[cause.id] == OP_SAMPLE:
            value = self.engine.lower(self.engine.arguments(cause.id)[-1])
            return Term(found.name, (found.arguments[0], self._parameter(cause.span), value))
        return found

    def argument(self, v: int) -> Argument:
        """The name of a variable, or the value of a constant."""
        engine = self.engine
        if engine.constant[v] and engine.lower(v) == engine.upper(v):
            value, kind = engine.lower(v), engine.kind[v]
            return value if kind == KIND_FLOAT else int(value) if kind in (KIND_INT, KIND_BOOL) else self.value(v)
        if engine.constant[v] and engine.kind[v] not in (KIND_FLOAT, KIND_INT, KIND_BOOL):
            return self.value(v)  # a set of objects, which is nobody's variable
        return self.name(v)

    def name(self, v: int) -> VariableName:
        """The name of a variable, in fields."""
        plan, reactor = self.plan, self.bench.name
        kind = _KINDS.get(self.engine.kind[v], "symbol")
        is_known = v < len(plan.variable_role)
        role = plan.variable_role[v] if is_known else -1
        owner = plan.variable_owner[v] if is_known else -1
        if role == ROLE_TOKEN and owner >= 0:
            return VariableName(self.part(v, owner), kind, self.token_name(owner), False, reactor)
        if role == ROLE_LOCAL and owner >= 0:
            name = self.database.names.text(plan.variable_name[v])
            return VariableName(name, kind, self.token_name(owner), True, reactor)
        if is_known and self.is_member_of_open_object(v):
            owning = self.name(plan.proxy_index[v])
            name = f"{owning.name}.{self.open_member(v)}"
            return VariableName(name, kind, owning.token, owning.is_local, reactor)
        if role > ROLE_INTERNAL:
            return VariableName(self.variable(v), kind, reactor=reactor)
        token = self.token_name(owner) if owner >= 0 else None
        return VariableName(f"_{v}", kind, token, token is not None, reactor)

    def _parameter(self, number: int) -> str:
        """The sampled parameter that is used at a span."""
        spans = self.database.code.spans
        if 0 <= number < len(spans):
            for site in self.database.program.sampled:
                if spans[number] in site.uses:
                    return site.name
        return "sampledParameter"


class SearchLog:
    """The failure log of a reactor's solver, and what it says in the outcome's terms."""

    def __init__(self, bench: Workbench, solver: Solver) -> None:
        self.reader = _ElementReader(bench)
        self.log = FailureLog(bench.database, solver.agenda, solver.stack, lambda: self.reader)

    @property
    def tried(self) -> int:
        """How many resolvers have failed, or were tried since none was left."""
        return self.log.count + self.log.pruned

    def is_enough(self) -> bool:
        """Whether time is over and something was found: on a slow machine the first failure may take all of it."""
        return self.tried > 0 and TIME_LIMIT.is_over()

    def deadlock(self) -> Deadlock | None:
        """Why the search ended without a plan; None if it did not."""
        return None if self.log.end is None else self._deadlock(self.log.end)

    def most_blamed(self) -> tuple[Span | None, int, int, int]:
        """The line that most of the failures name, None where none does, the first of those that as many name; how many
        others these are, how many failures name it, and how many there were."""
        blamed = self.log.blamed
        if not blamed:
            return None, 0, 0, self.tried
        most = max(blamed.values())
        alike = [span for span, count in blamed.items() if count == most]
        first = min(alike, key=lambda span: (span.source.name, span.line, span.column))
        return first, len(alike) - 1, most, self.tried

    def rejection(self, t: int) -> Deadlock | None:
        """Why the search rejected token `t`; None if it did not."""
        failed = self.log.rejections.get(self.reader.token(t))
        return None if failed is None else self._deadlock(failed)

    def _deadlock(self, failed: FailedFlaw, depth: int = 0) -> Deadlock:
        """What was tried in vain, level by level; of what lies deeper only the choices at which it ended."""
        tried = [
            FailedChoice(
                attempt.resolver,
                self._conflict((*attempt.causes, *attempt.told)),
                None if attempt.dead_end is None else self._deadlock(attempt.dead_end, depth + 1),
            )
            for attempt in (failed.attempts if depth < _DEEPEST_TOLD else _ends_of(failed))
        ]
        return Deadlock(failed.flaw, tried=tuple(tried))

    def _conflict(self, causes: tuple[FoundCause, ...]) -> Conflict | None:
        return Conflict(tuple(self._element(cause) for cause in causes)) if causes else None

    def _element(self, found: FoundCause) -> ConflictElement:
        kind = _element_kind(found.term, found.number, is_declared=found.origin is CauseOrigin.DECLARED)
        place = None if found.span is None else _place_of(found.span)
        token = self.reader.tokens.get(found.owner)
        place = self.reader.place_beyond(found.term, found.number, kind, token) or place
        return _element(kind, place, token, found.term, ())


def _ends_of(failed: FailedFlaw) -> list[Attempt]:
    """The first choices, whatever led to them, that were refuted at once."""
    found: list[Attempt] = []
    left = [failed]
    while left and len(found) < _MOST_ENDS:
        for attempt in left.pop().attempts:
            if attempt.dead_end is None:
                found.append(attempt)
            else:
                left.append(attempt.dead_end)
    return found[:_MOST_ENDS]


def _element(
    kind: ElementKind,
    place: SourcePlace | None,
    token: TokenName | None,
    found: Term | ResourceTerm,
    terms: tuple[Term, ...],
) -> ConflictElement:
    """An element; `terms` where what it says must be taken apart."""
    told = terms or (found.terms if isinstance(found, ResourceTerm) else (found,))
    return ConflictElement(kind, place, token.predicate if token is not None else "", token, found, told)


def _element_kind(found: Term | ResourceTerm, span: int, *, is_declared: bool) -> ElementKind:
    """What an element is, by what it says and where it comes from."""
    if isinstance(found, ResourceTerm):
        return ElementKind.RESOURCE
    match found.name:
        case "precedence":
            return ElementKind.RELATION if span >= 0 else _ORIGINS.get(span, ElementKind.ORDER)
        case "bounds":
            written = ElementKind.DECLARATION if is_declared else ElementKind.DECISION
            return ElementKind.ASSIGNMENT if span >= 0 else _ORIGINS.get(span, written)
        case "sampledParameter":
            return ElementKind.SAMPLE
        case _:
            return ElementKind.CONSTRAINT


def _written_terms(written: Written, arguments: tuple[Argument, ...]) -> tuple[Term, ...]:
    """The terms of a modeler's own constraint, who is given variables by their names as texts."""
    names = {str(one): one for one in arguments if isinstance(one, VariableName)}
    given = [str(one) if isinstance(one, VariableName) else one for one in arguments]
    found = written.terms(given) or ()
    return tuple(Term(name, tuple(names.get(str(one), one) for one in operands)) for name, operands in found)


def _place_of(span: Span) -> SourcePlace:
    """A span as data: file, line, column, and the text without line breaks."""
    line, column = span.source.locate(span.begin)
    return SourcePlace(span.source.name, line, column, " ".join(span.text.split()))
