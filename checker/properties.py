"""Properties of a mission: a record in, which promise was kept and by what margin out.

Each is about the tokens that were executed on one timeline, or on two. A margin is how far a numeric condition was from
being violated (in units of the argument, or in ticks); it steers the adaptive sampler, and reports tell the least one.
"""

import ast
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

from checker.judge.report import ResourceProfile
from checker.levels import level_fate
from checker.sampling.rendering import number
from compiler.program import TOKEN_TIMES
from runtime.executive.columns import TokenColumns
from runtime.executive.configuration import AgentConfiguration, PropertyConfiguration, PropertyKind, TokenPattern
from runtime.executive.expression import ExpressionError, parse_expression
from runtime.executive.outcome import Event, EventKind, PropertyFate
from runtime.executive.record import MissionRecord, OpenValues, ReactorRecord, TokenRecord, ValueRange

_MOST_SHOWN = 4  # values of an argument
_NUMBERS = re.compile(r"\d+(?:\.\d+)?")
_ORDERS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE)


@dataclass(frozen=True, slots=True)
class _Held:
    """A token that was executed, with its arguments by name: `end` is infinite while it goes on, to `least_end` at
    least."""

    predicate: str
    start: int
    end: float
    arguments: Mapping[str, object]
    least_end: float


def property_fates(
    agent: AgentConfiguration,
    arguments: Mapping[str, Sequence[str]],
    record: MissionRecord,
    last_tick: int,
    events: Sequence[Event] = (),
    profiles: Sequence[ResourceProfile] = (),
    *,
    is_cut: bool = False,
) -> tuple[PropertyFate, ...]:
    """What became of each property; `arguments` names those of each predicate (`Class.predicate`).

    Where a flight `is_cut` off before the mission ends, what is to come later may come yet. What no reactor with a
    model owns or uses is in no record: of that the events tell what was published.
    """
    histories: dict[str, list[_Held]] = {}

    def history(timeline: str) -> list[_Held]:
        if timeline not in histories:
            found = _history(agent, timeline, arguments, record, last_tick, events)
            histories[timeline] = _published(timeline, events, last_tick) if found is None else found
        return histories[timeline]

    def fate(one: PropertyConfiguration) -> PropertyFate:
        if one.level is not None:
            return level_fate(one, one.level, profiles, record, agent.final_tick if one.by is None else one.by)
        then = history(one.then.timeline) if one.then else []
        return _fate(one, history(one.pattern.timeline), then, agent, last_tick, is_cut)

    return tuple(fate(one) for one in agent.properties)


def _history(
    agent: AgentConfiguration,
    timeline: str,
    arguments: Mapping[str, Sequence[str]],
    record: MissionRecord,
    last_tick: int,
    events: Sequence[Event],
) -> list[_Held] | None:
    """What was executed on a timeline, in order; as its owner recorded it, else as one who observed it did."""
    owners = [one.name for one in agent.reactors if timeline in one.internal]
    users = [one.name for one in agent.reactors if timeline in one.external]
    reactor = next((one for name in (*owners, *users) for one in record.reactors if one.reactor == name), None)
    if reactor is None:
        return None
    begun = [
        token
        for token in _tokens_on(reactor, timeline)
        if token.state == "active" and isinstance(token.start, int | float) and token.start <= last_tick
    ]
    found = [_held(token, arguments, last_tick) for token in begun if token.fate != "cut"]
    cut = {_head(token): token for token in begun if token.fate == "cut"}
    if cut:  # a repair forgets what is past: what has happened is what was published
        known = {(one.start, one.predicate) for one in found}
        for one in _published(timeline, events, last_tick):
            if (one.start, one.predicate) not in known:
                token = cut.get((one.start, one.predicate))
                said = dict(one.arguments) | (_decided(token, arguments) if token is not None else {})
                found.append(replace(one, arguments=said))
    return sorted(found, key=lambda one: (one.start, one.end))


def _held(token: TokenRecord, arguments: Mapping[str, Sequence[str]], last_tick: int) -> _Held:
    """What a token of the plan held when the mission ended."""
    start, predicate = _head(token)
    end = float(token.end) if isinstance(token.end, int | float) else math.inf
    given = _decided(token, arguments) | {"start": start, "end": end, "duration": end - start}
    least = max(last_tick + 1.0, token.end.lower if isinstance(token.end, ValueRange) else end)
    return _Held(predicate, start, end, given, least if end == math.inf else end)


