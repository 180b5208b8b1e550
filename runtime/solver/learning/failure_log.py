"""Failure log: which resolvers failed for which flaws, and the causes, as data; words are made in `rendering.py`.

For explanations only: each failure is explained and minimised, which costs far more than the search itself. After
`_MOST` failures the log stays as it is; of what the search had pruned, `_MOST_PRUNED` are tried.
"""

from collections import Counter
from collections.abc import Callable

from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import FLAG_DECISION
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.minimisation.minimise import minimise
from runtime.limits import TIME_LIMIT
from runtime.plan.database import PlanDatabase
from runtime.plan.lifecycle import fire, merge
from runtime.plan.readout.cause_rendering import words
from runtime.plan.readout.open_levels import level_users, open_level
from runtime.plan.readout.readout import live_tokens, span_of, token_names
from runtime.plan.readout.statements import ResourceTerm
from runtime.plan.readout.terms import TermReader
from runtime.plan.tags import MERGED, NONE, OBJECT, REJECTED
from runtime.plan.tokens.predicate_hierarchy import first_active, next_active
from runtime.plan.tokens.timelines import order
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.learning.attempts import Attempt, CauseOrigin, FailedFlaw, Flaw, FoundCause, Resolver, ResolverKind
from runtime.solver.tags import OPEN_CONDITION, THREAT, UNBOUND_VARIABLE

_MOST = 400
_MOST_PRUNED = 200
_MOST_TRIALS = 20


