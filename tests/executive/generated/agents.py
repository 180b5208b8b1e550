"""Random agents: reactors in a random graph, written down as models, a mission file and an agent file of T-REX."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

Bounds = tuple[int, int]
STORE = 5  # what the store of a planner holds
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
        if self.line.factor and parent_has_factor:
            said += f" {name}.x == x * {self.line.factor} + 0.1;"
        if self.before is not None:
            said = f"{self.before.text(name + '0', parent_has_factor)} {said} {name}0 before {name};"
        if self.least is not None:
            said = f"if (n >= {self.least}) {{ {said} }}"
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
    uses: int = 0  # of the store of its planner, from its start on
    returns: bool = False  # at its end it gives back what it used
    step: float = 1  # of a counter
    factor: float = 0  # of another argument, which is its parent's so many times
    planned: tuple[int, int] = (0, 0)  # the start and the n of a goal of the model itself

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
            more = " float x;" if self.factor else ""
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
            yield f"{name}::Do {{ {lasting}{most} }}"
            if self.rest:
                yield f"{name}::Rest {{ duration >= {self.rest}; }}"
        else:
            lasts = f"duration >= {self.lasts[0]};"
            if self.lasts[1] is not None:
                lasts += f" duration <= {self.lasts[1]};"
            inside = f" contained_by({self.within.class_name}.S1 w);" if self.within is not None else ""
            asked = " ".join(child.text(f"c{number}", self.factor > 0) for number, child in enumerate(self.children))
            yield f"{name}::Do {{ {lasts}{inside} {asked} {self.ties}{self.store()} }}"

    @property
    def parameter(self) -> str:
        """The parameter from which a command draws how much longer it lasts."""
        return f"LATE_{self.name.upper()}"

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
        yield from (line for line in (self.within, self.copied) if line is not None)


@dataclass(slots=True)
class Reactor:
    """A reactor and its timelines."""

    name: str
    latency: int
    lookahead: int
    lines: list[Line] = field(default_factory=list)
    max_steps: int | None = None
    forbids_failed: bool = False  # its model has no room for a timeline that failed
    early: list[Line] = field(default_factory=list)
    late: list[Line] = field(default_factory=list)
    solver: str = ""  # its table

    def external(self) -> list[Line]:
        """The timelines that it uses, once each."""
        own = set(self.lines)
        return [line for line in dict.fromkeys(line for mine in self.lines for line in mine.used()) if line not in own]

    def observed(self) -> list[Line]:
        """Those of them that it asks for nothing."""
        return [line for line in self.external() if line.kind not in ("command", "task")]

    def model(self) -> str:
        """Its model."""
        external = self.external()
        text = ['#include "TREX.nddl"', *(line.declaration() for line in [*external, *self.lines])]
        if any(line.uses for line in self.lines):
            text.append(f"Reservoir store = new Reservoir({STORE}.0, 0.0, {STORE}.0);")
        text += [rule for line in self.lines for rule in line.rules()]
        if self.forbids_failed:
            text += [f"{line.class_name}::Failed {{ start <= 0; }}" for line in external]
        watched = self.observed()
        for line in external:
            mode = "Observe" if line in watched else "External"
            text.append(f"{line.class_name} {line.name} = new {line.class_name}({mode});")
        text += [f"{line.class_name} {line.name} = new {line.class_name}(Internal);" for line in self.lines]
        return "\n".join([*text, "close();", *filter(None, (line.fact() for line in self.lines)), ""])


@dataclass(slots=True)
class Coded(Reactor):
    """A reactor in Python: what it says of its own timeline, asks of others and takes back, and at which ticks."""

    says: tuple[tuple[int, int], ...] = ()  # ticks, and the value of `Loud`; 0 for `Quiet`
    asks: tuple[tuple[int, Line, int, Bounds, int], ...] = ()  # a tick, whom, n, when to start, the tick of recall
    answers: tuple[tuple[Line, Line, int], ...] = ()  # whenever the first holds something new, the second is asked

    def external(self) -> list[Line]:
        """The timelines that it uses, once each."""
        found = [line for _, line, *_ in self.asks]
        return list(dict.fromkeys([*found, *(line for pair in self.answers for line in pair[:2])]))

    def code(self) -> str:
        """Its text."""
        asks = [(at, line.name, n, start, recall) for at, line, n, start, recall in self.asks]
        answers = [(seen.name, line.name, n) for seen, line, n in self.answers]
        own = self.lines[0].name
        return CODE.format(says=dict(self.says), asks=asks, answers=answers, own=own)


CODE = """from runtime.user.reactor import Now, Reactor

SAYS, ASKS, ANSWERS = {says!r}, {asks!r}, {answers!r}


class Hand(Reactor):
    def __init__(self, settings):
        self.numbers = {{}}

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            for at in {{*SAYS, *(ask[0] for ask in ASKS), *(ask[4] for ask in ASKS)}}:
                if at > 0:
                    now.wake(at)
        value = SAYS.get(now.tick)
        if value:
            now.publish("{own}", "Loud", v=value)
        elif value is not None:
            now.publish("{own}", "Quiet")
        for k, (at, line, n, start, recall) in enumerate(ASKS):
            if at == now.tick:
                self.numbers[k] = now.ask(line, "Do", start=start, n=n)
            elif recall == now.tick:
                now.recall(self.numbers[k])
        for seen, line, n in ANSWERS:
            if seen in now.news and now.tick:
                now.ask(line, "Do", start=(now.tick + 1, now.tick + 9), n=n)
