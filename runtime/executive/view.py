"""Read a plan database under execution in tokens, ticks and names."""

from array import array
from collections.abc import Mapping
from math import inf

from compiler.program import DURATION, END, FIRST_PARAMETER, OBJECT, START, DomainConstant
from runtime.constraints.domains.sparse_set import SparseSet
from runtime.constraints.domains.tags import KIND_BOOL, KIND_FLOAT, KIND_INT, KIND_STRING
from runtime.executive.messages import Arguments, draft_of, make_domain
from runtime.executive.recorder import Recorder
from runtime.executive.timelines import TimelineState
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.names import TokenName
from runtime.plan.tags import (
    ACTIVE,
    FLAG_FACT,
    FLAG_GOAL,
    FREED,
    HEAD_OPEN,
    HEAD_THREAT,
    INACTIVE,
    INFINITY,
    LIST_OPEN,
    LIST_ORDER,
    LIST_THREAT,
    LISTS,
    MERGED,
    NONE,
    REJECTED,
)
from runtime.plan.tokens.predicate_hierarchy import is_kind_of

# Spans of what no line of the model says: the executive's own reasons.
SPAN_OBSERVATION, SPAN_CLOCK, SPAN_EXECUTIVE, SPAN_REQUEST, SPAN_MISSION = -2, -3, -4, -5, -6
_NameDraft = draft_of(TokenName)


def whole_bound(bound: float) -> int:
    """A whole bound; infinities as NDDL has them."""
    return int(max(-INFINITY, min(bound, INFINITY)))


class _MissingTimelineError(ValueError):
    """A timeline of the configuration that the model does not have."""


