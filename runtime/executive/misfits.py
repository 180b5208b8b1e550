"""A request that cannot be posted in; the reason, which is its arguments or its times, out."""

from runtime.executive.messages import Request
from runtime.executive.outcome import Reason, ReasonKind
from runtime.executive.view import SPAN_REQUEST
from runtime.executive.workbench import Workbench
from runtime.plan.tags import INFINITY


def misfit(bench: Workbench, predicate: int, object_id: int, request: Request) -> Reason:
    """Why no token of a predicate can be as a request asks: by its arguments alone, its times alone, or by both."""
    if not _fits(bench, predicate, object_id, request, by_times=False):
        return Reason(ReasonKind.MISFIT, message=bench.unknown_argument(predicate, request.arguments))
    times = (("start", request.start), ("end", request.end), ("duration", request.duration))
    asked = ", ".join(f"{name} {_text(bounds)}" for name, bounds in times if _is_bounded(name, bounds))
    if _fits(bench, predicate, object_id, request, by_times=True):
        return Reason(ReasonKind.TIMES, message=f" its arguments: {asked}")
    return Reason(ReasonKind.TIMES, message=f": {asked}")


def _fits(bench: Workbench, predicate: int, object_id: int, request: Request, *, by_times: bool) -> bool:
    """Whether a token can have the times of a request, or its arguments; the plan stays as it was."""
    mark = bench.mark()
    token = bench.new_goal(predicate, object_id)
    if by_times:
        fits = (
            bench.within(bench.start(token), request.start, SPAN_REQUEST, token)
            and bench.within(bench.end(token), request.end, SPAN_REQUEST, token)
            and bench.within(bench.duration(token), request.duration, SPAN_REQUEST, token)
        )
    else:
        fits = bench.restrict_parameters(token, request.arguments, SPAN_REQUEST)
    bench.rewind_to(mark)
    bench.commit()
    return fits


def _is_bounded(name: str, bounds: tuple[int, int]) -> bool:
    lowest = 1 if name == "duration" else 0
    return bounds[0] > lowest or bounds[1] < INFINITY


def _text(bounds: tuple[int, int]) -> str:
    lower, upper = bounds
    return str(lower) if lower == upper else f"[{lower} {'+inf' if upper >= INFINITY else upper}]"
