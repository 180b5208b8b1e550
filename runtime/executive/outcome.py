"""What a mission leaves behind: its events, the values it drew, and why it ended, as typed data.

Everything here is picklable and free of engine ids, so that workers can send it and a store can keep it. Two runs of
one mission give equal outcomes, in either form of the engine and on any machine. Sentences are made of it by
`runtime.executive.rendering` alone; nothing reads them back.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

from runtime.executive.messages import Arguments
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import Argument, ResourceTerm, Term
from runtime.solver.learning.attempts import Flaw, Resolver


@dataclass(frozen=True, slots=True)
class SourcePlace:
    """Where in the model something stands: file as the model was named, line and column from 1, and the text."""

    file: str
    line: int
    column: int
    text: str


# ---- conflicts ----


class ElementKind(StrEnum):
    """What an element of a conflict is."""

    RELATION = "relation"  # between tokens, of a rule
    CONSTRAINT = "constraint"
    DURATION = "duration"  # start + duration = end
    SAMPLE = "sample"
    ASSIGNMENT = "assignment"  # a value given by the text of the model
    DECLARATION = "declaration"  # a base domain, of the model or of the mission file
    OBSERVATION = "observation"
    REQUEST = "request"
    CLOCK = "clock"  # what has not happened can only happen later
    ORDER = "order"  # the executive's or the planner's decision about the order of tokens
    DECISION = "decision"  # a value, or a merge, that the planner has decided
    RESOURCE = "resource"  # a resource that is used too much
    LONGEST = "longest"  # a token lasts as long as the model allows
    SHARED_END = "shared end"  # an observed token lasts as long as its owner's


@dataclass(frozen=True, slots=True)
class ConflictElement:
    """One element of a conflict: what was posted, by which rule for which token, and where that is written.

    `rule` is the predicate of the rule, `token` the token for which it posted; without them the script did. `says` is
    what it comes to, in one term (None: `kind` says it all); `terms` the same for a judge, taken apart if need be.
    For a shared end, `observed` names the value and its timeline.
    """

    kind: ElementKind
    place: SourcePlace | None
    rule: str
    token: TokenName | None
    says: Term | ResourceTerm | None
    terms: tuple[Term, ...]
    observed: tuple[str, str] | None = None

    @property
    def variables(self) -> tuple[VariableName, ...]:
        """The variables that its terms speak of, as often as they do."""
        return tuple([one for term in self.terms for one in term.arguments if isinstance(one, VariableName)])

    @property
    def written(self) -> str:
        """Its line as the modeler wrote it, where what it says speaks of a part of an expression; else empty."""
        operands = self.says.arguments if isinstance(self.says, Term) else ()
        is_part = any(isinstance(one, VariableName) and one.is_unnamed for one in operands)
        return " ".join(self.place.text.split()) if is_part and self.place is not None else ""

    def names(self, token: TokenName) -> bool:
        """Whether what it says speaks of `token`."""
        if self.written:
            return False
        operands = self.says.arguments if isinstance(self.says, Term) else ()
        is_about = self.kind is ElementKind.LONGEST and self.token == token
        return is_about or any(isinstance(one, VariableName) and one.token == token for one in operands)


@dataclass(frozen=True, slots=True)
class Conflict:
    """A minimal set of elements that cannot hold together, in the order in which the story is told."""

    elements: tuple[ConflictElement, ...]

    @property
    def variables(self) -> tuple[VariableName, ...]:
        """The variables that its elements speak of, once each, in their order."""
        return tuple(dict.fromkeys(one for element in self.elements for one in element.variables))

    @property
    def parameters(self) -> tuple[str, ...]:
        """The sampled parameters that it depends on."""
        return tuple(dict.fromkeys(name for name, _ in self.drawn))

    @property
    def drawn(self) -> tuple[tuple[str, Argument], ...]:
        """The sampled parameters that it depends on, each with a value that was drawn for it."""
        terms = [term for element in self.elements for term in element.terms if term.name == "sampledParameter"]
        return tuple(dict.fromkeys((str(term.arguments[1]), term.arguments[2]) for term in terms))


# ---- what was tried ----


class ChoiceKind(StrEnum):
    """A way to synchronise a timeline now (T-REX 1.4)."""

    EXTEND = "extend"  # the present token goes on
    NEXT = "next"  # the planned token starts
    NEW = "new"  # a token of `predicate` starts
    OBSERVE = "observe"  # what was observed stands by itself
    MEET = "meet"  # what was observed is the planned token


@dataclass(frozen=True, slots=True)
class PresentChoice:
    """What might hold on a timeline now."""

    kind: ChoiceKind
    token: TokenName | None = None
    predicate: str = ""


@dataclass(frozen=True, slots=True)
class FailedChoice:
    """A choice that was tried and failed: by `conflict`, or because nothing mends the flaw that it leads to."""

    choice: Resolver | PresentChoice
    conflict: Conflict | None = None
    leads_to: "Deadlock | None" = None


@dataclass(frozen=True, slots=True)
class Deadlock:
    """A flaw of the plan, or a timeline of the present, for which no choice is left, with each that was tried."""

    flaw: Flaw | None
    timeline: str = ""
    tried: tuple[FailedChoice, ...] = ()

    def conflicts(self) -> Iterator[Conflict]:
        """The conflicts that ended what was tried, however deep."""
        for one in self.tried:
            if one.conflict is not None:
                yield one.conflict
            if one.leads_to is not None:
                yield from one.leads_to.conflicts()


# ---- why ----


class ReasonKind(StrEnum):
    """Why a request was refused, a goal given up, a plan repaired or a reactor lost."""

    # of requests and goals
    NO_LOOKAHEAD = "no lookahead"
    NO_OWNER = "no owner"
    UNKNOWN_PREDICATE = "unknown predicate"
    MISFIT = "misfit"
    TIMES = "times"
    TOO_LATE = "too late"
    DROPPED = "dropped"
    LACKING = "lacking"
    REJECTED = "rejected"
    DECLINED = "declined"  # by the code of a reactor in Python
    RECALLED = "recalled"
    # of the present
    CLOCK = "clock"
    GOES_ON = "goes on"
    ENDED = "ended"
    CANNOT_GO_ON = "cannot go on"
    CANNOT_START = "cannot start"
    NONE_CAN_START = "none can start"
    DID_NOT_START = "did not start"
    UNMET = "unmet"
    CANNOT_RELAX = "cannot relax"
    # of the plan
    NO_INSERTION = "no place"
    NO_PLAN = "no plan"
    # of limits and code
    STEPS = "steps"
    DEPTH = "depth"
    RAISED = "raised"
    UNLOADABLE = "unloadable"
    # of the mission
    GOALS_OPEN = "goals open"
    NO_RECORD = "no record"
    HELD_FAILED = "held failed"
    CUT_OFF = "cut off"
    CUT_LOOSE = "cut loose"


@dataclass(frozen=True, slots=True)
class Reason:
    """Why something happened, with what it is about; `limit` is a number of tries, steps or decisions.

    `message` is text of others, such as that of an exception in a user's reactor, which `raised` is the line of.
    `since` is when what holds has begun: one planned token may be met by several runs, one after each repair.
    `repair` is the reason of the repair in which a goal left the plan.
    """

    kind: ReasonKind
    token: TokenName | None = None
    predicate: str = ""
    timeline: str = ""
    tick: int | None = None
    limit: int | None = None
    message: str = ""
    repair: "Reason | None" = None
    raised: SourcePlace | None = None
    since: int | None = None


class RepairStage(StrEnum):
    """What a repair takes back (T-REX 1.9)."""

    KEEP_PAST = "keeping the past"
    FORGET_PAST = "forgetting the past"
    REPLAN = "no plan"


# ---- events ----


class Phase(StrEnum):
    """The part of a tick."""

    START = "start"
    OBSERVE = "observe"
    SYNCHRONISE = "synchronise"
    REPAIR = "repair"
    DELIBERATE = "deliberate"
    DISPATCH = "dispatch"
    END = "end"


class EventKind(StrEnum):
    """What happened."""

    OBSERVATION = "observation"
    REQUEST = "request"
    RECALL = "recall"
    REFUSE = "refuse"  # the owner does not take a request
    REJECT = "reject"  # the owner gives up a request that it had taken
    ACHIEVED = "achieved"  # a request has run to its end
    RELAX = "relax"
    SAMPLE = "sample"
    KILL = "kill"
    ABORT = "abort"
    END = "end"


@dataclass(frozen=True, slots=True)
class Draw:
    """A sampled value: `raw` as drawn, `value` after the clip policy, in force from `tick` on."""

    parameter: str
    tick: int
    raw: float
    value: float


@dataclass(frozen=True, slots=True)
class TimeBounds:
    """When something is asked for: both ends included, infinite ones as ±(2**52 - 1)."""

    start: tuple[int, int]
    end: tuple[int, int]
    duration: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Event:
    """One thing that happened; `causes` are indices of earlier events of the same trace.

    Within a tick they are in the order in which they happened. `timeline`, `predicate` and `arguments` say what is
    observed, asked for, refused or given up; `token` is its token in the plan of the owner (in a request: of the
    sender), `request` the number of the request that it is about (NDDL goals: None). A request has its `bounds`, a
    sample its `draw`, a relax its `stage`; refuse, reject, relax, kill and abort their `reason`, and what the search
    knows of it: the `conflict`, and what was tried. `code` is that of kill, abort and end.
    """

    tick: int
    phase: Phase
    kind: EventKind
    reactor: str = ""
    timeline: str = ""
    predicate: str = ""
    arguments: Arguments = ()
    causes: tuple[int, ...] = ()
    token: TokenName | None = None
    request: int | None = None
    bounds: TimeBounds | None = None
    draw: Draw | None = None
    stage: RepairStage | None = None
    code: str = ""
    reason: Reason | None = None
    conflict: Conflict | None = None
    deadlock: Deadlock | None = None


# ---- the end ----


@dataclass(frozen=True, slots=True)
class Abort:
    """Why an agent stopped early. `code` is F1 to F11 of the failure taxonomy (reference of T-REX, 1.11).

    `conflict` is what broke first, `deadlock` what was tried in vain; `repairs` stopped each repair stage after it.
    """

    code: str
    tick: int
    reactor: str
    timelines: tuple[str, ...]
    reason: Reason
    conflict: Conflict | None
    relaxes: int
    event: int  # index of the abort event in the trace
    repairs: tuple[Conflict, ...] = ()
    deadlock: Deadlock | None = None


@dataclass(frozen=True, slots=True)
class OpenGoal:
    """A mandatory goal that was not achieved; `event` is the index of what became of it last (-1: nothing).

    `conflict` is what made a repair necessary in which it left the plan, `deadlock` what the planner tried in vain.
    """

    timeline: str
    predicate: str
    arguments: Arguments = ()
    reason: Reason | None = None  # None: it was still waiting, planned or running
    event: int = -1
    conflict: Conflict | None = None
    deadlock: Deadlock | None = None


@dataclass(frozen=True, slots=True)
class LevelChange:
    """By how much the level of a resource changes; `askers` are whose rules ask for it, each with what they ask for."""

    reactor: str
    resource: str
    tick: int
    amount: float
    level: float
    askers: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class PropertyFate:
    """Whether a property of the mission was kept; if not, the tick of its violation.

    `margin` is how far it was from being violated, infinite where no number decides. `is_void`: nothing that it
    promises was due, as what that follows on never happened, or too late. `seen` says what came in place of what was
    to be reached, which argument was never decided, or what the level was; `changes` led to a level that is violated.
    """

    name: str
    is_kept: bool
    tick: int | None
    margin: float
    is_void: bool = False
    seen: str = ""
    changes: tuple[LevelChange, ...] = ()


@dataclass(frozen=True, slots=True)
class Outcome:
    """A finished mission. `final_tick` is where it was to end, `last_tick` where it ended."""

    seed: int
    last_tick: int
    final_tick: int
    abort: Abort | None
    draws: tuple[Draw, ...]
    events: Sequence[Event]
    open_goals: tuple[OpenGoal, ...]
    breaches: tuple[Reason, ...] = ()  # what the judge found to break the model though nothing failed
    properties: tuple[PropertyFate, ...] = ()
    asleep: tuple[str, ...] = ()  # timelines of reactors in Python that nothing calls any more
    behaviour: tuple[int, ...] = ()  # what the checker found that it exercised: rules, branches, kinds of events

    @property
    def ended_early(self) -> bool:
        """The founding paper's oracle: premature end means a fault (section 4)."""
        return self.abort is not None or self.last_tick < self.final_tick
