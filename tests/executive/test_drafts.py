"""Frozen values that are filled as drafts are those that their classes make."""

import pickle
from dataclasses import FrozenInstanceError

import pytest

from compiler.program import DomainConstant
from runtime.executive.messages import make_domain
from runtime.executive.outcome import Event, EventKind, Phase
from runtime.executive.trace import Trace


def test_an_event_is_one_that_its_class_makes() -> None:
    trace = Trace()
    trace.record(EventKind.REQUEST, "pilot", "arm", "Grip", causes=(0,), request=3)
    (event,) = trace.events
    made = Event(0, Phase.START, EventKind.REQUEST, "pilot", "arm", "Grip", causes=(0,), request=3)
    assert type(event) is Event
    assert (event, hash(event), repr(event)) == (made, hash(made), repr(made))
    assert pickle.loads(pickle.dumps(event)) == made
    with pytest.raises(FrozenInstanceError):
        event.tick = 1  # type: ignore[misc]


def test_a_domain_is_one_that_its_class_makes() -> None:
    domain = make_domain("int", "int", (1, 4), None)
    made = DomainConstant("int", "int", (1, 4), None)
    assert type(domain) is DomainConstant
    assert (domain, hash(domain), repr(domain)) == (made, hash(made), repr(made))
    assert pickle.loads(pickle.dumps(domain)) == made
    with pytest.raises(FrozenInstanceError):
        domain.kind = "float"  # type: ignore[misc]
