"""A determined reactor among others: requests and observations in, observations out, many quiet ticks in one call.

It answers as the general reactor would, and wherever its code stops, it becomes one: a general reactor is given all
that came from outside so far, and goes on from there. The general engine is the judge.
"""

from collections.abc import Callable
from dataclasses import dataclass

from compiler.determined.reasons import Undetermined
from compiler.program import DomainConstant, PredicateCode
from runtime.determined.inputs import Inputs, catch_up
from runtime.determined.loading import RegisterProgram, is_open, number_of
from runtime.determined.log import ROW, WISHED
from runtime.determined.machine import CHANGES, STOPS
from runtime.determined.present import (
    FAR,
    NONE,
    WISH,
    WISH_END_FROM,
    WISH_END_UNTIL,
    WISH_FROM,
    WISH_LEAST,
    WISH_MOST,
    WISH_UNTIL,
)
from runtime.executive.agent import Failure
from runtime.executive.configuration import ReactorConfiguration
from runtime.executive.messages import Arguments, Observation, Request, token_text
from runtime.executive.outcome import Conflict, Draw
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.story import latest
from runtime.executive.trace import Trace

AHEAD = 256  # ticks that are carried out before anybody asks for them
INFINITY = 4503599627370495


@dataclass(eq=False, slots=True)
class Wish:
    """A request under way; `started` is the tick at which its token started."""

    request: Request
    line: int
    block: int
    values: dict[int, float]
    started: int = NONE


