"""Timelines of random agents: what they hold, what their owners' models say of them."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

Bounds = tuple[int, int]
STORE = 5  # what the store of a planner holds
PACE = "enum Pace { slow, fast }"
SPOTS = "class Spot { int far; Spot(int f) { far = f; } } Spot near = new Spot(1); Spot remote = new Spot(4);"
Kind = Literal["script", "counter", "mirror", "command", "task", "horn"]


@dataclass(frozen=True, slots=True)
class Child:
    """What a task asks of a timeline: a relation, its value beside the task's own, and times, as text of the model."""

    line: "Line"
    relation: Literal["contains", "meets", "met_by", "follows", "beside"]
    plus: int = 0
    also: str = ""
    before: "Child | None" = None  # comes first on the same timeline
    least: int | None = None  # the n of a task from which on it asks for this
    waits: bool = False  # it asks only once it has begun
    pace: str = ""  # that of a paced child
    above: "tuple[Line, int] | None" = None  # it asks if a counter has come so far when it begins

    def text(self, name: str, parent_has_factor: bool) -> str:
        """The statements of a rule."""
        said = f"{self.line.class_name}.Do {name}"
        if self.relation == "follows":
            said = f"any({said}); end + 2 <= {name}.start; {name}.start <= end + 9;"
        elif self.relation == "beside":
            said = f"any({said}); {name}.start == start;"
        else:
            said = f"{self.relation}({said});"
        said += f" {name}.n == n + {self.plus}; {name}.start >= 1; {self.also.format(name)}"
        if self.line.paced:
            said += f" {name}.pace == {self.pace or 'Pace.slow'};"
        if self.line.factor and parent_has_factor:
            said += f" {name}.x == x * {self.line.factor} + 0.1;"
        if self.before is not None:
            said = f"{self.before.text(name + '0', parent_has_factor)} {said} {name}0 before {name};"
        if self.least is not None:
            said = f"if (n >= {self.least}) {{ {said} }}"
        if self.above is not None:
            seen, least = self.above
            said = f"starts_during({seen.class_name}.At {name}s); if ({name}s.v >= {least}) {{ {said} }}"
        return f"if (start <= AGENT_CLOCK) {{ {said} }}" if self.waits else said


