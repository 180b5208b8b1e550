"""A conflict in one reactor, told on through the reactors that published, or asked for, what it hangs on."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from runtime.constraints.domains.tags import HALF_INF, SIDE_LOWER, SIDE_UPPER
from runtime.executive.differences import contradict
from runtime.executive.dispatch import Dispatch
from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import Conflict, ConflictElement, Deadlock, ElementKind
from runtime.executive.reactor import TeleoReactor, Watched
from runtime.executive.story import bounded, latest
from runtime.executive.timelines import NOTHING, Goal, TimelineState
from runtime.executive.trace import Trace, as_it_is
from runtime.executive.view import SPAN_OBSERVATION
from runtime.executive.workbench import Workbench
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import Term

_TIMES = ("start", "end", "duration")


def watched_in(
    conflict: Conflict, bench: Workbench, timelines: Sequence[TimelineState], goals: Sequence[Goal]
) -> tuple[Watched, ...]:
    """The elements of a conflict that say how long what another reactor published lasts, or what one asked for."""
    ends = {
        bench.name_of(line.current): line.source
        for line in timelines
        if not line.is_internal and line.current != NOTHING and line.source is not None
    }
    asked = {
        bench.name_of(goal.token): goal.request
        for goal in goals
        if goal.request.sender and bench.is_alive(goal.token, goal.token_key)
    }
    return tuple(_watched(conflict, ends, asked))


def _watched(
    conflict: Conflict, ends: Mapping[TokenName, Observation], asked: Mapping[TokenName, Request]
) -> Iterator[Watched]:
    for number, element in enumerate(conflict.elements):
        variable = element.terms[0].arguments[0] if element.terms and element.terms[0].arguments else None
        if element.token is None or not isinstance(variable, VariableName) or variable.token != element.token:
            continue
        if element.kind is ElementKind.OBSERVATION and variable.name == "end" and element.token in ends:
            yield Watched(number, variable, ends[element.token])
        elif element.kind is ElementKind.REQUEST and variable.name in _TIMES and element.token in asked:
            yield Watched(number, variable, asked[element.token])


def asked_in(
    deadlock: Deadlock | None, watched: Callable[[Conflict], Sequence[Watched]], trace: Trace
) -> Deadlock | None:
    """What was tried in vain, with what set the times in it that other reactors asked for.

    As a search does not shrink what it met, what holds without these requests is left as it is.
    """
    if deadlock is None or trace.tell_on is as_it_is:
        return deadlock
    tried = []
    for one in deadlock.tried:
        told = one.conflict
        if told is not None and not contradict(e for e in told.elements if e.kind is not ElementKind.REQUEST):
            told = trace.tell_on(told, tuple(each for each in watched(told) if isinstance(each.source, Request)))
        tried.append(replace(one, conflict=told, leads_to=asked_in(one.leads_to, watched, trace)))
    return replace(deadlock, tried=tuple(tried))


def why_sent(
    bench: Workbench, dispatch: Dispatch, number: int, name: str, side: int
) -> tuple[VariableName, float, Conflict] | None:
    """A time of a token that was asked for by a request: its name, its bound now, and what sets that."""
    for key, request in dispatch.sent.items():
        token = dispatch.sent_tokens[key]
        if request.number == number and bench.is_alive(token, key):
            times = {"start": bench.start, "end": bench.end, "duration": bench.duration}
            v = times[name](token)
            bound = bench.upper(v) if side == SIDE_UPPER else bench.lower(v)
            named, reasons = bounded(bench, v, side)
            return named, bound, reasons
    return None


def why_lasting(
    bench: Workbench,
    timelines: Sequence[TimelineState],
    hangs_on: Callable[[Conflict], Sequence[Watched]],
    token: int,
    key: int,
    least: float,
) -> tuple[VariableName, Conflict] | None:
    """The end of a token, and what sets it: what others publish or ask for, where that alone makes it `least` or later;
    else the token lasts as long as the model allows (T-REX 1.5).
    """
    if not bench.is_alive(token, key):
        return None
    end, mark = bench.end(token), bench.mark()
    behind = bounded(bench, end, SIDE_LOWER) if _outlasts(bench, timelines, end, least) else None
    bench.rewind_to(mark)
    bench.release(mark)
    return behind if behind is not None and hangs_on(behind[1]) else latest(bench, end)


def _outlasts(bench: Workbench, timelines: Sequence[TimelineState], end: int, least: float) -> bool:
    """Whether an end is `least` or later if what others publish goes on until then, as who sleeps has not been told."""
    if least < 0:
        return False
    for line in timelines:
        if not line.is_internal and line.current != NOTHING and line.news is None:
            if not bench.at_least(bench.end(line.current), least, SPAN_OBSERVATION, line.current):
                return False
    return bool(bench.engine.lower(end) >= least)


def told_on(
    conflict: Conflict,
    watches: Sequence[Watched],
    reactors: Sequence[TeleoReactor],
    told: frozenset[str] = frozenset(),
) -> Conflict:
    """A conflict with what set the times in it that others answer for, before each.

    It is not told on through reactors that it came through: these have been `told` of.
    """
    elements = [[element] for element in conflict.elements]
    for watched in watches:
        element, source = conflict.elements[watched.number], watched.source
        on = told | {watched.variable.reactor}
        name = source.sender if isinstance(source, Request) else source.owner
        owner = next((one for one in reactors if one.name == name and name not in on), None)
        if owner is None:
            continue
        if isinstance(source, Request):
            elements[watched.number] = _asked(element, watched.variable, source, owner, reactors, on)
            continue
        lasts = owner.why_it_lasts(source.token, source.token_key, _least(element))
        if lasts is not None:
            end, reasons = lasts
            reasons = told_on(reasons, owner.hangs_on(reasons), reactors, on)
            observed = replace(
                element,
                kind=ElementKind.SHARED_END,
                says=None,
                terms=(Term("eq", (watched.variable, end)),),
                observed=(source.predicate, source.timeline),
            )
            elements[watched.number] = [*reasons.elements, observed]
    return Conflict(tuple(dict.fromkeys(element for together in elements for element in together)))


def _least(element: ConflictElement) -> float:
    """The tick at which an observed token that goes on is over at the earliest; -1 where it is over."""
    match element.terms:
        case (Term(name="bounds", arguments=(_, int() | float() as lower, int() | float() as upper)),):
            return lower if upper >= HALF_INF else -1
        case _:
            return -1


def _asked(
    element: ConflictElement,
    variable: VariableName,
    request: Request,
    sender: TeleoReactor,
    reactors: Sequence[TeleoReactor],
    told: frozenset[str],
) -> list[ConflictElement]:
    """What was asked for, behind what set it in the plan of who asked; only as far as that plan has not changed."""
    match element.terms:
        case (Term(name="bounds", arguments=(_, int() | float() as lower, int() | float() as upper)),):
            pass
        case _:
            return [element]
    left = [lower, upper]
    reasons: dict[ConflictElement, None] = {}
    for index, (side, bound) in enumerate(((SIDE_LOWER, lower), (SIDE_UPPER, upper))):
        found = sender.why_asked(request.number, variable.name, side) if abs(bound) < HALF_INF else None
        if found is not None and found[1] == bound:
            name, _, conflict = found
            reasons |= dict.fromkeys(told_on(conflict, sender.hangs_on(conflict), reactors, told).elements)
            left[index] = -HALF_INF if side == SIDE_LOWER else HALF_INF
    if not reasons:
        return [element]
    terms = [Term("eq", (variable, name))]
    if any(abs(one) < HALF_INF for one in left):
        terms.append(Term("bounds", (variable, *left)))
    return [*reasons, replace(element, terms=tuple(terms))]
