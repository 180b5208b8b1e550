"""Run one mission: the clock, and each tick every reactor in turn; a configuration goes in, an outcome comes out."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from runtime.executive.configuration import AgentConfiguration
from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import (
    Abort,
    Conflict,
    Deadlock,
    ElementKind,
    EventKind,
    OpenGoal,
    Outcome,
    Phase,
    Reason,
    Term,
    VariableName,
)
from runtime.executive.trace import Trace


@dataclass(frozen=True, slots=True)
class Watched:
    """Element `number` of a conflict says how long `variable`, the end of an observed token, has been put off."""

    number: int
    variable: VariableName
    source: Observation


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a reactor cannot go on; `conflict` is what broke first, `repairs` what stopped each repair."""

    code: str
    reason: Reason
    timelines: tuple[str, ...]
    conflict: Conflict | None
    relaxes: int
    repairs: tuple[Conflict, ...] = ()
    causes: tuple[int, ...] = ()
    watched: tuple[Watched, ...] = ()
    deadlock: Deadlock | None = None


class Reactor(Protocol):
    """A controller that owns timelines and uses those of others (T-REX 1.1)."""

    name: str
    internal: tuple[str, ...]
    external: tuple[str, ...]
    latency: int
    lookahead: int
    due: int  # the next tick at which it has something to do; earlier ones cost nothing

    def start_tick(self, tick: int) -> None:
        """Set "now"."""

    def next_tick(self, tick: int) -> int:
        """The next tick at which something can happen without news from outside."""

    def notify(self, observation: Observation) -> None:
        """Take note of what an owner published this tick; it is due then."""

    def synchronise(self, tick: int) -> Failure | None:
        """Make the plan agree with the world at `tick`, or say why that is impossible."""

    def observations(self, tick: int) -> list[Observation]:
        """What its own timelines have begun to hold at `tick`."""

    def step(self, tick: int) -> bool:
        """Make one planning decision; False if there is nothing to decide."""

    def failure(self) -> Failure | None:
        """Why planning has failed for good, if it has."""

    def requests(self, tick: int) -> list[Request]:
        """What is to be asked of owners now."""

    def recalls(self) -> list[int]:
        """Numbers of the requests that are taken back."""

    def open_requests(self) -> list[int]:
        """Numbers of the requests that it has made and that have not started."""

    def accept(self, request: Request) -> None:
        """Queue a request for one of its timelines."""

    def recall(self, number: int) -> None:
        """Drop a request that has not started."""

    def open_goals(self) -> list[OpenGoal]:
        """Mandatory goals that were not achieved."""

    def why_it_lasts(self, token: int, key: int) -> tuple[VariableName, Conflict] | None:
        """The name of the end of one of its tokens, and what sets that end."""


class OwnershipError(ValueError):
    """Reactors whose timelines have no owner, several owners, or owners in a circle."""


def in_order(reactors: Sequence[Reactor]) -> list[Reactor]:
    """Reactors with owners before users, otherwise as given (T-REX 1.3).

    Raises `OwnershipError` where a timeline has no owner or several, or where owners depend on each other.
    """
    owner: dict[str, Reactor] = {}
    for reactor in reactors:
        for timeline in reactor.internal:
            if timeline in owner:
                raise OwnershipError(f"`{timeline}` is owned by `{owner[timeline].name}` and by `{reactor.name}`")
            owner[timeline] = reactor
    waiting = list(reactors)
    done: list[Reactor] = []
    while waiting:
        for reactor in waiting:
            for timeline in reactor.external:
                if timeline not in owner:
                    raise OwnershipError(f"`{reactor.name}` uses `{timeline}`, which no reactor owns")
            if all(owner[timeline] in done for timeline in reactor.external):
                break
        else:
            names = ", ".join(f"`{reactor.name}`" for reactor in waiting)
            raise OwnershipError(f"reactors wait for each other's timelines in a circle: {names}")
        waiting.remove(reactor)
        done.append(reactor)
    return done


