"""A reactor that does again what one did in a flight of which there is a trace, or a log of T-REX (T-REX 3.3)."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from nddl_lang.text.values import json_value
from runtime.user.reactor import Argument, Now, Reactor, Ticks, Value
from runtime.user.transaction_log import SUFFIX, read_transaction_log


class LogPlayer(Reactor):
    """Stands in for the reactor `reactor` (a setting) of the trace at `trace`: same values, goals and recalls.

    Of a `.tr.log`, which is of one reactor, `reactor` may be left out. With `timelines`, names apart by commas, it
    publishes only on these. Where the trace ends before the mission, what it said last goes on.
    """

    def __init__(self, settings: Mapping[str, Value]) -> None:
        super().__init__(settings)
        self.events: dict[int, list[dict[str, Any]]] = {}
        self.numbers: dict[int, int] = {}
        trace = Path(str(settings["folder"])) / str(settings["trace"])
        if trace.name.endswith(SUFFIX):
            found: list[dict[str, Any]] = list(read_transaction_log(trace).events)
        else:
            found = [json_value(line) for line in trace.read_text(encoding="utf-8").splitlines()]
            found = [event for event in found if event.get("reactor") == settings["reactor"]]
        own = str(settings["timelines"]).split(",") if "timelines" in settings else None
        for event in found:
            is_told = own is None or event.get("timeline") in own
            if event["kind"] in ("request", "recall") or (event["kind"] == "observation" and is_told):
                self.events.setdefault(event["tick"], []).append(event)

    def tick(self, now: Now) -> None:
        """Do what is on record for this tick, and sleep until the next one with a record."""
        for event in self.events.pop(now.tick, ()):
            arguments = {name: _argument(value) for name, value in event["arguments"].items()}
            if event["kind"] == "observation":
                now.publish(event["timeline"], event["predicate"], **arguments)
            elif event["kind"] == "request":
                start, end, duration = (_ticks(event[name]) for name in ("start", "end", "duration"))
                self.numbers[event["request"]] = now.ask(
                    event["timeline"], event["predicate"], start=start, end=end, duration=duration, **arguments
                )
            elif event["request"] in self.numbers:
                now.recall(self.numbers[event["request"]])
        if self.events:
            now.wake(min(self.events))


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