class FailureLog:
    """The failures of one search: why it ended, and why tokens were rejected."""

    def __init__(
        self,
        database: PlanDatabase,
        agenda: Agenda,
        stack: Decisions,
        reader: Callable[[], TermReader] | None = None,
    ) -> None:
        """`reader` gives names as the plan stands when it is called; by default they are those of the script."""
        self.database = database
        self.plan = database.plan
        self.agenda = agenda
        self.stack = stack
        self._reader = reader or self._script_reader
        self.count = self.pruned = 0
        self.blamed: Counter[Span] = Counter()  # the lines that failures named, how many
        self.attempts: dict[int, list[Attempt]] = {}
        self.rejections: dict[str, FailedFlaw] = {}
        self.end: FailedFlaw | None = None

    def note_contradiction(self) -> FailedFlaw:
        """There is a conflict before any decision."""
        attempt = self._attempt(Resolver(ResolverKind.PROPAGATE), self._reader())
        self.end = FailedFlaw(Flaw(NONE), (attempt,))
        return self.end

    def note_failure(self, d: int) -> None:
        """The resolver that decision `d` has chosen has failed; the conflict is still there."""
        if self.count < _MOST:
            self.count += 1
            reader = self._reader()
            self._add(d, self._blaming(self._resolver(d, reader), reader))

    def note_rejection(self, d: int) -> None:
        """Decision `d` is in force: note it if it has rejected a token."""
        item = self.stack.item[d]
        if self.stack.kind[d] != OPEN_CONDITION or self.plan.rows.status[item] != REJECTED:
            return
        reader = self._reader()
        self.rejections[reader.token(item)] = FailedFlaw(self._flaw(d, reader), tuple(self.attempts.get(d, ())))

    def note_dead_end(self, d: int, heir: int) -> None:
        """Decision `d` has no resolver left; the search goes on at `heir` (NONE: nowhere)."""
        reader = self._reader()
        if self.count < _MOST and self.pruned < _MOST_PRUNED and not self._is_late():
            self._try_pruned(d, reader)
        failed = FailedFlaw(self._flaw(d, reader), tuple(self.attempts.pop(d, ())))
        for other in range(max(heir, 0) + 1, d):
            self.attempts.pop(other, None)
        if heir < 0:
            self.end = failed
        else:
            self._add(heir, Attempt(self._resolver(heir, reader), (), failed))

    def _is_late(self) -> bool:
        """Whether the time of the mission is over, and something that stands in the way is known."""
        return self.count + self.pruned > 0 and TIME_LIMIT.is_over()

    def _add(self, d: int, attempt: Attempt) -> None:
        """Add to the attempts of decision `d`, each once."""
        known = self.attempts.setdefault(d, [])
        if attempt not in known:
            known.append(attempt)

    def _script_reader(self) -> TermReader:
        """Names as the plan stands now."""
        names = token_names(self.database, live_tokens(self.database))
        return TermReader(self.database, lambda t: names.get(t, f"token {t}"))

    def _blaming(self, resolver: Resolver, reader: TermReader) -> Attempt:
        """The causes of the present conflict, whose lines are blamed for it."""
        attempt = self._attempt(resolver, reader)
        self.blamed.update({cause.span for cause in attempt.causes if cause.span is not None})
        return attempt

    def _attempt(self, resolver: Resolver, reader: TermReader) -> Attempt:
        """The minimal causes of the present conflict; those without a source place come last."""
        engine = self.database.engine
        found = sorted(engine.explain(), key=lambda cause: cause.span < 0)  # source lines are the last to be dropped
        causes = dict.fromkeys(self._cause(cause, reader) for cause in minimise(engine, found))
        implied = any(cause.origin is CauseOrigin.IMPLIED for cause in causes)  # it tells the users and the limits
        told = [one for one in causes if implied and not one.span and one.origin is CauseOrigin.DECLARED]
        rest = sorted((one for one in causes if one not in told), key=_rank)
        return Attempt(resolver, tuple(rest), told=tuple(told))

    def _cause(self, cause: Cause, reader: TermReader) -> FoundCause:
        term = reader.term(cause)
        if isinstance(term, ResourceTerm):
            return FoundCause(None, "", term, CauseOrigin.IMPLIED)
        flags = self.database.engine.restriction_flags
        is_declared = cause.kind is CauseKind.RESTRICTION and not flags[cause.id] & FLAG_DECISION
        owner = reader.token(cause.owner) if cause.owner >= 0 else ""
        origin = CauseOrigin.DECLARED if is_declared else CauseOrigin.DECIDED
        return FoundCause(span_of(self.database, cause.span), owner, term, origin, cause.span)

    def _flaw(self, d: int, reader: TermReader) -> Flaw:
        """The flaw of decision `d`."""
        item, kind = self.stack.item[d], self.stack.kind[d]
        if kind == OPEN_CONDITION:
            predicate = self.database.program.predicates[self.plan.rows.predicate[item]].name
            return Flaw(kind, reader.token(item), predicate)
        if kind == THREAT:
            return Flaw(kind, reader.token(item))
        if kind == UNBOUND_VARIABLE:
            return Flaw(kind, reader.variable(item))
        at, level = self.stack.instant[d], open_level(self.database, item)
        if level is None or level.at != at:  # of a resource with a "GroundedProfile", which is judged otherwise
            return Flaw(kind, self.database.objects.names[item], at=at)
        users = level_users(self.database, item, at, level.is_low, reader.token)
        return Flaw(kind, level.resource, at=at, level=level, users=tuple(users))

    def _resolver(self, d: int, reader: TermReader) -> Resolver:
        """What decision `d` has chosen, while it is in force."""
        stack, rows = self.stack, self.plan.rows
        item, kind = stack.item[d], stack.kind[d]
        if kind == OPEN_CONDITION:
            if rows.status[item] == MERGED:
                return Resolver(ResolverKind.MERGE, (reader.token(rows.merged_into[item]),))
            if rows.status[item] == REJECTED:
                return Resolver(ResolverKind.REJECT)
            way = stack.cursor[d]
            first, last = self.agenda.supports.first[rows.predicate[item] : rows.predicate[item] + 2]
            if 0 <= way < last - first:
                action = self.agenda.supports.action[first + way]
                return Resolver(ResolverKind.SUPPORT, (self.database.program.predicates[action].name,))
            return Resolver(ResolverKind.ACTIVATE)
        if kind == UNBOUND_VARIABLE:
            return Resolver(ResolverKind.SPECIFY, (reader.value(item),))
        at = stack.pool_first[d] + max(stack.cursor[d], 0)
        before, after = stack.pool_before[at], stack.pool_after[at]
        if kind == THREAT:
            return self._insertion(stack.pool_object[at], before, after, item, reader)
        return Resolver(ResolverKind.PRECEDE, (reader.variable(before), reader.variable(after)))

    def _insertion(self, o: int, before: int, after: int, t: int, reader: TermReader) -> Resolver:
        name = self.database.objects.names[o]
        if before == after:
            return Resolver(ResolverKind.INSERT_ONLY, (name,))
        if before == t:
            return Resolver(ResolverKind.INSERT_BEFORE, (name, reader.token(after)))
        return Resolver(ResolverKind.INSERT_AFTER, (name, reader.token(before)))

    # ---- resolvers that the search pruned ----

    def _try_pruned(self, d: int, reader: TermReader) -> None:
        """Carry out resolvers that the search pruned, for the causes."""
        item = self.stack.item[d]
        if self.stack.kind[d] == THREAT:
            self._try_insertions(d, item, reader)
        elif self.stack.kind[d] == OPEN_CONDITION:
            rows = self.plan.rows
            other = first_active(self.plan, rows.predicate[item])
            trials = 0
            while other >= 0 and trials < _MOST_TRIALS and not self._is_late():
                mark = self.database.mark()
                if not merge(self.plan, item, other, NONE):
                    resolver = Resolver(ResolverKind.MERGE, (reader.token(other),))
                    self._add_pruned(d, resolver, reader)
                self.database.release(mark)
                other = next_active(self.plan, other, rows.predicate[item])
                trials += 1

    def _add_pruned(self, d: int, resolver: Resolver, reader: TermReader) -> None:
        self.pruned += 1
        self._add(d, self._blaming(resolver, reader))

    def _try_insertions(self, d: int, t: int, reader: TermReader) -> None:
        """Try every insertion of a token on every timeline that it may be on."""
        v = self.plan.rows.var0[t] + OBJECT
        trials = 0
        for value in self.database.engine.values_of(v):
            o = int(value)
            if not self.plan.object_timeline[o]:
                continue
            count = self.agenda.sequence.take(o)
            sequence = list(self.agenda.sequence.tokens[:count])
            insertions = [(t, other) for other in sequence] + [(sequence[-1], t)] if sequence else [(t, t)]
            for before, after in insertions:
                trials += 1
                if trials > _MOST_TRIALS or self._is_late():
                    return
                mark = self.database.mark()
                if not (order(self.plan, o, before, after, NONE) and fire(self.plan)):
                    self._add_pruned(d, self._insertion(o, before, after, t, reader), reader)
                self.database.release(mark)


def _rank(cause: FoundCause) -> tuple[int, str, int, str]:
    """Sort key of causes: implied ones, then by source place, then those without one."""
    if cause.span is None:
        return (0 if cause.origin is CauseOrigin.IMPLIED else 2, "", 0, words(cause.term))
    return (1, cause.span.source.name, cause.span.begin, words(cause.term))
