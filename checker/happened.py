"""What happened in a mission, drawn in characters: a row per timeline, time from left to right."""

from runtime.executive.events import heads_of
from runtime.executive.outcome import Outcome

WIDTH = 100
_MOST = 40  # rows


def gantt(outcome: Outcome, width: int = WIDTH) -> str:
    """A row per timeline, each value with its name as far as there is room, `|` where it begins."""
    rows: dict[str, list[tuple[int, str]]] = {}
    for _, tick, timeline, predicate in heads_of(outcome.events):
        rows.setdefault(timeline, []).append((tick, predicate))
    if not rows:
        return ""
    last = max(outcome.last_tick, 1)
    margin = max(map(len, rows)) + 1
    columns = max(width - margin, 20)
    shown = [f"{name:<{margin}}{_row(values, last, columns)}" for name, values in list(rows.items())[:_MOST]]
    if len(rows) > _MOST:
        shown.append(f"and {len(rows) - _MOST} more timelines")
    scale = f"{'tick':<{margin}}0{outcome.last_tick!s:>{columns - 1}}"
    return "\n".join([*shown, scale]) + "\n"


def _row(values: list[tuple[int, str]], last: int, columns: int) -> str:
    places = [min(tick * columns // (last + 1), columns - 1) for tick, _ in values]
    cells = [" "] * columns
    for number, (place, (_, name)) in enumerate(zip(places, values, strict=True)):
        end = places[number + 1] if number + 1 < len(places) else columns
        if end <= place:
            continue
        dense = number > 0 and places[number - 1] == place
        room = end - place
        text = ("#" if dense else "|") + name[: room - 1]
        cells[place : place + len(text)] = text
        for at in range(place + len(text), end):
            cells[at] = "."
    return "".join(cells)
