"""`nddlc run`: fly one mission, show what happened, and say how it ended."""

import re
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

import click

from checker.causes import Failed, dead_ends, failed_at, failed_by, goals_ruled_out, lines_that_rule_out, missed_after
from checker.clock_table import clock_log
from checker.culprit import culprit_of
from checker.excerpts import Excerpts
from checker.happened import WIDTH, gantt
from checker.mission import LARGEST_SEED
from checker.one_flight import Flight, FlightSettings, fly, trace_text
from checker.oracle import Verdict
from checker.real_time import RealTimeClock
from checker.rendering import failure_text, waiting_text
from checker.waiting import kept_open_by, waited_for
from nddlc.fitting import columns, say
from nddlc.inputs import STORE, mission_here, write_text
from nddlc.main import named
from nddlc.one_mission import prepare, values_of
from nddlc.seeking import BAR_SECONDS, LINE_SECONDS
from nddlc.trust import trust_option
from runtime.executive.clocks import clock_of
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.events import single_events
from runtime.executive.outcome import Event, EventKind, OpenGoal
from runtime.executive.rendering import deadlock_text, event_text, goal_text, token_text

_PASS, _FAIL = 0, 1
_TOLD = (EventKind.REFUSE, EventKind.REJECT, EventKind.RECALL, EventKind.RELAX, EventKind.KILL, EventKind.ABORT)

_FILE = click.Path(path_type=Path, dir_okay=False)
_MOST_LINES = 8  # of the model that are named for a failure
_MOST_REASONS = 3  # of goals that stayed open, each with its lines


@click.command()
@click.argument("path", metavar="[MISSION|RUN#N]", required=False)
@click.option("--seed", type=click.IntRange(0, LARGEST_SEED), help="The seed of the mission, else that of the file.")
@click.option("--param", "given", multiple=True, metavar="NAME=VALUE", help="Give a parameter a value; repeatable.")
@click.option("--until", type=click.IntRange(0), help="Stop at this tick.")
@click.option("--trace", type=_FILE, help="Write the trace here, as JSON Lines; folders are made.")
@click.option("--real-time", "is_timed", is_flag=True, help="Let each tick take its time; what takes longer is late.")
@click.option("--clock", "log", type=_FILE, help="Write the steps of planners in each tick here, for `log` of a clock.")
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where runs are kept.")
@trust_option
def command(
    path: str | None,
    seed: int | None,
    given: tuple[str, ...],
    until: int | None,
    trace: Path | None,
    log: Path | None,
    is_timed: bool,
    store_path: Path,
    is_trusted: bool,
) -> int:
    """Fly one mission and show what happened.

    MISSION is a mission file (.toml), by default the one here, or an agent file of T-REX (.xml, .cfg); RUN#N is
    mission N of a run of `nddlc check`, such as `latest#37`. It is flown as fast as it can be, unless `--real-time`
    is given. Ends with 0 if the mission passes, with 1 if it fails, with 2 if it cannot be flown.
    """
    if path is not None and "#" in path and not Path(path).exists():
        file, mission, models, own_seed = named("nddlc.stored:stored_flight")(path, store_path, is_trusted)
    else:
        file, mission, models = prepare(mission_here(path), is_trusted=is_trusted, is_linted=True)
        own_seed = mission.check.seed
    settings = FlightSettings(own_seed if seed is None else seed, values_of(given, models), until)
    agent = models.agent
    clock = clock_of(agent.clock)
    if is_timed:
        ends = agent.final_tick if until is None else min(until, agent.final_tick)
        clock = RealTimeClock(agent.tick, agent.clock.share, lambda tick: _progress(f"tick {tick} of {ends} ..."))
    else:
        _progress(f"flying {agent.name} ...")
    now = time.monotonic if is_timed else _Watch(agent.name)
    try:
        flight = fly(mission, models, settings, clock if is_timed or log is not None else None, now)
    finally:
        _progress("")
    if log is not None:
        write_text(log, clock_log(clock, agent.tick))
    if trace is not None:
        write_text(trace, trace_text(flight, file, trace))
    say(_report(mission.agent, flight))
    if isinstance(clock, RealTimeClock):
        say(f"  a tick of {agent.tick:g} s began {clock.latest:.3g} s late at most\n")
    return _PASS if flight.judgement.verdict is Verdict.PASS else _FAIL


