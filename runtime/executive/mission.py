"""Run one mission of a configuration: programs and a seed go in, an outcome comes out."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

from compiler.program import DomainConstant, Program
from runtime.determined.building import find_out, known
from runtime.determined.loading import RegisterProgram
from runtime.determined.reactor import DeterminedReactor
from runtime.executive.agent import Agent
from runtime.executive.clocks import FastClock, clock_of
from runtime.executive.coded_reactor import CodedReactor
from runtime.executive.configuration import AgentConfiguration, GoalConfiguration, Value
from runtime.executive.draws import Draws, World
from runtime.executive.messages import Arguments, Request
from runtime.executive.outcome import Abort, Conflict, EventKind, Outcome, Reason, ReasonKind
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.planning import Planner
from runtime.executive.reactor import TeleoReactor
from runtime.executive.record import MissionRecord
from runtime.executive.stock import Loans
from runtime.executive.story import conflict_of
from runtime.executive.trace import Trace
from runtime.executive.view import whole_bound
from runtime.executive.workbench import Workbench
from runtime.limits import LimitError, OutOfTimeError
from runtime.plan.database import Environment, PlanDatabase
from runtime.plan.tags import INFINITY
from runtime.solver.configuration.configuration import Configuration
from runtime.user.constraint import Constraint
from runtime.user.reactor import Reactor as UserReactor


class UnusableModelError(ValueError):
    """A model that cannot be executed: its script is stopped by a fault, or contradicts itself by a `conflict`."""

    def __init__(self, message: str, reactor: str = "", conflict: Conflict | None = None) -> None:
        super().__init__(message)
        self.reactor, self.conflict = reactor, conflict


@dataclass(frozen=True, slots=True)
class MissionPrograms:
    """The compiled model and the flaw handling of each reactor, in the order of the configuration."""

    programs: tuple[Program, ...]
    solvers: tuple[Configuration, ...]
    constraints: tuple[Constraint, ...] = ()  # those of the project that the models call
    code: tuple[type[UserReactor], ...] = ()  # the classes of the reactors written in Python


def run_mission(
    configuration: AgentConfiguration,
    programs: MissionPrograms,
    seed: int,
    overrides: Mapping[str, float] | None = None,
    every_tick: bool = False,
    until: int | None = None,
    compiles: bool = True,
) -> Outcome:
    """Carry out one mission, see `record_mission`, without a record: that of determined reactors is work."""
    with Loans() as loans:
        return _flown(configuration, programs, seed, overrides, every_tick, until, compiles, False, loans)[0]


def record_mission(
    configuration: AgentConfiguration,
    programs: MissionPrograms,
    seed: int,
    overrides: Mapping[str, float] | None = None,
    every_tick: bool = False,
    until: int | None = None,
    compiles: bool = True,
    tells_on: bool = True,
    clock: FastClock | None = None,
) -> tuple[Outcome, MissionRecord]:
    """Carry out one mission; `overrides` replaces draws of the named parameters by given values.

    Determined reactors are carried out as register code, unless `compiles` is false: events are the same.
    It ends at the final tick, or at `until`. With `every_tick` reactors are woken at each tick, whether or not anything
    can happen; events are the same. Without `tells_on` conflicts end at what a reactor has observed, which saves the
    work to ask the reactor that published it. It is flown by `clock`, by default that of the configuration.

    A model that does not load, be it for what was drawn, ends the mission before it begins (F9). Raises `ValueError`
    (of `workbench` and `agent`) for timelines that do not exist or have no single owner.
    """
    with Loans() as loans:
        outcome, reactors = _flown(
            configuration, programs, seed, overrides, every_tick, until, compiles, True, loans, tells_on, clock
        )
        recorded = tuple(each.record() for each in reactors if isinstance(each, (PlanReactor, DeterminedReactor)))
    return outcome, MissionRecord(recorded)


def _flown(
    configuration: AgentConfiguration,
    programs: MissionPrograms,
    seed: int,
    overrides: Mapping[str, float] | None,
    every_tick: bool,
    until: int | None,
    compiles: bool,
    records: bool,
    loans: Loans,
    tells_on: bool = True,
    clock: FastClock | None = None,
) -> tuple[Outcome, list[TeleoReactor]]:
    """A mission, and its reactors as it left them."""
    trace = Trace()
    world = World(configuration, seed, overrides or {}, trace)
    try:
        reactors = _make_reactors(configuration, programs, world, compiles, records, loans)
    except UnusableModelError as problem:
        return _unloaded(configuration, problem, world), []
    goals = []
    for number, goal in enumerate(configuration.goals):
        kinds = _goal_kinds(configuration, programs, goal)
        goals.append((goal.at, request_of(goal, -1 - number, kinds)))
    clock = clock or clock_of(configuration.clock)
    agent = Agent(configuration, reactors, goals, seed, trace, every_tick, tells_on, clock)
    try:
        outcome = agent.run(until)
    except OutOfTimeError as problem:
        raise OutOfTimeError(f"{problem}: {_endless(agent.tick, problem.planner, reactors)}") from problem
    except LimitError as problem:
        raise LimitError(f"no end was found at tick {agent.tick}: {problem}{_most_planned(reactors)}") from problem
    asleep = [one for one in reactors if isinstance(one, CodedReactor) and one.is_asleep()]
    return replace(outcome, asleep=tuple(line for one in asleep for line in one.internal)), reactors


def _endless(tick: int, planner: object, reactors: list[TeleoReactor]) -> str:
    """Who searches without an end, and what stands in the way most often; where nothing does, what it plans most of."""
    if not isinstance(planner, Planner):
        return f"nobody was in the middle of a search at tick {tick}"
    planned = _most_planned([one for one in reactors if isinstance(one, PlanReactor) and one.planner is planner])
    span, others, count, failures = planner.most_blamed()
    found = f"`{planner.bench.name}` found no end of its search at tick {tick}"
    if span is None:
        return found + planned
    line = " ".join(span.text.split())
    more = f" and {others} more stand" if others else " stands"
    often = f"`{line}` ({span.source.name}:{span.line}){more} in the way in {count} of its first {failures} failures"
    return f"{found}; {often}"


def _most_planned(reactors: list[TeleoReactor]) -> str:
    """Which tokens a plan has most of, of that reactor which has the most, and which line asks for them."""
    plans = [plan for plan in map(_planning, reactors) if plan is not None]
    if not plans:
        return ""
    largest = max(plans, key=lambda reactor: reactor.bench.rows.token_count)
    rows, database = largest.bench.rows, largest.bench.database
    asked = Counter((rows.predicate[t], rows.span[t]) for t in largest.bench.all_tokens() if rows.parent[t] >= 0)
    if not asked:
        return ""
    (predicate, span), count = asked.most_common(1)[0]
    spans = database.code.spans
    tokens = "token" if count == 1 else "tokens"
    place = f", for {spans[span].source.name}:{spans[span].line}" if 0 <= span < len(spans) else ""
    return f"; `{largest.name}` plans {count} {tokens} `{database.program.predicates[predicate].name}`{place}"


def _planning(reactor: TeleoReactor) -> PlanReactor | None:
    """A reactor that plans: itself, or the one that has taken over, or was about to, from register code."""
    if isinstance(reactor, DeterminedReactor):
        return reactor.general or (reactor.witness.reactor if reactor.witness is not None else None)
    return reactor if isinstance(reactor, PlanReactor) else None


def _unloaded(configuration: AgentConfiguration, problem: UnusableModelError, world: World) -> Outcome:
    """The outcome of a mission of which a model does not load."""
    trace = world.trace
    reason = Reason(ReasonKind.UNLOADABLE, tick=0, message=str(problem))
    causes = tuple(range(len(trace.events)))
    event = trace.record(
        EventKind.ABORT, problem.reactor, causes=causes, code="F9", reason=reason, conflict=problem.conflict
    )
    abort = Abort("F9", 0, problem.reactor, (), reason, problem.conflict, 0, event)
    draws, events = tuple(trace.draws), trace.events
    return Outcome(world.seed, 0, configuration.final_tick, abort, draws, events, ())


def _make_reactors(
    configuration: AgentConfiguration,
    programs: MissionPrograms,
    world: World,
    compiles: bool,
    records: bool,
    loans: Loans,
) -> list[TeleoReactor]:
    """The reactors of a mission in its order, ready for tick 0."""
    trace, seed, overrides = world.trace, world.seed, world.overrides
    reactors: list[TeleoReactor] = []
    users = {line for each in configuration.reactors for line in each.external}
    users.update(line for each in configuration.coded for line in each.external)
    for number, (each, program) in enumerate(zip(configuration.reactors, programs.programs, strict=True)):
        world.learn(program)
        loaded = register_program(configuration, programs, number) if compiles else None
        if loaded is None:
            reactors.append(_plan_reactor(configuration, programs, number, world, loans))
            continue

        def general(shadow: Trace, number: int = number) -> PlanReactor:
            apart = World(configuration, seed, overrides, shadow)
            apart.parameters = world.parameters
            return _plan_reactor(configuration, programs, number, apart, loans)

        reactor = DeterminedReactor(each, loaded, world.in_force, general, configuration.final_tick, trace)
        reactor.machine.shows = records
        reactor.watched = sum(1 << reactor.numbers[line] for line in each.internal if line in users)
        reactors.append(reactor)
    kinds_of = partial(_parameter_kinds, configuration, programs)
    for coded, cls in zip(configuration.coded, programs.code, strict=True):
        make = partial(cls, {"folder": configuration.root, **dict(coded.settings), "seed": seed})
        reactors.append(CodedReactor(coded, make, kinds_of, trace, cls.wakes_on, configuration.root))
    places = {name: number for number, name in enumerate(configuration.order)}
    return sorted(reactors, key=lambda one: places.get(one.name, len(places)))


def _plan_reactor(
    configuration: AgentConfiguration, programs: MissionPrograms, number: int, world: World, loans: Loans
) -> PlanReactor:
    """A reactor with a plan database of its own."""
    each = configuration.reactors[number]
    solver, last = programs.solvers[number], configuration.final_tick
    draws = Draws(each.name, world)

    def make(environment: Environment) -> tuple[Workbench, Planner]:
        bench = loaded_bench(configuration, programs, number, environment)
        return bench, Planner(bench, solver, last, each.max_steps, each.max_depth)

    parts = (programs.programs[number], solver, programs.constraints)
    loaded = loans.borrow(configuration, number, parts, draws.draw, make)
    loaded.bench.goals = configuration.goals
    draws.view = loaded.bench
    return PlanReactor(each, loaded.bench, loaded.planner, last, world.trace, draws)


def register_program(
    configuration: AgentConfiguration, programs: MissionPrograms, number: int
) -> RegisterProgram | None:
    """The register code of a reactor, if it is determined."""
    each, program = configuration.reactors[number], programs.programs[number]
    found = known(program, each, configuration.tick, configuration.final_tick)
    if found is None:
        bench = loaded_bench(configuration, programs, number, lambda name, token: None)
        found = find_out(bench, program, each, configuration.tick, configuration.final_tick)
    return found[0]


def loaded_bench(
    configuration: AgentConfiguration, programs: MissionPrograms, number: int, environment: Environment
) -> Workbench:
    """A plan database in which the script of a reactor's model has been run."""
    name = configuration.reactors[number].name
    database = PlanDatabase(programs.programs[number], environment, programs.constraints, narrows_functions=True)
    fault = database.run_script()
    if fault is not None:
        raise UnusableModelError(f"{fault.span.source.name}:{fault.span.line}: {fault.message}", name)
    bench = Workbench(database, name)
    holds = bench.set_global("TICK_DURATION", configuration.tick)
    holds = holds and bench.set_global("MISSION_START", 0)
    holds = holds and bench.set_global("MISSION_END", configuration.final_tick)
    holds = holds and bench.start_clock(configuration.final_tick)
    if not holds or not bench.is_consistent():
        message = f"the model of `{name}` contradicts itself before the mission begins"
        raise UnusableModelError(message, name, conflict_of(bench))
    bench.commit()
    return bench


