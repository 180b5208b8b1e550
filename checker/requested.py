"""Programs and an argument that a reactor was asked for in, the lines out by which its senders came to ask for it.

A static slice, against the way of the value: from the argument of a child through local variables of the same rule to
parameters of its own token, and on through the rules that ask for that token, in whatever reactor.
"""

from collections import Counter
from collections.abc import Collection, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from checker.asked_children import children_asked_for, left_out, may_ask
from checker.influence import Branch, InfluenceLine, branch_name, branch_of, line_of
from checker.names import relative_name
from checker.single_values import numbers_of, single_value
from compiler.instructions import all_instructions, branched_instructions
from compiler.program import (
    FIRST_PARAMETER,
    TOKEN_TIMES,
    Child,
    Guard,
    LocalVariable,
    NewToken,
    NewVariable,
    Operand,
    Post,
    Program,
    RuleCode,
    TokenVariable,
)
from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import HALF_INF
from runtime.executive.events import events_on, single_events
from runtime.executive.outcome import ConflictElement, ElementKind, Event, EventKind, SourcePlace
from runtime.plan.readout.names import TokenName, VariableName

_EQUAL = "eq"
_TELLING = (EventKind.OBSERVATION, EventKind.REQUEST)
_Wanted = tuple[tuple[str, str], float | str | None]  # predicate and parameter, and its value if that is known
_MOST = 6  # lines that are told of one argument


@dataclass(frozen=True, slots=True)
class PlannerChoice:
    """An argument that the planner of a reactor has chosen, since no line says what it is; where it asked for that.

    Where the argument `is_open` it has chosen none, and asked for any value.
    """

    reactor: str
    argument: str
    place: SourcePlace | None
    is_open: bool = False


@dataclass(frozen=True, slots=True)
class _Asking:
    """The lines of a rule that say what a parameter of a child is.

    It comes from the own parameters `behind`, of which those `handed` on have the same value. All parameters of the
    child that are `passed` on stand with the own ones whose values they have. `token` tells of the one that asked.
    """

    rule: str
    lines: tuple[InfluenceLine, ...]
    behind: tuple[str, ...]
    handed: frozenset[str]
    passed: tuple[tuple[str, str], ...] = ()
    token: Event | None = None


def lines_that_ask(
    element: ConflictElement,
    programs: Mapping[str, Program],
    root: Path,
    held: Collection[str],
    taken: Container[Branch] | None = None,
    events: Sequence[Event] = (),
    timelines: Container[str] = (),
) -> tuple[InfluenceLine, ...]:
    """The lines by which an argument came to be asked for, the outermost first; none for a time.

    `programs` are those of the reactors by name, `held` the predicates, without their classes, of what has happened,
    `taken` the branches that were taken, if that is known: others have asked for nothing. Nor have tokens that handed
    another value on, by `events`, where one has handed on this; nor those that handed on other arguments than the
    request had, on one of the `timelines` that a conflict speaks of if any.
    """
    variable = _asked_variable(element)
    if variable is None or variable.token is None:
        return ()
    found: dict[InfluenceLine, None] = {}
    first: _Wanted = (variable.token.predicate, variable.name), _value(element)
    numbers = {reactor: dict(numbers_of(program)) for reactor, program in programs.items()}
    done: set[tuple[str, str]] = set()
    request = _request_for(first, events, timelines)
    waiting: list[tuple[tuple[str, str], float | str | None, Event | None]] = [(*first, request)]
    while waiting:
        wanted, value, asked = waiting.pop(0)
        if wanted in done:
            continue
        done.add(wanted)
        asking = [
            _asking(program, rule, wanted, numbers[reactor], value, taken, asked, events)
            for reactor, program in programs.items()
            for rule in (program.rules if wanted != first[0] or reactor != variable.reactor else ())
            if rule.predicate.rpartition(".")[2] in held
        ]
        if wanted == first[0]:
            asking = [one for one in asking if one.lines and _asked_so(one, request, events)] or asking
        for one in _with_value(asking, value, events):
            found |= dict.fromkeys(one.lines)
            waiting += [((one.rule, name), value if name in one.handed else None, one.token) for name in one.behind]
    return tuple(
        replace(line, place=replace(line.place, file=relative_name(line.place.file, root)))
        for line in reversed(list(found)[:_MOST])
    )


