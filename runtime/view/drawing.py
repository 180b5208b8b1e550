"""Drawings of plans: a row per object, bars and levels between two instants; the plan in, what is drawn out."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from runtime.plan.readout.level_profile import LevelProfile
from runtime.plan.readout.state import Interval, PlanState, TokenExtent, TokenState, bound_text

_MOST_IDLE = 10  # timelines without tokens that are shown
_FAR = 10**9  # a horizon beyond is not drawn to its ends
_MOST_LANES = 8  # of one row; with more all tokens are drawn as early as they can be
_LOOSE = 4  # times as long as the earliest plan: what may last longer is not drawn to its end
_LONG_NUMBER = re.compile(r"-?\d+\.\d{11,}(?:e[-+]?\d+)?")


@dataclass(frozen=True, slots=True)
class Bar:
    """A token as it is drawn: from its earliest start to its latest end, and in between where it holds in any case.

    Where there is no such time, `sure` is empty. `is_early`: drawn to its earliest end, as if nothing could move.
    """

    row: str
    label: str
    predicate: str
    start: int
    end: int
    sure: tuple[int, int]
    is_open: bool  # it may last beyond the last moment that anything is drawn at
    is_fixed: bool
    is_early: bool
    tip: str


@dataclass(frozen=True, slots=True)
class Drawing:
    """What there is to draw, and between which moments; of a resource its level, of other objects their tokens."""

    rows: tuple[str, ...]
    bars: Mapping[str, tuple[Bar, ...]]
    profiles: Mapping[str, LevelProfile]
    first: int
    last: int

    def __bool__(self) -> bool:
        return any(self.bars.values()) or any(len(profile.steps) > 1 for profile in self.profiles.values())


def drawing(plan: PlanState, horizon: tuple[int, int], profiles: Mapping[str, LevelProfile]) -> Drawing:
    """Rows in the order of the objects: timelines, even idle ones; what else has tokens; resources in use."""
    tokens = [(token, token.extent) for token in plan.tokens if token.state == "ACTIVE" and token.extent is not None]
    extents = [extent for _, extent in tokens]
    known = [int(bound) for own in extents for bound in (*own.start, *own.end) if abs(bound) < inf]
    first = min([*(known or [horizon[0]]), horizon[0]]) if horizon[0] > -_FAR else min(known or [0])
    if known and min(known) - horizon[0] > 2 * (max(known) - min(known)):
        first = min(known)  # far from where the horizon begins
    earliest = [int(bound) for own in extents for bound in (own.start[0], own.end[0]) if abs(bound) < inf]
    last = max([*earliest, first + 1])
    latest = max([*known, last])
    last = latest if latest - first <= _LOOSE * (last - first) else last + (last - first)
    found: dict[str, list[Bar]] = {name: [] for name in plan.sequences}
    for token, extent in tokens:
        bar = _bar(token, extent, first, last)
        found.setdefault(bar.row, []).append(bar)
    ranges = {name: sorted(own, key=lambda bar: (bar.start, bar.sure, bar.end)) for name, own in found.items()}
    if any(len(lanes(own)) > _MOST_LANES for own in ranges.values()):
        early = {name: [_early(bar) for bar in own] for name, own in found.items()}
        found = {name: sorted(own, key=lambda bar: (bar.start, bar.end)) for name, own in early.items()}
        last = max([bar.end for own in found.values() for bar in own] + [first + 1])
    else:
        found = ranges
    idle = [name for name, own in found.items() if not own]
    if len(idle) > _MOST_IDLE:
        found = {name: own for name, own in found.items() if own}
    used = {name: profile for name, profile in profiles.items() if len(profile.steps) > 1 or found.get(name)}
    bars = {name: tuple(own) for name, own in found.items() if name not in profiles}
    others = sorted(name for name in bars if name not in plan.sequences)
    rows = (*(name for name in plan.sequences if name in bars), *others, *used)
    return Drawing(rows, bars, used, first, last)


def _bar(token: TokenState, extent: TokenExtent, first: int, last: int) -> Bar:
    start = first if abs(extent.start[0]) == inf else int(extent.start[0])
    earliest = start if abs(extent.end[0]) == inf else int(extent.end[0])
    end = int(min(extent.end[1], last))
    sure = (int(min(extent.start[1], last)), earliest)
    parameters = ", ".join(f"{name}={readable(domain.brief)}" for name, domain in extent.parameters.items())
    times = f"start {interval_text(extent.start)} end {interval_text(extent.end)}"
    tip = f"{token.name}: {token.predicate}({parameters}) {times}"
    row = extent.object.values[1:-1] or str(extent.object)
    predicate = token.predicate.rpartition(".")[2]
    return Bar(
        row, token.name, predicate, start, max(end, start), sure, extent.end[1] > last, extent.is_fixed, False, tip
    )


def _early(bar: Bar) -> Bar:
    """The bar from its earliest start to its earliest end."""
    end = max(bar.sure[1], bar.start)
    return replace(bar, end=end, sure=(bar.start, end), is_early=not bar.is_fixed)


def lanes(own: Sequence[Bar]) -> list[list[Bar]]:
    """Bars of one row that overlap, one below the other."""
    found: list[list[Bar]] = []
    for bar in own:
        for lane in found:
            if lane[-1].end <= bar.start and lane[-1].start < bar.start:
                lane.append(bar)
                break
        else:
            found.append([bar])
    return found


def interval_text(interval: Interval) -> str:
    """A time: one number, or two bounds."""
    lower, upper = interval
    return bound_text(lower) if lower == upper else f"[{bound_text(lower)}, {bound_text(upper)}]"


def readable(values: str) -> str:
    """Values as people read them: of a number that arithmetic left with many digits the first twelve; not of texts."""
    return values if '"' in values else _LONG_NUMBER.sub(lambda found: f"{float(found[0]):.12g}", values)


def level_text(low: float, high: float) -> str:
    """A level: one number, or two bounds."""
    return f"{low:.6g}" if low == high else f"{low:.6g}..{high:.6g}"
