"""Make a reactor's plan agree with the present: fold in what was observed, complete what it owns (T-REX 1.4).

Each timeline is a decision with a few choices; decisions are taken in the order of the timelines and taken back
chronologically. Where that takes long, a timeline on which nothing fits is decided first from then on.
"""

from dataclasses import replace

from runtime.executive.dispatch import Dispatch
from runtime.executive.lasting import go_on, persist, why_not
from runtime.executive.messages import Observation
from runtime.executive.outcome import ChoiceKind, Deadlock, FailedChoice, PresentChoice, Reason, ReasonKind
from runtime.executive.planning import EPISODE_DONE, EPISODE_EXHAUSTED, EPISODE_TOO_DEEP, Planner
from runtime.executive.reactor import SyncFailure, code_of_news
from runtime.executive.story import conflict_of
from runtime.executive.timelines import NOTHING, TimelineState
from runtime.executive.view import SPAN_CLOCK, SPAN_EXECUTIVE, SPAN_OBSERVATION
from runtime.executive.workbench import Workbench
from runtime.limits import LimitError

_FREE_TRIES = 100  # tries beyond those that a present without conflicts takes
_MOST_TRIES = 100_000
_UNDEFINED = "undefined"
_TRIES_EXHAUSTED = SyncFailure("", (), Reason(ReasonKind.UNMET), None)

# A choice: how a token is found (it goes on, starts, is made, observed, or meets what is), it or NOTHING, a predicate.
_EXTEND, _NEXT, _NEW, _FACT, _MEET = range(5)
_Choice = tuple[int, int, int]
_KINDS = (ChoiceKind.EXTEND, ChoiceKind.NEXT, ChoiceKind.NEW, ChoiceKind.OBSERVE, ChoiceKind.MEET)


def synchronise(
    bench: Workbench,
    planner: Planner,
    timelines: list[TimelineState],
    tick: int,
    final_tick: int,
    asked: Dispatch,
) -> SyncFailure | None:
    """Synchronise all `timelines` at `tick`; on success each has its current token and the plan is consistent.

    The present token is kept as long as it may; but a token that somebody asked for starts as soon as it may, and so
    does any on a timeline that is early. `asked` tells what an owner will not do. On failure the caller rewinds.
    """
    failed = go_on(bench, timelines, tick)
    if failed is not None:
        return failed
    if not bench.set_clock(tick):
        return SyncFailure("F3", (), Reason(ReasonKind.CLOCK, tick=tick), conflict_of(bench))
    failed = persist(bench, timelines, tick, asked)
    if failed is not None:
        return failed
    mark = bench.mark()
    failed = _Search(bench, planner, timelines, tick, final_tick, asked, False).run()
    if failed is not None:
        # Choices fail all the time; only when all have failed is it worth while to find out why.
        bench.rewind_to(mark)
        search = _Search(bench, planner, timelines, tick, final_tick, asked, True)
        failed, bench.plan.resources.relief = search.explained(search.run()), None
    if planner.solver.relief is not None:
        planner.solver.relief.within = None
    return failed