"""


@dataclass(frozen=True, slots=True)
class Goal:
    """A goal of the mission file."""

    line: Line
    at: int
    start: Bounds
    n: int | None
    is_mandatory: bool = False
    duration: Bounds | None = None
    recall: int | None = None
    x: tuple[float, float] | None = None


@dataclass(slots=True)
class RandomAgent:
    """A mission: reactors, goals, and what becomes of who fails."""

    name: str
    final_tick: int
    on_failure: str
    reactors: list[Reactor]
    goals: list[Goal]

    def owner(self, line: Line) -> Reactor:
        """Who owns a timeline."""
        return next(one for one in self.reactors if line in one.lines)

    def mission_file(self) -> str:
        """The mission file."""
        text = ["[mission]", f'name = "{self.name}"', f"final_tick = {self.final_tick}"]
        text.append(f'on_failure = "{self.on_failure}"')
        for one in self.reactors:
            text += ["", "[[reactor]]", f'name = "{one.name}"']
            if isinstance(one, Coded):
                text.append(f'code = "{one.name}.py:Hand"')
            else:
                text += [f'model = "{one.name}.nddl"', f"latency = {one.latency}", f"lookahead = {one.lookahead}"]
            if one.solver:
                text.append(f'solver = "{one.name}.toml"')
            text.append(f"internal = {[line.name for line in one.lines]}")
            text.append(f"external = {[line.name for line in one.external()]}")
            if one.max_steps is not None:
                text.append(f"max_steps = {one.max_steps}")
            text += [
                f"{when} = {[line.name for line in lines]}"
                for when, lines in (("early", one.early), ("late", one.late))
                if lines
            ]
        for line in (line for one in self.reactors for line in one.lines if line.drawn):
            text += ["", f"[parameters.{line.parameter}]", f"range = [0, {line.drawn}]"]
            if line.period:
                text += ['mode = "intra"', f"update = {line.period}"]
        for goal in self.goals:
            text += ["", "[[goal]]", f'timeline = "{goal.line.name}"', 'predicate = "Do"', f"at = {goal.at}"]
            text += [f"mandatory = {str(goal.is_mandatory).lower()}", f"start = {list(goal.start)}"]
            if goal.duration is not None:
                text.append(f"duration = {list(goal.duration)}")
            if goal.recall is not None:
                text.append(f"recall = {goal.recall}")
            text.append("[goal.parameters]")
            if goal.n is not None:
                text.append(f"n = {goal.n}")
            if goal.x:
                text.append(f"x = {list(goal.x)}")
        return "\n".join([*text, "", "[check]", "missions = 1", "seed = 1", ""])

    def agent_file(self) -> str | None:
        """The same as an agent file of T-REX; None if that has no words for it."""
        lines = [line for one in self.reactors for line in one.lines]
        if self.on_failure != "abort_agent" or any(goal.recall is not None for goal in self.goals):
            return None
        if any(isinstance(one, Coded) or one.early or one.late or one.solver for one in self.reactors):
            return None
        if any(line.drawn for line in lines):
            return None
        text = [f'<Agent name="{self.name}" finalTick="{self.final_tick}">', '  <StepClock steps="50"/>']
        for one in self.reactors:
            steps = f' maxSteps="{one.max_steps}"' if one.max_steps is not None else ""
            text.append(
                f'  <EuropaReactor name="{one.name}" latency="{one.latency}" lookahead="{one.lookahead}"'
                f' model="{one.name}.nddl"{steps}>'
            )
            text += [f'    <Internal name="{line.name}"/>' for line in one.lines]
            watched = one.observed()
            for line in one.external():
                goals = ' goals="false"' if line in watched else ""
                text.append(f'    <External name="{line.name}"{goals}/>')
            text.append("  </EuropaReactor>")
        for goal in self.goals:
            mandatory = ' mandatory="true"' if goal.is_mandatory else ""
            text.append(f'  <Goal on="{goal.line.name}" pred="Do" at="{goal.at}"{mandatory}>')
            text.append(_variable("start", f'min="{goal.start[0]}" max="{goal.start[1]}"'))
            if goal.duration is not None:
                text.append(_variable("duration", f'min="{goal.duration[0]}" max="{goal.duration[1]}"'))
            if goal.n is not None:
                text.append(_variable("n", f'value="{goal.n}"'))
            if goal.x:
                text.append(_variable("x", f'min="{goal.x[0]}" max="{goal.x[1]}"', "float"))
            text.append("  </Goal>")
        return "\n".join([*text, "</Agent>", ""])

    def write(self, folder: Path) -> Path:
        """Write its models and its mission file into a folder; the mission file."""
        for one in self.reactors:
            if isinstance(one, Coded):
                (folder / f"{one.name}.py").write_text(one.code())
            else:
                (folder / f"{one.name}.nddl").write_text(one.model())
            if one.solver:
                (folder / f"{one.name}.toml").write_text(one.solver)
        file = folder / "mission.toml"
        file.write_text(self.mission_file())
        return file


def _variable(name: str, domain: str, kind: str = "int") -> str:
    return f'    <Variable name="{name}"><{kind} {domain}/></Variable>'
