"""Random determined models, and missions flown both ways: by register code and by the general engine."""

import random
from dataclasses import dataclass, field
from typing import Literal

from runtime.executive.configuration import AgentConfiguration, GoalConfiguration, ParameterConfiguration
from runtime.executive.mission import MissionPrograms, register_program, run_mission
from runtime.executive.outcome import Event, EventKind, Outcome, Reason
from runtime.solver.configuration.configuration import default_configuration
from tests.executive.flying import Flyer, program, simulator


@dataclass(frozen=True, slots=True)
class Case:
    """One mission of simulators."""

    flyers: tuple[Flyer, ...]
    goals: tuple[GoalConfiguration, ...] = ()
    parameters: tuple[ParameterConfiguration, ...] = ()
    until: int = 40

    def agent(self) -> tuple[AgentConfiguration, MissionPrograms]:
        """What `run_mission` takes."""
        reactors = tuple(flyer.configuration for flyer in self.flyers)
        agent = AgentConfiguration("toy", ".", self.until, reactors, self.goals, self.parameters)
        programs = tuple(program(flyer.configuration.model, flyer.text) for flyer in self.flyers)
        return agent, MissionPrograms(programs, tuple(default_configuration() for _ in self.flyers))

    def fly(self, seed: int, compiles: bool, every_tick: bool = False) -> Outcome:
        """Fly it."""
        agent, programs = self.agent()
        return run_mission(agent, programs, seed, every_tick=every_tick, compiles=compiles)

    def is_compiled(self) -> bool:
        """Whether all of its reactors are determined."""
        agent, programs = self.agent()
        return all(register_program(agent, programs, number) is not None for number in range(len(self.flyers)))


def told(outcome: Outcome) -> tuple[object, ...]:
    """What both ways must agree on.

    Tokens are numbered by each engine in its own way. A draw is put on record when its token is planned or when it
    starts, so its own tick counts; and requests bear numbers of events, so they are numbered anew.
    """
    requests = [event.request for event in outcome.events if event.kind is EventKind.REQUEST]
    numbers = {request: number for number, request in enumerate(requests)}
    abort = outcome.abort and (outcome.abort.code, outcome.abort.tick, outcome.abort.reactor)
    goals = [(goal.timeline, goal.predicate, goal.arguments, why(goal.reason)) for goal in outcome.open_goals]
    lines = [line(event, numbers.get(event.request)) for event in outcome.events]
    return sorted(filter(None, lines)), outcome.last_tick, abort, goals


def why(reason: Reason | None) -> tuple[object, ...]:
    """A reason without the numbers of tokens."""
    if reason is None:
        return ()
    return (reason.kind, reason.token and reason.token.predicate, reason.predicate, reason.tick, *why(reason.repair))


def line(event: Event, request: int | None) -> str:
    """An event as text, with the number of its request; nothing for draws."""
    if event.kind is EventKind.SAMPLE:
        return ""
    arguments = ", ".join(f"{name}={domain.interval or domain.values}" for name, domain in event.arguments)
    what = f"{event.predicate}({arguments}) {request} {event.code}"
    return f"{event.tick:6} {event.kind.name} {event.reactor} {event.timeline} {what}"


