"""A reactor that plans with a plan database: it synchronises, deliberates, asks owners for what it needs, repairs."""

from runtime.executive.agent import Failure, Watched
from runtime.executive.configuration import ReactorConfiguration
from runtime.executive.dispatch import Dispatch
from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import (
    Conflict,
    ElementKind,
    EventKind,
    OpenGoal,
    Phase,
    Reason,
    ReasonKind,
    RepairStage,
    VariableName,
)
from runtime.executive.planning import Planner
from runtime.executive.repair import hold_present, relax, stand
from runtime.executive.story import conflict_of, latest
from runtime.executive.synchronise import Unsettled, settle
from runtime.executive.timelines import NOTHING, Goal, TimelineState
from runtime.executive.trace import Trace
from runtime.executive.view import SPAN_REQUEST
from runtime.executive.workbench import Workbench


class PlanReactor:
    """Keeps the plan of its own timelines, and what it expects of others', in step with the world."""

    def __init__(
        self, configuration: ReactorConfiguration, bench: Workbench, planner: Planner, final_tick: int, trace: Trace
    ) -> None:
        self.name = configuration.name
        self.internal = configuration.internal
        self.external = configuration.external
        self.latency = configuration.latency
        self.lookahead = configuration.lookahead
        self.bench = bench
        self.planner = planner
        self.final_tick = final_tick
        self.trace = trace
        self.max_steps = configuration.max_steps
        self.timelines = [bench.timeline(name, True) for name in self.internal]
        self.timelines += [bench.timeline(name, False) for name in self.external]
        self.by_name = {line.name: line for line in self.timelines}
        self.waiting: list[Request] = []
        self.goals: list[Goal] = []
        self.tick = 0
        self.due = 0
        self.relaxes = 0
        self.relaxed_at = NOTHING
        self.steps_left = self.max_steps
        self.broken: Failure | None = None
        self.dispatch = Dispatch(self.name, bench, self.timelines, trace)
        self.given_up: list[OpenGoal] = []
        self.is_stirred = False  # something came from outside after the present was settled

    @property
    def is_early(self) -> bool:
        """Whether planned tokens start as soon as they may: a simulator keeps what holds, a planner gets on."""
        return self.lookahead > 1

    # ---- the tick ----

    def start_tick(self, tick: int) -> None:
        """Set "now", and turn the requests whose time has come into goals."""
        self.bench.archive(self.timelines, self.tick)
        self.bench.tidy()
        self.tick = tick
        self.steps_left = self.max_steps
        self.is_stirred = False
        reach = tick + self.latency + max(self.lookahead, 1)
        later = []
        for request in self.waiting:
            if request.start[0] <= reach:
                self._post(request, tick)
            else:
                later.append(request)
        self.waiting = later

    def notify(self, observation: Observation) -> None:
        """Take note of what an owner published this tick; the last word counts."""
        self.by_name[observation.timeline].news = observation
        self.is_stirred = True
        self.due = observation.tick

    def next_tick(self, tick: int) -> int:
        """The next tick at which something can happen here without news from outside.

        In the temporal network "later than now" fails for a time exactly when its latest value is reached, so between
        such ticks, earliest starts and the moments at which tokens come into the planning window nothing changes.
        """
        bench = self.bench
        if self.is_stirred or self.steps_left <= 0 or bench.reads_clock():
            return tick + 1
        reach = self.latency + max(self.lookahead, 1)
        times = [float(request.start[0] - reach) for request in self.waiting]
        for line in self.timelines:
            if line.current != NOTHING:
                times.append(bench.upper(bench.end(line.current)))
            for token in bench.planned_after(line.object_id, line.current):
                start = bench.start(token)
                times.append(bench.upper(start))
                if line.is_internal:
                    if not bench.is_blocked(token, line.current, tick):
                        times.append(bench.lower(start))
                elif not self.dispatch.is_asked(token) and not bench.is_blocked(token, line.current, tick):
                    times.append(bench.lower(start) - 1 - self.dispatch.notice(line))
        for token in bench.undecided():
            times.append(bench.upper(bench.start(token)))
            if bench.lower(bench.start(token)) > tick + reach:
                times.append(bench.lower(bench.start(token)) - reach)
        return int(max(tick + 1, min([self.final_tick, *times])))

    def synchronise(self, tick: int) -> Failure | None:
        """Settle the present; if that fails, repair: first keep the past, then forget it (T-REX 1.4, 1.9)."""
        causes = tuple(line.news.event for line in self.timelines if line.news is not None)
        events = tuple(line.event for line in self.timelines if line.event != NOTHING and not line.is_internal)
        failures: list[Unsettled] = []
        watched: tuple[Watched, ...] = ()
        for attempt in range(3):
            if attempt:
                self.trace.phase = Phase.REPAIR
                self.trace.record(
                    EventKind.RELAX,
                    self.name,
                    causes=causes,
                    stage=RepairStage.KEEP_PAST if attempt == 1 else RepairStage.FORGET_PAST,
                    reason=failures[-1].reason,
                    conflict=failures[-1].conflict,
                )
                self.relaxes += 1
                if not relax(self.bench, self.timelines, self._live_goals(), tick, forget=attempt == 2):
                    what = Reason(ReasonKind.CANNOT_RELAX)
                    failures.append(Unsettled(failures[0].code, (), what, conflict_of(self.bench)))
                    break
            mark = self.bench.mark()
            failure = settle(self.bench, self.planner, self.timelines, tick, self.is_early)
            if failure is None:
                self.planner.keep()
                self._close_goals(tick)
                return None
            failures.append(failure)
            if attempt == 0:
                watched = self._watched(failure.conflict)
            self.bench.rewind_to(mark)
            self.bench.commit()
        first = failures[0]
        repairs = _distinct(first.conflict, failures[1:])
        lines = first.timelines or tuple(line.name for line in self.timelines if line.is_internal)
        causes = causes or events[:1]
        return Failure(first.code, first.reason, lines, first.conflict, self.relaxes, repairs, causes, watched)

    def _watched(self, conflict: Conflict | None) -> tuple[Watched, ...]:
        """The elements of a conflict that say how long what another reactor published has lasted."""
        if conflict is None:
            return ()
        ends = {
            self.bench.name_of(line.current): line.source
            for line in self.timelines
            if not line.is_internal and line.current != NOTHING and line.source is not None
        }
        found = []
        for number, element in enumerate(conflict.elements):
            source = ends.get(element.token) if element.token is not None else None
            if element.kind is not ElementKind.OBSERVATION or source is None:
                continue
            variable = element.terms[0].arguments[0]
            if isinstance(variable, VariableName) and variable.name == "end" and variable.token == element.token:
                found.append(Watched(number, variable, source))
        return tuple(found)

    def why_it_lasts(self, token: int, key: int) -> tuple[VariableName, Conflict] | None:
        """The end of one of its tokens, and what sets it: the token lasts as long as the model allows (T-REX 1.5)."""
        if not self.bench.is_alive(token, key):
            return None
        return latest(self.bench, self.bench.end(token))

    def observations(self, tick: int) -> list[Observation]:
        """What its own timelines have begun to hold at `tick`; also clears the news that was folded in."""
        published = []
        for line in self.timelines:
            if line.news is not None:
                line.event = line.news.event
                line.source = line.news
                line.news = None
            if line.is_internal and line.current != NOTHING and self.bench.started_at(line.current) == tick:
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

    # ---- planning ----

    def step(self, tick: int) -> bool:
        """Make one decision inside the planning window; when nothing is left, keep the plan."""
        if self.broken is not None or self.steps_left <= 0:
            return False
        self.steps_left -= 1
        if self.steps_left == 0:
            self.planner.keep()
            return False
        end = min(tick + self.latency + max(self.lookahead, 1), self.final_tick)
        match self.planner.deliberate(tick, end):
            case "decided":
                return True
            case "done":
                self._report_rejected()
                return False
            case "deep":
                what = Reason(ReasonKind.DEPTH, limit=self.planner.max_depth)
                self.broken = Failure("F5", what, self.internal, None, self.relaxes)
                return False
            case _:
                return self._replan(tick)

    def _replan(self, tick: int) -> bool:
        """No plan inside the window: relax once and plan again; failing that, give up (T-REX 1.11, F4)."""
        what, conflict = self.planner.reason()
        if self.steps_left > 0 and self.relaxed_at != tick:
            self.relaxed_at = tick
            self.relaxes += 1
            self.trace.record(EventKind.RELAX, self.name, stage=RepairStage.REPLAN, reason=what, conflict=conflict)
            if relax(self.bench, self.timelines, self._live_goals(), tick + 1, forget=False):
                return True
        self.broken = Failure("F4", what, self.internal, conflict, self.relaxes)
        return False

    def failure(self) -> Failure | None:
        """Why planning has failed for good, if it has."""
        return self.broken

    # ---- goals ----

    def accept(self, request: Request) -> None:
        """Queue a request for one of its timelines; who does not look ahead takes none (T-REX 1.8)."""
        if self.lookahead == 0:
            self._refuse(request, Reason(ReasonKind.NO_LOOKAHEAD))
            return
        self.waiting.append(request)
        self.due = min(self.due, max(self.tick + 1, request.start[0] - self.latency - max(self.lookahead, 1)))

    def recall(self, number: int) -> None:
        """Drop a request that has not started."""
        self.waiting = [request for request in self.waiting if request.number != number]
        for goal in self.goals:
            if goal.request.number == number and not goal.is_closed and self.bench.is_alive(goal.token, goal.token_key):
                if not self.bench.is_started(goal.token, self.tick):
                    goal.is_closed = True
                    seen = hold_present(self.bench, self.timelines)
                    self.bench.remove([goal.token])
                    stand(self.bench, self.timelines, seen, False)
                    self.is_stirred = True
                    self.due = self.tick + 1

    def _post(self, request: Request, tick: int) -> None:
        """Make a rejectable token of a request, or refuse it."""
        line = self.by_name[request.timeline]
        predicate = line.predicates.get(request.predicate, NOTHING)
        if predicate == NOTHING:
            what = Reason(ReasonKind.UNKNOWN_PREDICATE, predicate=request.predicate, timeline=request.timeline)
            self._refuse(request, what)
            return
        if request.start[1] < tick:
            self._refuse(request, Reason(ReasonKind.TOO_LATE))
            return
        mark = self.bench.mark()
        token = self.bench.new_goal(predicate, line.object_id)
        bench = self.bench
        holds = (
            bench.at_least(bench.start(token), max(request.start[0], tick), SPAN_REQUEST, token)
            and bench.at_most(bench.start(token), request.start[1], SPAN_REQUEST, token)
            and bench.within(bench.end(token), request.end, SPAN_REQUEST, token)
            and bench.within(bench.duration(token), request.duration, SPAN_REQUEST, token)
            and bench.restrict_parameters(token, request.arguments, SPAN_REQUEST)
        )
        if not holds:
            bench.rewind_to(mark)
            bench.commit()
            self._refuse(request, Reason(ReasonKind.MISFIT))
            return
        bench.commit()
        bench.remember_request(token)
        self.goals.append(Goal(request, token, bench.key(token)))

    def _refuse(self, request: Request, why: Reason) -> None:
        event = self.trace.record(
            EventKind.REJECT,
            self.name,
            request.timeline,
            request.predicate,
            request.arguments,
            (request.event,),
            request=request.number,
            reason=why,
        )
        if request.is_mandatory:
            self.given_up.append(OpenGoal(request.timeline, request.predicate, request.arguments, why, event))

    def _live_goals(self) -> list[Goal]:
        return [goal for goal in self.goals if not goal.is_closed]

    def _close_goals(self, tick: int) -> None:
        """Goals that have run are done; goals that are too late are given up."""
        for goal in self._live_goals():
            if not self.bench.is_alive(goal.token, goal.token_key):
                goal.is_closed = True
                self._refuse(goal.request, Reason(ReasonKind.DROPPED))
            elif self.bench.is_over(goal.token, tick):
                goal.is_closed = True
        if len(self.goals) > 64:
            self.goals = self._live_goals()

    def _report_rejected(self) -> None:
        for goal in self._live_goals():
            if self.bench.is_rejected(goal.token):
                goal.is_closed = True
                self._refuse(goal.request, Reason(ReasonKind.REJECTED))

    def open_goals(self) -> list[OpenGoal]:
        """Mandatory goals that were refused, or that have not run to their end by now."""
        left = [goal.request for goal in self._live_goals()] + self.waiting
        return self.given_up + [
            OpenGoal(r.timeline, r.predicate, r.arguments, event=r.event) for r in left if r.is_mandatory
        ]

    # ---- dispatch ----

    def requests(self, tick: int) -> list[Request]:
        """What is to be asked of owners now."""
        return self.dispatch.requests(tick)

    def open_requests(self) -> list[int]:
        """Numbers of the requests that it has made and that have not started."""
        return self.dispatch.open_requests()

    def recalls(self) -> list[int]:
        """Numbers of the requests whose token has lost its place in the plan."""
        return self.dispatch.recalls(self.tick)

    def _causes_of(self, line: TimelineState) -> tuple[int, ...]:
        """The request that the current token answers, and what else was published before."""
        for goal in self.goals:
            if self.bench.is_alive(goal.token, goal.token_key) and self.bench.stands_for(goal.token) == line.current:
                return (goal.request.event,)
        return (line.event,) if line.event != NOTHING else ()


def _distinct(first: Conflict | None, failures: list[Unsettled]) -> tuple[Conflict, ...]:
    """The conflicts of later attempts that differ from the first."""
    found: list[Conflict] = []
    for failure in failures:
        if failure.conflict is not None and failure.conflict != first and failure.conflict not in found:
            found.append(failure.conflict)
    return tuple(found)