class Agent:
    """Reactors under one step clock; `run` carries out the mission once."""

    def __init__(
        self,
        configuration: AgentConfiguration,
        reactors: Sequence[Reactor],
        goals: Sequence[tuple[int, Request]],
        seed: int,
        trace: Trace,
        every_tick: bool = False,
    ) -> None:
        self.configuration = configuration
        self.every_tick = every_tick
        self.goals = goals
        self.unsent = [request for _, request in goals]
        self.reactors = in_order(reactors)
        self.awake: list[Reactor] = []
        self.killed: list[Reactor] = []
        self.owners = {timeline: reactor for reactor in self.reactors for timeline in reactor.internal}
        self.seed = seed
        self.trace = trace
        self.tick = 0

    def run(self) -> Outcome:
        """Carry out the mission from tick 0 to the final tick, or to the abort."""
        abort: Abort | None = None
        final_tick = self.configuration.final_tick
        while True:
            self.trace.tick = self.tick
            self._send_goals()
            abort = self._synchronise()
            # At the final tick there is no future to plan for.
            if abort is None and self.tick < final_tick:
                abort = self._deliberate()
            if abort is not None or self.tick >= final_tick or not self.reactors:
                break
            self._dispatch()
            self._advance()
        left = [goal for reactor in [*self.killed, *self.reactors] for goal in reactor.open_goals()]
        left += [OpenGoal(r.timeline, r.predicate, r.arguments, event=r.event) for r in self.unsent if r.is_mandatory]
        self.trace.phase = Phase.END
        if abort is None:
            self.trace.record(EventKind.END, "")
        return Outcome(
            self.seed,
            self.tick,
            final_tick,
            abort,
            tuple(self.trace.draws),
            tuple(self.trace.events),
            tuple(left),
        )

    def _send_goals(self) -> None:
        """Hand the goals of the mission file that are due to the owners of their timelines, if there are any left."""
        self.trace.phase = Phase.START
        for at, request in self.goals:
            if at == self.tick and request.timeline in self.owners:
                self.owners[request.timeline].accept(request)
                self.unsent.remove(request)

    def _advance(self) -> None:
        """Go on to the next tick at which a reactor has something to do or a goal is due."""
        if self.every_tick:
            self.tick += 1
            return
        times = [reactor.due for reactor in self.reactors]
        times += [at for at, _ in self.goals if at > self.tick]
        self.tick = min(max(self.tick + 1, min(times, default=self.tick + 1)), self.configuration.final_tick)

    def _synchronise(self) -> Abort | None:
        """Let reactors settle the present, owners first, each seeing the values of this very tick."""
        self.awake = []
        is_last = self.tick == self.configuration.final_tick
        for reactor in list(self.reactors):
            if reactor.due > self.tick and not is_last and not self.every_tick:
                continue
            self.awake.append(reactor)
            self.trace.phase = Phase.START
            reactor.start_tick(self.tick)
            self.trace.phase = Phase.SYNCHRONISE
            failure = reactor.synchronise(self.tick)
            if failure is not None:
                if self.configuration.on_failure == "abort_agent":
                    return self._abort(reactor, failure)
                self._kill(reactor, failure)
                continue
            self.trace.phase = Phase.OBSERVE
            self._publish(reactor.observations(self.tick))
        return None

    def _deliberate(self) -> Abort | None:
        """Let reactors plan, round robin, one decision at a time, until nobody has anything to decide."""
        self.trace.phase = Phase.DELIBERATE
        busy = list(self.awake)
        while busy:
            busy = [reactor for reactor in busy if reactor.step(self.tick)]
        for reactor in list(self.awake):
            failure = reactor.failure()
            if failure is not None:
                if self.configuration.on_failure == "abort_agent":
                    return self._abort(reactor, failure)
                self._kill(reactor, failure)
        return None

    def _dispatch(self) -> None:
        """Deliver recalls and requests; owners consider them at the next tick (T-REX 1.3)."""
        self.trace.phase = Phase.DISPATCH
        asked: list[Request] = []
        for reactor in self.awake:
            for number in reactor.recalls():
                for owner in self.reactors:
                    owner.recall(number)
            asked += reactor.requests(self.tick)
        for reactor in self.awake:
            reactor.due = reactor.next_tick(self.tick)
        for request in asked:
            if request.timeline in self.owners:
                self.owners[request.timeline].accept(request)

    def _publish(self, observations: list[Observation]) -> None:
        for observation in observations:
            for reactor in self.reactors:
                if observation.timeline in reactor.external:
                    reactor.notify(observation)

    def _abort(self, reactor: Reactor, failure: Failure) -> Abort:
        """Record that the agent ends early, with its reason."""
        conflict = self._traced(failure)
        drawn = conflict.parameters if conflict is not None else ()
        event = self.trace.record(
            EventKind.ABORT,
            reactor.name,
            ", ".join(failure.timelines),
            causes=failure.causes + self.trace.draw_events(drawn),
            code=failure.code,
            reason=failure.reason,
            conflict=conflict,
            deadlock=failure.deadlock,
        )
        return Abort(
            failure.code,
            self.tick,
            reactor.name,
            failure.timelines,
            failure.reason,
            conflict,
            failure.relaxes,
            event,
            failure.repairs,
            failure.deadlock,
        )

    def _traced(self, failure: Failure) -> Conflict | None:
        """The conflict of a failure, told on through the reactors that published what it hangs on."""
        conflict = failure.conflict
        if conflict is None:
            return None
        elements = [[element] for element in conflict.elements]
        for watched in failure.watched:
            owner = next((r for r in self.reactors if r.name == watched.source.owner), None)
            told = owner.why_it_lasts(watched.source.token, watched.source.token_key) if owner else None
            if told is None:
                continue
            name, reasons = told
            observed = replace(
                conflict.elements[watched.number],
                kind=ElementKind.SHARED_END,
                says=None,
                terms=(Term("eq", (watched.variable, name)),),
                observed=(watched.source.predicate, watched.source.timeline),
            )
            elements[watched.number] = [*reasons.elements, observed]
        return Conflict(tuple(element for together in elements for element in together))

    def _kill(self, reactor: Reactor, failure: Failure) -> None:
        """Take a failed reactor out and tell the users of its timelines (T-REX 1.6, second generation)."""
        event = self.trace.record(
            EventKind.KILL,
            reactor.name,
            ", ".join(failure.timelines),
            causes=failure.causes,
            code=failure.code,
            reason=failure.reason,
            conflict=self._traced(failure),
            deadlock=failure.deadlock,
        )
        self.reactors.remove(reactor)
        self.awake.remove(reactor)
        self.killed.append(reactor)
        for number in reactor.open_requests():
            for owner in self.reactors:
                owner.recall(number)
        for timeline in reactor.internal:
            del self.owners[timeline]
            seen = self.trace.record(EventKind.OBSERVATION, reactor.name, timeline, "Failed", causes=(event,))
            self._publish([Observation(self.tick, timeline, "Failed", (), seen)])
