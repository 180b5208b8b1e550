"""A determined reactor among others: requests and observations in, observations out, many quiet ticks in one call.

It answers as the general reactor would, and wherever its code stops, it becomes one: a general reactor is given all
that came from outside so far, and goes on from there. The general engine is the judge.
"""

from collections.abc import Callable

from runtime.determined.arguments import given_block
from runtime.determined.asking import Ask, ask, ask_instead, binds
from runtime.determined.expand import expand, record_of
from runtime.determined.inputs import Inputs, ShadowReactor, take_over
from runtime.determined.loading import RegisterProgram
from runtime.determined.publish import Publisher, Samples, Wish, row_key
from runtime.determined.tags import FAR, LINE, NONE, ROW, STOPS
from runtime.executive.configuration import ReactorConfiguration
from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import Conflict, Draw, EventKind, OpenGoal, Reason, ReasonKind
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.reactor import Failure, Refusal, TeleoReactor, Watched
from runtime.executive.record import ReactorRecord
from runtime.executive.trace import Trace
from runtime.plan.readout.names import VariableName

_AHEAD = 48  # ticks that are carried out before anybody asks for them


class DeterminedReactor(TeleoReactor):
    """Carried out by a register machine or, once that has stopped, by a general reactor."""

    def __init__(
        self,
        configuration: ReactorConfiguration,
        program: RegisterProgram,
        drawn: Callable[[str, int], tuple[Draw, int] | None],
        general: Callable[[Trace], PlanReactor],
        final_tick: int,
        trace: Trace,
    ) -> None:
        place = configuration
        super().__init__(place.name, place.internal, place.external, place.latency, place.lookahead)
        self.runs_ahead = True
        self.program = program
        self.make_general = general
        self.final_tick = final_tick
        self.trace = trace
        samples = Samples(sorted(program.layout.samples, key=lambda name: program.layout.samples[name]), drawn)
        self.machine = program.machine(samples)
        self.numbers = program.model.line_numbers
        self.watched = sum(1 << n for n in program.internal)  # timelines whose changes others see
        self.publisher = Publisher(self.name, program, self.machine.log, samples, trace)
        self.inputs = Inputs()
        self.wishes: list[Wish] = []  # requests that have not started
        self.news: dict[int, Observation] = {}
        self.windows: dict[str, tuple[int, int]] = {}
        self.execution_latency = 0
        self.tick = NONE
        self.reached = NONE  # the last tick that the machine has carried out
        self.base = NONE  # the tick of its snapshot
        self.is_beyond = False  # something came in that only the general engine understands
        self.general: PlanReactor | None = None
        self.witness: ShadowReactor | None = None  # of what came in up to `witnessed`
        self.witnessed = NONE
        self.refused_goals: list[OpenGoal] = []
        self.refusals_made: list[Refusal] = []
        for fact in program.first:
            ask(self.machine, Ask(fact.line, fact.block, fact.values, (0, 0), fact.end, (1, FAR)))
        self.machine.keep()

    def set_owners(self, windows: dict[str, tuple[int, int]], execution_latency: int) -> None:
        """Take note of the owners' latencies, for the general reactor."""
        self.windows = windows
        self.execution_latency = execution_latency
        self.machine.present.reach = execution_latency + 1

    # ---- the tick ----

    def start_tick(self, tick: int) -> None:
        """Set "now"."""
        if self.general is not None:
            self.general.start_tick(tick)
        self.tick = tick

    def notify(self, observation: Observation) -> None:
        """Take note of what an owner published this tick; the last word counts."""
        self.due = observation.tick
        if self.general is not None:
            self.general.notify(observation)
            return
        self.inputs.note(self.trace.tick, self.tick < self.trace.tick, observation)
        self.news[self.numbers[observation.timeline]] = observation

    def synchronise(self, tick: int) -> Failure | None:
        """Carry out the tick, unless that has been done ahead."""
        if self.general is not None:
            return self.general.synchronise(tick)
        if self.news:
            self._return_to(tick - 1)
        if self.reached < tick and not self._carry_out(tick):
            return self._hand_over(tick, False).synchronise(tick)
        return None

    def _carry_out(self, tick: int) -> bool:
        """Carry out all ticks up to `tick`, with what was observed; false if the machine stops."""
        machine = self.machine
        if self.reached < tick - 1:
            self.reached = int(machine.run(self.reached, tick - 1, 0))
            if self.reached < tick - 1:
                return False
        asks: list[Ask] = []
        for line, news in self.news.items():
            given = given_block(self.program, self.machine, line, news.predicate, news.arguments)
            if given is None:
                return False
            asks.append(Ask(line, *given, (tick, tick), (tick + 1, FAR), (1, FAR)))
        if asks:
            for wanted in asks:
                ask(self.machine, wanted)
        if (self.news or machine.present.next_event(tick - 1) <= tick) and not machine.tick(tick):
            return False
        self.news.clear()
        self.reached = tick
        return True

    def _return_to(self, tick: int) -> None:
        """Take back what was carried out ahead of `tick`."""
        if self.reached <= tick:
            return
        self._forget_ahead(self.base)
        self.reached = int(self.machine.run(self.base, tick, 0))
        assert self.reached == tick and self.machine.log.told_rows <= self.machine.log.row_count

    def _forget_ahead(self, tick: int) -> None:
        """Go back to the snapshot, which was taken at `tick`."""
        self.machine.go_back()
        self.machine.log.forget_from(tick + 1)

    def record(self) -> ReactorRecord:
        """All tokens that were executed, with their children and runs of rules."""
        if self.general is not None:
            return self.general.bench.recorder.close()
        if self.reached == NONE:  # another reactor has ended the mission before the first tick of this one
            return self.program.frame._replace(reactor=self.name)
        self._return_to(self.tick)
        return record_of(self.program.frame, self.name, expand(self.program, self.machine, self.tick), self.tick)

    def observations(self, tick: int) -> list[Observation]:
        """What its own timelines have begun to hold at `tick`; what has begun before is only put on record."""
        if self.general is not None:
            return self.general.observations(tick)
        found = self.publisher.tell(tick, self.watched)
        if self.wishes:
            self.wishes = [wish for wish in self.wishes if wish.started < 0]
        return found

    def untold(self) -> int:
        """The first tick of what it has carried out ahead and not put on record."""
        return int(self.machine.log.next_tick()) if self.general is None else FAR

    def pass_over(self, tick: int) -> None:
        """Put on record what was carried out ahead, up to a tick that has passed."""
        if self.general is None:
            self.publisher.tell(tick, 0)
            self.tick = tick  # what is on record has happened, also if the mission ends before the next tick of its own

    # ---- the future ----

    def urgency(self, tick: int) -> float:
        """How soon it should be given a step (T-REX 1.3)."""
        if self.general is not None:
            return self.general.urgency(tick)
        return 1.0 / (1 + self.latency + 1)  # one step does all there is to do

    def step(self, tick: int) -> bool:
        """Take in requests and carry out ticks ahead; where the next one is beyond the machine, plan in general."""
        if self.general is None:
            self._take_requests(tick)
        if self.general is None and self.reached == tick:
            self.machine.keep()
            self.base = tick
            watched = 0
            # To the next event costs nothing, however far away it is.
            limit = min(max(tick + _AHEAD, self.machine.present.next_event(tick)), self.final_tick)
            for wish in self.wishes:
                watched |= 1 << wish.line
                limit = min(limit, max(self.final_tick - 1, tick + 1))
                if len(self.wishes) > 1 or wish is not self.publisher.asked.get(wish.line):
                    limit = min(limit, max(wish.request.start[0] - self.machine.present.reach, tick + 1))
            self.reached = int(self.machine.run(tick, limit, watched))
            if self.machine.why == STOPS and self.reached == tick:
                self._hand_over(tick, True)
            elif self.machine.why == STOPS:  # what the last tick has left half done is taken back
                self._forget_ahead(tick)
                self.machine.run(tick, self.reached, 0)
            self.inputs.step += 1
        return self.general is not None and self.general.step(tick)

    def _take_requests(self, tick: int) -> None:
        """Have the machine start the next request of each timeline as soon as it may, later than `tick`."""
        if not self.inputs.is_fresh and not self._is_open(tick):
            return
        self.inputs.is_fresh = False
        chosen: dict[int, Wish] = {}
        for wish in self.wishes:
            best = chosen.get(wish.line)
            self.is_beyond = self.is_beyond or wish.request.start[1] <= tick or self._comes_last(wish, tick)
            if best is None or wish.request.start[0] < best.request.start[0]:
                chosen[wish.line] = wish
        reach = tick + self.machine.present.reach
        # Of two requests for the same time the planner says which comes first, or whether both have room.
        soon = [wish.block for wish in self.wishes if wish.request.start[0] <= reach]
        near = [line for block in soon for line in self.program.begun_by(block)]
        self.is_beyond = self.is_beyond or len(near) > len(set(near))
        if not self.is_beyond:
            self._return_to(tick)
            self._choose(tick, chosen)
        if self.is_beyond:
            self._hand_over(tick, True)

    def _is_open(self, tick: int) -> bool:
        """Whether a request waits for another one that has started, or will soon be looked at, or several are near."""
        if not self.wishes:
            return False
        reach = tick + self.machine.present.reach
        asked = self.publisher.asked
        if sum([wish.request.start[0] <= reach for wish in self.wishes]) > 1:
            return True
        for wish in self.wishes:
            if self._comes_last(wish, tick):
                return True
            if wish is not asked.get(wish.line) and (wish.line not in asked or wish.request.start[0] <= reach):
                return True
        return False

    def _comes_last(self, wish: Wish, tick: int) -> bool:
        """Whether a request might start at the final tick, when the planner begins nothing that was asked for."""
        return tick >= self.final_tick - 1 and wish.request.start[0] <= self.final_tick

    def _choose(self, tick: int, chosen: dict[int, Wish]) -> None:
        machine = self.machine
        present = machine.present
        self.publisher.asked = chosen
        self.publisher.look()
        asks = []
        for line, wish in chosen.items():
            request = wish.request
            start = (max(request.start[0], tick + 1), request.start[1])
            asks.append(Ask(line, wish.block, wish.values, start, request.end, request.duration))
        ask_instead(machine, asks)
        self.is_beyond = self.is_beyond or not all(present.has_room(line, tick) for line in chosen)
        machine.keep()
        self.base = tick
        for line, wish in chosen.items():
            self.is_beyond = self.is_beyond or not machine.can_start(line, max(wish.request.start[0], tick + 1))
            self._forget_ahead(tick)

    def failure(self) -> Failure | None:
        """Why planning has failed for good, if it has."""
        return None if self.general is None else self.general.failure()

    def next_tick(self, tick: int) -> int:
        """The next tick that others can see, or at which the machine stops."""
        if self.general is not None:
            return self.general.next_tick(tick)
        if self.news:
            return tick + 1  # an owner was killed after this tick was synchronised
        return max(tick + 1, min(self.machine.log.next_change(self.watched), self.reached, self.final_tick))

    # ---- requests ----

    def accept(self, request: Request) -> None:
        """Queue a request for one of its timelines; who does not look ahead takes none."""
        if self.general is not None:
            self.general.accept(request)
            return
        if self.lookahead == 0:
            self._refuse(request)
            return
        self.inputs.note(self.trace.tick, False, request)
        line = self.numbers[request.timeline]
        given = given_block(self.program, self.machine, line, request.predicate, request.arguments)
        if given is None:
            self.is_beyond = True
            return
        wish = Wish(request, line, given[0], given[1])
        self.wishes.append(wish)
        self.publisher.wishes.append(wish)
        self.publisher.look()

    def _refuse(self, request: Request) -> None:
        why, line, what = Reason(ReasonKind.NO_LOOKAHEAD), request.timeline, request.predicate
        causes, number = (request.event,), request.number
        event = self.trace.record(
            EventKind.REFUSE, self.name, line, what, request.arguments, causes, request=number, reason=why
        )
        self.refusals_made.append(Refusal(request, event))
        if request.is_mandatory:
            self.refused_goals.append(OpenGoal(line, what, request.arguments, why, event))

    def recall(self, number: int) -> None:
        """Drop a request that has not started; what has started goes on to its own end."""
        if self.general is not None:
            self.general.recall(number)
            return
        self.inputs.note(self.trace.tick, False, number)
        for wish in self.publisher.wishes:
            if wish.request.number == number and wish.ended < 0:
                wish.is_recalled = True
                if wish.started >= 0:
                    self._return_to(self.tick)
                    self.is_beyond = self.is_beyond or binds(self.machine, wish.line, wish.started, wish.request)
                if wish.request.is_mandatory:
                    request, why = wish.request, Reason(ReasonKind.RECALLED)
                    self.refused_goals.append(OpenGoal(request.timeline, request.predicate, request.arguments, why))
        self.publisher.look()
        self.wishes = [wish for wish in self.wishes if wish.request.number != number]

    def refusals(self) -> list[Refusal]:
        """Which of the requests made to it will not be met."""
        found, self.refusals_made = self.refusals_made, []
        return found if self.general is None else found + self.general.refusals()

    def open_goals(self) -> list[OpenGoal]:
        """Mandatory goals that were refused, or that have not run to their end by now."""
        if self.general is not None:
            return self.general.open_goals()
        left = [wish.request for wish in self.publisher.wishes if wish.ended < 0 and not wish.is_recalled]
        return self.refused_goals + [
            OpenGoal(r.timeline, r.predicate, r.arguments, event=r.event) for r in left if r.is_mandatory
        ]

    def requests(self, tick: int) -> list[Request]:
        """It asks nobody for anything."""
        return [] if self.general is None else self.general.requests(tick)

    def open_requests(self) -> list[int]:
        """It has asked nobody for anything."""
        return [] if self.general is None else self.general.open_requests()

    def recalls(self) -> list[int]:
        """It takes nothing back."""
        return [] if self.general is None else self.general.recalls()

    def refused(self, refusal: Refusal) -> None:
        """It has asked nobody for anything."""
        if self.general is not None:
            self.general.refused(refusal)

    # ---- the general reactor ----

    def _hand_over(self, tick: int, is_synchronised: bool) -> PlanReactor:
        """Become a general reactor that knows what came from outside; `is_synchronised`: the present of `tick` too."""
        self.publisher.tell(tick if is_synchronised else tick - 1, 0)
        self.witness = witness = self._new_shadow()
        witness.catch_up(tick, is_synchronised)
        self.general = general = witness.reactor
        take_over(general, self.trace)
        for name in self.internal:
            general.by_name[name].event = self.machine.log.latest[self.numbers[name]]
        return general

    def _new_shadow(self) -> ShadowReactor:
        """A general reactor that will live through the same."""
        shadow = Trace()
        general = self.make_general(shadow)
        general.set_owners(self.windows, self.execution_latency)
        return ShadowReactor(general, shadow, self.inputs)

    def _asked(self) -> PlanReactor:
        """The general reactor that is asked for causes, brought up to the present; one lives through all."""
        if self.witness is None:
            self.witness = self._new_shadow()
        if self.witnessed != self.tick:
            self.witness.catch_up(self.tick, True)
            self.witnessed = self.tick
        return self.witness.reactor

    def why_it_lasts(self, token: int, key: int, least: float) -> tuple[VariableName, Conflict] | None:
        """What sets the end of a token that was published: asked of a general reactor, as this one has no causes."""
        if key >= 0:  # it became a general reactor before it published that
            return None if self.general is None else self.general.why_it_lasts(token, key, least)
        general = self.general or self._asked()
        log = self.machine.log
        if 0 <= token < log.row_count and row_key(int(log.rows[ROW * token])) == key:
            line = general.by_name[self.program.model.lines[int(log.rows[ROW * token + LINE])].name]
            if line.current >= 0 and row_key(int(general.bench.started_at(line.current))) == key:
                return general.why_it_lasts(line.current, general.bench.key(line.current), least)
        return None

    def hangs_on(self, conflict: Conflict | None) -> tuple[Watched, ...]:
        """The elements of what `why_it_lasts` told that other reactors have to answer for."""
        if self.general is not None:
            return self.general.hangs_on(conflict)
        return () if self.witness is None else self.witness.reactor.hangs_on(conflict)
