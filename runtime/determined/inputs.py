"""What came to a reactor from outside, in order; a general reactor that is given the same comes to the same state."""

from dataclasses import dataclass, field

from runtime.executive.agent import Failure
from runtime.executive.messages import Observation, Request
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

    def notify(self, observation: Observation) -> None:
        """Note an observation."""
        self.received.append(Input(observation.tick, True, observation))

    def accept(self, tick: int, is_early: bool, request: Request) -> None:
        """Note a request."""
        self.received.append(Input(tick, is_early, request))

    def recall(self, tick: int, number: int) -> None:
        """Note that a request was taken back."""
        self.received.append(Input(tick, False, number))


def catch_up(reactor: PlanReactor, shadow: Trace, inputs: Inputs, until: int, is_settled: bool) -> Failure | None:
    """Have a fresh reactor live through what came in before tick `until`, or until that tick is settled."""
    waiting = list(inputs.received)
    tick = 0
    while tick <= until:
        shadow.tick = tick
        is_last = tick == until
        _give(reactor, waiting, tick, True)
        reactor.start_tick(tick)
        if is_last and not is_settled:
            return None
        failure = reactor.synchronise(tick)
        if failure is not None:
            return failure
        reactor.observations(tick)
        if is_last:
            return None
        while reactor.step(tick):
            pass
        failure = reactor.failure()
        if failure is not None:
            return failure
        reactor.recalls()
        reactor.requests(tick)
        reactor.due = reactor.next_tick(tick)
        _give(reactor, waiting, tick, False)
        tick = max(tick + 1, min([reactor.due, until, *(each.tick for each in waiting[:1])]))
    return None


def _give(reactor: PlanReactor, waiting: list[Input], tick: int, is_early: bool) -> None:
    while waiting and waiting[0].tick == tick and waiting[0].is_early == is_early:
        what = waiting.pop(0).what
        if isinstance(what, Observation):
            reactor.notify(what)
        elif isinstance(what, Request):
            reactor.accept(what)
        else:
            reactor.recall(what)
