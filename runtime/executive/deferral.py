"""Deferral: observations that cannot matter to a plan wait until its reactor is due, and are folded in then.

An observation cannot matter where its predicate has neither rules nor constraints and its parameters take any value,
where nothing hangs on the token that it ends, and where nothing is planned on its timeline. Of those that have waited
the last two enter the plan, as if the reactor had been woken by each; the others are only put on record.
"""

from math import inf

from compiler.program import DomainConstant
from runtime.constraints.domains.tags import HALF_INF
from runtime.executive.messages import Observation, make_tuple
from runtime.executive.past import OverToken, Past
from runtime.executive.record import NOBODY, TokenRecord, Value
from runtime.executive.timelines import NOTHING, TimelineState
from runtime.executive.view import SPAN_EXECUTIVE, SPAN_OBSERVATION
from runtime.executive.workbench import Workbench
from runtime.plan.tags import INFINITY
from runtime.plan.tokens.tokens import take_key

_OPEN = (-INFINITY, INFINITY)  # what was never fixed
_KEPT = 2  # the current token, and the one before it for rules that say "met by"


class Deferral:
    """The observations of one reactor that wait."""

    def __init__(self, bench: Workbench, timelines: list[TimelineState], past: Past) -> None:
        self.bench = bench
        self.past = past
        self.lines = {line.name: line for line in timelines}
        self.waiting: dict[str, list[Observation]] = {}
        self.passed: list[TokenRecord] = []
        self._is_loose: dict[str, bool] = {}  # whether nothing hangs on what holds on a timeline, and nothing follows
        self._is_plain: dict[int, bool] = {}  # whether a predicate says nothing of its tokens
        self._kinds: dict[int, list[tuple[str, str]]] = {}  # names and kinds of the parameters of a predicate
        self._shapes: dict[int, list[tuple[object, ...]]] = {}  # of the owner's tokens, where they are of these kinds

    def takes(self, observation: Observation) -> bool:
        """Let an observation wait, if it cannot matter."""
        line = self.lines[observation.timeline]
        known = self._is_loose.get(line.name)
        if known is None:
            known = self._is_loose[line.name] = self._may_end(line)
        waiting = self.waiting.get(line.name)
        if waiting and waiting[len(waiting) - 1].tick == observation.tick:
            waiting.pop()  # the last word counts
        predicate = line.predicates.get(observation.predicate, NOTHING)
        if not known or predicate == NOTHING or not self._says_nothing(predicate):
            return False
        if not self._fits(predicate, observation):
            return False
        self.waiting.setdefault(line.name, []).append(observation)
        return True

    def fold(self, tick: int) -> int:
        """Fold in what has waited since before `tick`, what came now is news; the tick of the last one, or NOTHING."""
        last = NOTHING
        self._is_loose.clear()
        if not self.waiting:
            return last
        for name, waiting in self.waiting.items():
            line = self.lines[name]
            if waiting and waiting[len(waiting) - 1].tick == tick:
                news = waiting.pop()
                line.news = line.news or news
            if waiting:
                last = max(last, waiting[len(waiting) - 1].tick)
        found = []
        order = {name: number for number, name in enumerate(self.lines)}
        for name, waiting in self.waiting.items():
            number = order[name]
            for k, each in enumerate(waiting):
                is_kept = k >= len(waiting) - _KEPT
                # When the token before it ended, if that is in the plan; else when it ends itself.
                end = waiting[k + 1].tick if not is_kept else waiting[0 if k <= len(waiting) - _KEPT else k].tick
                found.append((each.tick, number, each, end, is_kept))
        gone: list[OverToken] = []
        # Keys are given in the order of time, as if each had been folded in when it came.
        found.sort()  # by tick and line: no line has two of one tick
        for _, _, each, end, is_kept in found:
            if is_kept:
                self._observe(self.lines[each.timeline], each, end)
            elif (one := self._pass(self.lines[each.timeline], each, end)) is not None:
                gone.append(one)
        for one in gone:
            self.past.put_back(one)
        self.waiting.clear()
        recorder = self.bench.recorder  # what a repair takes away now has been there
        recorder.synchronised = max(recorder.synchronised, last)
        return last

    def close(self, missed: int) -> int:
        """Fold in what has waited when the mission ends; what holds then went on. The tick of the last one.

        What came in the tick that its reactor has `missed` never reached it.
        """
        for waiting in self.waiting.values():
            if waiting and waiting[len(waiting) - 1].tick >= missed:
                waiting.pop()
        last = self.fold(NOTHING)
        for line in self.lines.values():
            if last != NOTHING and line.current != NOTHING:
                span = SPAN_EXECUTIVE if line.is_internal else SPAN_OBSERVATION
                self.bench.at_least(self.bench.end(line.current), last + 1, span, line.current)
        return last

    def _observe(self, line: TimelineState, observation: Observation, end: int) -> None:
        """Let an observation begin a token; the one before ended at `end`."""
        bench, tick = self.bench, observation.tick
        holds = line.current == NOTHING or bench.end_observed(line.current, end)
        fact = bench.new_token(line.predicates[observation.predicate], line.object_id, True)
        holds = holds and bench.fix(bench.start(fact), tick, SPAN_OBSERVATION, fact)
        holds = holds and bench.at_least(bench.end(fact), tick + 1, SPAN_OBSERVATION, fact)
        holds = holds and bench.restrict_parameters(fact, observation.arguments, SPAN_OBSERVATION)
        holds = holds and bench.activate(fact) and bench.place_after(line.object_id, fact, line.current)
        assert holds, "an observation that cannot matter contradicts the plan"
        line.current, line.event, line.source = fact, observation.event, observation

    def _pass(self, line: TimelineState, observation: Observation, end: int) -> OverToken | None:
        """Put an observation on record that begins, and at `end` is over, without entering the plan.

        Gives what rules may look back at of it.
        """
        predicate = line.predicates[observation.predicate]
        name = self.bench.predicate_name(predicate)
        key = take_key(self.bench.plan)
        begun = observation.tick
        values: list[Value] = []
        if observation.source is not None:
            values = observation.source.values_of(observation.token)
        else:
            for _, domain in observation.arguments:
                interval = domain.interval
                assert interval is not None  # so it fits
                values.append(interval[0])
        times = (end - begun, begun, end)
        fields = (key, name, line.name, "active", *times, tuple(values), NOBODY, "observation", "over", end, ())
        self.passed.append(make_tuple(TokenRecord, fields))
        if predicate not in self.past.predicates:
            return None
        return OverToken(NOTHING, key, predicate, line.object_id, begun, end, observation.arguments)

    # ---- what cannot matter ----

    def _may_end(self, line: TimelineState) -> bool:
        """Whether nothing hangs on the end of what holds, and nothing is to follow it."""
        bench, current = self.bench, line.current
        if line.is_internal or current == NOTHING or not bench.is_fact(current):
            return False
        if bench.rows.merged[current] >= 0 or bench.rows.children[current] >= 0 or bench.parent(current) >= 0:
            return False
        if bench.next_of(line.object_id, current) != NOTHING or bench.upper(bench.end(current)) < inf:
            return False
        if not self._says_nothing(bench.predicate_of(current)):
            return False
        return not any(bench.predicate_of(t) in line.planned for t in [*bench.undecided(), *bench.unordered()])

    def _says_nothing(self, predicate: int) -> bool:
        known = self._is_plain.get(predicate)
        if known is None:
            code = self.bench.database.program.predicates[predicate]
            known = self._is_plain[predicate] = (
                not code.rules
                and not code.body
                and not code.is_action
                and not code.is_event
                and all(
                    each.type.kind in ("int", "float")
                    and _is_unlimited(each.domain)
                    and _is_unlimited(each.type.domain)
                    for each in code.parameters
                )
            )
        return known

    def _fits(self, predicate: int, observation: Observation) -> bool:
        """Whether all parameters are given one value of their kind, in their order."""
        kinds = self._kinds.get(predicate)
        if kinds is None:
            parameters = self.bench.database.program.predicates[predicate].parameters
            kinds = self._kinds[predicate] = [(each.name, each.type.kind) for each in parameters]
        source = observation.source
        if source is not None:
            shapes = source.shapes_of(observation.token)
            if self._shapes.get(predicate) is not shapes:
                if [shape[:2] for shape in shapes] != kinds:
                    return False
                self._shapes[predicate] = shapes
            return _OPEN not in source.values_of(observation.token)
        arguments = observation.arguments
        if len(arguments) != len(kinds):
            return False
        for k, (name, domain) in enumerate(arguments):
            interval = domain.interval
            if kinds[k] != (name, domain.kind) or interval is None or interval[0] != interval[1]:
                return False
        return True


def _is_unlimited(domain: DomainConstant | None) -> bool:
    return domain is None or (
        domain.interval is not None and domain.interval[0] <= -HALF_INF and domain.interval[1] >= HALF_INF
    )