def who_chose(
    element: ConflictElement, programs: Mapping[str, Program], events: Iterable[Event], root: Path
) -> PlannerChoice | None:
    """Who asked for an argument of which no line says what it is, so that its planner chose; None where one may say it.

    To be asked of an element without `lines_that_ask`.
    """
    variable = _asked_variable(element)
    if variable is None or variable.token is None or variable.name in TOKEN_TIMES:
        return None
    predicate = variable.token.predicate
    wanted = predicate.rpartition(".")[2]
    asked = [one for one in events if one.kind is EventKind.REQUEST and one.predicate == wanted]
    if not asked or (sender := programs.get(asked[-1].reactor)) is None:
        return None
    steps = [step for rule in sender.rules for step in all_instructions(rule.body) if isinstance(step, Child)]
    spans = dict.fromkeys(step.span for step in steps if step.predicate == predicate)
    if not spans or any(isinstance(one, NewToken) and one.predicate == predicate for one in sender.script):
        return None
    place = line_of(next(iter(spans))) if len(spans) == 1 else None
    place = place and replace(place, file=relative_name(place.file, root))
    return PlannerChoice(asked[-1].reactor, f"{wanted}.{variable.name}", place)


def left_open(
    token: TokenName, tick: int, programs: Mapping[str, Program], events: Sequence[Event], root: Path
) -> Iterator[PlannerChoice]:
    """The arguments without any bound in the last request up to `tick` for what a token holds, with who asked so.

    What the owner says itself, who publishes its value, nobody needs to say.
    """
    wanted = token.predicate.rpartition(".")[2]
    asked = [
        one
        for one in single_events(events)
        if one.kind is EventKind.REQUEST and one.predicate == wanted and one.tick <= tick
    ]
    if not asked or (sender := programs.get(asked[-1].reactor)) is None:
        return
    seen = [one for one in events_on(events, {asked[-1].timeline}) if one.kind is EventKind.OBSERVATION]
    values = dict(next((one.arguments for one in reversed(seen) if one.predicate == wanted and one.tick <= tick), ()))
    for name, domain in asked[-1].arguments:
        lower, upper = domain.interval or (0, 0)
        if single_value(values.get(name)) is None and lower <= -HALF_INF and upper >= HALF_INF:
            spans = list(dict.fromkeys(_unsaid(sender, token.predicate, name)))
            place = line_of(spans[0]) if len(spans) == 1 else None
            place = place and replace(place, file=relative_name(place.file, root))
            yield PlannerChoice(asked[-1].reactor, f"{wanted}.{name}", place, is_open=True)


def lines_of_argument(
    program: Program, asker: str, wanted: tuple[str, str], root: Path, value: float | None = None
) -> tuple[SourcePlace, ...]:
    """The lines of a predicate's rules that say what a parameter of what they ask for is."""
    numbers = dict(numbers_of(program))
    rules = [rule for rule in program.rules if rule.predicate == asker]
    lines = (line for rule in rules for line in _asking(program, rule, wanted, numbers, value, None).lines)
    return tuple(dict.fromkeys(replace(one.place, file=relative_name(one.place.file, root)) for one in lines))


def _unsaid(program: Program, predicate: str, name: str) -> Iterator[Span]:
    """Where rules ask for a predicate without a line that speaks of one of its parameters."""
    at = _position(program, predicate, name)
    for rule in program.rules:
        steps = list(all_instructions(rule.body))
        told = {one for step in steps if isinstance(step, Post) for one in step.operands}
        for step in steps:
            if isinstance(step, Child) and step.predicate == predicate and TokenVariable(step.slot, at) not in told:
                yield step.span


def _asked_variable(element: ConflictElement) -> VariableName | None:
    """The variable of which an element says that it is as it was asked for; None where it says something else."""
    is_asked = element.kind is ElementKind.REQUEST and element.place is None
    return next(iter(element.variables), None) if is_asked else None


