"""Random agents: reactors in a random graph, written down as models, a mission file and an agent file of T-REX."""

from dataclasses import dataclass, field
from pathlib import Path

from tests.executive.generated.timelines import PACE, SPOTS, STORE, Bounds, Line


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
        text = ['#include "TREX.nddl"']
        text += [PACE] * any(line.paced for line in [*external, *self.lines])
        text += [SPOTS] * any(line.placed or line.visits for line in [*external, *self.lines])
        text += [line.declaration() for line in [*external, *self.lines]]
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
    raises: int | None = None  # the tick at which it fails
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
        return CODE.format(says=dict(self.says), asks=asks, answers=answers, own=own, raises=self.raises)


CODE = """from runtime.user.reactor import Now, Reactor

SAYS, ASKS, ANSWERS = {says!r}, {asks!r}, {answers!r}


class Hand(Reactor):
    def __init__(self, settings):
        self.numbers = {{}}

    def tick(self, now: Now) -> None:
        if now.tick == {raises}:
            raise ValueError("broken")
        if now.tick == 0:
            if {raises}:
                now.wake({raises})
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
    pace: str = ""
    spot: str = ""


@dataclass(slots=True)
class RandomAgent:
    """A mission: reactors, goals, and what becomes of who fails."""

    name: str
    final_tick: int
    on_failure: str
    reactors: list[Reactor]
    goals: list[Goal]
    steps: int | None = None  # of its clock

    def owner(self, line: Line) -> Reactor:
        """Who owns a timeline."""
        return next(one for one in self.reactors if line in one.lines)

    def mission_file(self) -> str:
        """The mission file."""
        text = ["[mission]", f'name = "{self.name}"', f"final_tick = {self.final_tick}"]
        text.append(f'on_failure = "{self.on_failure}"')
        text += [] if self.steps is None else ["[clock]", f"steps = {self.steps}"]
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
            text += [f'{name} = "{value}"' for name, value in (("pace", goal.pace), ("spot", goal.spot)) if value]
        return "\n".join([*text, "", "[check]", "missions = 1", "seed = 1", ""])

    def agent_file(self) -> str | None:
        """The same as an agent file of T-REX; None if that has no words for it."""
        lines = [line for one in self.reactors for line in one.lines]
        if self.on_failure != "abort_agent" or any(goal.recall is not None for goal in self.goals):
            return None
        if any(isinstance(one, Coded) or one.early or one.late for one in self.reactors):
            return None
        if any(line.drawn for line in lines):
            return None
        text = [
            f'<Agent name="{self.name}" finalTick="{self.final_tick}">',
            f'  <StepClock steps="{self.steps}"/>' if self.steps else "  <FastClock/>",
        ]
        for one in self.reactors:
            steps = f' maxSteps="{one.max_steps}"' if one.max_steps is not None else ""
            table = f' plan_cfg="{one.name}.toml"' if one.solver else ""
            text.append(
                f'  <EuropaReactor name="{one.name}" latency="{one.latency}" lookahead="{one.lookahead}"'
                f' model="{one.name}.nddl"{steps}{table}>'
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
            for name, value in (("pace", goal.pace), ("spot", goal.spot)):
                if value:
                    text.append(_variable(name, f'value="{value}"', "symbol"))
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
