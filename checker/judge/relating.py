"""Judge children and relations: is the token that a rule asks for there, and do their times agree."""

from collections.abc import Callable

from checker.judge.bench import Bench, Tok
from checker.judge.choosing import is_left_open, may_be_outside, nearest_of
from checker.judge.meanings import equal
from checker.judge.operands import BodyFrame, VariableNames, member_of, reader
from checker.judge.relations import OE, OS, TE, demands
from checker.judge.values import difference, ends_of, hull
from compiler.program import END, OBJECT, START, Child, Relate
from nddl_lang.text.source import Span
from runtime.executive.record import NOBODY, Value

Step = Callable[[BodyFrame], None]
LEFT_OPEN = ("left open", "the others determine it")
CUT_OFF = "a token that was cut off by a repair"


def child_step(child: Child, names: VariableNames) -> Step:
    slot, origin = child.slot, child.origin
    pairs = demands(child.relation, child.bounds)
    given = None if isinstance(child.object, str) else reader(child.object, names)
    suffix = child.predicate.rpartition(".")[2]
    label = child.label or suffix

    def step(frame: BodyFrame) -> None:
        bench, parent = frame.bench, frame.tok
        assert parent is not None
        frame.tokens[slot] = None
        if frame.choosing is not None:
            holder = parent.values[OBJECT] if child.object == "own" else None if given is None else given(frame)
            key = frame.choosing.pick(frame, child, pairs, holder, names)
            if key == NOBODY and may_be_outside(bench, child, pairs, frame.tokens[origin]):
                bench.skip("a child that lies outside of what is told")
                return
            if key == NOBODY and is_left_open(frame, child, holder, names):
                bench.skip("a child that the plan leaves inactive")
                return
            if key == NOBODY:
                near, missed = nearest_of(frame, child, pairs, holder, names)
                what = "no token of the plan fits"
                bench.report("child", label, (parent, *near), missed, "asked for", what, child.span)
                return
        else:
            key = next(frame.children, NOBODY)
        tok = bench.tokens.get(key)
        if key == NOBODY:
            if not _may_be_missing(bench, child, pairs, parent, frame.tokens[origin]):
                bench.report("child", label, (parent,), (), "asked for", "not on record", child.span)
                return
            bench.skip("a child is not on record")
            return
        if tok is None:
            bench.report("child", label, (parent,), (), "asked for", "gone without a record", child.span)
            return
        predicate = tok.record.predicate
        if predicate != child.predicate and not (
            child.object == "own"
            and predicate.rpartition(".")[2] == suffix
            and names.is_kind_of(predicate.rpartition(".")[0], child.predicate.rpartition(".")[0])
        ):
            bench.report("child", label, (parent, tok), (), predicate, child.predicate, child.span)
            return
        frame.tokens[slot] = tok
        holder = parent.values[OBJECT] if child.object == "own" else None if given is None else given(frame)
        if holder is not None and not bench.weigh(equal(tok.values[OBJECT], holder)):
            objects: tuple[tuple[str, Value], ...] = (("object", tok.values[OBJECT]), ("asked", holder))
            bench.report("child", label, (parent, tok), objects, "on its object", "on another", child.span)
        first = frame.tokens[origin]
        if first is None:
            return
        if tok.is_outdated or first.is_outdated:
            bench.skip(CUT_OFF)
            return
        if not tok.is_planned and member_of(bench, names, tok.values[OBJECT], "mode") == "Ignore":
            bench.skip("a child on a timeline that the model ignores")
            return
        if not tok.is_planned and _is_due(bench, first, tok, pairs):
            bench.report("child", label, (parent, tok), (), tok.record.state, "was due and never came", child.span)
            return
        _relate(frame, child.relation, pairs, first, tok, child.span)

    return step


def _may_be_missing(
    bench: Bench, child: Child, pairs: tuple[tuple[int, int, float, float], ...], parent: Tok, origin: Tok | None
) -> bool:
    """Whether a running rule may have lost a child: to a repair, with its reactor, or outside of the mission."""
    if bench.last_repair >= 0 or bench.has_failed or not parent.is_planned or parent.is_outdated:
        return True
    if ends_of(parent.values[END])[1] <= 0 or ends_of(parent.values[START])[0] >= bench.final_tick:
        return True
    return may_be_outside(bench, child, pairs, origin)


def _is_due(bench: Bench, origin: Tok, tok: Tok, pairs: tuple[tuple[int, int, float, float], ...]) -> bool:
    """Whether a relation to a token in the plan leaves no time after the last tick for `tok` to begin or end.

    What ends before the mission asks for nothing in it, and of what begins at its end nobody plans the children.
    """
    if not origin.is_planned or bench.has_failed:
        return False
    if ends_of(origin.values[END])[1] <= 0 or ends_of(origin.values[START])[0] >= bench.final_tick:
        return False
    for first, second, lower, upper in pairs:
        if first < 2 <= second:
            ends = hull(origin.values[START + first])
            latest = None if ends is None else ends[1] + upper
            point = second
        elif second < 2 <= first:
            ends = hull(origin.values[START + second])
            latest = None if ends is None else ends[1] - lower
            point = first
        else:
            continue
        if latest is not None and latest < bench.last_tick + (1 if point == TE else 0):
            return True
    return False


def _relate(
    frame: BodyFrame, name: str, pairs: tuple[tuple[int, int, float, float], ...], origin: Tok, target: Tok, span: Span
) -> None:
    """Judge a relation between two tokens."""
    bench = frame.bench
    times = (origin.values[START], origin.values[END], target.values[START], target.values[END])
    said = ("it holds", "it does not")
    for first, second, lower, upper in pairs:
        a, b = times[first], times[second]
        if isinstance(a, int) and isinstance(b, int):
            bench.judged += 1
            if lower <= b - a <= upper:
                continue
        else:
            gap = hull(difference(b, a))
            bench.open += 1
            if lower == upper and target.is_planned and (isinstance(a, int) or isinstance(b, int)):
                said = LEFT_OPEN
            elif gap is None or (gap[0] <= upper and lower <= gap[1]):
                continue
        points = ("start", "end", "start", "end")
        values = (
            (f"{(origin if first in (OS, OE) else target).name}.{points[first]}", a),
            (f"{(origin if second in (OS, OE) else target).name}.{points[second]}", b),
        )
        bench.report("relation", name, (origin, target), values, *said, span)
        return


def relate_step(given: Relate) -> Step:
    pairs = demands(given.relation, given.bounds)

    def step(frame: BodyFrame) -> None:
        origin, target = frame.tokens[given.origin], frame.tokens[given.target]
        if origin is None or target is None:
            frame.bench.skip("a child is not on record")
        elif origin.is_outdated or target.is_outdated:
            frame.bench.skip(CUT_OFF)
        else:
            _relate(frame, given.relation, pairs, origin, target, given.span)

    return step
