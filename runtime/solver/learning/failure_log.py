"""Keep account of why choices failed while a search runs, so that it can say why there is no plan.

For explanations only: each failed choice is explained and shrunk to a minimal set of causes, which costs far more than
the search itself. After `MOST` failures the account stays as it is.
"""

from dataclasses import dataclass
from typing import Protocol

from runtime.constraints.explanation.cause import Cause
from runtime.constraints.minimisation.minimise import minimise
from runtime.plan.database import PlanDatabase
from runtime.plan.lifecycle import fire, merge
from runtime.plan.tags import MERGED, NONE, OBJECT, REJECTED
from runtime.plan.tokens.predicate_hierarchy import first_active, next_active
from runtime.plan.tokens.timelines import order
from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.learning.rendering import Line, Wording
from runtime.solver.tags import CUSTOM, OPEN_CONDITION, THREAT, UNBOUND_VARIABLE

MOST = 400
MOST_TRIALS = 20


@dataclass(frozen=True, slots=True)
class Attempt:
    """A choice that failed: by a conflict of `lines`, or because nothing mends what it leads to."""

    choice: str
    lines: tuple[Line, ...]
    because: "Failure | None" = None


@dataclass(frozen=True, slots=True)
class Failure:
    """A flaw that no choice mends."""

    flaw: str
    attempts: tuple[Attempt, ...]


class Account(Protocol):
    """What a search tells of its failures."""

    def contradicted(self) -> None: ...
    def failed(self, d: int) -> None: ...
    def rejected(self, d: int) -> None: ...
    def given_up(self, d: int, heir: int) -> None: ...