class DeterminedReactor:
    """Implements `Reactor` by a register machine, or, once that has stopped, by a general reactor."""

    runs_ahead = True

    def __init__(
        self,
        configuration: ReactorConfiguration,
        program: RegisterProgram,
        drawn: Callable[[str, int], tuple[Draw, int] | None],
        general: Callable[[Trace], PlanReactor],
        final_tick: int,
        trace: Trace,
    ) -> None:
        self.name = configuration.name
        self.internal = configuration.internal
        self.external = configuration.external
        self.latency = configuration.latency
        self.lookahead = configuration.lookahead
        self.program = program
        self.drawn = drawn
        self.make_general = general
        self.final_tick = final_tick
        self.trace = trace
        self.parameters = sorted(program.layout.samples, key=lambda name: program.layout.samples[name])
        self.machine = program.machine(self)
        self.numbers = program.model.line_numbers
        self.watched = sum(1 << n for n in program.internal)
        self.inputs = Inputs()
        self.wishes: list[Wish] = []
        self.news: dict[int, Observation] = {}
        self.draws: dict[tuple[int, int], Draw] = {}
        self.events = [NONE] * len(program.layout.lines)
        self.tick = NONE
        self.reached = NONE  # the last tick that the machine has carried out
        self.base = NONE  # the tick of its snapshot
        self.told = 0  # rows of the log that have been published
        self.told_draws = 0
        self.due = 0
        self.is_stirred = True  # something came in that the machine has not seen
        self.is_beyond = False  # something came in that only the general engine understands
        self.general: PlanReactor | None = None
        self.unmet: list[str] = []
        self._begin()

    def _begin(self) -> None:
        """The facts of the script are what holds first."""
        for fact in self.program.first:
            self._ask(fact.line, fact.block, fact.values, (0, 0), fact.end, (1, FAR))

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
        self.inputs.notify(observation)
        self.news[self.numbers[observation.timeline]] = observation
        self.is_stirred = True

    def synchronise(self, tick: int) -> Failure | None:
        """Carry out the tick, unless that has been done ahead."""
        if self.general is not None:
            return self.general.synchronise(tick)
        if self.is_beyond or ((self.is_stirred or self.reached < tick) and not self._carry_out(tick)):
            return self._hand_over(tick, False)
        return None

    def _carry_out(self, tick: int) -> bool:
        """Carry out all ticks up to `tick`, with what came in; false if the machine stops."""
        machine = self.machine
        if self.reached >= tick:
            self._go_back()
        if self.reached < tick - 1:
            self.reached = machine.run(self.reached, tick - 1, 0)
            if self.reached < tick - 1:
                return False
        if not self._take_inputs(tick):
            return False
        if machine.present.next_event(tick - 1) <= tick and not machine.tick(tick):
            return False
        self.reached = tick
        return True

    def _go_back(self) -> None:
        """Return to the snapshot; draws are made anew."""
        machine = self.machine
        machine.go_back()
        machine.log.forget_from(self.base + 1)
        for k in range(len(machine.sample_until)):
            machine.sample_until[k] = NONE
        self.reached = self.base

    def _take_inputs(self, tick: int) -> bool:
        """Put observations and the next request of each timeline into the machine; false where they do not fit."""
        state, n = self.machine.present.state, self.machine.lines
        for line, news in self.news.items():
            given = self._given(line, news.predicate, news.arguments)
            if given is None:
                return False
            self._ask(line, given[0], given[1], (tick, tick), (tick + 1, FAR), (1, FAR))
        self.news.clear()
        chosen: dict[int, Wish] = {}
        for wish in self.wishes:
            best = chosen.get(wish.line)
            if wish.started < 0 and (best is None or wish.request.start[0] < best.request.start[0]):
                chosen[wish.line] = wish
        self.is_stirred = False
        for line, wish in chosen.items():
            request = wish.request
            if request.start[1] < tick:
                return False
            if tick == 0 and state[WISH * n + line] >= 0:  # what the script says comes first
                self.is_stirred = True
                continue
            start = (max(request.start[0], tick), request.start[1])
            self._ask(line, wish.block, wish.values, start, request.end, request.duration)
        return True

    def _ask(
        self,
        line: int,
        block: int,
        values: "dict[int, float] | object",
        start: tuple[int, int],
        end: tuple[int, int],
        duration: tuple[int, int],
    ) -> None:
        """Have the machine start a token on a timeline as soon as it may."""
        machine = self.machine
        state, n = machine.present.state, machine.lines
        state[WISH * n + line] = block
        for section, (lower, upper) in (
            (WISH_FROM, start),
            (WISH_END_FROM, end),
            (WISH_LEAST, duration),
        ):
            state[section * n + line] = max(lower, 0)
            state[(section + 1) * n + line] = min(upper, FAR)
        assert (WISH_UNTIL, WISH_END_UNTIL, WISH_MOST) == (WISH_FROM + 1, WISH_END_FROM + 1, WISH_LEAST + 1)
        assert isinstance(values, dict)
        first = machine.wished[line]
        for k, value in values.items():
            machine.registers[first + k] = value

    def _given(self, line: int, short: str, arguments: Arguments) -> tuple[int, dict[int, float]] | None:
        """The block and the values of a token that comes from outside; None where only the general engine can tell."""
        predicate = self.program.model.predicate(line, short)
        if predicate is None or predicate.is_action or predicate.is_event:
            return None
        values = _values(self.program, predicate, arguments)
        if values is None:
            return None
        try:
            block = self.program.block(line, predicate, sum(1 << k for k in values))
        except Undetermined:
            return None
        self.program.bring_up_to_date(self.machine)
        return block, values

    def draw(self, machine: object, parameter: int, tick: int) -> bool:
        """Give the machine the value of a parameter that is in force at `tick`; false if the mission has none."""
        found = self.drawn(self.parameters[parameter], tick)
        if found is None:
            return False
        draw, until = found
        self.machine.sample_value[parameter] = draw.value
        self.machine.sample_until[parameter] = until
        self.draws[parameter, tick] = draw
        return True

    # ---- publishing ----

    def observations(self, tick: int) -> list[Observation]:
        """What its own timelines have begun to hold at `tick`; what has begun before is only put on record."""
        if self.general is not None:
            return self.general.observations(tick)
        return self._publish(tick)

    def pass_over(self, tick: int) -> None:
        """Put on record what happened before `tick`: others are about to."""
        if self.general is None:
            now, phase = self.trace.tick, self.trace.phase
            self._publish(tick - 1)
            self.trace.tick, self.trace.phase = now, phase

    def _publish(self, tick: int) -> list[Observation]:
        log, trace = self.machine.log, self.trace
        now = trace.tick
        published: list[Observation] = []
        while self.told < log.row_count and log.rows[ROW * self.told] <= tick:
            at = log.rows[ROW * self.told]
            last = self.told
            while last < log.row_count and log.rows[ROW * last] == at:
                last += 1
            trace.tick = at
            trace.phase = "synchronise"
            self._tell_draws(at)
            trace.phase = "observe"
            found = self._tell(range(self.told, last), at)
            if at == now:
                published += found
            self.told = last
        trace.tick = now
        return published

    def _tell_draws(self, tick: int) -> None:
        log = self.machine.log
        while self.told_draws < log.draw_count and log.draws[2 * self.told_draws] <= tick:
            at = log.draws[2 * self.told_draws : 2 * self.told_draws + 2]
            self.trace.record_draw(self.name, self.draws[int(at[1]), int(at[0])])
            self.told_draws += 1

    def _tell(self, rows: range, tick: int) -> list[Observation]:
        """Publish the tokens of one tick, in the order of the configuration."""
        log = self.machine.log
        by_line = {int(log.rows[ROW * row + 1]): row for row in rows}
        published = []
        for line in (*self.program.internal, *(n for n in by_line if n not in self.program.internal)):
            if line not in by_line:
                continue
            row = by_line[line]
            if line not in self.program.internal:
                continue
            predicate = self.program.model.program.predicates[log.rows[ROW * row + 2]]
            arguments = arguments_of(self.program, predicate, log.values[log.rows[ROW * row + 4] :])
            short = predicate.name.rpartition(".")[2]
            wish = self._wish_at(line, row, tick)
            last = self.events[line]
            causes = (wish.request.event,) if wish is not None else (last,) if last >= 0 else ()
            name = self.program.model.lines[line].name
            event = self.trace.record("observation", self.name, name, token_text(short, arguments), causes)
            self.events[line] = event
            published.append(Observation(tick, name, short, arguments, event, self.name, row, line))
        return published

    def _wish_at(self, line: int, row: int, tick: int) -> Wish | None:
        """The request that a token answers."""
        block = self.machine.log.rows[ROW * row + 3]
        for wish in self.wishes:
            if wish.line == line and wish.started < 0 and block == wish.block | WISHED:
                wish.started = tick
                self.is_stirred = self.is_stirred or any(w.line == line and w.started < 0 for w in self.wishes)
                return wish
        return None

    # ---- ahead of time ----

    def step(self, tick: int) -> bool:
        """Carry out ticks ahead; where the next one is beyond the machine, plan as the general reactor."""
        if self.general is None and self.reached == tick and not self.is_stirred:
            self.machine.keep()
            self.base = tick
            watched = self.watched
            for wish in self.wishes:
                if wish.started < 0:
                    watched |= 1 << wish.line
            self.reached = self.machine.run(tick, min(tick + AHEAD, self.final_tick), watched)
            if self.machine.why == STOPS and self.reached == tick:
                self._hand_over(tick, True)
        return self.general is not None and self.general.step(tick)

    def failure(self) -> Failure | None:
        """Why planning has failed for good, if it has."""
        return None if self.general is None else self.general.failure()

    def next_tick(self, tick: int) -> int:
        """The next tick that others can see, or at which the machine stops."""
        if self.general is not None:
            return self.general.next_tick(tick)
        if self.is_stirred:
            return tick + 1
        if self.machine.why == STOPS or self.machine.why == CHANGES or self.reached < self.final_tick:
            return max(tick + 1, self.reached)
        return self.final_tick

    # ---- requests ----

    def accept(self, request: Request) -> None:
        """Queue a request for one of its timelines; who does not look ahead takes none."""
        if self.general is not None:
            self.general.accept(request)
            self.due = min(self.due, self.general.due)
            return
        if self.lookahead == 0:
            text = token_text(request.predicate, request.arguments)
            self._refuse(request, f"{text}: `{self.name}` does not look ahead and takes no goals")
            return
        now = self.trace.tick
        is_early = self.tick < now  # goals of the mission come before the reactor's own turn
        self.inputs.accept(now, is_early, request)
        self.due = now if is_early else now + 1
        line = self.numbers[request.timeline]
        given = self._given(line, request.predicate, request.arguments)
        if given is None:
            self.is_beyond = True
            return
        self.wishes.append(Wish(request, line, given[0], given[1]))
        self.is_stirred = True

    def _refuse(self, request: Request, what: str) -> None:
        self.trace.record("reject", self.name, request.timeline, what, (request.event,))
        if request.is_mandatory:
            self.unmet.append(what)

    def recall(self, number: int) -> None:
        """Drop a request that has not started; what has started goes on to its own end."""
        if self.general is not None:
            self.general.recall(number)
            return
        for wish in self.wishes:
            if wish.request.number == number and wish.started < 0:
                self.inputs.recall(self.tick, number)
                self.wishes.remove(wish)
                if self.reached > self.base:
                    self._go_back()
                n = self.machine.lines
                self.machine.present.state[WISH * n + wish.line] = NONE
                self.machine.keep()
                self.is_stirred = True
                self.due = self.tick + 1
                return

    def unmet_goals(self) -> list[str]:
        """Mandatory goals that were refused, or that have not run to their end by now."""
        if self.general is not None:
            return self.unmet + self.general.unmet_goals()
        return self.unmet + [
            token_text(wish.request.predicate, wish.request.arguments)
            for wish in self.wishes
            if wish.request.is_mandatory and not self._is_over(wish)
        ]

    def _is_over(self, wish: Wish) -> bool:
        rows = self.machine.log.rows
        return wish.started >= 0 and any(
            rows[ROW * row + 1] == wish.line and wish.started < rows[ROW * row] <= self.tick for row in range(self.told)
        )

    def requests(self, tick: int) -> list[Request]:
        """It asks nobody for anything."""
        return [] if self.general is None else self.general.requests(tick)

    def open_requests(self) -> list[int]:
        """It has asked nobody for anything."""
        return [] if self.general is None else self.general.open_requests()

    def recalls(self) -> list[int]:
        """It takes nothing back."""
        return [] if self.general is None else self.general.recalls()

    # ---- the general reactor ----

    def _hand_over(self, tick: int, is_settled: bool) -> Failure | None:
        """Become a general reactor that knows what came from outside; `is_settled`: the present of `tick` too."""
        shadow = Trace()
        general = self.make_general(shadow)
        failure = catch_up(general, shadow, self.inputs, tick, is_settled)
        general.trace = general.dispatch.trace = self.trace
        for name in self.internal:
            general.by_name[name].event = self.events[self.numbers[name]]
        self.general = general
        if is_settled:
            self.due = tick + 1
            return failure
        return failure or general.synchronise(tick)

    def why_it_lasts(self, token: int, key: int) -> tuple[str, Conflict] | None:
        """What sets the end of a token that was published: asked of a general reactor, as this one has no causes."""
        if self.general is not None:
            general = self.general
        else:
            shadow = Trace()
            general = self.make_general(shadow)
            if catch_up(general, shadow, self.inputs, self.tick, True) is not None:
                return None
        line = self.program.model.lines[key].name if 0 <= key < len(self.events) else ""
        state = general.by_name.get(line)
        if state is None or general.bench.started_at(state.current) != self.machine.log.rows[ROW * token]:
            return general.why_it_lasts(token, key)
        return latest(general.bench, general.bench.end(state.current))