@dataclass(frozen=True, slots=True)
class Line:
    """A timeline: what kind of thing it is, and what may be told about it beforehand."""

    name: str
    kind: Kind
    steps: tuple[int, ...] = ()  # of a script: how long each lasts; of a counter: one length
    breaks: bool = False  # the last step of a script cannot be followed by anything
    extra: int = 1  # a command lasts n + extra
    rest: int = 0  # and at least so long nothing after it
    most: int | None = None  # the largest n that it carries out
    lasts: tuple[int, int | None] = (1, None)  # a task
    children: tuple[Child, ...] = ()
    ties: str = ""  # what a task says of the times of two that it asks for, beside each other
    within: "Line | None" = None  # a script: the task lies within its second step
    copied: "Line | None" = None  # what a mirror shows
    drawn: int = 0  # a command lasts up to so much longer, by chance
    period: int = 0  # drawn anew every so many ticks
    latest: int | None = None  # it begins only while no more than this is drawn
    uses: int = 0  # of the store of its planner, from its start on
    returns: bool = False  # at its end it gives back what it used
    step: float = 1  # of a counter
    factor: float = 0  # of another argument, which is its parent's so many times
    planned: tuple[int, int] = (0, 0)  # the start and the n of a goal of the model itself
    paced: bool = False  # it has a `pace`: a slow command lasts 2 longer
    placed: bool = False  # a command has a `spot`, an object: it lasts so much longer as that is far
    visits: "Line | None" = None  # a task asks for one of these at each spot

    @property
    def class_name(self) -> str:
        """The name of its class."""
        return self.name.capitalize()

    def declaration(self) -> str:
        """Its class."""
        if self.kind == "script":
            names = [f"S{number}" for number in range(len(self.steps) + 1)]
            predicates, default = " ".join(f"predicate {name} {{ }}" for name in names), "S0"
        elif self.kind == "counter":
            kind = "int" if self.step == 1 else "float"
            predicates, default = f"predicate At {{ {kind} v; }}", "At"
        elif self.kind == "horn":
            predicates, default = "predicate Quiet { } predicate Loud { int v; }", "Quiet"
        elif self.kind == "mirror":
            kind = "int" if self.copied is None or self.copied.step == 1 else "float"
            predicates, default = f"predicate Dark {{ }} predicate Lit {{ {kind} v; }}", "Dark"
        else:
            more = " float x;" * bool(self.factor) + " Pace pace;" * self.paced + " Spot spot;" * self.placed
            predicates, default = f"predicate Rest {{ }} predicate Do {{ int n;{more} }}", "Rest"
        name = self.class_name
        return f'class {name} extends AgentTimeline {{ {predicates} {name}(Mode m) {{ super(m, "{default}"); }} }}'

    def rules(self) -> Iterator[str]:
        """What its owner's model says about it."""
        name = self.class_name
        if self.kind == "script":
            for number, length in enumerate(self.steps):
                yield f"{name}::S{number} {{ duration == {length}; meets(object.S{number + 1} next); }}"
            if self.breaks:
                yield f"{name}::S{len(self.steps)} {{ start <= 0; }}"
        elif self.kind == "counter":
            yield f"{name}::At {{ duration == {self.steps[0]}; meets(object.At next); next.v == v + {self.step}; }}"
        elif self.kind == "mirror":
            assert self.copied is not None
            when, value = {"counter": ("At", "v"), "horn": ("Loud", "v")}.get(self.copied.kind, ("S1", "7"))
            yield f"{self.copied.class_name}::{when} {{ equals({name}.Lit m); m.v == {value}; }}"
        elif self.kind == "command":
            most = f" n <= {self.most};" if self.most is not None else ""
            lasting = f"duration == n + {self.extra};"
            if self.drawn:
                yield f"int {self.parameter} = [0 {self.drawn}];"
                lasting = f"int late; late == sampledParameter({self.parameter}); duration == n + {self.extra} + late;"
                most += f" late <= {self.latest};" * (self.latest is not None)
            yield f"{name}::Do {{ {self.slackened(lasting)}{most} }}"
            if self.rest:
                yield f"{name}::Rest {{ duration >= {self.rest}; }}"
        else:
            lasts = f"duration >= {self.lasts[0]};"
            if self.lasts[1] is not None:
                lasts += f" duration <= {self.lasts[1]};"
            inside = f" contained_by({self.within.class_name}.S1 w);" if self.within is not None else ""
            asked = " ".join(child.text(f"c{number}", self.factor > 0) for number, child in enumerate(self.children))
            yield f"{name}::Do {{ {lasts}{inside} {asked} {self.ties}{self.store()}{self.tour()} }}"

    @property
    def parameter(self) -> str:
        """The parameter from which a command draws how much longer it lasts."""
        return f"LATE_{self.name.upper()}"

    @property
    def slack(self) -> int:
        """How much longer than told by n a command may last."""
        return self.drawn + 2 * self.paced + 4 * self.placed

    def slackened(self, lasting: str) -> str:
        """How long a command lasts, with what its other arguments add."""
        if self.placed:
            lasting = f"int far; far == spot.far; {lasting[:-1]} + far;"
        if not self.paced:
            return lasting
        head, _, length = lasting.rpartition("duration == ")
        slow = f"duration == {length[:-1]} + 2;"
        return f"{head}if (pace == Pace.fast) {{ duration == {length} }} else {{ {slow} }}"

    def tour(self) -> str:
        """What a task asks for at each spot."""
        if self.visits is None:
            return ""
        said = f"contains({self.visits.class_name}.Do tour); tour.spot == each; tour.n == 1; tour.start >= 1;"
        return f" Spot all; foreach (each in all) {{ {said} }}"

    def store(self) -> str:
        """What a task says of the store of its planner."""
        if not self.uses:
            return ""
        said = f" any(Reservoir.consume take); take.time == start; take.quantity == {self.uses}.0;"
        if self.returns:
            said += f" any(Reservoir.produce give); give.time == end; give.quantity == {self.uses}.0;"
        return said

    def fact(self) -> str:
        """How it begins, if something must be said."""
        if self.planned[0]:
            goal = f"{self.name}0"
            return f"goal({self.name}.Do {goal}); {goal}.start == {self.planned[0]}; eq({goal}.n, {self.planned[1]});"
        if self.kind != "counter":
            return ""
        return f"fact({self.name}.At {self.name}0); {self.name}0.start == 0; eq({self.name}0.v, 0);"

    def used(self) -> Iterator["Line"]:
        """The timelines of which its rules speak."""
        yield from (child.line for child in self.children)
        yield from (child.above[0] for child in self.children if child.above is not None)
        yield from (line for line in (self.within, self.copied, self.visits) if line is not None)
