"""Make a reactor's plan agree with the present: fold in what was observed, complete what it owns (T-REX 1.4).

Each timeline is a decision with a few choices; decisions are taken in the order of the timelines and taken back
chronologically. Where that takes long, a timeline on which nothing fits is decided first from then on.
"""

from collections.abc import Callable
from dataclasses import dataclass

from runtime.executive.dispatch import Dispatch
from runtime.executive.messages import Observation
from runtime.executive.outcome import Conflict, Deadlock, Reason, ReasonKind
from runtime.executive.planning import LimitError, Planner
from runtime.executive.story import conflict_of
from runtime.executive.timelines import NOTHING, TimelineState
from runtime.executive.view import SPAN_CLOCK, SPAN_EXECUTIVE, SPAN_OBSERVATION
from runtime.executive.workbench import Workbench

_FREE_TRIES = 100  # tries beyond those that a present without conflicts takes
_MOST_TRIES = 100_000
_EXTEND, _NEXT, _NEW, _FACT, _MEET = "extend", "next", "new", "fact", "meet"
_UNDEFINED = "undefined"


@dataclass(frozen=True, slots=True)
class Continuation:
    """One way to synchronise a timeline: `token` is kept, started or met; `predicate` is that of a new token."""

    kind: str
    token: int
    predicate: int


@dataclass(frozen=True, slots=True)
class SyncFailure:
    """The present cannot be explained: the failure code, where, why, and the conflict."""

    code: str
    timelines: tuple[str, ...]
    reason: Reason
    conflict: Conflict | None
    deadlock: Deadlock | None = None


_TRIES_EXHAUSTED = SyncFailure("", (), Reason(ReasonKind.UNMET), None)


def synchronise(
    bench: Workbench,
    planner: Planner,
    timelines: list[TimelineState],
    tick: int,
    final_tick: int,
    dispatch: Dispatch,
) -> SyncFailure | None:
    """Synchronise all `timelines` at `tick`; on success each has its current token and the plan is consistent.

    The present token is kept as long as it may; but a token that somebody asked for starts as soon as it may, and so
    does any on a timeline that is early. `dispatch` tells what was asked of owners. On failure the caller rewinds.
    """
    for line in timelines:
        # While the reactor slept, what holds has gone on.
        span = SPAN_EXECUTIVE if line.is_internal else SPAN_OBSERVATION
        if line.current != NOTHING and not bench.at_least(bench.end(line.current), tick, span, line.current):
            what = Reason(ReasonKind.CANNOT_GO_ON, bench.name_of(line.current), tick=tick)
            return SyncFailure("F3" if line.is_internal else "F1", (line.name,), what, conflict_of(bench))
    if not bench.set_clock(tick):
        return SyncFailure("F3", (), Reason(ReasonKind.CLOCK, tick=tick), conflict_of(bench))
    failed = _persist(bench, timelines, tick, dispatch.is_refused)
    if failed is not None:
        return failed
    mark = bench.mark()
    if _Search(bench, planner, timelines, tick, final_tick, dispatch, False).run() is None:
        return None
    # Choices fail all the time; only when all have failed is it worth while to find out why.
    bench.rewind_to(mark)
    return _Search(bench, planner, timelines, tick, final_tick, dispatch, True).run()


def _persist(
    bench: Workbench, timelines: list[TimelineState], tick: int, is_refused: Callable[[int], bool]
) -> SyncFailure | None:
    """No news means no change: what is observed on other reactors' timelines goes on; a new value ends it."""
    for line in timelines:
        if line.is_internal or line.current == NOTHING:
            continue
        if line.news is None:
            if not bench.at_least(bench.end(line.current), tick + 1, SPAN_OBSERVATION, line.current):
                what = Reason(ReasonKind.GOES_ON, bench.name_of(line.current), tick=tick)
                following = bench.next_of(line.object_id, line.current)
                code = "F6" if following >= 0 and is_refused(following) else "F1"
                return SyncFailure(code, (line.name,), what, conflict_of(bench))
        elif not bench.fix(bench.end(line.current), tick, SPAN_OBSERVATION, line.current):
            what = Reason(ReasonKind.ENDED, bench.name_of(line.current), tick=tick)
            return SyncFailure("F2", (line.name,), what, conflict_of(bench))
    return None