def _values(program: RegisterProgram, predicate: PredicateCode, arguments: Arguments) -> dict[int, float] | None:
    """The parameters that are given a value, as numbers; None where one is given a choice, or is not known."""
    numbers = {parameter.name: k for k, parameter in enumerate(predicate.parameters)}
    values: dict[int, float] = {}
    for name, domain in arguments:
        if name not in numbers:
            return None
        parameter = predicate.parameters[numbers[name]]
        if is_open(domain):
            continue
        value = number_of(program.layout, domain)
        is_number = parameter.type.kind in ("int", "float", "bool")
        if value is None or (domain.interval is None and parameter.type.kind != "bool") == is_number:
            return None
        if parameter.type.kind == "int" and value != int(value):
            return None
        values[numbers[name]] = value
    return values


def arguments_of(program: RegisterProgram, predicate: PredicateCode, values: object) -> Arguments:
    """Parameters as others read them, from the log."""
    names = program.names
    told = []
    for k, parameter in enumerate(predicate.parameters):
        kind, type_name = parameter.type.kind, parameter.type.type_name
        value = values[k]  # type: ignore[index]
        if value != value:
            domain = DomainConstant(kind, type_name, (-INFINITY, INFINITY), None)
        elif kind == "float":
            domain = DomainConstant(kind, type_name, (value, value), None)
        elif kind == "int":
            domain = DomainConstant(kind, type_name, (int(value), int(value)), None)
        elif kind == "bool":
            domain = DomainConstant(kind, type_name, None, (bool(value),))
        else:
            if int(value) >= len(names):
                names[:] = sorted(program.layout.symbols, key=lambda name: program.layout.symbols[name])
            domain = DomainConstant(kind, type_name, None, (names[int(value)],))
        told.append((parameter.name, domain))
    return tuple(told)
