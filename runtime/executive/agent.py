"""Run one mission: the clock, and each tick every reactor in turn; a configuration goes in, an outcome comes out."""

from collections.abc import Sequence
from math import inf

from runtime.executive.clocks import FastClock
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import (
    Abort,
    Conflict,
    EventKind,
    OpenGoal,
    Outcome,
    Phase,
    Reason,
    ReasonKind,
)
from runtime.executive.ownership import in_order, tell_owners
from runtime.executive.poster import GoalPoster
from runtime.executive.reactor import Failure, Refusal, TeleoReactor, Watched
from runtime.executive.told_on import asked_in, told_on
from runtime.executive.trace import Trace, as_it_is
from runtime.limits import TIME_LIMIT

_START, _SYNCHRONISE, _OBSERVE = Phase.START, Phase.SYNCHRONISE, Phase.OBSERVE
_DELIBERATE, _DISPATCH = Phase.DELIBERATE, Phase.DISPATCH
_UNWATCHED = 256  # visits between two looks at how long the mission has taken


class Agent:
    """Reactors under one clock; `run` carries out the mission once."""

    def __init__(
        self,
        configuration: AgentConfiguration,
        reactors: Sequence[TeleoReactor],
        goals: Sequence[tuple[int, Request]],
        seed: int,
        trace: Trace,
        every_tick: bool = False,
        tells_on: bool = True,
        clock: FastClock | None = None,
    ) -> None:
        self.configuration = configuration
        self.clock = clock or FastClock()
        self.every_tick = every_tick
        self.poster = GoalPoster(goals, configuration.goals, trace)
        self.reactors = in_order(reactors)
        tell_owners(self.reactors)
        for place, reactor in enumerate(self.reactors):
            reactor.place, reactor.is_metered = place, self.clock.is_metered
        self.ahead = [reactor for reactor in self.reactors if reactor.runs_ahead]
        if self.ahead == self.reactors[:1]:
            self.ahead = []  # nothing comes between what it has carried out already and what it does now
        self.awake: list[TeleoReactor] = []
        self.killed: list[TeleoReactor] = []
        self.owners = {timeline: reactor for reactor in self.reactors for timeline in reactor.internal}
        self.users: dict[str, list[TeleoReactor]] = {}
        for reactor in self.reactors:
            for timeline in reactor.external:
                self.users.setdefault(timeline, []).append(reactor)
        self.senders: dict[int, TeleoReactor] = {}  # who made a request, by its number
        self.takers: dict[int, TeleoReactor] = {}  # who was asked
        self.made: dict[int, Request] = {}  # requests of reactors that have not been taken back
        self.stirred: list[TeleoReactor] = []  # who has got something to do from a reactor that was killed
        self.seed = seed
        self.trace = trace
        if tells_on:
            trace.tell_on = self._told_on
        self.tick = 0
        self.posts_at = self.poster.due
        self.last_urgency, self.last_place = inf, 0  # of the latest turn of a tick; before all turns

    def run(self, until: int | None = None) -> Outcome:
        """Carry out the mission from tick 0 to the final tick, to `until`, or to the abort."""
        final_tick = self.configuration.final_tick
        last = final_tick if until is None else min(until, final_tick)
        abort: Abort | None = None
        visits = 0
        while True:
            visits += 1
            if visits % _UNWATCHED == 0:  # planners look at the time themselves, others do not
                TIME_LIMIT.check(None)
            self.trace.tick = self.tick
            self.clock.begin(self.tick)
            if self.ahead:
                self._pass_over()
            abort = self._synchronise()
            # At the final tick there is no future to plan for.
            if abort is None and self.tick < final_tick:
                abort = self._deliberate()
            if abort is not None or self.tick >= last or not self.reactors:
                break
            self._advance(last)
        left = [goal for reactor in [*self.killed, *self.reactors] for goal in reactor.open_goals()]
        left += [OpenGoal(r.timeline, r.predicate, r.arguments) for _, r in self.poster.unsent if r.is_mandatory]
        if last < final_tick:
            # The others may still be achieved.
            left = [g for g in left if g.reason is not None and g.reason.kind is not ReasonKind.CUT_LOOSE]
        self.trace.phase = Phase.END
        if abort is None:
            self.trace.record(EventKind.END, "", code="F10" if left and not self.killed else "")
        self.trace.tell_on = as_it_is  # without a cycle the memory of a mission is free as soon as nobody looks at it
        draws, events = tuple(self.trace.draws), self.trace.events
        return Outcome(self.seed, self.tick, last, abort, draws, events, tuple(left))

    def _advance(self, last: int) -> None:
        """Go on to the next tick at which a reactor has something to do or a goal is due."""
        if self.every_tick:
            self.tick += 1
            return
        tick = self.tick
        for reactor in self.awake:
            reactor.due = reactor.next_tick(tick)
        soonest = self.posts_at
        for reactor in self.reactors:
            soonest = min(soonest, reactor.due)
        self.tick = min(max(tick + 1, soonest), last)

    def _pass_over(self) -> None:
        """Put on record what was carried out for earlier ticks, in the order of time."""
        while True:
            tick = self.tick
            for reactor in self.ahead:
                tick = min(tick, reactor.untold())
            if tick == self.tick:
                break
            for reactor in self.ahead:
                reactor.pass_over(tick)

    # ---- the present ----

    def _synchronise(self) -> Abort | None:
        """Let reactors synchronise the present, owners first, each seeing the values of this very tick."""
        self.awake = []
        is_last = self.tick == self.configuration.final_tick
        for reactor in list(self.reactors):
            if reactor.due > self.tick and not is_last and not self.every_tick and not reactor.runs_ahead:
                continue
            abort = self._synchronise_one(reactor)
            if abort is not None:
                for later in self.reactors[self.reactors.index(reactor) + 1 :]:
                    later.missed = self.tick
                return abort
        return None

    def _synchronise_one(self, reactor: TeleoReactor) -> Abort | None:
        """Let one reactor synchronise the present, and tell what its timelines begin to hold."""
        self.awake.append(reactor)
        self.trace.phase = _START
        reactor.start_tick(self.tick)
        self.trace.phase = _SYNCHRONISE
        failure = reactor.synchronise(self.tick)
        if failure is not None:
            return self._give_up(reactor, failure)
        self.trace.phase = _OBSERVE
        self._publish(reactor.observations(self.tick))
        if reactor.lacking:  # who asked for it may be over at the same tick, and comes later in it
            for refusal in reactor.lacking:
                if (sender := self.senders.get(refusal.request.number)) is not None:
                    sender.due = min(sender.due, self.tick)
            self._tell_refusals(reactor.lacking)
            reactor.lacking.clear()
        return None

    def _publish(self, observations: list[Observation]) -> None:
        for observation in observations:
            for reactor in self.users.get(observation.timeline, ()):
                if reactor in self.reactors:
                    reactor.notify(observation)

    # ---- the future ----

    def _deliberate(self) -> Abort | None:
        """Hand out goals, and let reactors plan, the most urgent first, until nobody has anything left to do.

        Who has finished tells owners what it needs of them, and they plan for it in the same tick.
        """
        busy = list(self.awake)
        self.last_urgency, self.last_place = inf, 0
        abort = self._post_goals(busy)
        while (busy or self.stirred) and abort is None:
            while self.stirred and abort is None:
                abort = self._wake(self.stirred.pop(), busy)
            if abort is not None or not busy:
                continue
            reactor = self._most_urgent(busy)
            urgency = reactor.urgency(self.tick)
            if self._is_later(urgency, reactor.place):
                self.last_urgency, self.last_place = urgency, reactor.place
            self.trace.phase = _DELIBERATE
            if self._step(reactor):
                continue
            busy.remove(reactor)
            failure = reactor.failure()
            abort = self._give_up(reactor, failure) if failure is not None else self._dispatch(reactor, busy)
            if reactor.has_turns():
                busy.append(reactor)
        return abort

    def _step(self, reactor: TeleoReactor) -> bool:
        """Let a reactor make a step, if the clock has one for who has something to decide; whether there is more."""
        if reactor.lookahead <= 1:
            return bool(reactor.step(self.tick))
        if not self.clock.is_free() and reactor.has_work(self.tick):
            self.clock.count(0)
            reactor.halt()
        made = reactor.decisions_made
        has_more = bool(reactor.step(self.tick))
        if reactor.decisions_made > made:
            self.clock.count(reactor.decisions_made - made)
        return has_more

    def _most_urgent(self, busy: list[TeleoReactor]) -> TeleoReactor:
        """Who comes next; of equal ones the first in the order of synchronising, whoever was woken first."""
        if len(busy) == 1:
            return busy[0]
        first = busy[0]
        most = first.urgency(self.tick)
        for k in range(1, len(busy)):
            reactor = busy[k]
            urgency = reactor.urgency(self.tick)
            if urgency > most or (urgency == most and reactor.place < first.place):
                first, most = reactor, urgency
        return first

    def _post_goals(self, busy: list[TeleoReactor]) -> Abort | None:
        """Hand the goals of the mission file that are due to the owners of their timelines, or take them back."""
        self.trace.phase = _START
        if self.tick < self.posts_at:
            return None
        for request in self.poster.hand_out(self.tick, self.owners):
            if (abort := self._ask(request, busy)) is not None:
                return abort
        self.posts_at = self.poster.due
        for number in self.poster.take_back(self.tick):
            if (abort := self._recall(number, busy)) is not None:
                return abort
        return None

    def _dispatch(self, reactor: TeleoReactor, busy: list[TeleoReactor]) -> Abort | None:
        """Deliver what a reactor takes back, asks for and refuses, now that it has finished planning."""
        self.trace.phase = _DISPATCH
        for refusal in reactor.refusals():
            abort = self._rouse(refusal, busy)
            if abort is not None:
                return abort
            self._tell_refusals([refusal])
        self.trace.phase = _DISPATCH  # to tell who sleeps wakes it
        for number in reactor.recalls():
            abort = self._recall(number, busy)
            if abort is not None:
                return abort
        self.trace.phase = _DISPATCH  # to take something back may have woken its owner
        for request in reactor.requests(self.tick):
            self.senders[request.number] = reactor
            self.made[request.number] = request
            abort = self._ask(request, busy)
            if abort is not None:
                return abort
        return None

    def _ask(self, request: Request, busy: list[TeleoReactor]) -> Abort | None:
        """Hand a request to the owner of its timeline, who has work now."""
        owner = self.owners.get(request.timeline)
        if owner is None:
            event = self.trace.record(
                EventKind.REFUSE,
                "",
                request.timeline,
                request.predicate,
                request.arguments,
                (request.event,),
                request=request.number,
                reason=Reason(ReasonKind.NO_OWNER, timeline=request.timeline),
            )
            self._tell_refusals([Refusal(request, event)])
            return None
        abort = self._wake(owner, busy)
        if abort is None and owner in self.reactors:
            self.takers[request.number] = owner
            owner.accept(request)
        return abort

    def _recall(self, number: int, busy: list[TeleoReactor]) -> Abort | None:
        """Tell the owner that a request is taken back."""
        self.senders.pop(number, None)
        self.made.pop(number, None)
        owner = self.takers.pop(number, None)
        if owner is None or owner not in self.reactors:
            return None
        abort = self._wake(owner, busy)
        if abort is None and owner in self.reactors:
            owner.recall(number)
        return abort

    def _is_later(self, urgency: float, place: int) -> bool:
        """Whether a turn comes after all that there were in this tick: the most urgent first, then by place."""
        return urgency < self.last_urgency or (urgency == self.last_urgency and place > self.last_place)

    def _rouse(self, refusal: Refusal, busy: list[TeleoReactor]) -> Abort | None:
        """Wake who sleeps though what it asked for is refused; it has its turn unless that would have been before."""
        sender = self.senders.get(refusal.request.number)
        if sender is None or sender in self.awake or sender not in self.reactors:
            return None
        abort = self._synchronise_one(sender)
        if abort is None and sender in self.reactors and self._is_later(sender.urgency(self.tick), sender.place):
            busy.append(sender)
        return abort

    def _tell_refusals(self, refusals: list[Refusal]) -> None:
        for refusal in refusals:
            sender = self.senders.get(refusal.request.number)
            if sender is not None and sender in self.reactors:
                sender.refused(refusal)

    def _wake(self, reactor: TeleoReactor, busy: list[TeleoReactor]) -> Abort | None:
        """Give a reactor work in this tick; one that sleeps is brought up to now first."""
        if reactor not in self.reactors:
            return None
        if reactor not in self.awake:
            abort = self._synchronise_one(reactor)
            if abort is not None or reactor not in self.reactors:
                return abort
        if reactor not in busy:
            busy.append(reactor)
        return None

    # ---- failures ----

    def _give_up(self, reactor: TeleoReactor, failure: Failure) -> Abort | None:
        """End the mission, or go on without the reactor, as the configuration has it."""
        if self.configuration.on_failure == "abort_agent":
            return self._abort(reactor, failure)
        self._kill(reactor, failure)
        return None

    def _abort(self, reactor: TeleoReactor, failure: Failure) -> Abort:
        """Record that the agent ends early, with its reason."""
        conflict = None if failure.conflict is None else self.trace.tell_on(failure.conflict, failure.watched)
        deadlock = asked_in(failure.deadlock, reactor.hangs_on, self.trace)
        drawn = conflict.parameters if conflict is not None else ()
        event = self.trace.record(
            EventKind.ABORT,
            reactor.name,
            ", ".join(failure.timelines),
            causes=failure.causes + self.trace.draw_events(drawn),
            code=failure.code,
            reason=failure.reason,
            conflict=conflict,
            deadlock=deadlock,
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
            deadlock,
        )

    def _told_on(self, conflict: Conflict, watches: tuple[Watched, ...]) -> Conflict:
        """A conflict, told on through the reactors that published or asked for what it hangs on."""
        return told_on(conflict, watches, self.reactors)

    def _kill(self, reactor: TeleoReactor, failure: Failure) -> None:
        """Take a failed reactor out and tell the users of its timelines (T-REX 1.6, second generation)."""
        event = self.trace.record(
            EventKind.KILL,
            reactor.name,
            ", ".join(failure.timelines),
            causes=failure.causes,
            code=failure.code,
            reason=failure.reason,
            conflict=None if failure.conflict is None else self.trace.tell_on(failure.conflict, failure.watched),
            deadlock=failure.deadlock,
        )
        self.reactors.remove(reactor)
        self.awake.remove(reactor)
        self.killed.append(reactor)
        done = {each.request for each in self.trace.events if each.kind is EventKind.ACHIEVED}
        for number in reactor.open_requests():
            owner = self.takers.pop(number, None)
            if owner is not None and owner in self.reactors and number not in done:
                one = self.made[number]
                what = (one.timeline, one.predicate, one.arguments, (event,))
                self.trace.record(EventKind.RECALL, reactor.name, *what, request=number)
                owner.recall(number)
                self.stirred.append(owner)
        lost = [number for number, owner in self.takers.items() if owner is reactor and number in self.made]
        self._tell_refusals([Refusal(self.made[number], event) for number in lost])
        for timeline in reactor.internal:
            del self.owners[timeline]
            seen = self.trace.record(EventKind.OBSERVATION, reactor.name, timeline, "Failed", causes=(event,))
            self._publish([Observation(self.tick, timeline, "Failed", (), seen)])