def _head(token: TokenRecord) -> tuple[int, str]:
    assert isinstance(token.start, int | float)
    return int(token.start), token.predicate.rpartition(".")[2]


def _decided(token: TokenRecord, arguments: Mapping[str, Sequence[str]]) -> dict[str, object]:
    """The arguments of a token by name."""
    return dict(zip(arguments.get(token.predicate, ()), token.arguments, strict=False))


def _published(timeline: str, events: Sequence[Event], last_tick: int) -> list[_Held]:
    """What was published on a timeline, in order: each value holds until the next, of two in a tick the later."""
    seen = [each for each in events if each.kind is EventKind.OBSERVATION and each.timeline == timeline]
    ends = [*(float(each.tick) for each in seen[1:]), math.inf]
    held = []
    for each, end in zip(seen, ends[: len(seen)], strict=True):
        if end > each.tick:
            given = _given(each) | {"start": each.tick, "end": end, "duration": end - each.tick}
            held.append(_Held(each.predicate, each.tick, end, given, min(end, last_tick + 1.0)))
    return held


def _given(event: Event) -> dict[str, object]:
    """The arguments of what was published: values, and ranges of numbers; what is several names is left out."""
    given: dict[str, object] = {}
    for name, domain in event.arguments:
        if domain.interval is not None:
            lower, upper = domain.interval
            given[name] = lower if lower == upper else ValueRange(lower, upper)
        elif domain.values is not None and len(domain.values) == 1:
            given[name] = domain.values[0]
    return given


def _tokens_on(reactor: ReactorRecord, timeline: str) -> Iterator[TokenRecord]:
    tokens = reactor.tokens
    if isinstance(tokens, TokenColumns):
        if timeline in tokens.names:
            indices = (tokens.times.objects == tokens.names.index(timeline)).nonzero()[0]
            yield from (tokens[int(index)] for index in indices)
    else:
        yield from (token for token in tokens if token.object == timeline)


def _fate(
    one: PropertyConfiguration,
    held: list[_Held],
    then: list[_Held],
    agent: AgentConfiguration,
    last_tick: int,
    is_cut: bool,
) -> PropertyFate:
    """Whether a property was kept; `tick` is when it was violated."""
    first, last = one.since, agent.final_tick if one.by is None else one.by
    is_due = last <= last_tick or not is_cut
    pattern = one.pattern
    match one.kind:
        case PropertyKind.REACHED:
            ends = [
                token.end
                for token in held
                if token.start >= first and token.end <= last_tick and _margin(pattern, token) >= 0.0
            ]
            best = min(ends, default=math.inf)
            if best > last and not is_due:
                return PropertyFate(one.name, True, None, math.inf)
            if best <= last:
                return PropertyFate(one.name, True, None, last - best)
            seen = _seen_instead(pattern, held, first, last_tick)
            return PropertyFate(one.name, False, min(last, last_tick), last - best, seen=seen)
        case PropertyKind.LEVEL:
            raise AssertionError("levels are no tokens")
        case PropertyKind.ALWAYS:
            told = _told_of(pattern, held)
            spans = [(token, _best(pattern, token)) for token in told if token.start <= last and token.end > first]
        case PropertyKind.NEVER:
            spans = [(token, -_margin(pattern, token)) for token in held if token.start <= last and token.end > first]
            spans = [(token, -1e-300 if margin == 0.0 else margin) for token, margin in spans]
        case PropertyKind.WITHIN:
            assert one.then is not None
            begins = [token.start for token in then if _margin(one.then, token) >= 0.0]
            spans = []
            for token in held:
                if first <= token.start <= last and _margin(pattern, token) >= 0.0:
                    soonest = token.start + (one.then.timeline == pattern.timeline)  # nothing follows itself
                    after = min((begin for begin in begins if begin >= soonest), default=math.inf)
                    is_open = after == math.inf and token.start + one.ticks > last_tick
                    spans.append((token, math.inf if is_open else one.ticks - (after - token.start)))
        case PropertyKind.UNTIL:
            assert one.then is not None
            begins = [token.start for token in then if token.start >= first and _margin(one.then, token) >= 0.0]
            stop = min(begins, default=math.inf)
            told = _told_of(pattern, held)
            spans = [(token, _best(pattern, token)) for token in told if token.start < stop and token.end > first]
            is_broken = any(margin < 0.0 and token.start <= last for token, margin in spans)
            if stop > last and is_due and not is_broken:
                return PropertyFate(one.name, False, min(last, last_tick), last - stop)
    worst = next((token for token, margin in spans if margin < 0.0), None)
    least = min((margin for _, margin in spans), default=math.inf)
    is_void = one.kind is PropertyKind.WITHIN and least == math.inf
    if worst is None:
        return PropertyFate(one.name, True, None, least, is_void)
    seen = _undecided(pattern, worst)
    return PropertyFate(one.name, False, max(worst.start, first), least, is_void, seen=seen)