def _value(element: ConflictElement) -> float | str | None:
    """The one value that was asked for; None where it is not known."""
    for term in element.terms:
        match term.name, term.arguments, term.values:
            case "bounds", _, (name,):
                return name
            case "bounds", (_, int() | float() as lower, int() | float() as upper), () if lower == upper:
                return float(lower)
            case _:
                pass
    return None


def _with_value(asking: Sequence[_Asking], value: float | str | None, events: Sequence[Event]) -> Sequence[_Asking]:
    """Of the rules that ask those whose tokens had the value where they hand it on, if any had, and all others."""
    if value is None or sum(bool(one.lines) for one in asking) < 2 or not any(one.handed for one in asking):
        return asking
    had = {one.rule for one in asking if one.handed and value in _values(one, events)}
    return [one for one in asking if not had or not one.handed or one.rule in had]


def _request_for(wanted: _Wanted, events: Sequence[Event], timelines: Container[str]) -> Event | None:
    """The last request for a token with the value that is wanted."""
    (predicate, name), value = wanted
    asked = [
        one
        for one in single_events(events)
        if one.kind is EventKind.REQUEST and one.predicate == predicate.rpartition(".")[2]
        if value is None or single_value(dict(one.arguments).get(name)) == value
    ]
    return next(iter(reversed([one for one in asked if one.timeline in timelines] or asked)), None)


def _asked_so(asking: _Asking, request: Event | None, events: Sequence[Event]) -> bool:
    """Whether a token of a rule had all arguments that a request has from it."""
    if request is None or not asking.passed:
        return False
    wanted = dict(request.arguments)
    about = (one for one in single_events(events) if one.predicate == asking.rule.rpartition(".")[2])
    return any(
        all(
            single_value(dict(one.arguments).get(own)) in (None, single_value(wanted.get(name)))
            for name, own in asking.passed
            if single_value(wanted.get(name)) is not None
        )
        for one in about
        if one.kind in _TELLING
    )


def _tells_of(event: Event, rule: RuleCode) -> bool:
    return event.kind in _TELLING and event.predicate == rule.predicate.rpartition(".")[2]


def _values(asking: _Asking, events: Sequence[Event]) -> set[object]:
    """The values that tokens had, observed or asked for, of the parameters that a rule hands on."""
    wanted = asking.rule.rpartition(".")[2]
    about = (one for one in single_events(events) if one.predicate == wanted and one.kind in _TELLING)
    return {single_value(domain) for one in about for name, domain in one.arguments if name in asking.handed}


def _asking(
    program: Program,
    rule: RuleCode,
    wanted: tuple[str, str],
    numbers: Mapping[Operand, float | str],
    value: float | str | None,
    taken: Container[Branch] | None,
    request: Event | None = None,
    events: Sequence[Event] = (),
) -> _Asking:
    """The lines of a rule that say what a parameter of a child is, and the own parameters that this comes from.

    Of several children those count for which the `request` may have been.
    """
    predicate, name = wanted
    body = [step for step, within in branched_instructions(rule.body) if taken is None or _is_taken(within, taken)]
    at = _position(program, predicate, name)
    children = {step.slot for step in body if isinstance(step, Child) and step.predicate == predicate}
    token: Event | None = None
    if request is not None:
        theirs = _names(program, predicate)
        children = {slot for slot in children if may_ask(rule, slot, theirs, request, numbers)}
    if request is not None and children:
        tokens = [one for one in single_events(events) if _tells_of(one, rule)]
        parameters = _names(program, rule.predicate), _names(program, predicate)
        fitting, token = children_asked_for(rule, children, parameters, request, tokens, numbers)
        children = set(fitting)
        if token is not None:
            out = left_out(rule, fitting, parameters, request, token, numbers)
            body = [step for step in body if step not in out]
    reached: set[Operand] = {TokenVariable(slot, at) for slot in children} if at >= 0 else set()
    posts: list[Post] = []
    grows = bool(reached)
    while grows:
        grows = False
        for step in body:
            if isinstance(step, Post) and step not in posts and _sets(step, reached, numbers, value):
                posts.append(step)
                reached |= {one for one in step.operands if isinstance(one, LocalVariable)}
                grows = True
            elif isinstance(step, NewVariable) and step.copy_of is not None and LocalVariable(step.slot) in reached:
                grows = grows or step.copy_of not in reached
                reached.add(step.copy_of)
    _drop_uses(posts, children)
    own = {one.variable for post in posts for one in post.operands if isinstance(one, TokenVariable) and one.token == 0}
    own |= {one.variable for one in reached if isinstance(one, TokenVariable) and one.token == 0}
    names = _names(program, rule.predicate)
    behind = [names[one - FIRST_PARAMETER] for one in sorted(own) if 0 <= one - FIRST_PARAMETER < len(names)]
    lines = [InfluenceLine(rule.predicate, rule.predicate.rpartition(".")[2], line_of(post.span)) for post in posts]
    equal = [post.operands for post in posts if post.name == _EQUAL]
    handed = {
        names[one.variable - FIRST_PARAMETER]
        for operands in equal
        if children & {each.token for each in operands if isinstance(each, TokenVariable) and each.variable == at}
        for one in operands
        if isinstance(one, TokenVariable) and one.token == 0 and 0 <= one.variable - FIRST_PARAMETER < len(names)
    }
    return _Asking(
        rule.predicate, tuple(lines), tuple(behind), frozenset(handed), tuple(_passed(program, rule, predicate)), token
    )


