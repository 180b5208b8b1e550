"""A reactor that does again what one did in a flight of which there is a trace, or a log of T-REX (T-REX 3.3)."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from nddl_lang.text.values import json_value
from runtime.executive.outcome import EventKind, Phase
from runtime.user.reactor import Argument, Now, Reactor, Ticks, Value
from runtime.user.transaction_log import SUFFIX, read_transaction_log

_THEN = (Phase.DELIBERATE, Phase.DISPATCH)


class LogPlayer(Reactor):
    """Stands in for the reactor `reactor` (a setting) of the trace at `trace`: same values, goals and recalls.

    What it asks and takes back has its place among what others do in the tick (a `.tr.log` tells nothing of these).
    Of a `.tr.log`, which is of one reactor, `reactor` may be left out. With `timelines`, names apart by commas, it
    publishes only on these. Where the trace ends before the mission, what it said last goes on.
    """

    def __init__(self, settings: Mapping[str, Value]) -> None:
        super().__init__(settings)
        self.events: dict[int, list[tuple[int, dict[str, Any]]]] = {}
        self.numbers: dict[int, int] = {}
        trace = Path(str(settings["folder"])) / str(settings["trace"])
        if trace.name.endswith(SUFFIX):
            found = [(-1, event) for event in read_transaction_log(trace).events]
        else:
            lines = trace.read_text(encoding="utf-8").splitlines()
            found = _placed([json_value(line) for line in lines], str(settings["reactor"]))
        own = str(settings["timelines"]).split(",") if "timelines" in settings else None
        for others, event in found:
            is_told = own is None or event.get("timeline") in own
            if event["kind"] in ("request", "recall") or (event["kind"] == "observation" and is_told):
                self.events.setdefault(event["tick"], []).append((others, event))

    def tick(self, now: Now) -> None:
        """Do what is on record for this tick, and sleep until the next one with a record."""
        behind = -1
        for others, event in self.events.pop(now.tick, ()):
            arguments = {name: _argument(value) for name, value in event["arguments"].items()}
            if event["kind"] == "observation":
                now.publish(event["timeline"], event["predicate"], **arguments)
                continue
            if others > behind:
                behind = others
                now.await_others(others)
            if event["kind"] == "request":
                start, end, duration = (_ticks(event[name]) for name in ("start", "end", "duration"))
                self.numbers[event["request"]] = now.ask(
                    event["timeline"], event["predicate"], start=start, end=end, duration=duration, **arguments
                )
            elif event["request"] in self.numbers:
                now.recall(self.numbers[event["request"]])
        if self.events:
            now.wake(min(self.events))


def _placed(events: list[dict[str, Any]], name: str) -> list[tuple[int, dict[str, Any]]]:
    """The events of one reactor, each with how much others have done by then in the deliberation of its tick."""
    found = []
    tick, others = -1, 0
    for event in events:
        if event.get("tick") != tick:
            tick, others = event.get("tick", -1), 0
        if event.get("reactor") == name:
            found.append((others, event))
        elif is_done_by_others(name, event.get("reactor", ""), event["kind"], event.get("phase", "")):
            others += 1
    return found


def _argument(value: Any) -> Argument:
    if isinstance(value, list):
        numbers = [float(one) for one in value if isinstance(one, int | float | str) and _is_number(one)]
        return (numbers[0], numbers[1]) if len(value) == 2 == len(numbers) else frozenset(value)
    return value  # type: ignore[no-any-return]


def _is_number(value: Any) -> bool:
    return not isinstance(value, bool) and (isinstance(value, int | float) or value in ("inf", "-inf"))


def _ticks(bounds: list[Any]) -> Ticks:
    low, high = (None if isinstance(bound, str) else int(bound) for bound in bounds)
    return (-(2**52) + 1 if low is None else low, 2**52 - 1 if high is None else high)


def is_done_by_others(name: str, reactor: str, kind: str, phase: str) -> bool:
    """Whether an event of a tick counts as one of others than the reactor of a name, in its deliberation.

    Draws do not: who is the first to read a value tells it.
    """
    return reactor not in ("", name) and phase in _THEN and kind != EventKind.SAMPLE
