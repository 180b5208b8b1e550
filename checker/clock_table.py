"""Read how long planners may deliberate: `[clock]` of a mission file, and the XML of a clock that T-REX has logged."""

from pathlib import Path

from checker.codes import MISSING_KEY, OUT_OF_RANGE, UNKNOWN_CHOICE, UNKNOWN_ELEMENT
from checker.mission_table import MissionText, Table
from checker.named_files import look_at
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import read_source
from nddl_lang.text.source import Source
from runtime.executive.clocks import FastClock
from runtime.executive.configuration import ClockConfiguration
from runtime.solver.configuration.element import Element
from runtime.solver.configuration.read_xml import read_xml

_MOST = 10**12  # ticks, and steps in one


def read_clock(table: Table, root: Path) -> ClockConfiguration:
    """The table `[clock]`: the `steps` of every tick, or a `log` with those of each; `percent_use` is of real time."""
    steps = table.whole("steps", 0, 1) or None
    file = table.string("log", "")
    share = table.number("percent_use", 100.0, 5.0, 100.0) / 100.0
    table.close()
    if not file:
        return ClockConfiguration(steps, None, share)
    if steps is not None:
        table.complain_of_value("steps", steps, "left out where `log` says how many there are", "leave one of them out")
    return ClockConfiguration(None, _read_log(table.text, (*table.path, "log"), root, file), share)


def _read_log(text: MissionText, key: tuple[str | int, ...], root: Path, file: str) -> tuple[tuple[int, int], ...]:
    """The steps by tick of a file that the mission names."""
    if not look_at(text, key, root, file):
        return ()
    counts, complaints = read_clock_log(read_source(root / file))
    text.diagnostics += complaints
    return counts


def read_clock_log(source: Source) -> tuple[tuple[tuple[int, int], ...], list[Diagnostic]]:
    """The steps by tick of `<Clock><tick value="3" count="12"/> ...</Clock>` (reference of T-REX, 3.2)."""
    root, found = read_xml(source)
    if root is None:
        return (), found
    if root.tag != "Clock":
        return (), [UNKNOWN_ELEMENT.at(root.span, tag=root.tag, parent="a clock's log", help="its root is `<Clock>`")]
    counts: dict[int, int] = {}
    for child in root.children:
        if child.tag != "tick":
            found.append(UNKNOWN_ELEMENT.at(child.span, tag=child.tag, parent="<Clock>", help="known elements: tick"))
            continue
        tick, count = _whole(child, "value", found), _whole(child, "count", found)
        if tick is not None and count is not None:
            if tick in counts:
                found.append(UNKNOWN_CHOICE.at(child.span, key="value", found=tick, choices="ticks that come once"))
            counts[tick] = count
    return tuple(sorted(counts.items())), found


def _whole(element: Element, name: str, found: list[Diagnostic]) -> int | None:
    attribute = element.find(name)
    if attribute is None:
        found.append(MISSING_KEY.at(element.span, table=f"<{element.tag}>", key=name))
        return None
    text = attribute.value.strip()
    if not (text.isascii() and text.isdecimal()) or len(text) > len(str(_MOST)):
        wanted = "a whole number, 0 or more"
        found.append(OUT_OF_RANGE.at(attribute.span, key=name, wanted=wanted, found=f'"{attribute.value}"'))
        return None
    return int(text)


def clock_log(clock: FastClock, tick: float) -> str:
    """The steps that a clock has counted as such a file; a tick lasts `tick` seconds."""
    lines = [f'  <tick value="{at}" count="{count}"/>' for at, count in sorted(clock.counts.items())]
    return "\n".join([f'<Clock rate="{tick:g}">', *lines, "</Clock>"]) + "\n"
