"""What the executive does to a plan database, said in tokens, ticks and names."""

from math import inf

from compiler.program import END, FIRST_PARAMETER, OBJECT, DomainConstant
from runtime.constraints.domains.arrays import grow_rows
from runtime.constraints.domains.tags import FLAG_DECISION, FLAG_FROZEN, KIND_FLOAT
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.messages import Arguments
from runtime.executive.timelines import TimelineState
from runtime.executive.view import SPAN_CLOCK, SPAN_EXECUTIVE, SPAN_MISSION, SPAN_OBSERVATION, SPAN_REQUEST, PlanView
from runtime.plan.database import PlanDatabase
from runtime.plan.lifecycle import activate, fire, merge
from runtime.plan.store.marks import commit, mark, release, rewind
from runtime.plan.store.prototypes import restrict_constant
from runtime.plan.tags import (
    ACTIVE,
    FLAG_FACT,
    FLAG_GOAL,
    FLAG_REJECTABLE,
    INACTIVE,
    INFINITY,
    LIST_ORDER,
    LISTS,
    MERGED,
    NONE,
)
from runtime.plan.tokens.archive import Leaving, archive, detach
from runtime.plan.tokens.retraction import cancel, forget_orders, remove_tokens, wake_guards
from runtime.plan.tokens.timelines import order
from runtime.plan.tokens.tokens import make_token


