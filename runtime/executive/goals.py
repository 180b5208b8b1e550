"""What a reactor was asked for: queued until its window comes, posted, given up, taken back, done (T-REX 1.8)."""

from dataclasses import replace

from runtime.executive.cuts import Cuts, Repair
from runtime.executive.dispatch import Dispatch
from runtime.executive.messages import Request
from runtime.executive.misfits import misfit
from runtime.executive.outcome import Conflict, Deadlock, EventKind, OpenGoal, Reason, ReasonKind
from runtime.executive.reactor import Refusal, Watched
from runtime.executive.repair import hold_present, stand
from runtime.executive.timelines import NOTHING, Goal, TimelineState
from runtime.executive.told_on import asked_in, watched_in
from runtime.executive.trace import Trace
from runtime.executive.view import SPAN_REQUEST
from runtime.executive.wishes import Wishes
from runtime.executive.workbench import Workbench
from runtime.plan.tags import INFINITY


class Goals:
    """The requests of one reactor, waiting or in its plan."""

    def __init__(self, name: str, bench: Workbench, timelines: list[TimelineState], trace: Trace) -> None:
        self.name = name
        self.bench = bench
        self.timelines = timelines
        self.trace = trace
        self.lines = {line.name: line for line in timelines}
        self.waiting: list[Request] = []
        self.posted: list[Goal] = []
        self.wishes = Wishes(name, bench, trace)
        self.to_recall: list[int] = []
        self.refusals: list[Refusal] = []
        self.lacking: list[Refusal] = []  # of what is over
        self.given_up: dict[int, OpenGoal] = {}  # mandatory ones, by the number of the request
        self.is_changed = False  # something was posted or taken out of the plan
        self.repair: Repair | None = None  # the last one
        self.cuts = Cuts(bench)
        self.loosened: list[tuple[int, int, float, float]] = []
        self.rejections: dict[int, Deadlock] = {}  # what the planner knows of the goals that it has rejected

    # ---- taking in ----

    def has_news(self, reach: int) -> bool:
        """Whether there is something to take in that may start by `reach`, or to take back."""
        return bool(self.to_recall or [request for request in self.waiting if request.start[0] <= reach])

    def take_in(self, tick: int, reach: int) -> bool:
        """Carry out recalls, and post what may start by `reach`, as it was asked; whether the plan has changed."""
        self.is_changed = False
        if self.to_recall:
            numbers, self.to_recall = self.to_recall, []
            for number in numbers:
                self._recall(number, tick)
        if self.has_news(reach):
            due = [request for request in self.waiting if request.start[0] <= reach]
            self.waiting = [request for request in self.waiting if request.start[0] > reach]
            for request in due:
                self._post(request, tick)
        return self.is_changed

    def _post(self, request: Request, tick: int) -> None:
        """Make a rejectable token of a request, or refuse it; it starts after `tick`, for what has begun stays."""
        bench, line = self.bench, self.lines[request.timeline]
        predicate = line.predicates.get(request.predicate, NOTHING)
        if predicate == NOTHING:
            why = Reason(ReasonKind.UNKNOWN_PREDICATE, predicate=request.predicate, timeline=request.timeline)
            self.refuse(request, why)
            return
        if request.start[1] <= tick:
            self.refuse(request, Reason(ReasonKind.TOO_LATE))
            return
        mark = bench.mark()
        token = bench.new_goal(predicate, line.object_id)
        holds = (
            bench.at_least(bench.start(token), max(request.start[0], tick + 1), SPAN_REQUEST, token)
            and bench.at_most(bench.start(token), request.start[1], SPAN_REQUEST, token)
            and bench.within(bench.end(token), request.end, SPAN_REQUEST, token)
            and bench.within(bench.duration(token), request.duration, SPAN_REQUEST, token)
            and bench.restrict_parameters(token, request.arguments, SPAN_REQUEST)
        )
        if not holds:
            bench.rewind_to(mark)
            bench.commit()
            self.refuse(request, misfit(bench, predicate, line.object_id, request))
            return
        bench.commit()
        bench.remember_request(token)
        if request.number < 0:
            bench.goal_numbers[bench.key(token)] = -1 - request.number
        self.posted.append(Goal(request, token, bench.key(token)))
        self.is_changed = True

    def _recall(self, number: int, tick: int) -> None:
        """Drop a request; a token that has begun goes on to its own end (T-REX 1.8)."""
        for request in [request for request in self.waiting if request.number == number]:
            self.waiting.remove(request)
            self._note_recalled(request)
        for goal in self.live():
            if goal.request.number != number:
                continue
            goal.is_closed = True
            self._note_recalled(goal.request)
            if not self.bench.is_alive(goal.token, goal.token_key):
                continue
            if self.bench.is_started(goal.token, tick):
                self._free(self.bench.stands_for(goal.token))
            else:
                self._take_away([goal.token])
                self.reopen()

    def _free(self, token: int) -> None:
        """What runs is bound by those only who still wait for it."""
        if any(line.current == token for line in self.timelines):
            self.bench.free_of_requests(token, [goal.token for goal in self.live()])

    def _note_recalled(self, request: Request) -> None:
        if request.is_mandatory:
            goal = OpenGoal(request.timeline, request.predicate, request.arguments, Reason(ReasonKind.RECALLED))
            self.given_up.setdefault(request.number, goal)

    # ---- giving up ----

    def refuse(self, request: Request, why: Reason) -> None:
        """Tell that a request will not be met."""
        event = self.trace.record(
            EventKind.REFUSE,
            self.name,
            request.timeline,
            request.predicate,
            request.arguments,
            (request.event,),
            request=request.number,
            reason=why,
        )
        self.refusals.append(Refusal(request, event))
        if request.is_mandatory:
            goal = OpenGoal(request.timeline, request.predicate, request.arguments, why, event)
            self.given_up[request.number] = goal

    def _give_up(
        self,
        request: Request,
        kind: ReasonKind,
        tick: int,
        deadlock: Deadlock | None = None,
        conflict: Conflict | None = None,
    ) -> None:
        """Tell that a goal of the plan will not be met, and what is known of why.

        What is dropped went in the last repair; what is rejected or late in the tick of a repair, because of it.
        """
        repair = self.repair
        if conflict is not None or (repair is not None and kind is not ReasonKind.DROPPED and repair.tick != tick):
            repair = None
        causes: tuple[int, ...] = (request.event,)
        why = Reason(kind)
        if repair is not None:
            conflict, causes = repair.conflict, (request.event, repair.event)
            deadlock, why = deadlock or repair.deadlock, Reason(kind, repair=repair.reason)
        if conflict is not None:
            causes += self.trace.draw_events(conflict.parameters)
        deadlock = asked_in(deadlock, self._watched, self.trace)
        event = self.trace.record(
            EventKind.REJECT,
            self.name,
            request.timeline,
            request.predicate,
            request.arguments,
            causes,
            request=request.number,
            reason=why,
            conflict=conflict,
            deadlock=deadlock,
        )
        self.refusals.append(Refusal(request, event, kind is ReasonKind.CUT_LOOSE))
        if request.is_mandatory:
            goal = OpenGoal(request.timeline, request.predicate, request.arguments, why, event, conflict, deadlock)
            self.given_up.setdefault(request.number, goal)

    def _watched(self, conflict: Conflict) -> tuple[Watched, ...]:
        return watched_in(conflict, self.bench, self.timelines, self.posted)

    def note_repair(
        self,
        tick: int,
        event: int,
        reason: Reason,
        conflict: Conflict | None,
        deadlock: Deadlock | None = None,
        watched: tuple[Watched, ...] = (),
    ) -> None:
        """Keep why the plan is repaired: where a goal is at stake, told on through the other reactors."""
        goals = self.live()
        if conflict is not None and watched and goals:
            conflict = self.trace.tell_on(conflict, watched)
        self.repair = Repair(tick, event, reason, conflict, deadlock)
        self.cuts.note(goals, tick)

    def missed(self) -> list[int]:
        """The goals that the planner has just rejected, whoever asked."""
        found: list[int] = []
        for goal in self.posted:
            if not (goal.is_closed or goal.is_rejected) and self.bench.is_alive(goal.token, goal.token_key):
                if self.bench.is_rejected(goal.token):
                    found.append(goal.token)
        return found

    def report_rejected(self, tick: int) -> None:
        """Tell once of each goal that the planner found no place for; it may come back when there is room."""
        for goal in self.live():
            is_rejected = self.bench.is_alive(goal.token, goal.token_key) and self.bench.is_rejected(goal.token)
            if is_rejected and goal.request.number in self.to_recall:
                continue  # who takes it back knows
            if is_rejected and not goal.is_rejected:
                goal.is_rejected = True
                self._give_up(goal.request, ReasonKind.REJECTED, tick, self.rejections.pop(goal.token, None))
            elif goal.is_rejected and not is_rejected:
                goal.is_rejected = False
                self.given_up.pop(goal.request.number, None)

    def reject(self, token: int, tick: int, conflict: Conflict | None) -> bool:
        """Give up the goal of a token that has not begun, for good; whether there is such a goal."""
        for goal in self.live():
            if goal.token == token and self.bench.is_waiting(token, tick):
                goal.is_closed = True
                if goal.request.number not in self.to_recall and not goal.is_rejected:
                    self._give_up(goal.request, ReasonKind.REJECTED, tick, conflict=conflict)
                self._take_away([token])
                return self.bench.is_consistent()
        return False

    def _take_away(self, tokens: list[int]) -> None:
        """Take tokens that have not begun out of the plan; what their rules asked for and has begun goes on."""
        self.bench.recorder.cut()
        seen = hold_present(self.bench, self.timelines)
        self.bench.remove(tokens)
        stand(self.bench, self.timelines, seen)
        self.is_changed = True

    def next_expiry(self) -> float:
        """The first tick at which a goal that is rejected can begin no more, and does not come back."""
        found: float = self.wishes.next_expiry() if self.wishes.open else INFINITY
        for goal in self.posted:
            if goal.is_rejected and self._may_come_back(goal):
                found = min(found, self.bench.upper(self.bench.start(goal.token)))
        return found

    def _may_come_back(self, goal: Goal) -> bool:
        is_rejected = goal.is_rejected and not goal.is_closed and self.bench.is_alive(goal.token, goal.token_key)
        return is_rejected and self.bench.is_rejected(goal.token)

    def reopen(self) -> bool:
        """Let the planner look again at goals that it rejected: there may be room now."""
        found = False
        for goal in self.live():
            if self._may_come_back(goal):
                self.bench.cancel(goal.token)
                found = True
        self.is_changed = self.is_changed or found
        return found

    def note_failed_starts(self, tokens: list[int]) -> None:
        """Count that the present failed when the owner of `tokens` had just begun what goals asked for."""
        roots = set()
        for token in tokens:
            while token >= 0:
                root, token = token, self.bench.parent(token)
            roots.add(root)
        for goal in self.live():
            if self.bench.is_alive(goal.token, goal.token_key) and self.bench.stands_for(goal.token) in roots:
                goal.failed_starts += 1

    def give_up_failed_starts(self, tick: int) -> None:
        """Give up goals that could not begin, and could not when asked for once more; what has begun stays."""
        bench = self.bench
        for goal in self.live():
            is_meant = goal.failed_starts > 1 and bench.is_alive(goal.token, goal.token_key)
            if is_meant and bench.is_waiting(bench.stands_for(goal.token), tick):
                goal.is_closed = True
                self._drop(goal, ReasonKind.REJECTED, tick)
                self._take_away([goal.token])

    def loosen(self) -> bool:
        """Free what runs of the bounds of those who asked for it: it is fact, what they asked is not (T-REX 1.9)."""
        for line in self.timelines:
            if line.is_internal and line.current != NOTHING:
                self.loosened += self.bench.free_of_requests(line.current, [])
        return len(self.loosened) > 0

    def bind(self, tick: int) -> None:
        """Bind what runs by what a goal asked of it, where all of that still can be; otherwise who asked is told."""
        bench, loosened, self.loosened = self.bench, self.loosened, []
        for goal in self.live() if loosened else []:
            if goal.is_loose or goal.token_key != bench.key(goal.token):
                continue
            mark = bench.mark()
            holds = True
            for token, variable, lower, upper in loosened:
                if token == goal.token:
                    holds = holds and bench.within(variable, (lower, upper), SPAN_REQUEST, token)
            if not holds:
                bench.rewind_to(mark)
            bench.commit()
            if not holds:
                goal.is_loose = True
                self._drop(goal, ReasonKind.CUT_LOOSE, tick)

    # ---- the tick ----

    def close(self, tick: int, asked: Dispatch) -> bool:
        """Goals that have run are done; those that are too late, or went in a repair, are given up. Whether any was.

        `asked` tells whether an owner has given up what a goal needed: then its end is no achievement.
        """
        found = False
        late: list[int] = []
        if self.cuts.held and self.repair is not None:
            self.cuts.close(self.live(), self.repair)
        for goal in self.live():
            bench, token = self.bench, goal.token
            if not bench.is_alive(token, goal.token_key):
                goal.is_closed = True
                self._drop(goal, ReasonKind.DROPPED, tick)
            elif bench.is_over(token, tick):
                goal.is_closed = True
                if asked.is_cut_off(token):
                    self._drop(goal, ReasonKind.LACKING, tick)
                    self.lacking.append(self.refusals.pop())
                elif not goal.is_loose:
                    self.achieved(goal.request)
                found = True
            elif bench.is_missed(token, tick):
                goal.is_closed = True
                self._drop(goal, ReasonKind.TOO_LATE, tick)
                late.append(token)
        if self.wishes.open:
            late += self.wishes.close(tick)
        if late:
            self._take_away(late)
        if len(self.posted) > 64:
            self.posted = self.live()
        return found

    def _drop(self, goal: Goal, kind: ReasonKind, tick: int) -> None:
        if not goal.is_rejected:
            self._give_up(goal.request, kind, tick)

    def achieved(self, request: Request) -> None:
        """Note that what was asked for has run to its end."""
        self.trace.record(
            EventKind.ACHIEVED,
            self.name,
            request.timeline,
            request.predicate,
            request.arguments,
            (request.event,),
            request=request.number,
        )

    def live(self) -> list[Goal]:
        """Goals that still may be met."""
        found = []
        for goal in self.posted:
            if not goal.is_closed:
                found.append(goal)
        return found

    def answered(self, token: int) -> list[Goal]:
        """The goals that a token of the plan is, or stands for."""
        found = []
        for goal in self.posted:
            if self.bench.is_alive(goal.token, goal.token_key) and self.bench.stands_for(goal.token) == token:
                found.append(goal)
        return found

    def open_goals(self) -> list[OpenGoal]:
        """Mandatory goals that were refused, or that have not run to their end by now."""
        left = [goal for goal in self.live() if goal.request.is_mandatory and goal.request.number not in self.given_up]
        return (
            list(self.given_up.values())
            + [self._live_goal(goal) for goal in left]
            + [_open_goal(request) for request in self.waiting if request.is_mandatory]
        )

    def _live_goal(self, goal: Goal) -> OpenGoal:
        """A goal that is planned or runs; where a repair has cut it loose, that is why it is open."""
        found, cut = _open_goal(goal.request), self.cuts.of.get(goal.request.number)
        if cut is None or not self.bench.is_alive(goal.token, goal.token_key):
            return found
        why = Reason(ReasonKind.CUT_LOOSE, repair=cut.reason)
        return replace(found, reason=why, event=cut.event, conflict=cut.conflict, deadlock=cut.deadlock)


def _open_goal(request: Request) -> OpenGoal:
    return OpenGoal(request.timeline, request.predicate, request.arguments, event=request.event)
