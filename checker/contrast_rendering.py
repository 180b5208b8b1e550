"""Words and data for a contrast: what sets a failed mission apart from the nearest one that passes."""

from collections.abc import Sequence
from typing import Any

from checker.contrast import Contrast
from checker.sampling.rendering import number
from runtime.executive.outcome import Event
from runtime.executive.rendering import trace_line


def contrast_lines(contrast: Contrast) -> list[str]:
    """A contrast for people."""
    changed = [f"{one.parameter} = {number(one.failing)} for {number(one.passing)}" for one in contrast.decisive]
    least = "no smaller set does" if contrast.is_smallest else "none of them may be left out"
    lines = [
        f"mission {contrast.passing} is the nearest that passes; with {', '.join(changed)} it fails so"
        f" ({least}; {contrast.flights} flights)"
    ]
    if contrast.partings:
        ticks = "tick" if contrast.differing == 1 else "ticks"
        lines.append(f"these two differ at {contrast.differing} {ticks}, first at tick {contrast.partings[0].tick}:")
    for parting in contrast.partings:
        lines += [f"  fails   {line}" for line in _told(parting.failing)]
        lines += [f"  passes  {line}" for line in _told(parting.passing)]
    return lines


def contrast_data(contrast: Contrast | None) -> dict[str, Any] | None:
    """The same as data."""
    if contrast is None:
        return None
    return {
        "passing": contrast.passing,
        "decisive": [
            {"parameter": one.parameter, "failing": one.failing, "passing": one.passing} for one in contrast.decisive
        ],
        "is_smallest": contrast.is_smallest,
        "flights": contrast.flights,
        "differing": contrast.differing,
        "partings": [
            {"tick": one.tick, "failing": _told(one.failing), "passing": _told(one.passing)}
            for one in contrast.partings
        ],
    }


def _told(events: Sequence[Event]) -> list[str]:
    return [trace_line(event) for event in events]
