"""Logs of a real mission in: what was observed, and the mission with players in place of the reactors that have logs.

A reactor that asks nobody, such as a vehicle, does what its log says; planners above it plan anew, with the models as
they are. So what the vehicle did then meets the rules as they are now, and a failure can be explained like any other.
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from checker.conditions.space import fixed
from checker.judge.trace_reading import read_events
from checker.mission import Mission
from runtime.executive.configuration import CodeConfiguration, PropertyKind, ReactorConfiguration
from runtime.executive.outcome import Event, EventKind
from runtime.executive.rendering import event_data
from runtime.user.transaction_log import SUFFIX, TransactionLog, read_transaction_log

_LAST = ("abort", "end")  # kinds of events after which there is nothing
_TO_COME = (PropertyKind.REACHED, PropertyKind.WITHIN, PropertyKind.UNTIL)


@dataclass(frozen=True, slots=True)
class ReactorLog:
    """What one reactor did: `file` has it, under the name `reactor`."""

    file: Path
    reactor: str
    provided: tuple[str, ...]
    failed: int | None = None


@dataclass(frozen=True, slots=True)
class MissionLog:
    """All that is on record of a mission. Floats are rounded to `step`.

    `seed` and `values` are those of a trace that says of which flight it is. `ends` is the last tick on record, None
    where it only tells when something happened last. `cut_off` names logs that break off.
    """

    reactors: tuple[ReactorLog, ...]
    events: tuple[dict[str, Any], ...]
    last_tick: int
    step: float
    ends: int | None
    cut_off: tuple[str, ...]
    seed: int | None = None
    values: tuple[tuple[str, float], ...] = ()

    @property
    def timelines(self) -> tuple[str, ...]:
        """Those on which something was observed."""
        seen = (str(event.get("timeline")) for event in self.events if event.get("kind") == "observation")
        return tuple(dict.fromkeys(seen))


def is_log(path: Path) -> bool:
    """Whether a path is that of a log of T-REX, or of a directory with such logs."""
    return path.name.endswith(SUFFIX) if not path.is_dir() else any(path.glob(f"*{SUFFIX}"))


def read_mission_log(path: Path) -> MissionLog:
    """Read a log, all logs of a directory, or a trace; raises OSError, or ValueError with what is wrong."""
    if not is_log(path):
        events = read_events(path.read_text(encoding="utf-8"))
        seed, values = _flight_of(events)
        last = _last(events)
        ends = last if events and events[-1].get("kind") in _LAST else None
        return MissionLog(_in_trace(path, events), tuple(events), last, 0.0, ends, (), seed, values)
    files = sorted(path.glob(f"*{SUFFIX}")) if path.is_dir() else [path]
    logs = [(file, _log(file)) for file in files]
    events = sorted((event for _, log in logs for event in log.events), key=lambda event: int(event["tick"]))
    reactors = tuple(ReactorLog(file, log.reactor, log.provided, log.failed) for file, log in logs)
    last = max(log.last_tick for _, log in logs)
    ends = last if any(log.has_all_ticks for _, log in logs) else None
    cut_off = tuple(file.name for file, log in logs if not log.is_whole)
    return MissionLog(reactors, tuple(events), last, max(log.step for _, log in logs), ends, cut_off)


def _log(file: Path) -> TransactionLog:
    try:
        return read_transaction_log(file)
    except ValueError as problem:
        raise ValueError(f"{file.name}, {problem}") from None


def _flight_of(events: Sequence[Mapping[str, Any]]) -> tuple[int | None, tuple[tuple[str, float], ...]]:
    """The seed and the values given to parameters, where a trace begins with them; None and none elsewhere."""
    head = events[0] if events else {}
    seed, values = head.get("seed"), head.get("values")
    if head.get("kind") != "mission" or not isinstance(seed, int) or not isinstance(values, dict):
        return None, ()
    return seed, tuple((str(name), float(value)) for name, value in values.items() if isinstance(value, int | float))


def _in_trace(path: Path, events: Iterable[Mapping[str, Any]]) -> tuple[ReactorLog, ...]:
    """The reactors of a trace, with the timelines on which they published."""
    found: dict[str, dict[str, None]] = {}
    for event in events:
        if event.get("kind") == "observation":
            found.setdefault(str(event.get("reactor")), {})[str(event.get("timeline"))] = None
    return tuple(ReactorLog(path, name, tuple(lines)) for name, lines in found.items())


def _last(events: Iterable[Mapping[str, Any]]) -> int:
    return max((int(event["tick"]) for event in events), default=0)


def with_players(mission: Mission, log: MissionLog) -> tuple[Mission, dict[str, ReactorLog]]:
    """The mission with players for the reactors that ask nobody and have a log, and the logs of the others by name.

    Parameters to which the log's flight gave values have these. Where the log ends before the mission does, as it was
    aborted, flights end there, too: what held then would go on for ever. What a property asks to come is not judged.
    """
    agent = mission.agent
    played: dict[str, CodeConfiguration] = {}
    others: dict[str, ReactorLog] = {}
    placed: list[ReactorConfiguration | CodeConfiguration] = [*agent.reactors, *agent.coded]
    for each in placed:
        own = next((one for one in log.reactors if each.internal and set(each.internal) <= set(one.provided)), None)
        if own is not None and not each.external:
            played[each.name] = _player(each, own)
        elif own is not None:
            others[each.name] = own
    reactors = tuple(each for each in agent.reactors if each.name not in played)
    coded = (*(each for each in agent.coded if each.name not in played), *played.values())
    changed = fixed(replace(agent, reactors=reactors, coded=coded), dict(log.values))
    if log.ends is not None and log.ends < agent.final_tick:
        kept = tuple(one for one in agent.properties if one.kind not in _TO_COME)
        changed = replace(changed, until=log.ends, properties=kept)
    return replace(mission, agent=changed, check=replace(mission.check, missions=1)), others


def _player(each: ReactorConfiguration | CodeConfiguration, log: ReactorLog) -> CodeConfiguration:
    settings = {"trace": str(log.file.resolve()), "reactor": log.reactor, "timelines": ",".join(each.internal)}
    return CodeConfiguration(each.name, "", "LogPlayer", each.latency, each.internal, (), tuple(settings.items()))


@dataclass(frozen=True, slots=True)
class Departure:
    """Where a flight is first another than the logged one: what held on a timeline then, and what holds now."""

    tick: int
    timeline: str
    logged: str
    flown: str


def first_departure(log: MissionLog, timelines: Iterable[str], events: Iterable[Event]) -> Departure | None:
    """The first tick at which one of the timelines begins to hold something else than it did; None where none does."""
    wanted = set(timelines)
    logged = _begun(log.events, wanted)
    flown = _begun((event_data(one) for one in events if one.kind is EventKind.OBSERVATION), wanted)
    last = max((tick for tick, _ in flown), default=0)
    for tick, timeline in sorted({*logged, *flown}):
        old, new = logged.get((tick, timeline), ""), flown.get((tick, timeline), "")
        if old != new and tick <= last:
            return Departure(tick, timeline, old, new)
    return None


def _begun(events: Iterable[Mapping[str, Any]], timelines: set[str]) -> dict[tuple[int, str], str]:
    """What began on timelines, by tick; values that are told again do not begin."""
    found: dict[tuple[int, str], str] = {}
    held: dict[str, str] = {}
    for event in events:
        line = str(event.get("timeline"))
        text = f"{event.get('predicate')}{json.dumps(event.get('arguments', {}), sort_keys=True)}"
        if event.get("kind") == "observation" and line in timelines and held.get(line) != text:
            held[line] = text
            found[int(event["tick"]), line] = str(event.get("predicate"))
    return found
