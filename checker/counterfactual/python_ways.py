"""A failed mission in, the arguments out that reactors in Python had read where one raised, or published what failed.

No line of a model says what such a reactor makes of what it is told, so all of that may bear on it.
"""

from collections.abc import Collection, Sequence

from checker.oracle import given_up
from runtime.executive.configuration import CodeConfiguration
from runtime.executive.events import events_on, heads_of
from runtime.executive.outcome import Event, EventKind, Outcome


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