def _seen_instead(pattern: TokenPattern, held: list[_Held], first: int, last_tick: int) -> str:
    """What came in place of what was to be reached: nothing of the kind, too late, or with other arguments."""
    what = f"`{pattern.predicate}`" if pattern.predicate else "what matches"
    alike = [token for token in held if token.start >= first and token.predicate == pattern.predicate]
    if found := next((token for token in held if token.start >= first and _margin(pattern, token) >= 0.0), None):
        lasts = "lasted" if found.end <= last_tick else "was to last"  # the mission was over before
        over = "" if found.end == math.inf else f" and {lasts} until {found.end:g}"
        return f"{what} began at {found.start}{over}"
    if not alike or pattern.where:
        return f"{what} never came on `{pattern.timeline}`" if not alike else ""
    told = []
    for name, wanted in pattern.parameters:
        values = [token.arguments.get(name) for token in alike]
        if name not in TOKEN_TIMES and all(_argument_margin(value, wanted) < 0.0 for value in values):
            shown = list(dict.fromkeys(_shown(value) for value in values))
            more = f" and {len(shown) - _MOST_SHOWN} more" if len(shown) > _MOST_SHOWN else ""
            told.append(f"`{name}` {', '.join(shown[:_MOST_SHOWN])}{more}")
    return f"{what} came with {' and '.join(told)}" if told else ""


def _undecided(pattern: TokenPattern, token: _Held) -> str:
    """Which of the arguments that a promise is about were never decided, if any were."""
    names = [name for name, _ in pattern.parameters]
    names += parse_expression(pattern.where).names if pattern.where else ()
    told = []
    for name in dict.fromkeys(names):
        value = token.arguments.get(name)
        if name not in TOKEN_TIMES and isinstance(value, ValueRange | OpenValues):
            told.append(f"`{name}` was never decided ({_shown(value)})")
    if pattern.where and (why := _without_value(pattern.where, token)):
        told.append(f"`{pattern.where}`: {why}")
    return ", ".join(told)


def _shown(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, ValueRange):
        return f"{number(value.lower)} to {number(value.upper)}"
    if value is None or isinstance(value, OpenValues):
        return "any value"
    return number(value) if isinstance(value, int | float) else str(value)


def _told_of(pattern: TokenPattern, held: list[_Held]) -> list[_Held]:
    """The tokens that a promise is about: where arguments are promised of a predicate, those with it."""
    has_condition = bool(pattern.parameters or pattern.where)
    return [one for one in held if not (has_condition and pattern.predicate) or one.predicate == pattern.predicate]


def _margin(pattern: TokenPattern, token: _Held) -> float:
    """How far a token is from not matching: negative where it does not, infinite where no number decides.

    One that goes on matches if it does whenever it ends.
    """
    return min(_margins(pattern, token))


def _best(pattern: TokenPattern, token: _Held) -> float:
    """The same, where it is promised to match: one that goes on matches as long as it may still."""
    return max(_margins(pattern, token))


def _margins(pattern: TokenPattern, token: _Held) -> list[float]:
    if token.end < math.inf:
        return [_margin_of(pattern, token)]
    ends = [math.inf, token.least_end, *_ends_told(pattern, token)]
    given = [{**token.arguments, "end": end, "duration": end - token.start} for end in ends]
    return [_margin_of(pattern, replace(token, arguments=each)) for each in given]


def _ends_told(pattern: TokenPattern, token: _Held) -> list[float]:
    """The later ends at which a pattern may come to match, or cease to: at its numbers and the token's, and beside."""
    told = [float(each) for each in _NUMBERS.findall(f"{pattern.where} {pattern.parameters}")]
    told += [float(value) for value in token.arguments.values() if isinstance(value, int | float)]
    ends = {first + each + step for each in told for first in (0, token.start) for step in (-1.0, 0.0, 1.0)}
    return sorted(end for end in ends if token.least_end < end < math.inf)