class _Watch:
    """The time, in seconds; who asks often sees on standard error that a long flight goes on."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._begun = self._told = time.monotonic()
        self._is_terminal = sys.stderr.isatty()

    def __call__(self) -> float:
        now = time.monotonic()
        if now - self._told >= (BAR_SECONDS if self._is_terminal else LINE_SECONDS):
            self._told = now
            text = f"flying {self._name}: {now - self._begun:.0f} s"
            if self._is_terminal:
                _progress(text)
            else:
                click.echo(text, err=True)
        return now


def _progress(text: str) -> None:
    if sys.stderr.isatty():
        click.echo(f"\r\x1b[K{text}", nl=False, err=True)


def _report(agent: AgentConfiguration, flight: Flight) -> str:
    """The Gantt of what happened, what was given up and repaired, and the outcome."""
    name = agent.name
    outcome, judgement = flight.outcome, flight.judgement
    lines = [gantt(outcome, columns() or WIDTH)]
    events = single_events(outcome.events)
    lines += [_told(alike) for alike in sorts_of(event for event in events if event.kind in _TOLD)]
    counts = Counter(event.kind for event in events)
    achieved = [event.request for event in events if event.kind is EventKind.ACHIEVED]
    done = sum(number is None or number < 0 for number in achieved)  # without a number: wanted by a model's script
    asked = sum(event.kind is EventKind.REQUEST and (event.request or 0) >= 0 for event in events)
    rejected = {event.request for event in events if event.kind is EventKind.REJECT and event.request is not None}
    back = len(rejected & set(achieved))
    recalled = [event.request or 0 for event in events if event.kind is EventKind.RECALL]
    taken_back = len({number for number in recalled if number < 0} - set(achieved))  # by the mission file
    lines.append(
        f"{name}, seed {flight.settings.seed}: {judgement.verdict.value}"
        f"{f' {judgement.code}' if judgement.code else ''} at tick {outcome.last_tick}\n"
    )
    if judgement.verdict is not Verdict.PASS:
        lines.append(f"  {failure_text(judgement, refusal=missed_after(outcome))}\n")
    lines.append(
        f"  goals achieved {done}, open {len(outcome.open_goals)}"
        f"{f', recalled {taken_back}' if taken_back else ''}; requests between reactors {asked}, "
        f"rejected {counts[EventKind.REJECT]}{f' ({back} came back)' if back else ''}, "
        f"refused {counts[EventKind.REFUSE]}, recalled {sum(number >= 0 for number in recalled)}; "
        f"repairs {counts[EventKind.RELAX]}\n"
    )
    if outcome.abort is None and outcome.last_tick < agent.final_tick:
        awaited = len(agent.goals) - (done - achieved.count(None)) - len(outcome.open_goals)
        goals = f"; {awaited} of its goals may still be achieved" if awaited > 0 else ""
        cut = f"flown to tick {outcome.last_tick} only, and judged as far"
        lines.append(f"  {cut}: the mission ends at {agent.final_tick}{goals}\n")
    for predicate, timeline, asker in flight.before:
        why = "the plan put it before tick 0; say that it starts at 0 or later"
        lines.append(f"  never carried out: {predicate} on `{timeline}`, asked for by {asker}: {why}\n")
    lines += [f"  open: {goal_text(goal)}{_so_far(goal, outcome.events)}\n" for goal in outcome.open_goals]
    lines += [f"  waits: {waiting_text(one)}\n" for one in waited_for(outcome, agent) if one.sender]
    if judgement.verdict is not Verdict.PASS:
        excerpts = Excerpts(Path(agent.root))
        ruled_out = goals_ruled_out(outcome) if outcome.abort is None else []
        if len(ruled_out) < 2:
            lines += _lines_of(failed_by(outcome), "what was wanted", excerpts)
        for answer in kept_open_by(outcome, agent) if not ruled_out else ():
            wanted = f"{token_text(answer.predicate, answer.arguments)}, which an open goal waits for"
            lines += _lines_of(failed_at(answer), wanted, excerpts)
        for missed, failed in ruled_out[:_MOST_REASONS] if len(ruled_out) > 1 else ():
            lines += _lines_of(
                failed, ", ".join(token_text(goal.predicate, goal.arguments) for goal in missed), excerpts
            )
        if len(ruled_out) > _MOST_REASONS:
            lines.append(f"  and {len(ruled_out) - _MOST_REASONS} more goals, each for lines of its own\n")
        lines.append("  what to change: `nddlc check` tries it out, `nddlc explain` then tells how it came\n")
    return "".join(lines)


def _lines_of(failed: Failed, wanted: str, excerpts: Excerpts) -> Iterator[str]:
    """The lines of the model that rule something out, first where it breaks; without any, what had no choice."""
    places = [one.place for one in lines_that_rule_out(failed) if one.place is not None]
    if places:
        yield f"  these lines together rule out {wanted}; it breaks at the first:\n"
    else:
        ends = dict.fromkeys(deadlock_text(way[-1]) for way in dead_ends(failed.deadlock))
        yield from (f"  no choice is left for {wanted}: {end}\n" for end in list(ends)[:_MOST_REASONS])
    for one in places[:_MOST_LINES]:
        yield f"    {one.file}:{one.line}:{one.column}: {_with_message(one.text, excerpts.line(one))}\n"
    if len(places) > _MOST_LINES:
        yield f"    and {len(places) - _MOST_LINES} more\n"


def _with_message(statement: str, line: str) -> str:
    """A statement, with the message that its line of the model gives it (`people <= SEATS : "the car is full"`)."""
    found = re.search(re.escape(statement) + r'\s*:\s*"[^"]*"', line)
    return found[0] if found is not None else statement


def sorts_of(events: Iterable[Event]) -> list[list[Event]]:
    """Events by what they are told as: those of one sort that follow each other, also where two sorts take turns."""
    sorts: list[tuple[Any, list[Event]]] = []
    for sort, alike in groupby(events, key=_sort_of_event):
        before = next((of for known, of in sorts[-2:] if known == sort), None)
        if before is None:
            sorts.append((sort, list(alike)))
        else:
            before += alike
    return [alike for _, alike in sorts]


def _sort_of_event(event: Event) -> tuple[Any, ...]:
    """What events that follow each other are told together by; the stage of a repair is no part of it."""
    reason = event.reason
    about = None if reason is None else (reason.kind, reason.token.predicate if reason.token else "", reason.predicate)
    return (event.kind, event.reactor, event.timeline, event.predicate, about)


def _told(alike: Sequence[Event]) -> str:
    """One line for events of one sort: the first of them, with how many there were and until when."""
    first, last = alike[0], alike[-1]
    who = " ".join(filter(None, (first.reactor, first.kind.value, first.timeline)))
    place = culprit_of(first.conflict).place if first.kind is EventKind.RELAX else None
    where = f", by {place.file}:{place.line} `{place.text}`" if place is not None else ""
    if len(alike) == 1:
        return f"{first.tick:>7}  {who}: {event_text(first)}{where}\n"
    until = f", until tick {last.tick}" if last.tick > first.tick else ""
    return f"{first.tick:>7}  {who}: {event_text(first)}{where} (and {len(alike) - 1} more of this sort{until})\n"


def _so_far(goal: OpenGoal, events: Sequence[Event]) -> str:
    """Of a goal that nothing became of: whether it was sent and had begun when the mission ended."""
    if goal.reason is not None:
        return ""
    if goal.event < 0:
        return ": its time to be sent had not come"
    began = next(
        (
            event.tick
            for event in events
            if event.kind is EventKind.OBSERVATION and event.timeline == goal.timeline and goal.event in event.causes
        ),
        None,
    )
    if began is None:
        return ": it had not begun"
    owners = {one.reactor for one in events if one.timeline == goal.timeline and one.predicate == "Failed"}
    killed = next((one.tick for one in events if one.kind is EventKind.KILL and one.reactor in owners), None)
    if killed is not None and killed >= began:
        return f": it began at tick {began}, and its owner was killed at tick {killed}"
    return f": it began at tick {began}, and nothing has ended it"