class Recorder:
    """The account of one search: why it ended, and why tokens were rejected."""

    def __init__(self, database: PlanDatabase, queues: Queues, stack: Decisions) -> None:
        self.database = database
        self.plan = database.plan
        self.queues = queues
        self.stack = stack
        self.count = 0
        self.attempts: dict[int, list[Attempt]] = {}
        self.reasons: dict[str, Failure] = {}
        self.end: Failure | None = None

    def contradiction(self) -> Failure:
        """Why the model contradicts itself before any decision."""
        lines = self.lines(Wording(self.database))
        return Failure("the model contradicts itself", (Attempt("before any decision", lines),))

    def contradicted(self) -> None:
        """There is a conflict before any decision."""
        self.end = self.contradiction()

    def failed(self, d: int) -> None:
        """The present choice of decision `d` has failed; the conflict is still there."""
        if self.count < MOST:
            self.count += 1
            wording = Wording(self.database)
            self.note(d, Attempt(self.choice(d, wording), self.lines(wording)))

    def rejected(self, d: int) -> None:
        """Decision `d` has rejected a token."""
        wording = Wording(self.database)
        name = wording.token(self.stack.item[d])
        self.reasons[name] = Failure(self.flaw(d, wording), tuple(self.attempts.get(d, ())))

    def given_up(self, d: int, heir: int) -> None:
        """Decision `d` has no choice left; `heir` is where the search goes on (NONE: nowhere)."""
        wording = Wording(self.database)
        if self.count < MOST:
            self.try_what_was_left_out(d, wording)
        failure = Failure(self.flaw(d, wording), tuple(self.attempts.pop(d, ())))
        for other in range(max(heir, 0) + 1, d):
            self.attempts.pop(other, None)
        if heir < 0:
            self.end = failure
        else:
            self.note(heir, Attempt(self.choice(heir, wording), (), failure))

    def note(self, d: int, attempt: Attempt) -> None:
        """Add to what is known of decision `d`; the same is not told twice."""
        known = self.attempts.setdefault(d, [])
        if attempt not in known:
            known.append(attempt)

    def lines(self, wording: Wording) -> tuple[Line, ...]:
        """The lines of the present conflict, as few as it needs; those that have no place in the model come last."""
        engine = self.database.engine
        found = sorted(engine.explain(), key=lambda cause: cause.span < 0)  # what the model says is kept rather
        causes: list[Cause] = minimise(engine, found)
        lines = dict.fromkeys(wording.line(cause) for cause in causes)
        if any(line.how == "so" for line in lines):  # it says who uses what, and what there is
            lines = dict.fromkeys(line for line in lines if line.span is not None or line.how != "declared")
        return tuple(sorted(lines, key=place_of))

    # ---- words ----

    def flaw(self, d: int, wording: Wording) -> str:
        """What decision `d` mends."""
        item, kind = self.stack.item[d], self.stack.kind[d]
        if kind == OPEN_CONDITION:
            predicate = self.database.program.predicates[self.plan.rows.predicate[item]].name
            return f"`{wording.token(item)}` ({predicate}) is not in the plan yet"
        if kind == THREAT:
            return f"`{wording.token(item)}` has no place on its timeline yet"
        if kind == UNBOUND_VARIABLE:
            return f"`{wording.variable(item)}` has no value yet"
        if kind == CUSTOM:
            return f"flaw {item} is not mended yet"
        return f"`{self.database.objects.names[item]}` might be used too much at {self.stack.other[d]}"

    def choice(self, d: int, wording: Wording) -> str:
        """What decision `d` has chosen, while it is in force."""
        stack, rows = self.stack, self.plan.rows
        item, kind = stack.item[d], stack.kind[d]
        if kind == OPEN_CONDITION:
            if rows.status[item] == MERGED:
                return f"merge it with `{wording.token(rows.merged_into[item])}`"
            if rows.status[item] == REJECTED:
                return "reject it"
            way = stack.cursor[d]
            first, last = self.queues.supports.first[rows.predicate[item] : rows.predicate[item] + 2]
            if 0 <= way < last - first:
                action = self.queues.supports.action[first + way]
                return f"have `{self.database.program.predicates[action].name}` bring it about, or activate it"
            return "activate it"
        if kind == UNBOUND_VARIABLE:
            return f"give it the value {wording.value(item)}"
        if kind == CUSTOM:
            return f"choice {stack.tries[d]}"
        at = stack.pool_first[d] + max(stack.cursor[d], 0)
        before, after = stack.pool_before[at], stack.pool_after[at]
        if kind == THREAT:
            return self.place(stack.pool_object[at], before, after, item, wording)
        return f"put {wording.variable(before)} before {wording.variable(after)}"

    def place(self, o: int, before: int, after: int, t: int, wording: Wording) -> str:
        """A place on a timeline."""
        name = self.database.objects.names[o]
        if before == after:
            return f"put it on `{name}`"
        if before == t:
            return f"put it before `{wording.token(after)}` on `{name}`"
        return f"put it after `{wording.token(before)}` on `{name}`"

    # ---- what the search saw at a glance ----

    def try_what_was_left_out(self, d: int, wording: Wording) -> None:
        """Carry out what was not worth trying, to see why."""
        item = self.stack.item[d]
        if self.stack.kind[d] == THREAT:
            self.try_places(d, item, wording)
        elif self.stack.kind[d] == OPEN_CONDITION:
            rows = self.plan.rows
            other = first_active(self.plan, rows.predicate[item])
            trials = 0
            while other >= 0 and trials < MOST_TRIALS:
                mark = self.database.mark()
                if not merge(self.plan, item, other, NONE):
                    self.note(d, Attempt(f"merge it with `{wording.token(other)}`", self.lines(wording)))
                self.database.release(mark)
                other = next_active(self.plan, other, rows.predicate[item])
                trials += 1

    def try_places(self, d: int, t: int, wording: Wording) -> None:
        """Try every place of a token on every timeline that it may be on."""
        v = self.plan.rows.var0[t] + OBJECT
        trials = 0
        for value in self.database.engine.values_of(v):
            o = int(value)
            if not self.plan.object_timeline[o]:
                continue
            count = self.queues.take_sequence(o)
            sequence = list(self.queues.sequence[:count])
            places = [(t, other) for other in sequence] + [(sequence[-1], t)] if sequence else [(t, t)]
            for before, after in places:
                trials += 1
                if trials > MOST_TRIALS:
                    return
                mark = self.database.mark()
                if not (order(self.plan, o, before, after, NONE) and fire(self.plan)):
                    self.note(d, Attempt(self.place(o, before, after, t, wording), self.lines(wording)))
                self.database.release(mark)


def place_of(line: Line) -> tuple[int, str, int, str]:
    """What sorts lines: what they come to, then by place in the text, then those without one."""
    if line.span is None:
        return (0 if line.how == "so" else 2, "", 0, line.text)
    return (1, line.span.source.name, line.span.begin, line.text)