class PlanView:
    """What can be asked of a plan database; `Workbench` changes it."""

    def __init__(self, database: PlanDatabase, name: str) -> None:
        self.database = database
        self.plan = database.plan
        self.engine = database.engine
        self.rows = database.plan.rows
        self.name = name
        self.predicates = {predicate.name: number for number, predicate in enumerate(database.program.predicates)}
        self.parameters: dict[int, dict[str, int]] = {}  # by predicate: the parameters' numbers by name
        self.globals = {name: number for number, (name, _) in enumerate(database.program.globals)}
        self.requested: dict[int, int] = {}  # token -> key
        self.due: dict[int, int] = {}  # the same of what follows from such a token, which has left the plan
        self.moved: dict[int, None] = {}  # variables whose least value was raised since the last tidying
        self.asked: Mapping[int, object] = {}  # what owners were asked for, by the key of its token
        self.is_reactive = False  # it looks one tick ahead at most
        self.external_objects: set[int] = set()
        self.recorder = Recorder(database, name)
        self.kept_key = array("q", [NONE]) * 64  # by row: the key of a token that is over and stays without its rules
        self.internal_objects: set[int] = set()
        self.met = SparseSet(256)  # the variables that a walk has met, until the next
        self.late_objects: set[int] = set()  # timelines on which what nobody asked for begins as late as it may

    # ---- names ----

    def timeline(self, name: str, is_internal: bool) -> TimelineState:
        """The timeline that global variable `name` holds; raises `MissingTimelineError` where there is none."""
        objects = self.database.objects.names
        if name not in objects:
            known = ", ".join([f"`{other}`" for other in objects]) or "none"
            raise _MissingTimelineError(f"the model of `{self.name}` has no object `{name}`; it has {known}")
        o = objects.index(name)
        code = self.database.program.classes[self.plan.object_class[o]]
        predicates: dict[str, int] = {}
        for number, predicate in enumerate(self.database.program.predicates):
            if predicate.class_name == code.name:
                predicates[predicate.name.rpartition(".")[2]] = number
        (self.internal_objects if is_internal else self.external_objects).add(o)
        default = predicates.get(self.default_name(o), NONE)
        line = TimelineState(name, o, is_internal, default, predicates)
        for own in predicates.values():
            while own >= 0:
                line.planned.add(own)
                own = self.plan.predicate_parent[own]
        return line

    def default_name(self, o: int) -> str:
        """The default predicate that a timeline names; `undefined` if it names none."""
        domain = self._member(o, "defaultPredicate")
        if domain is not None and domain.values is not None and len(domain.values) == 1:
            return str(domain.values[0])
        return "undefined"

    def _member(self, o: int, name: str) -> DomainConstant | None:
        members = self.database.program.classes[self.plan.object_class[o]].members
        for k, member in enumerate(members):
            if member.name == name:
                return self.domain(self.plan.object_var0[o] + k, member.type.kind, member.type.type_name)
        return None

    def accepts_requests(self, o: int) -> bool:
        """Whether its users may ask for tokens on a timeline: not if the model only observes or ignores it."""
        return self.mode(o) not in ("Observe", "Ignore")

    def mode(self, o: int) -> str:
        """The part that a reactor plays for a timeline, as its model says; empty if it does not say."""
        mode = self._member(o, "mode")
        return str(mode.values[0]) if mode is not None and mode.values is not None and len(mode.values) == 1 else ""

    def name_of(self, t: int) -> TokenName:
        """The name of a token for reports; it outlives the token."""
        name = _NameDraft()
        name.predicate = self.predicate_name(self.rows.predicate[t])
        name.key = self.key(t)
        name.__class__ = TokenName
        return name  # type: ignore[no-any-return]

    def predicate_name(self, predicate: int) -> str:
        """`Class.predicate`."""
        return str(self.database.program.predicates[predicate].name)

    def short_name(self, t: int) -> str:
        """The predicate of a token without its class."""
        return self.predicate_name(self.rows.predicate[t]).rpartition(".")[2]

    # ---- variables of tokens ----

    def start(self, t: int) -> int:
        """The variable that holds when `t` starts."""
        return self.rows.var0[t] + START

    def end(self, t: int) -> int:
        """The variable that holds when `t` ends."""
        return self.rows.var0[t] + END

    def duration(self, t: int) -> int:
        """The variable that holds how long `t` lasts."""
        return self.rows.var0[t] + DURATION

    def lower(self, v: int) -> float:
        """The earliest or least that is still possible."""
        return self.engine.lower(v)

    def upper(self, v: int) -> float:
        """The latest or most that is still possible."""
        return self.engine.upper(v)

    def arguments(self, t: int) -> Arguments:
        """What is known of the parameters of `t`."""
        first = self.rows.var0[t] + FIRST_PARAMETER
        parameters = self.database.program.predicates[self.rows.predicate[t]].parameters
        found = []
        for k, parameter in enumerate(parameters):
            found.append((parameter.name, self.domain(first + k, parameter.type.kind, parameter.type.type_name)))
        return tuple(found)

    def domain(self, v: int, kind: str, type_name: str) -> DomainConstant:
        """The present domain of a variable, by names, so that another model can read it."""
        engine, prototypes = self.engine, self.database.prototypes
        shape = engine.kind[v]
        if shape in (KIND_INT, KIND_FLOAT, KIND_BOOL):
            lower, upper = engine.lower(v), engine.upper(v)
            if shape == KIND_BOOL:
                return make_domain(kind, type_name, None, tuple([bool(x) for x in range(int(lower), int(upper) + 1)]))
            if shape == KIND_INT:
                return make_domain(kind, type_name, (whole_bound(lower), whole_bound(upper)), None)
            return make_domain(kind, type_name, (max(lower, -INFINITY) + 0, min(upper, INFINITY) + 0), None)
        if not engine.is_finite(v) and engine.lower(v) != engine.upper(v):
            return make_domain(kind, type_name, (-INFINITY, INFINITY), None)
        single = engine.lower(v) == engine.upper(v)
        values = [int(engine.lower(v))] if single else [int(value) for value in engine.values_of(v)]
        if shape == KIND_STRING:
            return make_domain(kind, type_name, None, tuple([prototypes.texts.text(x) for x in values]))
        if kind == "object":
            return make_domain(kind, type_name, None, tuple([self.database.objects.names[x] for x in values]))
        return make_domain(kind, type_name, None, tuple([prototypes.symbols.text(x) for x in values]))

    # ---- asking ----

    def key(self, t: int) -> int:
        """A number that names this token for ever, while `t` may name another one later."""
        return self.rows.key[t]

    def is_alive(self, t: int, key: int) -> bool:
        """Whether `t` still is the token that had `key`."""
        return bool(0 <= t < self.rows.token_count and self.rows.status[t] != FREED and self.rows.key[t] == key)

    def is_freed(self, t: int) -> bool:
        """Whether the row is empty."""
        return bool(self.rows.status[t] == FREED)

    def is_fact(self, t: int) -> bool:
        """Whether the token is an observation."""
        return bool(self.rows.flags[t] & FLAG_FACT)

    def is_active(self, t: int) -> bool:
        """Whether the token is in the plan by itself."""
        return bool(self.rows.status[t] == ACTIVE)

    def is_goal(self, t: int) -> bool:
        """Whether the token is one that may be given up."""
        return bool(self.rows.flags[t] & FLAG_GOAL)

    def is_merged(self, t: int) -> bool:
        """Whether the token stands for another one."""
        return bool(self.rows.status[t] == MERGED)

    def is_rejected(self, t: int) -> bool:
        """Whether the planner has given the token up."""
        return bool(self.rows.status[t] == REJECTED)

    def is_started(self, t: int, tick: int) -> bool:
        """Whether the token began at `tick` or before."""
        return not self._is_undecided(t) and self.engine.upper(self.start(t)) <= tick

    def _is_undecided(self, t: int) -> bool:
        return bool(self.rows.status[t] in (INACTIVE, REJECTED))

    def started_at(self, t: int) -> float:
        """When a token started, -inf if that is open."""
        start = self.start(t)
        return self.engine.lower(start) if self.engine.lower(start) == self.engine.upper(start) else -inf

    def is_over(self, t: int, tick: int) -> bool:
        """Whether the token has ended by `tick`."""
        return not self._is_undecided(t) and self.engine.upper(self.end(t)) <= tick

    def is_waiting(self, t: int, tick: int) -> bool:
        """Whether the token has not begun before `tick`."""
        return self._is_undecided(t) or self.engine.upper(self.start(t)) >= tick

    def is_requested(self, t: int) -> bool:
        """Whether the token is, or stands for, one that somebody asked for."""
        if self.requested.get(t) == self.rows.key[t]:
            return True
        other = self.rows.merged[t]
        while other >= 0:
            if self.requested.get(other) == self.rows.key[other]:
                return True
            other = self.rows.merged_next[other]
        return False

    def remember_request(self, t: int) -> None:
        """Note that somebody asked for `t`."""
        self.requested[t] = self.rows.key[t]

    def parent(self, t: int) -> int:
        """The token whose rule asked for `t`; NONE where there is none."""
        return self.rows.parent[t]

    def root(self, t: int) -> int:
        """The token at which the chain of those whose rules asked for `t` begins."""
        while (parent := self.parent(t)) >= 0:
            t = parent
        return t

    def stands_for(self, t: int) -> int:
        """The token of the plan that `t` is, or is merged into."""
        return self.rows.merged_into[t] if self.rows.status[t] == MERGED else t

    def is_missed(self, t: int, tick: int) -> bool:
        """Whether the token has no place in the plan, and can begin no more."""
        return not self.is_active(t) and not self.is_merged(t) and self.upper(self.start(t)) <= tick

    def is_nobodys(self, t: int) -> bool:
        """Whether the token is neither an observation nor a goal, and the one that asked for it is gone."""
        return self.rows.parent[t] == NONE and not self.is_fact(t) and not self.is_goal(t)

    def predicate_of(self, t: int) -> int:
        """The predicate of a token."""
        return self.rows.predicate[t]

    def is_met_by(self, planned: int, observed: int) -> bool:
        """Whether a planned token of one predicate is met by what is observed to be of another, or of the same.

        A class has the predicates of what it extends as its own: who asked for that has got this, unless rules speak
        of the one that is observed alone. These would be lost on a token of the other.
        """
        if planned == observed:
            return True
        if not is_kind_of(self.plan, observed, planned):
            return False
        rules = self.plan.rule_number[self.plan.first_rule[planned] : self.plan.first_rule[planned + 1]]
        own = self.plan.rule_number[self.plan.first_rule[observed] : self.plan.first_rule[observed + 1]]
        return set(own) <= set(rules)

    def next_of(self, o: int, current: int) -> int:
        """The token behind the current one in the sequence of a timeline; the first one if there is no current."""
        if current < 0:
            return self.rows.head_first[self.plan.object_head[o]]
        return self.rows.link_after[LISTS * current + LIST_ORDER]

    def following(self, t: int) -> int:
        """The token behind another one in the sequence of their timeline; NONE behind the last."""
        return self.rows.link_after[LISTS * t + LIST_ORDER]

    def all_tokens(self) -> list[int]:
        """All tokens, oldest first."""
        rows = self.rows
        live = [(rows.key[t], t) for t in range(rows.token_count) if rows.status[t] != FREED]
        live.sort()
        return [t for _, t in live]

    def last_start(self) -> float:
        """The first tick that is the latest start of a token that is still to be decided; inf where there is none."""
        rows, found = self.rows, inf
        t = rows.head_first[HEAD_OPEN]
        while t >= 0:
            found = min(found, self.engine.upper(rows.var0[t] + START))
            t = rows.link_after[LISTS * t + LIST_OPEN]
        return found

    def unplaced(self, tick: int) -> list[int]:
        """Tokens that are in no sequence yet and may start by `tick` as well as later.

        A token that is still to be decided may turn out to be one that holds already; a goal may not.
        """
        rows, engine = self.rows, self.engine
        found = [t for t in self.undecided() if rows.flags[t] & FLAG_GOAL] + self._listed(HEAD_THREAT, LIST_THREAT)
        return [t for t in found if engine.lower(self.start(t)) <= tick < engine.upper(self.start(t))]

    def unordered(self) -> list[int]:
        """Active tokens that are in no sequence yet."""
        return self._listed(HEAD_THREAT, LIST_THREAT)

    def _listed(self, head: int, kind: int) -> list[int]:
        """The tokens of one list."""
        found = []
        t = self.rows.head_first[head]
        while t >= 0:
            found.append(t)
            t = self.rows.link_after[LISTS * t + kind]
        return found

    def object_of(self, t: int) -> int:
        """The object that a token is on; NONE while that is open."""
        v = self.rows.var0[t] + OBJECT
        return int(self.engine.lower(v)) if self.engine.is_singleton(v) else NONE

    def is_due_to_request(self, t: int) -> bool:
        """Whether the token, or one that it follows from, is one that somebody asked for."""
        while t >= 0:
            if self.is_requested(t) or self.due.get(t) == self.rows.key[t]:
                return True
            t = self.rows.parent[t]
        return False

    def is_internal(self, t: int) -> bool:
        """Whether the token is on a timeline of this reactor."""
        return self.object_of(t) in self.internal_objects

    def must_begin(self, o: int, tick: int) -> list[int]:
        """Undecided tokens on a timeline that can begin at `tick` only; at tick 0, facts that may, for they hold.

        Of goals, a planner gives up those, for they have no plan; the world, which plans no farther, begins them.
        """
        found = [t for t in self.undecided() if self.object_of(t) == o and (self.is_reactive or not self.is_goal(t))]
        found.sort(key=self.is_goal)
        due = [t for t in found if self.lower(self.start(t)) <= tick <= self.upper(self.start(t))]
        return [t for t in due if self.upper(self.start(t)) == tick or (tick == 0 and self.is_fact(t))]

    def waits_for_own(self, t: int, tick: int) -> bool:
        """Whether the token is to follow one of this reactor that has not begun, and that nobody asked for."""
        t = self.rows.parent[t]
        while t >= 0:
            if self.is_requested(t) or self.is_started(t, tick):
                return False
            if self.object_of(t) in self.late_objects:
                return True
            t = self.rows.parent[t]
        return False

    def undecided(self) -> list[int]:
        """Tokens that are still to be decided."""
        return self._listed(HEAD_OPEN, LIST_OPEN)
