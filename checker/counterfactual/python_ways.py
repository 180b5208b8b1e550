"""A failed mission in, what reactors in Python have to do with it out: what they had read, and whether they sleep.

No line of a model says what such a reactor makes of what it is told, so all that it read may bear on what it published.
"""

import ast
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

from checker.oracle import given_up
from runtime.executive.configuration import AgentConfiguration, CodeConfiguration
from runtime.executive.events import events_on, heads_of
from runtime.executive.outcome import Conflict, ElementKind, Event, EventKind, Outcome, SourcePlace

_ENDS = ("end", "duration")


def read_in_python(
    outcome: Outcome, observed: Collection[tuple[str, str]], coded: Sequence[CodeConfiguration]
) -> set[tuple[str, str]]:
    """Predicates, without their classes, each with an argument; `observed` are those of the conflicts, with classes."""
    if not coded:
        return set()
    failed = {predicate.rpartition(".")[2] for predicate, _ in observed}
    spoken = {timeline for _, _, timeline, predicate in heads_of(outcome.events) if predicate in failed}
    abort = given_up(outcome)
    ended = abort.reactor if abort is not None else ""
    waiting = [one for one in coded if one.name == ended or spoken & set(one.internal)]
    read: set[str] = set()
    while waiting:
        more = set(waiting.pop().external) - read
        read |= more
        waiting += [one for one in coded if more & set(one.internal)]
    last: dict[str, Event] = {}
    for event in events_on(outcome.events, read):
        if event.kind is EventKind.OBSERVATION:
            last[event.timeline] = event
    return {(event.predicate, name) for event in last.values() for name, _ in event.arguments}


def asleep_in(
    outcome: Outcome, conflict: Conflict | None, agent: AgentConfiguration
) -> Iterator[tuple[str, SourcePlace]]:
    """The reactors that nothing calls to end what broke a plan by going on, each with the line that published it."""
    going_on = {
        variable.token.predicate.rpartition(".")[2]
        for element in (conflict.elements if conflict is not None else ())
        if element.kind is ElementKind.OBSERVATION
        for variable in element.variables
        if variable.token is not None and variable.name in _ENDS
    }
    holding = {timeline: predicate for _, _, timeline, predicate in heads_of(outcome.events)}
    for one in agent.coded if outcome.asleep else ():
        for timeline in set(one.internal) & set(outcome.asleep):
            if one.file and (predicate := holding.get(timeline)) in going_on:
                yield one.name, _published_at(one, Path(agent.root), timeline, predicate)


def _published_at(coded: CodeConfiguration, root: Path, timeline: str, predicate: str) -> SourcePlace:
    """The line of a reactor's class that publishes a predicate, as far as its text tells, else the class itself."""
    text = (root / coded.file).read_text(encoding="utf-8")
    classes = [one for one in ast.walk(ast.parse(text)) if isinstance(one, ast.ClassDef)]
    own = next((one for one in classes if one.name == coded.class_name), None)
    line = own.lineno if own is not None else 1
    for call in ast.walk(own) if own is not None else ():
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr == "publish":
            said = [one.value for one in call.args if isinstance(one, ast.Constant)]
            line = call.lineno if said[:2] == [timeline, predicate] else line
    shown = text.splitlines()[line - 1].strip()
    return SourcePlace(coded.file, line, 1, shown)
