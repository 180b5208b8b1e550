"""What an agent is started with: its reactors, their goals, and how chance is drawn, as plain frozen data.

Whoever starts a mission fills this in (the checker, from `mission.toml`); the agent only reads it. Everything here is
picklable, compares by content and names no machine: model files are named relative to `root`, with `/`.
"""

import math
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Literal

from runtime.executive.outcome import SourcePlace

Value = int | float | bool | str
Bounds = tuple[float, float]  # both ends included; -inf and inf where there is none

OnFailure = Literal["abort_agent", "kill_reactor"]
Mode = Literal["inter", "intra"]


@dataclass(frozen=True, slots=True)
class ReactorConfiguration:
    """One reactor: its model and its place among the others (reference of T-REX, 3.1)."""

    name: str
    model: str  # path relative to the agent's root
    latency: int = 0
    lookahead: int = 1
    internal: tuple[str, ...] = ()  # timelines it owns, by the name of the global variable
    external: tuple[str, ...] = ()  # timelines it uses
    solver: str | None = None  # path of its flaw handling, relative to the agent's root
    early: tuple[str, ...] = ()  # timelines on which what is planned starts as soon as it may, asked for or not
    late: tuple[str, ...] = ()  # on which what nobody asked for starts only when it must: the default comes before it
    observe: tuple[str, ...] = ()  # timelines that it uses and never asks for anything, whatever its model allows
    max_steps: int | None = None  # planner decisions in one tick
    max_depth: int | None = None  # planner decisions in force at once, over all ticks of an episode


@dataclass(frozen=True, slots=True)
class CodeConfiguration:
    """One reactor written in Python: a subclass of `runtime.user.reactor.Reactor` in a file of the project."""

    name: str
    file: str  # path relative to the agent's root; empty: one of nddlc's own
    class_name: str
    latency: int = 0
    internal: tuple[str, ...] = ()
    external: tuple[str, ...] = ()
    settings: tuple[tuple[str, Value], ...] = ()
    lookahead: int = 0  # 0: it takes no commands


@dataclass(frozen=True, slots=True)
class GoalConfiguration:
    """A rejectable goal, sent to the owner of `timeline` at tick `at`, and taken back at tick `recall`.

    A mandatory goal that is not achieved at the end stands in `Outcome.open_goals`; others do not.
    A parameter is given one value, or the two ends of a range. `places` are those of its bounds and parameters in the
    mission file, by key; they change no mission.
    """

    timeline: str
    predicate: str
    at: int = 0
    mandatory: bool = False
    start: Bounds | None = None
    end: Bounds | None = None
    duration: Bounds | None = None
    parameters: tuple[tuple[str, Value | Bounds], ...] = ()
    recall: int | None = None
    places: tuple[tuple[str, SourcePlace], ...] = field(default=(), compare=False)


@dataclass(frozen=True, slots=True)
class ParameterConfiguration:
    """How the values of one `sampledParameter` are drawn; `runtime.executive.chance.sample` is the only reader.

    `values` (with `weights`, else equally likely) serve "discrete", the first of them alone serves "fixed".
    An "intra" parameter is drawn again every `update` ticks, an "inter" parameter once per mission. A normal one has
    its own `mean` and `deviation`, or those of the uniform one. Parameters of one `stream` (else each its own, by
    name) are drawn together. A `share` in [0, 1) stands in place of the drawn one: a sampler has chosen it.
    """

    name: str
    lower: float
    upper: float
    distribution: str = "uniform"  # a row of `runtime.executive.distributions`
    mode: Mode = "inter"
    update: int = 10
    clip: Bounds | None = None
    is_whole: bool = False
    values: tuple[float, ...] = ()
    weights: tuple[float, ...] = ()
    mean: float | None = None
    deviation: float | None = None
    expression: str = ""  # of a dependent one, over the values of others
    stream: str = ""
    share: float | None = None


class PropertyKind(StrEnum):
    """What a property promises."""

    REACHED = "reached"  # a matching token is over in time
    ALWAYS = "always"  # each token on the timeline matches
    NEVER = "never"  # none does
    WITHIN = "within"  # each matching token is followed by another in so many ticks
    UNTIL = "until"  # tokens match until another begins
    LEVEL = "level"  # a resource keeps within bounds


@dataclass(frozen=True, slots=True)
class TokenPattern:
    """Tokens on a timeline: with a predicate (empty: any), values or ranges of arguments, and a condition on them."""

    timeline: str
    predicate: str = ""
    parameters: tuple[tuple[str, Value | Bounds], ...] = ()
    where: str = ""


@dataclass(frozen=True, slots=True)
class LevelPattern:
    """Levels of a resource: within `bounds`, and by `margin` within the limits that the resource has itself.

    Without a `reactor` the resource is that of the first reactor which has one of the name.
    """

    resource: str
    reactor: str = ""
    bounds: Bounds = (-math.inf, math.inf)
    margin: float = 0.0


@dataclass(frozen=True, slots=True)
class PropertyConfiguration:
    """A property of a mission, judged when it is over; it holds from tick `since` to tick `by` (None: the last).

    It is about tokens that match `pattern`, or about a `level`.
    """

    name: str
    kind: PropertyKind
    pattern: TokenPattern = TokenPattern("")
    then: TokenPattern | None = None
    since: int = 0
    by: int | None = None
    ticks: int = 0
    level: LevelPattern | None = None


@dataclass(frozen=True, slots=True)
class ClockConfiguration:
    """How long planners may deliberate in a tick; by default until nobody has work (reference of T-REX, 1.2).

    `steps` are those of a step clock, `counts` the steps by tick of a log clock; of a tick in real time planners may
    use a `share`.
    """

    steps: int | None = None
    counts: tuple[tuple[int, int], ...] | None = None
    share: float = 1.0


@dataclass(frozen=True, slots=True)
class AgentConfiguration:
    """One mission but for its seed. A parameter of the model that is not listed is uniform over its base domain.

    `order` names the reactors of both kinds as the file has them; those that it leaves out come after the others.
    """

    name: str
    root: str  # folder that the other paths are relative to
    final_tick: int
    reactors: tuple[ReactorConfiguration, ...]
    goals: tuple[GoalConfiguration, ...] = ()
    parameters: tuple[ParameterConfiguration, ...] = ()
    tick: float = 1.0  # seconds per tick: the model's TICK_DURATION
    on_failure: OnFailure = "abort_agent"
    constraints: tuple[str, ...] = ()  # Python files with constraints that the models call, relative to the root
    constraint_seconds: float = 5.0  # that one call of these may take
    coded: tuple[CodeConfiguration, ...] = ()  # reactors written in Python
    properties: tuple[PropertyConfiguration, ...] = ()
    order: tuple[str, ...] = ()
    clock: ClockConfiguration = ClockConfiguration()
    until: int | None = None  # where flights are cut off, as what came after is not known; None: at the final tick