@dataclass(eq=False, slots=True)
class Writer:
    """Writes one random model of a few timelines, each of its own class."""

    chance: random.Random
    classes: list[str] = field(default_factory=list)
    rules: list[str] = field(default_factory=list)
    objects: list[str] = field(default_factory=list)
    facts: list[str] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    goals: list[GoalConfiguration] = field(default_factory=list)
    until: int = 40

    def timeline(self, name: str, predicates: str, default: str) -> None:
        """A class and its only object."""
        self.classes.append(
            f'class {name} extends AgentTimeline {{ {predicates} {name}(Mode m) {{ super(m, "{default}"); }} }}'
        )
        self.objects.append(f"{name} {name.lower()} = new {name}(Internal);")
        self.names.append(name.lower())

    def expression(self, known: list[str]) -> str:
        """An int or float expression of what is known."""
        a, b = self.chance.choice(known), self.chance.choice(known)
        number = self.chance.choice(("2.0", "0.5", "0.1", "-1.5", "3.0"))
        return self.chance.choice(
            (
                f"{a} + {number}",
                f"{a} * {number}",
                f"{a} - {b}",
                f"{a} + {b} * {number}",
                f"min({a}, {b})",
                f"max({a}, {number})",
                f"abs({a})",
                f"({a} + {b}) * 0.25",
            )
        )

    def chain(self, name: str, reads: str | None, with_draw: bool) -> None:
        """Tokens that follow each other, each with the state that the one before left."""
        chance = self.chance
        self.timeline(name, "predicate Step { float x; float y; bool up; float x1; float y1; bool up1; }", "Step")
        known = ["x", "y"]
        body = [f"duration == {chance.choice((1, 1, 2, 3, 7))};", "meets(object.Step next);"]
        body += ["next.x == x1; next.y == y1; next.up == up1;"]
        if reads is not None:
            body.append(f"contained_by({reads}.Holds c);")
            known.append("c.v")
        if with_draw:
            body.append("float n; n == sampledParameter(NOISE);")
            known.append("n")
        body.append(f"float a; a == {self.expression(known)};")
        limit = chance.choice(("3.0", "0.0", "10.0"))
        body.append(f"if (up == true) {{ x1 == x + {chance.choice(('1.0', '0.3', 'a * 0.01'))}; }}")
        body.append(f"if (up == false) {{ x1 == x - {chance.choice(('1.0', '0.7'))}; }}")
        body.append(f"if (x1 > {limit}) {{ up1 == false; }}")
        body.append(f"if (x1 <= {limit}) {{ up1 == true; }}")
        body.append(f"y1 == {self.expression([*known, 'a'])} * 0.1;")
        if chance.random() < 0.4:
            flash = f"{name}Flash"
            self.timeline(flash, "predicate Off { } predicate On { float w; }", "Off")
            self.rules.append(f"{flash}::On {{ duration == 1; }}")
            lasting = chance.choice(("", " f.duration == 1;"))
            body.append(f"if (up1 != up) {{ meets({flash}.On f); f.w == x1;{lasting} }}")
        if chance.random() < 0.4:
            seen = f"{name}Seen"
            self.timeline(seen, "predicate Is { float w; }", "Is")
            body.append(f"equals({seen}.Is s); s.w == x;")
        chance.shuffle(body)
        ranks = {"contained_by": 0, "meets": 0, "float n": 0, "float a": 1}
        body.sort(key=lambda text: next((rank for start, rank in ranks.items() if text.startswith(start)), 2))
        self.rules.append(f"{name}::Step {{ {' '.join(body)} }}")
        self.facts.append(
            f"fact({name.lower()}.Step {name.lower()}0); {name.lower()}0.start == 0;"
            f" eq({name.lower()}0.x, 0.0); eq({name.lower()}0.y, 1.0); {name.lower()}0.up == true;"
        )

    def command(self, name: str, with_draw: bool) -> None:
        """A timeline that does what it is asked for as long as that takes."""
        chance = self.chance
        lasting = chance.choice(("duration == n + 1;", "duration == 5;", "int t; t == ceil(n * 1.5); duration == t;"))
        if with_draw:
            lasting = "float d; int t; d == sampledParameter(SLOW); t == ceil(d * 4.0); duration == t + 1;"
        after = chance.choice(("", "meets(object.Rest r); r.k == n;", "meets(object.Rest r);"))
        if after and chance.random() < 0.5:
            after += chance.choice((" r.duration == n;", " r.duration == 4;", " if (n > 3) { r.duration == n + 2; }"))
        rest = chance.choice(("", "duration >= 3;", "duration == 4;"))
        kept, quiet = "int k;", "Rest"
        if "r.k" in after and chance.random() < 0.5:  # what is not told the next token would be a choice
            kept, quiet = chance.choice(("Small k;", "Odd k;", "int k = LIMIT;")), "Lull"
        self.timeline(name, f"predicate Rest {{ {kept} }} predicate Lull {{ }} predicate Do {{ int n; }}", quiet)
        self.rules.append(f"{name}::Do {{ {lasting} {after} }}")
        self.rules.append(f"{name}::Rest {{ {rest} }}")
        for _ in range(chance.randint(0, 3)):
            self.goal(name.lower(), "Do", ("n", chance.randint(0, 6)))

    def helm(self, name: str, is_read: bool) -> str:
        """A timeline of commands with a mirror that has one predicate.

        Where a chain reads the mirror, a command lasts until the next one: the general engine plans the next step of
        the chain before the command is over, and with it what comes then.
        """
        mirror = f"{name}Mirror"
        self.timeline(name, "predicate Idle { } predicate Run { float v; }", "Idle")
        self.timeline(mirror, "predicate Holds { float v; }", "Holds")
        self.rules.append(f"{name}::Idle {{ equals({mirror}.Holds s); s.v == 0.0; }}")
        lasting = "" if is_read else self.chance.choice(("", "duration <= 9;", "duration == 6;"))
        self.rules.append(f"{name}::Run {{ equals({mirror}.Holds s); s.v == v; {lasting} }}")
        for _ in range(self.chance.randint(0, 2)):
            self.goal(name.lower(), "Run", ("v", self.chance.choice((1.5, 0.1, -2.0))))
        return mirror

    def goal(self, timeline: str, predicate: str, *parameters: tuple[str, float | int]) -> None:
        """Something that is asked for at some tick."""
        at = self.chance.randint(0, self.until - 5)
        first = at + self.chance.randint(-1, 12)
        window = (float(first), float(first + self.chance.choice((0, 3, 20, 60))))
        is_mandatory = self.chance.random() < 0.3
        self.goals.append(
            GoalConfiguration(timeline, predicate, at, is_mandatory, window, None, None, tuple(parameters))
        )


def random_case(seed: int) -> Case:
    """One to three groups of timelines."""
    chance = random.Random(seed)
    writer = Writer(chance)
    for number in range(chance.randint(1, 3)):
        kind = chance.choice(("chain", "command", "helm"))
        with_draw = chance.random() < 0.5
        if kind == "chain":
            writer.chain(f"C{number}", None, with_draw)
        elif kind == "command":
            writer.command(f"K{number}", with_draw)
        else:
            is_read = chance.random() < 0.7
            mirror = writer.helm(f"H{number}", is_read)
            if is_read:
                writer.chain(f"C{number}", mirror, with_draw)
    text = "\n".join(
        [
            "float NOISE = [-1.0 1.0]; float SLOW = [0.1 2.0]; int LIMIT = 4;",
            "typedef int [1 5] Small; typedef int {1, 3, 5} Odd;",
            *writer.classes,
            *writer.rules,
            *writer.objects,
            "close();",
            *writer.facts,
        ]
    )
    modes: tuple[Literal["inter", "intra"], ...] = ("inter", "intra")
    mode = chance.choice(modes)
    parameters = (
        ParameterConfiguration("NOISE", -1.0, 1.0, mode=mode, update=chance.choice((1, 3, 10))),
        ParameterConfiguration("SLOW", 0.1, 2.0, mode=mode, update=7),
    )
    flyer = simulator(f"sim{seed}", text, " ".join(writer.names))
    return Case((flyer,), tuple(writer.goals), parameters, writer.until)
