"""What a property says of the level of a resource, and what happened to that in; what became of it, and why, out."""

import math
from collections.abc import Iterator, Sequence

from checker.judge.report import ResourceProfile
from checker.sampling.rendering import number
from runtime.executive.configuration import LevelPattern, PropertyConfiguration
from runtime.executive.outcome import LevelChange, PropertyFate
from runtime.executive.record import MissionRecord, ReactorRecord

_ROUNDING = 1e-9  # relative, of sums of floats
_CHANGES = ("produce", "consume", "use", "uses")  # the predicates of a resource


def level_fate(
    one: PropertyConfiguration,
    wanted: LevelPattern,
    profiles: Sequence[ResourceProfile],
    record: MissionRecord,
    last: int,
) -> PropertyFate:
    """Whether a resource kept its levels; where its limits were never fixed nothing is known, and nothing kept."""
    own = (each for each in profiles if each.resource == wanted.resource and wanted.reactor in ("", each.reactor))
    profile = next(own, None)
    if profile is None:
        return PropertyFate(one.name, False, one.since, -math.inf)
    lower, upper = wanted.bounds
    if wanted.margin > 0.0:
        lower, upper = max(lower, profile.least + wanted.margin), min(upper, profile.most - wanted.margin)
    ends = [*(tick for tick, _ in profile.levels[1:]), math.inf]
    held = [(begin, end, level) for (begin, level), end in zip(profile.levels, ends, strict=True)]
    margins = [
        (max(begin, one.since), _margin(level, lower, upper), level)
        for begin, end, level in held
        if begin <= last and end > one.since
    ]
    least = min((margin for _, margin, _ in margins), default=math.inf)
    broken = next(((tick, level) for tick, margin, level in margins if margin < 0.0), None)
    if broken is None:
        return PropertyFate(one.name, True, None, least)
    tick, level = broken
    promised = f"at least {number(lower)}" if level < lower else f"at most {number(upper)}"
    seen = f"the level of {wanted.resource} is {number(level)}, {promised} is promised"
    return PropertyFate(one.name, False, tick, least, seen=seen, changes=tuple(_changes(profile, record, tick)))


def _margin(level: float, lower: float, upper: float) -> float:
    """How far a level is within its bounds; levels are sums of floats, so what is off by rounding counts as kept."""
    margin = min(level - lower, upper - level)
    return 0.0 if -_ROUNDING * max(1.0, abs(level)) <= margin < 0.0 else margin


def _changes(profile: ResourceProfile, record: MissionRecord, last: int) -> Iterator[LevelChange]:
    """The changes of a level up to a tick, each with the predicates whose rules ask for it."""
    reactor = next((one for one in record.reactors if one.reactor == profile.reactor), None)
    asking = _asking(reactor, profile.resource) if reactor is not None else {}
    before = profile.levels[0][1]
    for tick, level in profile.levels[1:]:
        if tick > last:
            return
        amount, before = level - before, level
        yield LevelChange(profile.reactor, profile.resource, tick, amount, level, tuple(asking.get(tick, ())))


def _asking(reactor: ReactorRecord, resource: str) -> dict[int, dict[tuple[str, str], None]]:
    """By the ticks at which tokens of a resource begin or end, whose rules have them as children."""
    changing = {
        one.key: one
        for one in reactor.tokens
        if one.object == resource and one.state == "active" and one.predicate.rpartition(".")[2] in _CHANGES
    }
    found: dict[int, dict[tuple[str, str], None]] = {}
    for one in reactor.tokens if changing else ():
        for child in (changing[key] for run in one.runs for key in run.children if key in changing):
            for tick in (child.start, child.end):
                if isinstance(tick, int | float) and abs(tick) < math.inf:
                    found.setdefault(int(tick), {})[one.predicate, child.predicate] = None
    return found
