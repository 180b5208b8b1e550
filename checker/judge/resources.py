"""Judge resources: the level over time from the uses that were executed, at every instant up to the last tick."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import inf, isnan, nan

from checker.judge.bench import Bench, Tok
from checker.judge.report import ResourceProfile
from checker.judge.tokens import ProgramJudge
from checker.judge.values import TOLERANCE
from checker.named_objects import RESOURCES
from compiler.program import END, FIRST_PARAMETER, START, Call
from nddl_lang.text.source import Span
from runtime.executive.record import Value, ValueRange


@dataclass(frozen=True, slots=True)
class _ResourceUse:
    """Something that changes a level: `amount` is added at `start` and, if it is given back, taken away at `end`.

    Where its times were left open it begins at `earliest` or later, and at `start` at the latest; it ends at `end` or
    later, and at `latest` at the latest. It is there for certain from `start` to `end`.
    """

    earliest: float
    start: float
    end: float | None
    latest: float
    amount: float
    tok: Tok | None
    span: Span | None


@dataclass(frozen=True, slots=True)
class _ResourceLimits:
    """What the level of a resource and its flows must keep to."""

    initial: float
    least: float
    most: float
    consumption_rate: float = inf
    consumption: float = inf
    production_rate: float = inf
    production: float = inf


def judge_resources(judge: ProgramJudge, bench: Bench) -> None:
    """Judge the level of each resource of a reactor."""
    kinds = {code.name: code.native for code in judge.program.classes if code.native in RESOURCES}
    if not kinds:
        return
    if any(isinstance(step, Call) and step.method in ("set_capacity", "set_limit") for step in judge.program.script):
        bench.skip("resources whose limits the script changes")
        return
    for thing in bench.record.objects:
        if thing.class_name not in kinds:
            continue
        members = [member.name for member in judge.names.classes[thing.class_name].members]
        limits = _limits_of(str(kinds[thing.class_name]), dict(zip(members, thing.members, strict=True)))
        if limits is None:
            bench.skip("a resource whose limits were never fixed")
        else:
            _judge_level(bench, thing.name, limits, list(_uses_of(bench, thing.name)))


def _limits_of(kind: str, members: dict[str, Value]) -> _ResourceLimits | None:
    """The limits of a resource; None if one of them was never fixed."""
    found: dict[str, float] = {}
    for name, value in members.items():
        if isinstance(value, (int, float)):
            found[name] = float(value)
        elif isinstance(value, ValueRange):
            return None
    if kind == "Unary":
        return _ResourceLimits(1.0, 0.0, inf, consumption=found.get("consumptionMax", inf))
    flows = (found.get("consumptionRateMax", inf), found.get("consumptionMax", inf))
    if kind == "Reservoir":
        levels = (found["initialCapacity"], found["levelLimitMin"], found["levelLimitMax"])
        return _ResourceLimits(*levels, *flows, found.get("productionRateMax", inf), found.get("productionMax", inf))
    return _ResourceLimits(found["capacity"], found["levelLimitMin"], inf, *flows)


def _uses_of(bench: Bench, resource: str) -> Iterator[_ResourceUse]:
    """What was executed on a resource, by tokens of its own and by `uses` in rules; each plan speaks of its own time.

    What a repair cut off counts until then. The plan that it made instead counts from then on: of what was going on it
    tells once more, from its beginning.
    """
    uses = list(_recorded(bench, resource))
    cuts = _cuts_of(bench) if any(tok is not None and tok.is_outdated for tok, _ in uses) else {}
    known: dict[tuple[float, float], int] = {}  # what was added at a time, by the first token that is cut off
    for tok, use in uses:
        if tok is not None and tok.is_outdated and use.end is None and use.start <= tok.record.tick:
            told = (use.start, use.amount)
            known[told] = min(known.get(told, tok.key), tok.key)
    for tok, use in uses:
        if tok is None:
            yield use
            continue
        since = max((tick for tick, key in cuts.items() if tok.key > key), default=-inf)
        if use.end is None and use.start < since and known.get((use.start, use.amount), tok.key) < tok.key:
            continue
        if tok.is_outdated:
            until = float(tok.standing.record.tick if tok.standing.is_cut else tok.record.tick)
            if use.earliest > until or (use.end is None and use.start > until):
                continue
            if use.earliest == -inf:  # the plan took it for something of before the mission, and does so no more
                use = replace(use, end=until, latest=until)
            ends = (None, inf) if use.end is None else (min(use.end, until), min(use.latest, until))
            use = replace(use, start=min(use.start, until), end=ends[0], latest=ends[1])
        if use.end is not None:
            use = replace(use, earliest=max(use.earliest, since), start=max(use.start, since))
        yield use


def _cuts_of(bench: Bench) -> dict[int, int]:
    """When repairs or recalls cut tokens off, with the newest token that was there; keys go up."""
    newest: dict[int, int] = {}
    for one in bench.tokens.records():
        if one.fate == "cut":
            newest[one.tick] = max(newest.get(one.tick, one.key), one.key)
    return newest


def _recorded(bench: Bench, resource: str) -> Iterator[tuple[Tok | None, _ResourceUse]]:
    """What is on record of a resource, each with its token."""
    fitting = (one for one in bench.tokens.on(resource) if one.state == "active")
    for tok in bench.tokens.of(fitting):
        record = tok.record
        kind = record.predicate.rpartition(".")[2]
        if kind not in ("produce", "consume", "uses", "use"):
            continue
        quantity: Value = tok.values[FIRST_PARAMETER] if record.arguments and kind != "use" else 1.0  # of a Unary
        found = _use(bench, kind, quantity, tok.values[START], tok.values[END], tok, None)
        yield from ((tok, one) for one in found)
    for holder, quantity, start, end, user, span in bench.uses:
        if holder == resource:
            yield from ((user, one) for one in _use(bench, "uses", quantity, start, end, user, span))


def _use(
    bench: Bench, kind: str, quantity: Value, start: Value, end: Value, tok: Tok | None, span: Span | None
) -> Iterator[_ResourceUse]:
    earliest, at = start if isinstance(start, ValueRange) else (_number(start), _number(start))
    if earliest > bench.last_tick:
        return
    amount = nan if isinstance(quantity, (tuple, str)) else float(quantity)
    if kind in ("produce", "consume"):
        yield _ResourceUse(earliest, at, None, inf, amount if kind == "produce" else -amount, tok, span)
    else:
        first, last = end if isinstance(end, ValueRange) else (_number(end), _number(end))
        yield _ResourceUse(earliest, at, first, last, -amount, tok, span)


def _number(value: Value) -> float:
    return value if isinstance(value, int) else nan


def _judge_level(bench: Bench, resource: str, limits: _ResourceLimits, uses: list[_ResourceUse]) -> None:
    """Judge the level at each instant at which it changes, and the flows; open times may be any of theirs."""
    if any(isnan(use.amount) or isnan(use.start) or isnan(use.latest) for use in uses):
        bench.skip("a resource with a use whose quantity or time was never fixed")
        return
    drawn: dict[float, float] = {}
    made: dict[float, float] = {}
    for use in uses:
        if use.start <= bench.last_tick:
            flow = drawn if use.amount < 0 else made
            flow[use.start] = flow.get(use.start, 0.0) + abs(use.amount)
    levels = _levels(limits.initial, _changes(uses, 0), bench.last_tick)
    first = () if levels and levels[0][0] <= 0 else ((0, limits.initial),)
    bench.profiles.append(ResourceProfile(bench.reactor, resource, limits.least, limits.most, (*first, *levels)))
    lowest = highest = levels
    if any(use.earliest != use.start or use.end not in (None, use.latest) for use in uses):
        lowest, highest = (_levels(limits.initial, _changes(uses, sign), bench.last_tick) for sign in (-1, 1))
    bench.judged += len(levels)
    too_low = next(((tick, level) for tick, level in highest if level < limits.least - TOLERANCE), None)
    too_high = next(((tick, level) for tick, level in lowest if level > limits.most + TOLERANCE), None)
    broken = min((one for one in (too_low, too_high) if one is not None), default=None)
    if broken is not None:
        _exceeded(bench, resource, "level", broken[1], limits.least, limits.most, broken[0], uses)
        return
    for name, flow, rate, total in (
        ("consumption", drawn, limits.consumption_rate, limits.consumption),
        ("production", made, limits.production_rate, limits.production),
    ):
        for tick, amount in sorted(flow.items()):
            if amount > rate + TOLERANCE:
                _exceeded(bench, resource, f"{name} at once", amount, 0.0, rate, tick, uses)
                return
        if sum(flow.values()) > total + TOLERANCE:
            _exceeded(bench, resource, f"{name} altogether", sum(flow.values()), 0.0, total, bench.last_tick, uses)


def _changes(uses: list[_ResourceUse], sign: int) -> dict[float, float]:
    """What is added at each time; what has the `sign` is there whenever it may be, all else only when it must be."""
    changes: dict[float, float] = {}
    for use in uses:
        is_wide = use.amount * sign > 0
        time = use.earliest if is_wide else use.start
        end = use.latest if is_wide else use.end
        if end is not None and end <= time:
            continue
        changes[time] = changes.get(time, 0.0) + use.amount
        if end is not None:
            changes[end] = changes.get(end, 0.0) - use.amount
    return changes


def _levels(level: float, changes: Mapping[float, float], last_tick: int) -> list[tuple[int, float]]:
    """The level after each change, from the one before all."""
    levels = []
    for tick in sorted(tick for tick in changes if tick <= last_tick):
        level += changes[tick]
        levels.append((int(tick) if tick > -inf else 0, level))
    return levels


def _exceeded(
    bench: Bench,
    resource: str,
    what: str,
    amount: float,
    least: float,
    most: float,
    tick: float,
    uses: list[_ResourceUse],
) -> None:
    users = tuple(use.tok for use in uses if use.tok is not None and use.start <= tick)[-4:]
    span = next((use.span for use in reversed(uses) if use.span is not None and use.start <= tick), None)
    values: tuple[tuple[str, Value], ...] = ((what, amount), ("tick", int(tick)))
    found = f"above {most:g}" if amount > most else f"below {least:g}"
    bench.report("level", resource, users, values, what, found, span)