def _drop_uses(posts: list[Post], children: Collection[int]) -> None:
    """Leave out what only goes on from the value: its product that nothing else says, what another child gets of it."""
    is_less = True
    while is_less:
        many = Counter(one for post in posts for one in set(post.operands))
        used = [post for post in posts if (end := _result(post, children)) is not None and many[end] == 1]
        for post in used:
            posts.remove(post)
        is_less = bool(used)


def _result(post: Post, children: Collection[int]) -> Operand | None:
    """What a constraint may give its value to: a local variable, or a parameter of a child that is none of some."""
    at_end = () if len(post.operands) < 3 else post.operands[:1] if post.name.startswith("test") else post.operands[-1:]
    gives = post.operands if post.name == _EQUAL else at_end
    for one in gives:
        if isinstance(one, TokenVariable) and one.token and one.token not in children:
            return one
        if isinstance(one, LocalVariable) and post.name != _EQUAL:
            return one
    return None


def _passed(program: Program, rule: RuleCode, predicate: str) -> Iterator[tuple[str, str]]:
    """The parameters that a rule hands on to its children of a predicate, each with its own, whatever the branch."""
    children = {
        one.slot for one in all_instructions(rule.body) if isinstance(one, Child) and one.predicate == predicate
    }
    theirs, own = _names(program, predicate), _names(program, rule.predicate)
    for step, within in branched_instructions(rule.body):
        if isinstance(step, Post) and step.name == _EQUAL and not within:
            for one, other in (step.operands[:2], step.operands[:2][::-1]):
                match one, other:
                    case TokenVariable(token=child, variable=at), TokenVariable(token=0, variable=mine):
                        places = at - FIRST_PARAMETER, mine - FIRST_PARAMETER
                        if child in children and 0 <= places[0] < len(theirs) and 0 <= places[1] < len(own):
                            yield theirs[places[0]], own[places[1]]
                    case _:
                        pass


def _is_taken(within: Iterable[tuple[Guard, bool]], taken: Container[Branch]) -> bool:
    """Whether a mission took all branches in which a line stands."""
    return all(branch_of(guard.span, branch_name(is_else)) in taken for guard, is_else in within)


def _sets(
    post: Post, reached: Collection[Operand], numbers: Mapping[Operand, float | str], value: float | str | None
) -> bool:
    """Whether a constraint speaks of what is reached, and does not say that it is another value than was asked for."""
    if not set(post.operands) & set(reached):
        return False
    others = [numbers[one] for one in post.operands if one in numbers]
    is_given = post.name == _EQUAL and len(post.operands) == 2 and len(others) == 1
    return not (is_given and value is not None and others[0] != value)


def _position(program: Program, predicate: str, name: str) -> int:
    """The number of a parameter among the variables of a token; -1 where there is none."""
    names = _names(program, predicate)
    return FIRST_PARAMETER + names.index(name) if name in names else -1


def _names(program: Program, predicate: str) -> list[str]:
    return next(([one.name for one in each.parameters] for each in program.predicates if each.name == predicate), [])
