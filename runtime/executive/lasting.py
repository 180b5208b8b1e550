"""Let what holds go on: while the reactor slept, and where no news has come (T-REX 1.4)."""

from runtime.executive.dispatch import Dispatch
from runtime.executive.outcome import Reason, ReasonKind
from runtime.executive.reactor import SyncFailure, code_of_news
from runtime.executive.story import conflict_of
from runtime.executive.timelines import NOTHING, TimelineState
from runtime.executive.view import SPAN_EXECUTIVE, SPAN_OBSERVATION
from runtime.executive.workbench import Workbench


def last_until(bench: Workbench, timelines: list[TimelineState], tick: int) -> SyncFailure | None:
    """What holds has gone on to `tick`, for good; on failure the plan stays as it was."""
    mark = bench.mark()
    failure = go_on(bench, timelines, tick)
    if failure is not None:
        bench.rewind_to(mark)
    bench.commit()
    return failure


def go_on(bench: Workbench, timelines: list[TimelineState], tick: int) -> SyncFailure | None:
    """What holds has gone on while the reactor slept; on failure the caller rewinds."""
    for line in timelines:
        span = SPAN_EXECUTIVE if line.is_internal else SPAN_OBSERVATION
        if line.current != NOTHING and not bench.at_least(bench.end(line.current), tick, span, line.current):
            what = why_not(ReasonKind.CANNOT_GO_ON, bench, line.current, tick)
            return SyncFailure("F3" if line.is_internal else "F1", (line.name,), what, conflict_of(bench))
    return None


def persist(bench: Workbench, timelines: list[TimelineState], tick: int, asked: Dispatch) -> SyncFailure | None:
    """No news means no change: what is observed on other reactors' timelines goes on; a new value ends it."""
    for line in timelines:
        if line.is_internal or line.current == NOTHING:
            continue
        if line.news is None:
            if not bench.at_least(bench.end(line.current), tick + 1, SPAN_OBSERVATION, line.current):
                what = why_not(ReasonKind.GOES_ON, bench, line.current, tick)
                following = bench.next_of(line.object_id, line.current)
                code = "F6" if following >= 0 and asked.is_refused(following) else "F1"
                return SyncFailure(code, (line.name,), what, conflict_of(bench))
        elif not bench.end_observed(line.current, tick):
            what = why_not(ReasonKind.ENDED, bench, line.current, tick)
            return SyncFailure(code_of_news(line.news), (line.name,), what, conflict_of(bench))
    return None


def why_not(kind: ReasonKind, bench: Workbench, token: int, tick: int) -> Reason:
    """What is wrong with a token that holds at a tick."""
    start = bench.started_at(token)
    return Reason(kind, bench.name_of(token), tick=tick, since=int(start) if start >= 0 else None)