class Workbench(PlanView):
    """A plan database under execution; every narrowing is propagated at once, so False always means a conflict.

    `goals` are those of the mission; `goal_numbers` says of the tokens (by key) that stand for one which it is.
    """

    def __init__(self, database: PlanDatabase, name: str) -> None:
        super().__init__(database, name)
        self.goals: tuple[GoalConfiguration, ...] = ()
        self.goal_numbers: dict[int, int] = {}
        self.defaults: dict[int, int] = {}  # default predicates, by timeline
        self.lasting: dict[int, int] = {}  # keys of what has gone on against a command, by timeline
        self.leaving = Leaving()

    # ---- going back ----

    def mark(self) -> int:
        """Remember the present state, for `rewind_to`, as often as wanted, and `release`."""
        return mark(self.plan)

    def rewind_to(self, mark: int) -> None:
        """Go back to a mark, which stays."""
        rewind(self.plan, mark)

    def release(self, mark: int) -> None:
        """Go back to the latest mark and forget it."""
        release(self.plan, mark)

    def commit(self) -> None:
        """Forget all marks: what holds now is final."""
        commit(self.plan)

    def is_consistent(self) -> bool:
        """Whether nothing contradicts anything."""
        return bool(self.engine.consistent)

    # ---- narrowing ----

    def at_least(self, v: int, bound: float, span: int, t: int) -> bool:
        """Raise a lower bound."""
        if self.engine.lower(v) >= bound:
            return True
        self.moved[v] = None
        return self._narrow(v, bound, inf, span, t)

    def at_most(self, v: int, bound: float, span: int, t: int) -> bool:
        """Reduce an upper bound."""
        if self.engine.upper(v) <= bound:
            return True
        return self._narrow(v, -inf, bound, span, t)

    def within(self, v: int, bounds: tuple[float, float], span: int, t: int) -> bool:
        """Keep a variable between two bounds."""
        return self.at_least(v, bounds[0], span, t) and self.at_most(v, bounds[1], span, t)

    def fix(self, v: int, value: float, span: int, t: int) -> bool:
        """Give a variable its value."""
        return self._narrow(v, value, value, span, t)

    def _narrow(self, v: int, lower: float, upper: float, span: int, t: int) -> bool:
        """Restrict a base domain; what had one value left may be decided by it, and guards wait for that."""
        was_decided = not self.plan.variable_guards[v] or self.engine.is_decided(v)
        if not self.engine.restrict_base(v, lower, upper, span, t):
            return False
        if not was_decided and self.engine.is_decided(v):
            wake_guards(self.plan, v)
        return fire(self.plan)

    def _parameter_numbers(self, predicate: int) -> dict[str, int]:
        """The numbers of a predicate's parameters, by name."""
        found = self.parameters.get(predicate)
        if found is None:
            parameters = self.database.program.predicates[predicate].parameters
            found = self.parameters[predicate] = {parameter.name: k for k, parameter in enumerate(parameters)}
        return found

    def unknown_argument(self, predicate: int, arguments: Arguments) -> str:
        """What of `arguments` a predicate does not have, in words; empty if it has all."""
        names = self._parameter_numbers(predicate)
        for name, _ in arguments:
            if name not in names:
                there = ", ".join(f"`{each}`" for each in names) or "none"
                return f": there is no parameter `{name}` (there is {there})"
        return ""

    def restrict_parameters(self, t: int, arguments: Arguments, span: int) -> bool:
        """Narrow parameters to what somebody else knows of them.

        A name that `t` does not have is left out of what was observed, and a misfit in what is asked for.
        """
        names = self._parameter_numbers(self.rows.predicate[t])
        for name, domain in arguments:
            if name not in names:
                if span != SPAN_OBSERVATION:
                    return False
                continue
            v = self.rows.var0[t] + FIRST_PARAMETER + names[name]
            if not self._restrict(v, domain, span, t):
                return False
        return fire(self.plan)

    def _restrict(self, v: int, domain: DomainConstant, span: int, t: int) -> bool:
        if domain.kind == "object" and domain.values is not None:
            objects = self.database.objects.names
            known = [objects.index(str(name)) for name in domain.values if name in objects]
            return self.engine.restrict_base_values(v, [float(o) for o in known], span, t)
        if domain.values is None and domain.interval is not None:
            lower, upper = domain.interval
            if lower == upper and -INFINITY < lower < INFINITY:  # what has happened, as a rule
                return self.engine.restrict_base(v, lower, lower, span, t)
        return restrict_constant(self.database.prototypes, v, domain, span, t)

    def make_values(self, t: int) -> None:
        """Give each number of a token that begins its value, where only the rounding of sums has left two."""
        engine = self.engine
        for k in range(FIRST_PARAMETER, int(self.rows.width[t])):
            v = int(self.rows.var0[t]) + k
            if engine.kind[v] == KIND_FLOAT and engine.flo[v] != engine.fhi[v] and engine.is_singleton(v):
                self.fix(v, engine.flo[v], SPAN_EXECUTIVE, t)

    def start_clock(self, final_tick: int) -> bool:
        """Let guards on the model's clock fire as soon as what they say has come true; the mission ends in time."""
        number = self.globals.get("AGENT_CLOCK")
        if number is None:
            return True
        self.plan.clock = self.plan.globals[number]
        return self.within(self.plan.clock, (0, final_tick), SPAN_MISSION, NONE)

    def set_clock(self, tick: int) -> bool:
        """Let the model's clock read `tick` or later."""
        number = self.globals.get("AGENT_CLOCK")
        return number is None or self.at_least(self.plan.globals[number], tick, SPAN_CLOCK, NONE)

    def set_global(self, name: str, value: float) -> bool:
        """Give a global variable of the T-REX library its value, if the model has it."""
        number = self.globals.get(name)
        return number is None or self.fix(self.plan.globals[number], value, SPAN_MISSION, NONE)

    # ---- tokens ----

    def new_token(self, predicate: int, o: int, is_fact: bool) -> int:
        """Make a token on a timeline; a conflict shows when it is narrowed or activated."""
        flags = FLAG_FACT if is_fact else 0
        return self._make(predicate, o, flags, SPAN_OBSERVATION if is_fact else SPAN_EXECUTIVE)

    def new_goal(self, predicate: int, o: int) -> int:
        """Make the token of a request."""
        return self._make(predicate, o, FLAG_GOAL | FLAG_REJECTABLE, SPAN_REQUEST)

    def adopt_script(self) -> list[int]:
        """Let what the script states hold, and what it wants begin, in the mission, not before; what it wants.

        That is asked for.
        """
        found: list[int] = []
        for t in self.all_tokens():
            flags = self.rows.flags[t]
            is_wanted = flags & (FLAG_GOAL | FLAG_REJECTABLE) != 0
            if self.rows.parent[t] >= 0 or self.rows.status[t] != INACTIVE or not (is_wanted or self.is_internal(t)):
                continue
            mark = self.mark()
            if not self.at_least(self.start(t), 0, SPAN_CLOCK, t):
                self.rewind_to(mark)
            self.commit()
            if is_wanted:
                self.rows.flags[t] = flags | FLAG_GOAL
                self.remember_request(t)
                found.append(t)
        return found

    def _make(self, predicate: int, o: int, flags: int, span: int) -> int:
        given = NONE if o < 0 else self.plan.object_constant[o]
        return make_token(self.plan, predicate, flags, NONE, NONE, given, span)

    def activate(self, t: int) -> bool:
        """Put a token into the plan; its rules fire."""
        return activate(self.plan, t, SPAN_EXECUTIVE)

    def merge(self, t: int, other: int) -> bool:
        """Let a token stand for another."""
        return merge(self.plan, t, other, SPAN_EXECUTIVE)

    def place_after(self, o: int, t: int, current: int) -> bool:
        """Order a token right behind the current one of its timeline, or in front of all."""
        following = self.next_of(o, current)
        if current >= 0 and not self._order(o, current, t):
            return False
        if following >= 0:
            return self._order(o, t, following)
        return current >= 0 or self._order(o, t, t)

    def _order(self, o: int, before: int, after: int) -> bool:
        return order(self.plan, o, before, after, SPAN_EXECUTIVE) and fire(self.plan)

    def cancel(self, t: int) -> bool:
        """Take a token out of the plan, with all that followed from it; it stays to be decided again."""
        return cancel(self.plan, t) and fire(self.plan) and self._undecide(t)

    def forget_orders(self) -> bool:
        """Take back the order in which the planner has put uses of resources."""
        return forget_orders(self.plan) and fire(self.plan)

    def _undecide(self, t: int) -> bool:
        """Undo what the planner decided about the variables of a token."""
        engine = self.engine
        first = int(self.rows.var0[t])
        made = [
            r
            for v in range(first + OBJECT, first + int(self.rows.width[t]))
            if engine.is_decided(v)
            for r in engine.restrictions_of(v)
            if engine.restriction_flags[r] & FLAG_DECISION and engine.restriction_span[r] == NONE
        ]
        return not made or (engine.retract((), (), made, ()) and fire(self.plan))

    def renew(self, t: int) -> bool:
        """Let the rules of a planned token fire anew, in its place on its timeline."""
        o, at = self.object_of(t), LISTS * t + LIST_ORDER
        is_placed = self.rows.link_head[at] >= 0
        earlier = []
        before = int(self.rows.link_before[at]) if is_placed else NONE
        while before >= 0:
            earlier.append((before, self.key(before)))
            before = int(self.rows.link_before[LISTS * before + LIST_ORDER])
        if not (self.cancel(t) and self.activate(t)):
            return False
        if not is_placed:
            return True
        # What its rules had asked for in front of it is gone with them.
        for other, key in earlier:
            if self.is_alive(other, key) and self.rows.link_head[LISTS * other + LIST_ORDER] >= 0:
                return self.place_after(o, t, other)
        return self.place_after(o, t, NONE)

    def is_kept(self, t: int) -> bool:
        """Whether the token is over and in the plan without its rules, for others to look back at."""
        return t < len(self.kept_key) and self.kept_key[t] == self.rows.key[t]

    def note_kept(self, t: int) -> None:
        """Note that the token, which is over and on record, stays in the plan without its rules."""
        if t >= len(self.kept_key):
            grow_rows(self, "kept_key", 2 * t + 64, NONE)
        self.kept_key[t] = self.rows.key[t]
        self.recorder.kept[self.rows.key[t]] = None

    def archive(self, timelines: list[TimelineState], tick: int) -> int:
        """Take out of the plan what is over; of each timeline the token before the current one is kept.

        What is done by rules that say "met by" finds its partner for as long as the next token holds.
        """
        rows, latest, kept_key = self.rows, self.engine.ub, self.kept_key
        staying = set()
        for line in timelines:
            if line.current >= 0:
                staying.add(line.current)
                staying.add(rows.link_before[LISTS * line.current + LIST_ORDER])
        over: list[int] = []
        known = len(kept_key)
        for t in range(rows.token_count):
            if t < known and kept_key[t] == rows.key[t]:
                continue  # over, and here for others to look back at
            status = rows.status[t]
            if (status == ACTIVE or status == MERGED) and latest[rows.var0[t] + END] <= tick and t not in staying:
                over.append(t)
        if not over or not fire(self.plan):
            return 0
        return archive(self.plan, over, tick, self.leaving, self._leave)

    def _leave(self, going: list[int], tick: int) -> None:
        """Record tokens that leave the plan; what follows from a request still does."""
        self.recorder.leave(going, tick)
        rows = self.rows
        for t in going if self.is_reactive else []:
            if rows.children[t] >= 0 and self.is_due_to_request(t):
                child = rows.children[t]
                while child >= 0:
                    self.due[child] = rows.key[child]
                    child = rows.sibling[child]

    def tidy(self) -> None:
        """Forget limits of times that a later one of the same kind has made needless: they grow with every tick."""
        engine = self.engine
        needless: list[int] = []
        for v in self.moved:
            lowest: list[int] = []  # kinds that have a limit
            r = engine.restriction_head[v]  # the newest first, and those of the clock only ever grow
            while r >= 0:
                span = engine.restriction_span[r]
                if span < -1 and engine.restriction_hi[r] == inf and engine.restriction_flags[r] == 0:
                    if span in lowest:
                        needless.append(r)
                    else:
                        lowest.append(span)
                r = engine.restriction_next[r]
        self.moved.clear()
        if needless:
            engine.retract((), (), needless, ())
            fire(self.plan)

    def free_of_requests(self, t: int, bound: list[int]) -> list[tuple[int, int, float, float]]:
        """Free a token of what was asked of its end and length: whose token asked, the variable, its bounds.

        What the tokens in `bound` ask stays.
        """
        engine, asked, limits = self.engine, [], []
        who = t
        while who >= 0:
            for v in () if who in bound else (self.end(who), self.duration(who)):
                for r in engine.restrictions_of(v):
                    if engine.restriction_span[r] == SPAN_REQUEST and not engine.restriction_flags[r] & FLAG_FROZEN:
                        asked.append((who, v, float(engine.restriction_lo[r]), float(engine.restriction_hi[r])))
                        limits.append(r)
            who = int(self.rows.merged[t] if who == t else self.rows.merged_next[who])
        if limits:
            engine.retract((), (), limits, ())
            fire(self.plan)
        return asked

    def detach(self, t: int) -> None:
        """Let a token stay when the one that asked for it goes."""
        self.recorder.detach(t)
        detach(self.plan, t)

    def remove(self, tokens: list[int]) -> bool:
        """Take tokens away for good."""
        return remove_tokens(self.plan, tokens) and fire(self.plan)

    def fact_of(self, t: int) -> int:
        """The observation that token `t` is, or that met it; NONE where there is none."""
        if t < 0 or self.is_fact(t):
            return t
        other = int(self.rows.merged[t])
        while other >= 0 and not self.is_fact(other):
            other = int(self.rows.merged_next[other])
        return other

    def end_observed(self, t: int, tick: int) -> bool:
        """End what holds on another reactor's timeline; the observation keeps that if the token it met goes."""
        fact = self.fact_of(t)
        if not self.fix(self.end(t), tick, SPAN_OBSERVATION, t):
            return False
        return fact == t or fact < 0 or self.fix(self.end(fact), tick, SPAN_OBSERVATION, fact)

    def stand_alone(self, fact: int, o: int) -> bool:
        """Put an observation into the plan by itself, behind what was on its timeline before."""
        if self.rows.status[fact] == MERGED:
            self.cancel(fact)
        if self.rows.status[fact] == INACTIVE and not self.activate(fact):
            return False
        if self.rows.link_head[LISTS * fact + LIST_ORDER] >= 0:
            return True
        before = NONE
        t = self.next_of(o, NONE)
        while t >= 0:
            if self.upper(self.start(t)) < self.lower(self.start(fact)):
                before = t
            t = self.following(t)
        return self.place_after(o, fact, before)
