"""A reactor that plans with a plan database: it synchronises, deliberates, asks owners for what it needs, repairs."""

from runtime.executive.clock import next_reading, next_within
from runtime.executive.configuration import ReactorConfiguration
from runtime.executive.deferral import Deferral
from runtime.executive.dispatch import Dispatch
from runtime.executive.draws import Draws
from runtime.executive.goals import Goals
from runtime.executive.holding import is_blocked
from runtime.executive.lasting import last_until
from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import Conflict, EventKind, OpenGoal, Phase, Reason, ReasonKind, RepairStage
from runtime.executive.past import Past
from runtime.executive.planning import EPISODE_DONE, EPISODE_EXHAUSTED, EPISODE_MOVED, EPISODE_TOO_DEEP, Planner
from runtime.executive.reactor import Failure, Refusal, SyncFailure, TeleoReactor, Watched, conflicts_beside
from runtime.executive.record import ReactorRecord
from runtime.executive.redrawing import draw_anew, leave_open
from runtime.executive.repair import relax
from runtime.executive.story import conflict_of
from runtime.executive.synchronise import synchronise
from runtime.executive.timelines import NOTHING, TimelineState
from runtime.executive.told_on import watched_in, why_lasting, why_sent
from runtime.executive.trace import Trace
from runtime.executive.workbench import Workbench
from runtime.plan.readout.names import VariableName


class _HistoryError(RuntimeError):
    """Forgetting what is over changed the plan: a mistake of the engine, no verdict about the model."""