class _Search:
    """Depth-first search over one decision per timeline, then over the flaws of the present."""

    def __init__(
        self,
        bench: Workbench,
        planner: Planner,
        timelines: list[TimelineState],
        tick: int,
        final_tick: int,
        dispatch: Dispatch,
        explains: bool,
    ) -> None:
        self.explains = explains
        self.bench = bench
        self.planner = planner
        self.tick = tick
        self.is_last = tick == final_tick
        self.dispatch = dispatch
        self.timelines = timelines
        self.lines = [line for line in timelines if not line.is_internal and line.news is not None]
        self.lines += [line for line in timelines if line.is_internal]
        self.made: list[int] = []
        self.first: SyncFailure | None = None
        self.first_depth = NOTHING
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
            order = {name: place for place, name in enumerate(reversed(stuck))}
            self.lines.sort(key=lambda line: order.get(line.name, len(order)))

    def _walk(self, max_tries: int, stuck: dict[str, None]) -> SyncFailure | None:
        """Decide the timelines in their order, up to a number of tries; note those on which nothing fitted."""
        bench = self.bench
        open_choices: list[list[Continuation]] = []
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
                self._note_failure(self.lines[depth], choice)
                bench.rewind_to(marks[depth])

    def _back(self, marks: list[int]) -> bool:
        """Undo the latest decision that stands; False if there is none."""
        if not marks:
            self._fail("F3", (), Reason(ReasonKind.UNMET))
            return False
        self.bench.rewind_to(marks[-1])
        return True

    def choices(self, line: TimelineState) -> list[Continuation]:
        """What may hold on `line` now, best first (T-REX 1.4)."""
        bench, tick, current = self.bench, self.tick, line.current
        if not line.is_internal:
            assert line.news is not None
            predicate = self.fitting(line, line.news)
            if predicate == NOTHING:
                return []
            meets = [
                Continuation(_MEET, token, predicate)
                for token in bench.planned_after(line.object_id, current)
                if bench.predicate_of(token) == predicate
                and bench.lower(bench.start(token)) <= tick <= bench.upper(bench.start(token))
            ]
            if any(self.dispatch.is_answered(meet.token, line.news.event) for meet in meets):
                return meets  # what was asked for has come: that is how the plan has to go on
            return [*meets, Continuation(_FACT, NOTHING, predicate)]
        extend: list[Continuation] = []
        if current != NOTHING:
            if bench.lower(bench.end(current)) > tick:
                return [Continuation(_EXTEND, current, NOTHING)]
            if bench.upper(bench.end(current)) > tick:
                extend = [Continuation(_EXTEND, current, NOTHING)]
        starts = [
            Continuation(_NEXT, token, NOTHING)
            for token in bench.planned_after(line.object_id, current)[:1]
            if bench.lower(bench.start(token)) <= tick <= bench.upper(bench.start(token))
        ]
        if not starts or not bench.is_requested(starts[0].token):
            starts = [Continuation(_NEXT, token, NOTHING) for token in bench.must_begin(line.object_id, tick)] + starts
        is_asked = bool(starts) and bench.is_requested(starts[0].token)
        if is_asked and self.is_last:
            starts = []  # what can begin at the end at the earliest is not begun
        is_due = bool(starts) and (line.is_early or is_asked)
        new = [
            Continuation(_NEW, NOTHING, p) for p in ([line.default, *line.others] if line.default >= 0 else line.others)
        ]
        if is_due:
            return [*starts, *extend, *new]
        if line.is_late and line.default >= 0:
            return [*extend, new[0], *starts, *new[1:]]
        return [*extend, *starts, *new]

    def fitting(self, line: TimelineState, news: Observation) -> int:
        """The predicate of what was observed; `undefined` if the model has none like it (T-REX 1.6)."""
        bench = self.bench
        predicate = line.predicates.get(news.predicate, NOTHING)
        if predicate != NOTHING and news.arguments:
            mark = bench.mark()
            token = bench.new_token(predicate, line.object_id, is_fact=True)
            fits = bench.restrict_parameters(token, news.arguments, SPAN_OBSERVATION)
            bench.rewind_to(mark)
            bench.release(mark)
            if fits:
                return predicate
        elif predicate != NOTHING:
            return predicate
        return line.predicates.get(_UNDEFINED, NOTHING)

    def apply(self, line: TimelineState, choice: Continuation) -> bool:
        """Carry out `choice`; False on conflict."""
        bench, tick = self.bench, self.tick
        token = choice.token
        if line.is_internal and line.current != NOTHING and choice.kind != _EXTEND:
            # Something holds at every tick: what held until now ends as the next thing begins.
            if not bench.fix(bench.end(line.current), tick, SPAN_EXECUTIVE, line.current):
                return False
        match choice.kind:
            case "extend":
                holds = bench.at_least(bench.end(token), tick + 1, SPAN_EXECUTIVE, token)
            case "next":
                if not bench.is_active(token):
                    holds = bench.activate(token) and bench.place_after(line.object_id, token, line.current)
                    if not holds:
                        return False
                holds = bench.fix(bench.start(token), tick, SPAN_EXECUTIVE, token) and bench.at_least(
                    bench.end(token), tick + 1, SPAN_EXECUTIVE, token
                )
            case "new":
                token = bench.new_token(choice.predicate, line.object_id, is_fact=False)
                holds = (
                    bench.fix(bench.start(token), tick, SPAN_EXECUTIVE, token)
                    and bench.at_least(bench.end(token), tick + 1, SPAN_EXECUTIVE, token)
                    and bench.activate(token)
                    and bench.place_after(line.object_id, token, line.current)
                )
            case _:
                assert line.news is not None
                token = self._observe(line, line.news, choice)
                holds = token != NOTHING
        self.made[len(self.made) - 1] = token
        return holds

    def _observe(self, line: TimelineState, news: Observation, choice: Continuation) -> int:
        """Insert what was observed as a fact, or let it meet the planned token `choice.token`; NOTHING on conflict."""
        bench, tick = self.bench, self.tick
        fact = bench.new_token(choice.predicate, line.object_id, is_fact=True)
        holds = bench.fix(bench.start(fact), tick, SPAN_OBSERVATION, fact)
        holds = holds and bench.at_least(bench.end(fact), tick + 1, SPAN_OBSERVATION, fact)
        if choice.predicate == line.predicates.get(news.predicate):
            holds = holds and bench.restrict_parameters(fact, news.arguments, SPAN_OBSERVATION)
        if not holds:
            return NOTHING
        if choice.kind == _MEET:
            return choice.token if bench.merge(fact, choice.token) else NOTHING
        if bench.activate(fact) and bench.place_after(line.object_id, fact, line.current):
            return fact
        return NOTHING

    def _finish(self) -> bool:
        """Let what has not started start later, and resolve the flaws of the present."""
        bench, tick = self.bench, self.tick
        for token in self.waiting():
            if self.is_last:
                break  # there is no later
            if not bench.at_least(bench.start(token), tick + 1, SPAN_CLOCK, token):
                code = "F6" if self.dispatch.is_refused(token) else "F1"
                self._fail(code, (), Reason(ReasonKind.DID_NOT_START, bench.name_of(token), tick=tick))
                return False
        outcome = self.planner.resolve_present(tick)
        if outcome in ("steps", "deep"):
            self.is_out_of_budget = True
            is_deep = outcome == "deep"
            limit = self.planner.max_depth if is_deep else self.planner.max_steps
            what = Reason(ReasonKind.DEPTH if is_deep else ReasonKind.STEPS, tick=tick, limit=limit)
            self.first = SyncFailure("F5", (), what, None)
            return False
        if outcome != "done":
            if self.first is None:
                what, conflict = self.planner.reason() if self.explains else (Reason(ReasonKind.NO_PLAN), None)
                deadlock = self.planner.deadlock() if self.explains else None
                self.first = SyncFailure("F3", (), what, conflict, deadlock)
            return False
        return True

    def waiting(self) -> list[int]:
        """Tokens that have not begun: all behind the current one of a timeline, and others that still may wait."""
        decided = dict(zip((line.name for line in self.lines), self.made, strict=True))
        found: dict[int, None] = {}
        for line in self.timelines:
            found |= dict.fromkeys(self.bench.planned_after(line.object_id, decided.get(line.name, line.current)))
        return list(found | dict.fromkeys(self.bench.unplaced(self.tick)))

    def _note(self) -> None:
        """Keep what was decided."""
        for line, token in zip(self.lines, self.made, strict=True):
            line.current = token

    def _note_failure(self, line: TimelineState, choice: Continuation) -> None:
        code = "F3" if line.is_internal else "F8" if line.news and line.news.predicate == "Failed" else "F2"
        match choice.kind:
            case "extend":
                what = Reason(ReasonKind.CANNOT_GO_ON, self.bench.name_of(choice.token), tick=self.tick)
            case "next" | "meet":
                what = Reason(ReasonKind.CANNOT_START, self.bench.name_of(choice.token), tick=self.tick)
            case _:
                predicate = self.bench.predicate_name(choice.predicate)
                what = Reason(ReasonKind.NONE_CAN_START, predicate=predicate, tick=self.tick)
        self._fail(code, (line.name,), what, self.lines.index(line))

    def _fail(self, code: str, timelines: tuple[str, ...], what: Reason, depth: int = NOTHING) -> None:
        """Remember what went wrong, unless something did before."""
        if self.first is None:
            self.first = SyncFailure(code, timelines, what, conflict_of(self.bench) if self.explains else None)
            self.first_depth = depth
