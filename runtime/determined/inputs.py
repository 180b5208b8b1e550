"""What came to a reactor from outside, in order; a general reactor that is given the same comes to the same state."""

from dataclasses import dataclass, field

from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import Phase
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.trace import Trace


@dataclass(frozen=True, slots=True)
class Input:
    """An observation, a request or a recall (by number) at a tick; `is_early`: before the tick was synchronised."""

    tick: int
    is_early: bool
    what: "Observation | Request | int"


@dataclass(eq=False, slots=True)
class Inputs:
    """All of them, oldest first."""

    received: list[Input] = field(default_factory=list)
    is_fresh: bool = False  # something has come in that nobody has looked at

    def note(self, tick: int, is_early: bool, what: "Observation | Request | int") -> None:
        """Note an observation, a request, or the number of a request that is taken back."""
        self.received.append(Input(tick, is_early, what))
        self.is_fresh = True


class _CatchUpError(RuntimeError):
    """The general engine does not get through what the register machine carried out: a mistake of ours."""


def catch_up(reactor: PlanReactor, shadow: Trace, inputs: Inputs, until: int, is_synchronised: bool) -> None:
    """Have a fresh reactor live through what came in before tick `until`, or until that tick is synchronised."""
    waiting = list(inputs.received)
    tick = 0
    while True:
        shadow.tick, shadow.phase = tick, Phase.SYNCHRONISE
        _give(reactor, waiting, tick, True)
        reactor.start_tick(tick)
        if tick == until and not is_synchronised:
            return
        failure = reactor.synchronise(tick)
        reactor.observations(tick)
        shadow.phase = Phase.DELIBERATE
        _give(reactor, waiting, tick, False)
        if tick == until and failure is None:
            return
        while failure is None and reactor.step(tick):
            pass
        failure = failure or reactor.failure()
        if failure is not None:
            raise _CatchUpError(f"`{reactor.name}` fails at tick {tick}: {failure.code} {failure.reason.kind.name}")
        reactor.recalls()
        reactor.requests(tick)
        reactor.refusals()
        reactor.due = reactor.next_tick(tick)
        tick = max(tick + 1, min([reactor.due, until, *(each.tick for each in waiting[:1])]))


def take_over(reactor: PlanReactor, trace: Trace) -> None:
    """From now on, what a reactor does is put on record; so is what it has drawn for what is still to begin."""
    for draw in reactor.trace.draws:
        trace.record_draw(reactor.name, draw)
    reactor.trace = reactor.dispatch.trace = reactor.goals.trace = reactor.draws.world.trace = trace


def _give(reactor: PlanReactor, waiting: list[Input], tick: int, is_early: bool) -> None:
    while waiting and waiting[0].tick == tick and waiting[0].is_early == is_early:
        what = waiting.pop(0).what
        if isinstance(what, Observation):
            reactor.notify(what)
        elif isinstance(what, Request):
            reactor.accept(what)
        else:
            reactor.recall(what)
