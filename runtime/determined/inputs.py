"""What came to a reactor from outside, in order; a general reactor that is given the same comes to the same state."""

from dataclasses import dataclass, field

from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import Phase
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.reactor import Failure
from runtime.executive.trace import Trace


@dataclass(frozen=True, slots=True)
class Input:
    """An observation, a request or a recall (by number) at a tick; `is_early`: before the tick was synchronised.

    What has the same `step` was taken in together, in one step of deliberation.
    """

    tick: int
    step: int
    is_early: bool
    what: "Observation | Request | int"


@dataclass(eq=False, slots=True)
class Inputs:
    """All of them, oldest first."""

    received: list[Input] = field(default_factory=list)
    step: int = 0  # how many steps of deliberation have been made
    is_fresh: bool = False  # something has come in that nobody has looked at

    def note(self, tick: int, is_early: bool, what: "Observation | Request | int") -> None:
        """Note an observation, a request, or the number of a request that is taken back."""
        self.received.append(Input(tick, self.step, is_early, what))
        self.is_fresh = True


class _CatchUpError(RuntimeError):
    """The general engine does not get through what the register machine carried out: a mistake of ours."""


class ShadowReactor:
    """A general reactor that lives through what came in, on from where it stands."""

    def __init__(self, reactor: PlanReactor, shadow: Trace, inputs: Inputs) -> None:
        self.reactor = reactor
        self.shadow = shadow
        self.inputs = inputs
        self.given = 0  # how much of what came in it has been given
        self.tick = 0
        self.step = 0  # the step in which what it was given last was taken in
        self.is_synchronised = False  # whether it stands behind the present of `tick`

    def catch_up(self, until: int, is_synchronised: bool) -> None:
        """Go on to tick `until`, before which it stands, or until that tick is synchronised."""
        while self.tick < until or not self.is_synchronised:
            if self.is_synchronised:
                self._deliberate(until)
                continue
            self.shadow.tick, self.shadow.phase = self.tick, Phase.SYNCHRONISE
            self._give(True)
            self.reactor.start_tick(self.tick)
            if self.tick == until and not is_synchronised:
                return
            failure = self.reactor.synchronise(self.tick)
            self.reactor.observations(self.tick)
            self.shadow.phase = Phase.DELIBERATE
            self._check(failure)
            self.is_synchronised = True
        self._give(False)

    def _deliberate(self, until: int) -> None:
        """Let the reactor plan, and go on to the next tick at which it has something to do."""
        reactor, tick = self.reactor, self.tick
        self._give(False)
        self._plan()
        reactor.due = reactor.next_tick(tick)
        following = [each.tick for each in self.inputs.received[self.given : self.given + 1]]
        self.tick = max(tick + 1, min([reactor.due, until, *following]))
        self.is_synchronised = False

    def _plan(self) -> None:
        """Let the reactor plan until it has finished, as one step of the register machine does."""
        reactor = self.reactor
        while reactor.step(self.tick):
            pass
        self._check(reactor.failure())
        reactor.recalls()
        reactor.requests(self.tick)
        reactor.refusals()

    def _check(self, failure: Failure | None) -> None:
        if failure is not None:
            name, why = self.reactor.name, failure.reason.kind.name
            raise _CatchUpError(f"`{name}` fails at tick {self.tick}: {failure.code} {why}")

    def _give(self, is_early: bool) -> None:
        """Give what came in at this tick, before or after it was synchronised; what came in later steps comes later."""
        received = self.inputs.received
        while self.given < len(received):
            one = received[self.given]
            if one.tick != self.tick or one.is_early != is_early:
                break
            if one.step != self.step and not is_early:
                if self.given > 0 and received[self.given - 1].tick == self.tick:
                    self._plan()
                self.step = one.step
            self.given += 1
            if isinstance(one.what, Observation):
                self.reactor.notify(one.what)
            elif isinstance(one.what, Request):
                self.reactor.accept(one.what)
            else:
                self.reactor.recall(one.what)


def take_over(reactor: PlanReactor, trace: Trace) -> None:
    """From now on, what a reactor does is put on record; so is what it has drawn for what is still to begin."""
    for draw in reactor.trace.draws:
        trace.record_draw(reactor.name, draw)
    reactor.trace = reactor.dispatch.trace = reactor.goals.trace = reactor.draws.world.trace = trace
