"""Logs as T-REX writes them, made from a flight: a file for each reactor, in the form of T-REX 2 now or in 2011."""

from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path
from xml.sax.saxutils import quoteattr

from runtime.executive.outcome import Event, EventKind, Outcome


def write_logs(folder: Path, outcome: Outcome, provided: Mapping[str, Sequence[str]], *, is_old: bool = False) -> None:
    """Write `<reactor>.tr.log` for each reactor, which provides some timelines."""
    for reactor, timelines in provided.items():
        own = [event for event in outcome.events if event.reactor == reactor]
        (folder / f"{reactor}.tr.log").write_text(_log(own, timelines, outcome.last_tick, is_old=is_old))


def _log(events: Sequence[Event], timelines: Sequence[str], last: int, *, is_old: bool) -> str:
    lines = ["<Log>", " <header>"]
    lines += [
        f"   <provide name={quoteattr(line)}" + ("" if is_old else ' goals="1" plan="0" ') + "/>" for line in timelines
    ]
    lines.append(" </header>")
    for tick in range(last + 1):
        seen = [_observation(one, is_old) for one in events if one.tick == tick and one.kind is EventKind.OBSERVATION]
        asked = [_request(one) for one in events if one.tick == tick and one.kind is EventKind.REQUEST]
        if is_old:
            lines += [f'  <tick value="{tick}">', *seen, *asked, "  </tick>"] if seen or asked else []
            continue
        lines.append(f' <tick value="{tick}">')
        lines += ["  <synchronize>", *seen, "  </synchronize>"] if seen else []
        lines += ["  <has_work>", '   <work value="1" />', *asked, "  </has_work>", " </tick>"]
    return "\n".join([*lines, "</Log>", ""])


def _observation(event: Event, is_old: bool) -> str:
    return _predicate("Observation", event, "".join(_variables(event, is_old)))


def _request(event: Event) -> str:
    assert event.bounds is not None
    times = {"start": event.bounds.start, "duration": event.bounds.duration, "end": event.bounds.end}
    spans = "".join(_variable(name, "int", _number("int", span, 0)) for name, span in times.items())
    goal = _predicate("Goal", event, spans + "".join(_variables(event, False)))
    return f'   <request id="{hex(140_000 + 16 * (event.request or 0))}" >\n{goal}\n   </request>'


def _predicate(tag: str, event: Event, inside: str) -> str:
    return f"<{tag} on={quoteattr(event.timeline)} pred={quoteattr(event.predicate)}>{inside}</{tag}>"


def _variables(event: Event, is_old: bool) -> list[str]:
    found = []
    for name, domain in event.arguments:
        if domain.interval is not None:
            kind = "int" if all(isinstance(end, int) for end in domain.interval) else "float"
            found.append(_variable(name, kind, _number(kind, domain.interval, 4 if is_old else 16, is_old=is_old)))
        else:
            values = domain.values or ()
            if all(isinstance(value, bool) for value in values) and len(values) == 1:
                found.append(_variable(name, "bool", f'<bool value="{int(values[0])}"/>'))
            else:
                elements = "".join(f"<elem value={quoteattr(str(value))}/>" for value in values)
                found.append(_variable(name, "enum", f"<enum>{elements}</enum>"))
    return found


def _variable(name: str, kind: str, domain: str) -> str:
    return f'<Variable type="{kind}" name={quoteattr(name)}>{domain}</Variable>'


def _number(kind: str, span: tuple[float, float], decimals: int, *, is_old: bool = False) -> str:
    texts = [(f"{end:.{decimals}f}" if kind == "float" else f"{end:.0f}") if isfinite(end) else "" for end in span]
    if span[0] == span[1] and not is_old:
        return f'<{kind} value="{texts[0]}"/>'
    ends = "".join(f' {name}="{text}"' for name, text in zip(("min", "max"), texts, strict=True) if text)
    return f"<{kind}{ends}/>"
