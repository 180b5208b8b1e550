"""Find out what a rule may have meant where nobody recorded its run: children among the tokens of the plan, branches.

A plan written by hand, and a trace, say which tokens there were, not which of them answered which rule. Each child is
tried among the tokens that fit by predicate, object and relation; the first choice under which all holds is taken.
"""

from collections.abc import Callable, Iterator
from math import inf

from checker.judge.bench import Bench, Tok
from checker.judge.operands import BodyFrame, VariableNames
from checker.judge.relations import Demand
from checker.judge.values import difference, hull, may_be_equal
from compiler.program import END, OBJECT, START, Child
from runtime.executive.record import NOBODY, BodyRun, GuardRun, Value

MOST_TRIES = 2000


class _RunLog:
    """What a run of a body would have on record."""

    def __init__(self) -> None:
        self.locals: list[Value] = []
        self.children: list[int] = []
        self.guards: list[GuardRun] = []

    def run(self, rule: int) -> BodyRun:
        """The run, as records have it."""
        return BodyRun(rule, tuple(self.locals), tuple(self.children), tuple(self.guards))


class Choosing:
    """The choices of one run of a rule: the n-th child takes candidate number `taken[n]`."""

    def __init__(self, rule: int) -> None:
        self.rule = rule
        self.taken: list[int] = []
        self.counts: list[int] = []
        self.known: set[int] = set()  # slots of locals whose values were inferred
        self.log = _RunLog()

    def begin(self) -> None:
        """Run the rule again from its start."""
        self.counts = []
        self.log = _RunLog()

    def run(self) -> BodyRun:
        """The run, as records have it."""
        return self.log.run(self.rule)

    def branch(self, truth: bool | None, carry_out: Callable[[], None] | None) -> None:
        """Note which branch of a guard is taken, None for neither, and what it does."""
        if truth is None:
            self.log.guards.append(GuardRun("waiting", False, None))
            return
        outer, self.log = self.log, _RunLog()
        if carry_out is not None:
            carry_out()
        run = self.run() if carry_out is not None else None
        outer.guards.append(GuardRun("then" if truth else "else", True, run))
        self.log = outer

    def pick(
        self, frame: BodyFrame, child: Child, pairs: tuple[Demand, ...], holder: Value | None, names: VariableNames
    ) -> int:
        """The key of the token that this child is taken to be; NOBODY for none of the plan."""
        n = len(self.counts)
        found = _candidates(frame, child, pairs, holder, names)
        is_outside = may_be_outside(frame.bench, child, pairs, frame.tokens[child.origin])
        if is_outside or is_left_open(frame, child, holder, names):
            found.append(NOBODY)
        self.counts.append(len(found))
        if n == len(self.taken):
            self.taken.append(0)
        key = found[self.taken[n]] if found else NOBODY
        self.log.children.append(key)
        return key

    def advance(self) -> bool:
        """Go on to the next choices; False if there are none."""
        del self.taken[len(self.counts) :]
        while self.taken:
            self.taken[-1] += 1
            if self.taken[-1] < self.counts[len(self.taken) - 1]:
                return True
            self.taken.pop()
        return False


def _candidates(
    frame: BodyFrame, child: Child, pairs: tuple[Demand, ...], holder: Value | None, names: VariableNames
) -> list[int]:
    """The tokens of a plan that may be what a rule asks for."""
    origin = frame.tokens[child.origin]
    return [
        tok.key
        for tok in _of_predicate(frame, child, names)
        if holder is None or may_be_equal(tok.values[OBJECT], holder)
        if origin is None or _is_related(pairs, origin, tok)
    ]


def is_left_open(frame: BodyFrame, child: Child, holder: Value | None, names: VariableNames) -> bool:
    """Whether the plan has an inactive token that may be the child: a planner leaves those beyond its horizon."""
    fitting = _of_predicate(frame, child, names, "inactive")
    return any(holder is None or may_be_equal(tok.values[OBJECT], holder) for tok in fitting)


def _of_predicate(frame: BodyFrame, child: Child, names: VariableNames, state: str = "active") -> Iterator[Tok]:
    """The tokens in a state of the predicate that a rule asks for."""
    wanted_class, _, suffix = child.predicate.rpartition(".")
    for record in frame.bench.tokens.records():
        class_name, _, name = record.predicate.rpartition(".")
        if name == suffix and record.state == state and names.is_kind_of(class_name, wanted_class):
            tok = frame.bench.tokens.get(record.key)
            assert tok is not None
            yield tok


def nearest_of(
    frame: BodyFrame, child: Child, pairs: tuple[Demand, ...], holder: Value | None, names: VariableNames
) -> tuple[tuple[Tok, ...], tuple[tuple[str, Value], ...]]:
    """The token that comes nearest to what a rule asks for in vain, and the values in the way; nothing if none does."""
    origin = frame.tokens[child.origin]
    best: tuple[float, Tok, tuple[tuple[str, Value], ...]] | None = None
    for tok in _of_predicate(frame, child, names):
        if holder is not None and not may_be_equal(tok.values[OBJECT], holder):
            far, values = inf, _objects(tok, holder)
        elif origin is not None:
            far, values = _missed(pairs, origin, tok)
        else:
            continue
        if best is None or far < best[0]:
            best = (far, tok, values)
    return ((), ()) if best is None else ((best[1],), best[2])


def _objects(tok: Tok, holder: Value) -> tuple[tuple[str, Value], ...]:
    return (("object", tok.values[OBJECT]), ("asked", holder))


def _missed(pairs: tuple[Demand, ...], origin: Tok, target: Tok) -> tuple[float, tuple[tuple[str, Value], ...]]:
    """By how many ticks two tokens miss a relation, and the times of which that is so."""
    times = [(tok, index) for tok in (origin, target) for index in (START, END)]
    most = 0.0
    found: tuple[tuple[str, Value], ...] = ()
    for first, second, lower, upper in pairs:
        (a, start), (b, end) = times[first], times[second]
        gap = hull(difference(b.values[end], a.values[start])) or (-inf, inf)
        far = max(gap[0] - upper, lower - gap[1])
        if far > most:
            points = {START: "start", END: "end"}
            named = ((f"{a.name}.{points[start]}", a.values[start]), (f"{b.name}.{points[end]}", b.values[end]))
            bound = ("distance at least", lower) if gap[1] < lower else ("distance at most", upper)
            most, found = far, (*named, bound)
    return most, found


def _is_related(pairs: tuple[Demand, ...], origin: Tok, target: Tok) -> bool:
    """Whether two tokens may be in a relation."""
    times = (origin.values[START], origin.values[END], target.values[START], target.values[END])
    for first, second, lower, upper in pairs:
        gap = hull(difference(times[second], times[first])) or (-inf, inf)
        if gap[0] > upper or gap[1] < lower:
            return False
    return True


def may_be_outside(bench: Bench, child: Child, pairs: tuple[Demand, ...], origin: Tok | None) -> bool:
    """Whether a missing child may lie after the end of what is known, or on a timeline that nobody told of."""
    class_name = child.predicate.rpartition(".")[0]
    if bench.told is not None and class_name not in bench.told:
        return True
    if bench.is_whole:
        return False
    if origin is None:
        return True
    for first, second, lower, upper in pairs:
        known = origin.values[START + first] if first < 2 else origin.values[START + second]
        ends = hull(known)
        if ends is None:
            return True
        latest = ends[1] + upper if first < 2 <= second else ends[1] - lower if second < 2 <= first else inf
        if latest <= bench.last_tick:
            return False
    return True
