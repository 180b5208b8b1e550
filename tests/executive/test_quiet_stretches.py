"""Register code goes over stretches in which nothing happens at no cost, and keeps the time that a mission may take."""

import pytest

from runtime.limits import TIME_LIMIT, OutOfTimeError
from tests.executive.determined_models import Case, told
from tests.executive.flying import simulator
from tests.executive.test_determined import run, steps


def test_a_quiet_stretch_costs_nothing_however_long_it_is() -> None:
    text = "class Helm extends AgentTimeline { predicate Idle { } predicate Run { float v; int n; }"
    text += (
        ' Helm(Mode m) { super(m, "Idle"); } } Helm::Run { duration <= n; } Helm helm = new Helm(Internal); close();'
    )
    quiet = Case((simulator("psim", text, "helm"),), (run(3, (5, 9), 1.0), run(9, (9e11, 9e11), 1.0)), (), 10**12)
    assert quiet.is_compiled()
    general, compiled = (quiet.fly(1, compiles=compiles) for compiles in (False, True))
    assert told(compiled) == told(general)
    assert compiled.last_tick == 10**12


def test_a_mission_that_never_searches_keeps_its_time_too() -> None:
    seconds = iter(range(9))
    with pytest.raises(OutOfTimeError, match="longer than 1 s"), TIME_LIMIT.lasting(1.0, lambda: next(seconds)):
        steps(until=10**6).fly(1, compiles=True)