def _goal_kinds(
    configuration: AgentConfiguration, programs: MissionPrograms, goal: GoalConfiguration
) -> Mapping[str, tuple[str, str]]:
    """Kind and type name of each parameter of a goal's predicate, in the model of the timeline's owner."""
    kinds = _parameter_kinds(configuration, programs, goal.timeline, goal.predicate) or {}
    return {name: (kind, type_name) for name, (kind, type_name, _) in kinds.items()}


def _parameter_kinds(
    configuration: AgentConfiguration, programs: MissionPrograms, timeline: str, predicate: str
) -> Mapping[str, tuple[str, str, tuple[str, ...]]] | None:
    """Kind, type name and names of the values of each parameter of a predicate; only enums name their values.

    They are those of the owner of the timeline, or else of a user.
    """
    pairs = list(zip(configuration.reactors, programs.programs, strict=True))
    owners = [program for reactor, program in pairs if timeline in reactor.internal]
    users = [program for reactor, program in pairs if timeline in reactor.external]
    for program in owners + users:
        classes = {name: code.type_name for name, code in program.globals}
        wanted = f"{classes.get(timeline, '')}.{predicate}"
        for each in program.predicates:
            if each.name == wanted:
                enums = dict(program.enums)
                types = {parameter.name: parameter.type for parameter in each.parameters}
                return {
                    name: (type_.kind, type_.type_name, enums.get(type_.type_name, ()) if type_.kind == "enum" else ())
                    for name, type_ in types.items()
                }
    return None


def request_of(goal: GoalConfiguration, number: int, kinds: Mapping[str, tuple[str, str]]) -> Request:
    """A goal of the mission file as a request; `kinds` gives kind and type name of each parameter."""
    arguments: Arguments = tuple(
        (name, _domain(value, *kinds.get(name, ("float", "float")))) for name, value in goal.parameters
    )
    return Request(
        number,
        goal.timeline,
        goal.predicate,
        arguments,
        _bounds(goal.start),
        _bounds(goal.end),
        _bounds(goal.duration),
        "",
        -1,
        goal.mandatory,
    )


def _bounds(given: tuple[float, float] | None) -> tuple[int, int]:
    if given is None:
        return (-INFINITY, INFINITY)
    return (whole_bound(given[0]), whole_bound(given[1]))


def _domain(value: Value | tuple[float, float], kind: str, type_name: str) -> DomainConstant:
    if isinstance(value, tuple):
        return DomainConstant(kind, type_name, value, None)
    if isinstance(value, (bool, str)):
        return DomainConstant(kind, type_name, None, (value,))
    number = float(value) if kind == "float" else value
    return DomainConstant(kind, type_name, (number, number), None)