class PlanReactor(TeleoReactor):
    """Keeps the plan of its own timelines, and what it expects of others', in step with the world."""

    def __init__(
        self,
        configuration: ReactorConfiguration,
        bench: Workbench,
        planner: Planner,
        final_tick: int,
        trace: Trace,
        draws: Draws,
    ) -> None:
        place = configuration
        super().__init__(place.name, place.internal, place.external, place.latency, place.lookahead)
        self.reach = self.latency + max(self.lookahead, 1)  # how far ahead it plans
        self.bench = bench
        self.planner = planner
        self.final_tick = final_tick
        self.trace = trace
        self.draws = draws
        self.max_steps = configuration.max_steps
        self.timelines = [bench.timeline(name, True) for name in self.internal]
        self.timelines += [bench.timeline(name, False) for name in self.external]
        for line in self.timelines:
            line.accepts_requests = bench.accepts_requests(line.object_id) and line.name not in configuration.observe
            line.is_early = line.name in configuration.early
            line.is_late = line.name in configuration.late
        bench.late_objects = {line.object_id for line in self.timelines if line.is_internal and not line.is_early}
        self.by_name = {line.name: line for line in self.timelines}
        self.goals = Goals(self.name, bench, self.timelines, trace)
        self.lacking = self.goals.lacking
        planner.missed = self.goals.missed
        self.goals.rejections = planner.rejections
        self.tick = self.relaxes = self.steps_made = self.work_since = 0
        self.relaxed_at = NOTHING
        self.broken: Failure | None = None
        self.past = Past(bench)
        self.deferral = Deferral(bench, self.timelines, self.past)
        self.dispatch = Dispatch(self.name, bench, self.timelines, trace)
        self.is_stirred = False  # something came from outside after the present was synchronised
        self.is_halted = False  # the clock grants no more steps in this tick

    def set_owners(self, windows: dict[str, tuple[int, int]], execution_latency: int) -> None:
        """Take note of when owners want to be asked; its own window counts what they need (T-REX 1.1)."""
        self.dispatch.owner_windows = windows
        self.reach = execution_latency + max(self.lookahead, 1)
        is_reactive = self.lookahead <= 1
        self.planner.window.is_reactive = self.draws.is_reactive = self.bench.is_reactive = is_reactive
        others = [line for line in self.timelines if not line.is_internal]
        asked = [line for line in others if line.accepts_requests]
        self.planner.window.observed = {o.object_id for o in others if not self.dispatch.takes_requests(o)}
        self.draws.asks_nobody, self.planner.window.undrawn = self.lookahead <= 1 and not asked, self.draws.undrawn

    # ---- the tick ----

    def start_tick(self, tick: int) -> None:
        """Set "now", and forget what is over."""
        self.tick = max(self.tick, self.deferral.fold(tick))
        self.past.archive(self.timelines, self.tick)
        self.bench.tidy()
        if not self.bench.is_consistent():
            raise _HistoryError(f"what is over at tick {tick} contradicts the plan of `{self.name}`")
        self.tick = tick
        if not self.is_out_of_steps():
            self._rest(tick)
        self.decisions_made = 0
        self.is_stirred = self.is_halted = self.draws.is_put_off = False

    def notify(self, observation: Observation) -> None:
        """Take note of what an owner published this tick; the last word counts. What cannot matter waits.

        That an owner died while it planned is news of the next tick, for who sleeps as for who is awake.
        """
        is_past = self.tick < observation.tick and self.trace.phase is not Phase.DELIBERATE
        if not (is_past and self.deferral.takes(observation)):
            self.by_name[observation.timeline].news = observation
            self.is_stirred = True
            self.due = observation.tick

    def next_tick(self, tick: int) -> int:
        """The next tick at which something can happen here without news from outside.

        In the temporal network "later than now" fails for a time exactly when its latest value is reached, so between
        such ticks, earliest starts and the moments at which tokens come into the planning window nothing changes.
        """
        bench = self.bench
        if self.is_stirred or self.is_out_of_steps():
            return tick + 1
        soonest = min(self.draws.next_change(bench, tick), next_reading(bench, tick), self.final_tick)
        soonest = min(soonest, self.goals.next_expiry())
        for request in self.goals.waiting:
            soonest = min(soonest, request.start[0] - self.reach)
        for line in self.timelines:
            if line.current != NOTHING:
                soonest = min(soonest, bench.upper(bench.end(line.current)))
            first = bench.next_of(line.object_id, line.current)
            token = first
            while token != NOTHING:
                soonest = min(soonest, bench.upper(bench.start(token)))
                token = bench.following(token)
            if line.is_internal:
                token = first
                # What nobody asked for begins when what holds cannot go on, unless the timeline is early.
                is_due = line.is_early or (token != NOTHING and bench.is_requested(token))
                if is_due and token != NOTHING and not is_blocked(bench, token, line.current, tick):
                    soonest = min(soonest, bench.lower(bench.start(token)))
            else:
                soonest = min(soonest, self.dispatch.next_due(line, tick))
        soonest = min(soonest, bench.last_start(), self.planner.window.next_freed(tick, self.reach))
        # Where steps are counted it counts when each variable of a token is decided, whether there is a choice or not.
        is_metered = self.is_metered or self.max_steps is not None
        soonest = min(soonest, next_within(bench, tick, self.reach, is_metered))
        return int(max(tick + 1, soonest))

    def synchronise(self, tick: int) -> Failure | None:
        """Synchronise the present; if that fails, repair: first keep the past, then forget it (T-REX 1.4, 1.9)."""
        causes: tuple[int, ...] = ()
        watched: tuple[Watched, ...] = ()
        events: list[int] = []
        failures: list[SyncFailure] = []
        self.dispatch.note_begun()
        for attempt in range(3):
            if attempt:
                self.trace.phase = Phase.REPAIR
                failed, broke = failures[attempt - 1], failures[0]
                event = self.trace.record(
                    EventKind.RELAX,
                    self.name,
                    causes=causes,
                    stage=RepairStage.KEEP_PAST if attempt == 1 else RepairStage.FORGET_PAST,
                    reason=failed.reason,
                    conflict=failed.conflict,
                )
                self.goals.note_repair(tick, event, broke.reason, broke.conflict, broke.deadlock, watched)
                self.relaxes += 1
                self.planner.kept_depth = 0
                self.dispatch.is_repaired = True
                if attempt == 1:
                    self.bench.recorder.agreed = None
                if not relax(self.bench, self.timelines, self.goals.live(), self.past, tick, forget=attempt == 2):
                    stuck = Reason(ReasonKind.CANNOT_RELAX)
                    failures.append(SyncFailure(broke.code, (), stuck, conflict_of(self.bench)))
                    continue
                self.goals.give_up_failed_starts(tick)
            failure = self._prepare(tick) or self._synchronise(tick)
            if failure is not None and attempt and self.goals.loosen():
                failure = self._prepare(tick) or self._synchronise(tick)
            if failure is None:
                self.goals.bind(tick)
                self.goals.report_rejected(tick)
                if self.goals.close(tick, self.dispatch):
                    self.goals.reopen()
                self.bench.recorder.synchronised = tick
                return None
            failures.append(failure)
            if attempt == 0:
                causes = tuple([line.news.event for line in self.timelines if line.news is not None])
                events = [line.event for line in self.timelines if line.event != NOTHING and not line.is_internal]
                watched = self.hangs_on(failure.conflict)
                self.goals.note_failed_starts(self.dispatch.answered())
        self.bench.recorder.is_lost = True
        first = failures[0]
        repairs = conflicts_beside(first.conflict, failures[1:])
        lines = first.timelines or tuple([line.name for line in self.timelines if line.is_internal])
        refusals = self.dispatch.refusals() if first.code == "F6" else ()
        causes = refusals or causes or tuple(events[:1])
        return Failure(
            first.code, first.reason, lines, first.conflict, self.relaxes, repairs, causes, watched, first.deadlock
        )

    def _prepare(self, tick: int) -> SyncFailure | None:
        """Draw anew, by what holds till now, what was drawn for a tick at which its token does not begin."""
        failure = last_until(self.bench, self.timelines, tick) if self.draws.open else None
        if failure is None and not draw_anew(self.bench, self.draws, self.goals, tick):
            return SyncFailure("F3", (), Reason(ReasonKind.UNMET), conflict_of(self.bench))
        return failure

    def _synchronise(self, tick: int) -> SyncFailure | None:
        """Synchronise the present, or leave the plan as it was."""
        mark = self.bench.mark()
        failure = synchronise(self.bench, self.planner, self.timelines, tick, self.final_tick, self.dispatch)
        if failure is None:
            self.planner.keep()
            return None
        self.bench.rewind_to(mark)
        self.bench.commit()
        return failure

    def hangs_on(self, conflict: Conflict | None) -> tuple[Watched, ...]:
        """The elements of a conflict that other reactors have to answer for."""
        return () if conflict is None else watched_in(conflict, self.bench, self.timelines, self.goals.posted)

    def why_it_lasts(self, token: int, key: int, least: float) -> tuple[VariableName, Conflict] | None:
        """The end of one of its tokens, and what sets it, or makes it `least` or later."""
        return why_lasting(self.bench, self.timelines, self.hangs_on, token, key, least)

    def why_asked(self, number: int, name: str, side: int) -> tuple[VariableName, float, Conflict] | None:
        """A time of a token that it has asked for by a request: its name, its bound now, and what sets that."""
        return why_sent(self.bench, self.dispatch, number, name, side)

    def observations(self, tick: int) -> list[Observation]:
        """What its own timelines have begun to hold at `tick`; also clears the news that was folded in."""
        published = []
        for line in self.timelines:
            if line.news is not None:
                line.event = line.news.event
                line.source = line.news
                line.news = None
            if line.is_internal and line.current != NOTHING and self.bench.started_at(line.current) == tick:
                self.bench.make_values(line.current)
                arguments = self.bench.arguments(line.current)
                predicate = self.bench.short_name(line.current)
                causes = self._causes_of(line)
                token = self.bench.name_of(line.current)
                line.event = self.trace.record(
                    EventKind.OBSERVATION, self.name, line.name, predicate, arguments, causes, token=token
                )
                published.append(
                    Observation(tick, line.name, predicate, arguments, line.event, self.name, line.current, token.key)
                )
        return published

    def record(self) -> ReactorRecord:
        """What its plan held over the mission."""
        self.bench.recorder.synchronised = max(self.bench.recorder.synchronised, self.deferral.close(self.missed))
        found = self.bench.recorder.close()
        passed = self.deferral.passed
        return found._replace(tokens=tuple(sorted([*found.tokens, *passed]))) if passed else found

    # ---- planning ----

    def urgency(self, tick: int) -> float:
        """How soon it should be given a step (T-REX 1.3)."""
        deadline = self.work_since + 1 + self.latency
        return 1.0 / ((max(deadline - tick, 0) + 1) * (self.steps_made + 1))

    def _rest(self, tick: int) -> None:
        """Note that it has no work: what comes next is new, with a deadline of its own (T-REX 1.3)."""
        self.work_since = tick
        self.steps_made = 0

    def is_out_of_steps(self) -> bool:
        """Whether it has made as many decisions in this tick as it may, or as the clock lets it."""
        return self.is_halted or (self.max_steps is not None and self.decisions_made >= self.max_steps)

    def has_work(self, tick: int) -> bool:
        """Whether there is something to decide, once what was asked is taken in."""
        if self.broken is not None or self.is_out_of_steps():
            return False
        if self.planner.is_fresh:
            self.goals.take_in(tick, tick + self.reach)
        return bool(self.planner.has_flaw(tick, min(tick + self.reach, self.final_tick)))

    def halt(self) -> None:
        """Leave what is undecided to the next tick."""
        self.is_halted = True

    def step(self, tick: int) -> bool:
        """Take in requests, or make one decision inside the planning window; when nothing is left, keep the plan.

        Who looks one tick ahead makes all its decisions in one step: what is asked meanwhile comes after them.
        """
        while self._advance(tick):
            if self.lookahead > 1:
                return True
        return False

    def _advance(self, tick: int) -> bool:
        """Make one decision; whether there is more to do."""
        if self.broken is not None:
            return False
        if self.is_out_of_steps():
            self.planner.pause()
        if self.planner.is_fresh:
            self.goals.take_in(tick, tick + self.reach)
        if self.is_out_of_steps():
            return False
        self.steps_made += 1
        outcome = self.planner.deliberate(tick, min(tick + self.reach, self.final_tick))
        if outcome != EPISODE_DONE:
            self.decisions_made += 1  # to find no plan, or none deep enough, took a step, too
        if outcome == EPISODE_MOVED:
            return True
        if (outcome == EPISODE_EXHAUSTED or self.goals.missed()) and leave_open(
            self.bench, self.draws, self.goals, tick
        ):
            return True
        if outcome == EPISODE_DONE:
            self._rest(tick)
            self.goals.report_rejected(tick)
            return self.goals.has_news(tick + self.reach)  # what was asked meanwhile is planned at the same tick
        if outcome == EPISODE_TOO_DEEP:
            what = Reason(ReasonKind.DEPTH, limit=self.planner.max_depth)
            self.broken = Failure("F5", what, self.internal, None, self.relaxes)
            return False
        return self._replan(tick)

    def _replan(self, tick: int) -> bool:
        """No plan inside the window: relax once and plan again; failing that, give up (T-REX 1.11, F4)."""
        what, conflict = self.planner.reason()
        if self.relaxed_at != tick:
            self.relaxed_at = tick
            self.relaxes += 1
            self.dispatch.is_repaired = True
            stage = RepairStage.REPLAN
            event = self.trace.record(EventKind.RELAX, self.name, stage=stage, reason=what, conflict=conflict)
            self.goals.note_repair(tick, event, what, conflict)
            if relax(self.bench, self.timelines, self.goals.live(), self.past, tick + 1, forget=False):
                return True
        deadlock = self.planner.deadlock()
        self.broken = Failure("F4", what, self.internal, conflict, self.relaxes, deadlock=deadlock)
        return False

    def failure(self) -> Failure | None:
        """Why planning has failed for good, if it has."""
        return self.broken

    # ---- goals ----

    def accept(self, request: Request) -> None:
        """Queue a request for one of its timelines; who does not look ahead takes none (T-REX 1.8)."""
        if self.lookahead == 0:
            self.goals.refuse(request, Reason(ReasonKind.NO_LOOKAHEAD))
            return
        self.goals.waiting.append(request)

    def recall(self, number: int) -> None:
        """Queue that a request is taken back."""
        self.goals.to_recall.append(number)

    def refusals(self) -> list[Refusal]:
        """Which of the requests made to it will not be met."""
        found, self.goals.refusals = self.goals.refusals, []
        return found

    def open_goals(self) -> list[OpenGoal]:
        """Mandatory goals that were refused, or that have not run to their end by now."""
        return self.goals.open_goals()

    # ---- dispatch ----

    def requests(self, tick: int) -> list[Request]:
        """What is to be asked of owners now."""
        return [] if self.is_out_of_steps() else self.dispatch.requests(tick, self.final_tick)

    def open_requests(self) -> list[int]:
        """Numbers of the requests that it has made and that are not over."""
        return self.dispatch.open_requests()

    def recalls(self) -> list[int]:
        """Numbers of the requests whose token left the plan in the plan."""
        return self.dispatch.recalls(self.tick)

    def refused(self, refusal: Refusal) -> None:
        """Take note that an owner will not do what it was asked for: its token will be missed (F6).

        What is done at another time than was asked for is judged by the plan, once it is observed.
        """
        if not refusal.is_done:
            self.dispatch.refused[refusal.request.number] = refusal.event
            self.is_stirred = True

    def _causes_of(self, line: TimelineState) -> tuple[int, ...]:
        """The requests that the current token answers; else what was published before."""
        answered = self.goals.answered(line.current)
        if answered:
            return tuple([goal.request.event for goal in answered])
        return (line.event,) if line.event != NOTHING else ()