def _margin_of(pattern: TokenPattern, token: _Held) -> float:
    if pattern.predicate and token.predicate != pattern.predicate:
        return -math.inf
    least = math.inf
    for name, wanted in pattern.parameters:
        least = min(least, _argument_margin(token.arguments.get(name), wanted))
    if pattern.where and least > -math.inf:
        least = min(least, _where_margin(pattern.where, token))
    return least


def _argument_margin(value: object, wanted: object) -> float:
    if isinstance(wanted, tuple):
        if isinstance(value, bool) or not isinstance(value, int | float | ValueRange):
            return -math.inf
        least, most = value if isinstance(value, ValueRange) else (value, value)  # all values of one never decided
        return float(min(least - wanted[0], wanted[1] - most))
    if isinstance(wanted, int | float) and not isinstance(wanted, bool) and isinstance(value, int | float):
        return math.inf if value == wanted else -abs(float(value) - wanted)
    return math.inf if value == wanted else -math.inf


def _where_margin(text: str, token: _Held) -> float:
    expression = parse_expression(text)
    values = {name: token.arguments.get(name) for name in expression.names}
    given = {name: float(value) for name, value in values.items() if isinstance(value, int | float)}
    ranges = {name: value for name, value in values.items() if isinstance(value, ValueRange)}
    if len(given) + len(ranges) < len(values):
        return -math.inf
    return _condition_margin(expression.root, given, ranges)


def _without_value(text: str, token: _Held) -> str:
    """Why a condition has no value for a token, such as a division by zero; empty where it has one."""
    expression = parse_expression(text)
    values = {name: token.arguments.get(name) for name in expression.names}
    given = {name: float(value) for name, value in values.items() if isinstance(value, int | float)}
    if len(given) < len(values) or not math.isnan(expression.limit(given)):
        return ""
    try:
        expression.value(given)
    except ExpressionError as problem:
        return str(problem)
    return ""


def _condition_margin(node: ast.expr, given: Mapping[str, float], ranges: Mapping[str, ValueRange]) -> float:
    """The margin of a condition: of an order the difference, of a conjunction the least, else all or nothing.

    Of arguments that were never decided it is the least one of all their values, as far as ends of ranges tell.
    """
    match node:
        case ast.BoolOp(op=ast.And(), values=parts):
            return min(_condition_margin(part, given, ranges) for part in parts)
        case ast.BoolOp(op=ast.Or(), values=parts):
            return max(_condition_margin(part, given, ranges) for part in parts)
        case _ if names := [name for name in ranges if name in _names(node)]:
            is_order = isinstance(node, ast.Compare) and len(node.ops) == 1 and isinstance(node.ops[0], _ORDERS)
            if not is_order or not _is_linear(node, names):
                return -math.inf
            ends = product(*(ranges[name] for name in names))
            return min(_condition_margin(node, {**given, **dict(zip(names, each, strict=True))}, {}) for each in ends)
        case ast.Compare(left=left, ops=[ast.Lt() | ast.LtE() | ast.Gt() | ast.GtE() as op], comparators=[right]):
            less, more = (left, right) if isinstance(op, ast.Lt | ast.LtE) else (right, left)
            gap = _number(more, given) - _number(less, given)
            if math.isnan(gap):
                return -math.inf
            is_strict = isinstance(op, ast.Lt | ast.Gt)
            return -1e-300 if gap == 0.0 and is_strict else gap
        case _:
            return math.inf if _number(node, given) else -math.inf


def _names(node: ast.AST) -> set[str]:
    return {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}


def _is_linear(node: ast.AST, names: Sequence[str]) -> bool:
    """Whether all is sums and multiples of `names`, so that what is least is so at ends of their ranges."""
    if _names(node).isdisjoint(names):
        return True
    match node:
        case ast.BinOp(left=left, op=ast.Mult(), right=right):
            return any(
                _names(one).isdisjoint(names) and _is_linear(other, names)
                for one, other in ((left, right), (right, left))
            )
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            return _names(right).isdisjoint(names) and _is_linear(left, names)
        case ast.Name():
            return True
        case ast.Compare() | ast.BinOp(op=ast.Add() | ast.Sub()) | ast.UnaryOp(op=ast.UAdd() | ast.USub()):
            return all(_is_linear(each, names) for each in ast.iter_child_nodes(node) if isinstance(each, ast.expr))
    return False


def _number(node: ast.expr, given: Mapping[str, float]) -> float:
    try:
        return parse_expression(ast.unparse(node)).limit(given)
    except ExpressionError:
        return math.nan