class _Search:
    """Depth-first search over one decision per timeline, then over the flaws of the present."""

    def __init__(
        self,
        bench: Workbench,
        planner: Planner,
        timelines: list[TimelineState],
        tick: int,
        final_tick: int,
        asked: Dispatch,
        explains: bool,
    ) -> None:
        self.explains = explains
        self.bench = bench
        self.planner = planner
        self.tick = tick
        self.is_last, self.asked = tick == final_tick, asked
        self.timelines, self.relief = timelines, planner.solver.relief
        self.lines = [line for line in timelines if not line.is_internal and line.news is not None]
        self.lines += sorted([line for line in timelines if line.is_internal], key=self._rank)
        self.made: list[int] = []
        self.first: SyncFailure | None = None
        self.first_depth = NOTHING
        self.tried: dict[str, dict[_Choice, FailedChoice]] = {}  # by timeline: each choice, as it first failed
        self.is_out_of_budget = False

    def run(self) -> SyncFailure | None:
        """Try choices until all timelines and the flaws of the present are resolved."""
        mark = self.bench.mark()
        stuck: dict[str, None] = {}
        max_tries = _FREE_TRIES
        tries = 0
        while True:
            outcome = self._walk(max_tries + len(self.lines), stuck)
            if outcome is not _TRIES_EXHAUSTED:
                return outcome
            tries += max_tries
            if tries > _MOST_TRIES:
                raise LimitError(f"no present was found at tick {self.tick} in {tries} tries")
            max_tries *= 2
            # What nothing fits comes first from now on: either it is synchronised, or there is no present at all.
            self.bench.rewind_to(mark)
            order = {name: k for k, name in enumerate(reversed(stuck))}
            self.lines.sort(key=lambda line: order.get(line.name, len(order)))

    def _walk(self, max_tries: int, stuck: dict[str, None]) -> SyncFailure | None:
        """Decide the timelines in their order, up to a number of tries; note those on which nothing fitted."""
        bench = self.bench
        open_choices: list[list[_Choice]] = []
        marks: list[int] = []
        self.made = []
        self.first = None
        tries = 0
        while True:
            depth = len(open_choices)
            if depth == len(self.lines):
                if self._finish():
                    self._note()
                    return None
                if self.is_out_of_budget:
                    return self.first
                if not self._back(marks):
                    return self.first
            else:
                open_choices.append(self.choices(self.lines[depth]))
                marks.append(bench.mark())
                self.made.append(NOTHING)
            while True:
                tries += 1
                if tries > max_tries:
                    return _TRIES_EXHAUSTED
                depth = len(open_choices) - 1
                if not open_choices[depth]:
                    stuck.pop(self.lines[depth].name, None)
                    stuck[self.lines[depth].name] = None
                    open_choices.pop()
                    marks.pop()
                    self.made.pop()
                    if not self._back(marks):
                        return self.first
                    continue
                choice = open_choices[depth].pop(0)
                if self.apply(self.lines[depth], choice):
                    if self.first_depth == depth:
                        self.first = None  # another choice did for this timeline: it is not where things go wrong
                    break
                if self.explains:
                    self._note_failure(self.lines[depth], choice)
                bench.rewind_to(marks[depth])
                if self._misfit(self.lines[depth], choice):
                    tries -= 1
                    line = self.lines[depth]
                    open_choices[depth] = self._observing(line, line.predicates.get(_UNDEFINED, NOTHING))
                elif not self.explains:
                    self._note_failure(self.lines[depth], choice)

    def _back(self, marks: list[int]) -> bool:
        """Undo the latest decision that stands; False if there is none."""
        if not marks:
            self._fail("F3", (), Reason(ReasonKind.UNMET))
            return False
        self.bench.rewind_to(marks[len(marks) - 1])
        return True

    def _rank(self, line: TimelineState) -> tuple[int, int]:
        """What begins as soon as it may comes first, what was asked for before the rest: nothing goes on in its way."""
        bench, token = self.bench, self.bench.next_of(line.object_id, line.current)
        if token < 0 or not self._may_start(token):
            return 2, 0
        return (0, bench.key(token)) if bench.is_requested(token) else (2 - line.is_early, 0)

    def choices(self, line: TimelineState) -> list[_Choice]:
        """What may hold on `line` now, best first (T-REX 1.4)."""
        bench, tick, current = self.bench, self.tick, line.current
        if not line.is_internal:
            assert line.news is not None
            predicate = line.predicates.get(line.news.predicate, NOTHING)
            found = self._observing(line, predicate)
            if self.explains or not found or found[0][0] != _FACT:
                found = self._observing(line, self.fitting(line, line.news))
            return found  # of a fact by itself it shows when it is carried out whether the arguments fit
        if current != NOTHING and bench.lower(bench.end(current)) > tick:
            return [(_EXTEND, current, NOTHING)]
        extend: list[_Choice] = []
        if current != NOTHING and bench.upper(bench.end(current)) > tick:
            extend = [(_EXTEND, current, NOTHING)]
        starts: list[_Choice] = []
        token = bench.next_of(line.object_id, current)
        if token >= 0 and self._may_start(token):
            starts.append((_NEXT, token, NOTHING))
        is_asked = bool(starts) and bench.is_requested(token)
        if not is_asked:
            forced = bench.must_begin(line.object_id, tick)
            undecided = [(_NEXT, each, NOTHING) for each in forced]
            # What is planned next may be what must begin: both are one token then.
            is_one = bool(starts and forced) and bench.predicate_of(token) == bench.predicate_of(forced[0])
            starts = starts + undecided if is_one and not bench.is_fact(forced[0]) else undecided + starts
            is_asked = bool(forced) and bench.is_requested(forced[0])
        if is_asked and self.is_last:
            starts = []  # what can begin at the end at the earliest is not begun
        new: list[_Choice] = [(_NEW, NOTHING, other) for other in line.others]
        if line.default >= 0:
            new.insert(0, (_NEW, NOTHING, line.default))
        if starts and (line.is_early or is_asked):
            return [*starts, *extend, *new]
        if line.is_late and line.default >= 0:
            return [*extend, new[0], *starts, *new[1:]]
        return [*extend, *starts, *new]

    def _observing(self, line: TimelineState, predicate: int) -> list[_Choice]:
        """How `predicate` may be observed: by a planned token that may start now, or by itself."""
        bench = self.bench
        found: list[_Choice] = []
        if predicate == NOTHING:
            return found
        assert line.news is not None
        token = bench.next_of(line.object_id, line.current)
        while token >= 0:
            if bench.is_met_by(bench.predicate_of(token), predicate) and self._may_start(token):
                found.append((_MEET, token, bench.predicate_of(token)))
            token = bench.following(token)
        for _, token, _ in found:
            if self.asked.is_answered(token, line.news.event):
                return found  # what was asked for has come: that is how the plan has to go on
        found.append((_FACT, NOTHING, predicate))
        return found

    def _misfit(self, line: TimelineState, choice: _Choice) -> bool:
        """Whether a choice has failed because the arguments that were observed are none of the model's."""
        news = line.news
        if self.explains or news is None or choice[0] != _FACT or choice[2] != line.predicates.get(news.predicate):
            return False
        return self.fitting(line, news) != choice[2]

    def _may_start(self, token: int) -> bool:
        """Whether a token may start now."""
        start = self.bench.start(token)
        return self.bench.lower(start) <= self.tick <= self.bench.upper(start)

    def fitting(self, line: TimelineState, news: Observation) -> int:
        """The predicate of what was observed; `undefined` if the model has none like it (T-REX 1.6)."""
        bench = self.bench
        predicate = line.predicates.get(news.predicate, NOTHING)
        if predicate != NOTHING and news.arguments:
            mark = bench.mark()
            token = bench.new_token(predicate, line.object_id, True)
            fits = bench.restrict_parameters(token, news.arguments, SPAN_OBSERVATION)
            bench.rewind_to(mark)
            bench.release(mark)
            if fits:
                return predicate
        elif predicate != NOTHING:
            return predicate
        return line.predicates.get(_UNDEFINED, NOTHING)

    def apply(self, line: TimelineState, choice: _Choice) -> bool:
        """Carry out `choice`; False on conflict."""
        bench, tick = self.bench, self.tick
        kind, token, predicate = choice
        self._postpone()
        if line.is_internal and line.current != NOTHING and kind != _EXTEND:
            # Something holds at every tick: what held until now ends as the next thing begins.
            if not bench.fix(bench.end(line.current), tick, SPAN_EXECUTIVE, line.current):
                return False
        if kind == _EXTEND:
            holds = bench.at_least(bench.end(token), tick + 1, SPAN_EXECUTIVE, token)
        elif kind == _NEXT:
            if not bench.is_active(token):
                holds = bench.activate(token) and bench.place_after(line.object_id, token, line.current)
                if not holds:
                    return False
            holds = bench.fix(bench.start(token), tick, SPAN_EXECUTIVE, token) and bench.at_least(
                bench.end(token), tick + 1, SPAN_EXECUTIVE, token
            )
        elif kind == _NEW:
            token = bench.new_token(predicate, line.object_id, False)
            holds = (
                bench.fix(bench.start(token), tick, SPAN_EXECUTIVE, token)
                and bench.at_least(bench.end(token), tick + 1, SPAN_EXECUTIVE, token)
                and bench.activate(token)
                and bench.place_after(line.object_id, token, line.current)
            )
        else:
            assert line.news is not None
            token = self._observe(line, line.news, kind, token, predicate)
            holds = token != NOTHING
        self.made[len(self.made) - 1] = token
        return holds

    def _observe(self, line: TimelineState, news: Observation, kind: int, token: int, predicate: int) -> int:
        """Insert what was observed as a fact, or let it meet the planned `token`; NOTHING on conflict."""
        bench, tick = self.bench, self.tick
        fact = bench.new_token(predicate, line.object_id, True)
        holds = bench.fix(bench.start(fact), tick, SPAN_OBSERVATION, fact)
        holds = holds and bench.at_least(bench.end(fact), tick + 1, SPAN_OBSERVATION, fact)
        if kind == _MEET or predicate == line.predicates.get(news.predicate):
            holds = holds and bench.restrict_parameters(fact, news.arguments, SPAN_OBSERVATION)
        if not holds:
            return NOTHING
        if kind == _MEET:
            return token if bench.merge(fact, token) else NOTHING
        if bench.activate(fact) and bench.place_after(line.object_id, fact, line.current):
            return fact
        return NOTHING

    def _finish(self) -> bool:
        """Let what has not started start later, and resolve the flaws of the present."""
        bench, tick = self.bench, self.tick
        self._postpone()
        for token in self.waiting():
            if self.is_last:
                break  # there is no later
            if not bench.at_least(bench.start(token), tick + 1, SPAN_CLOCK, token):
                code = "F6" if self.asked.is_refused(token) else "F1"
                self._fail(code, (), Reason(ReasonKind.DID_NOT_START, bench.name_of(token), tick=tick))
                return False
        outcome = self.planner.resolve_present(tick)
        if outcome not in (EPISODE_DONE, EPISODE_EXHAUSTED):
            self.is_out_of_budget = True
            is_deep = outcome == EPISODE_TOO_DEEP
            limit = self.planner.max_depth if is_deep else self.planner.max_steps
            what = Reason(ReasonKind.DEPTH if is_deep else ReasonKind.STEPS, tick=tick, limit=limit)
            self.first = SyncFailure("F5", (), what, None)
            return False
        if outcome == EPISODE_EXHAUSTED:
            if self.first is None:
                what, conflict = self.planner.reason() if self.explains else (Reason(ReasonKind.NO_PLAN), None)
                deadlock = self.planner.deadlock() if self.explains else None
                self.first = SyncFailure("F3", (), what, conflict, deadlock)
            return False
        return True

    def _postpone(self) -> None:
        """Leave a level to the end that what is open now may relieve, as planning does: no order of lines decides."""
        if self.relief is not None:
            window = self.planner.window
            window.tick, window.end, window.is_present, self.relief.within = self.tick, self.tick, True, window
            self.relief.count_guards()
            self.bench.plan.resources.relief = self.relief

    def waiting(self) -> list[int]:
        """Tokens that have not begun: all behind the current one of a timeline, and others that still may wait."""
        bench = self.bench
        found: dict[int, None] = {}
        for line in self.timelines:
            token = line.current
            for k, other in enumerate(self.lines):
                if other is line:
                    token = self.made[k]
            token = bench.next_of(line.object_id, token)
            while token >= 0:
                found[token] = None
                token = bench.following(token)
        for token in bench.unplaced(self.tick):
            found[token] = None
        return list(found)

    def _note(self) -> None:
        """Keep what was decided."""
        for k, line in enumerate(self.lines):
            line.current = self.made[k]

    def _note_failure(self, line: TimelineState, choice: _Choice) -> None:
        kind, token, predicate = choice
        conflict = conflict_of(self.bench) if self.explains else None
        if self.explains:
            named = self.bench.name_of(token) if token != NOTHING else None
            called = "" if predicate == NOTHING else self.bench.predicate_name(predicate)
            tried = self.tried.setdefault(line.name, {})
            tried.setdefault(choice, FailedChoice(PresentChoice(_KINDS[kind], named, called), conflict))
        if self.first is not None:
            return
        code = "F3" if line.is_internal else code_of_news(line.news)
        if kind == _EXTEND:
            what = why_not(ReasonKind.CANNOT_GO_ON, self.bench, token, self.tick)
        elif kind in (_NEXT, _MEET):
            what = Reason(ReasonKind.CANNOT_START, self.bench.name_of(token), tick=self.tick)
        else:
            name = self.bench.predicate_name(predicate)
            what = Reason(ReasonKind.NONE_CAN_START, predicate=name, tick=self.tick)
        self.first = SyncFailure(code, (line.name,), what, conflict)
        self.first_depth = self.lines.index(line)

    def _fail(self, code: str, timelines: tuple[str, ...], what: Reason) -> None:
        """Remember what went wrong, unless something did before."""
        if self.first is None:
            self.first = SyncFailure(code, timelines, what, conflict_of(self.bench) if self.explains else None)
            self.first_depth = NOTHING

    def explained(self, failure: SyncFailure | None) -> SyncFailure | None:
        """A failure with all that was tried on its timeline, where that was more than one thing."""
        if failure is None or failure.deadlock is not None or len(failure.timelines) != 1:
            return failure
        tried = tuple(self.tried.get(failure.timelines[0], {}).values())
        return replace(failure, deadlock=Deadlock(None, failure.timelines[0], tried)) if len(tried) > 1 else failure
