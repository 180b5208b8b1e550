"""A whole mission put to the plain oracle: rules, timelines, publications, levels and goals of all reactors."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import inf

from compiler.program import END, FIRST_PARAMETER, OBJECT, START, Program
from runtime.executive.chance import sample
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.outcome import Event, EventKind, Outcome
from runtime.executive.record import MissionRecord, TokenRecord
from tests.checker.judge.plain_oracle import PlainOracle
from tests.checker.judge.plain_tries import Mission, Token
from tests.checker.judge.plain_values import box_of, box_of_constant, overlap

_SLACK = 1e-3  # of levels: a sum of many reals


def objections(
    agent: AgentConfiguration, programs: Sequence[Program], outcome: Outcome, record: MissionRecord
) -> list[str]:
    """What of an executed mission cannot be, by its models."""
    found = []
    events = list(outcome.events)
    draw = _draws(agent, programs, outcome.seed)
    lost = {event.reactor for event in events if event.kind in (EventKind.KILL, EventKind.ABORT)}
    places = {one.name: (one, program) for one, program in zip(agent.reactors, programs, strict=True)}
    for each in record.reactors:
        configuration, program = places[each.reactor]
        repaired = max((e.tick for e in events if e.kind is EventKind.RELAX and e.reactor == each.reactor), default=-1)
        oracle = PlainOracle(program, each, Mission(agent.final_tick, draw, each.reactor in lost, repaired))
        shared = (*configuration.internal, *configuration.external)
        said = [*oracle.objections(), *_in_order(oracle, shared), *_levels(oracle)]
        for line in shared:
            published = [e for e in events if e.kind is EventKind.OBSERVATION and e.timeline == line]
            if all(event.predicate != "Failed" for event in published):
                said += _published(oracle, line, published)
        if outcome.abort is None and outcome.last_tick >= agent.final_tick:
            said += _goals(agent, outcome, oracle, configuration.internal)
        found += [f"{each.reactor}: {one}" for one in said]
    return found


def _draws(agent: AgentConfiguration, programs: Sequence[Program], seed: int) -> Callable[[str, int], float | None]:
    known: dict[str, ParameterConfiguration] = {one.name: one for one in agent.parameters}
    for program in programs:
        for site in program.sampled:
            if site.name not in known and site.default is not None and site.default.interval is not None:
                low, high = map(float, site.default.interval)
                known[site.name] = ParameterConfiguration(site.name, low, high, is_whole=site.kind == "int")

    def draw(name: str, tick: int) -> float | None:
        parameter = known.get(name)
        if parameter is None:
            return None
        given: Mapping[str, float] = {}
        if parameter.expression:
            others = {other: draw(other, tick) for other in known if other != name and other in parameter.expression}
            given = {other: value for other, value in others.items() if value is not None}
        return sample(parameter, seed, tick, given).value

    return draw


# ---- timelines ----


def _in_order(oracle: PlainOracle, shared: tuple[str, ...]) -> Iterator[str]:
    """Tokens of a timeline follow each other, on a shared one without a gap."""
    natives = {code.name: code.native for code in oracle.program.classes}
    for name, thing in oracle.objects.items():
        if natives.get(thing.class_name) != "Timeline":
            continue
        tokens = [
            token
            for token in oracle.tokens
            if token.boxes[OBJECT] == frozenset({name}) and token.record.fate != "cut" and token.end[1] > 0
        ]
        tokens.sort(key=lambda one: (one.start[0], one.end[0]))
        for before, after in pairwise(tokens):
            if before.end[0] > after.start[1]:
                yield f"{name}: {_name(before)} and {_name(after)} at once"
            elif name in shared and before.end[1] < after.start[0] and oracle.mission.repaired < 0:
                yield f"{name}: nothing holds from {before.end[1]} to {after.start[0]}"
        if name in shared and tokens and tokens[-1].end[1] < oracle.record.last_tick and oracle.mission.repaired < 0:
            yield f"{name}: nothing holds after {tokens[-1].end[1]}"


def _name(token: Token) -> str:
    return f"{token.code.name}#{token.record.key}"


def _published(oracle: PlainOracle, line: str, published: list[Event]) -> Iterator[str]:
    """What a reactor holds on a timeline began with what was published, and all that was published began a token."""
    last = oracle.record.last_tick
    held: dict[int, list[TokenRecord]] = {}
    for one in oracle.record.tokens:
        if one.object == line and one.state in ("active", "merged") and isinstance(one.start, int):
            held.setdefault(one.start, []).append(one)
    told = {event.tick: event for event in published if event.tick <= last}
    for tick, event in told.items():
        if not any(_is_it(oracle, one, event) for one in held.get(tick, ())):
            yield f"{line}: {event.predicate} was published at {tick}, and nothing like it begins then"
    for tick, ones in held.items():
        lasting = [one for one in ones if one.state == "active" and one.fate != "cut" and 0 <= tick <= last]
        if lasting and tick not in told:
            yield f"{line}: {lasting[0].predicate} begins at {tick}, and nobody published it"


def _is_it(oracle: PlainOracle, one: TokenRecord, event: Event) -> bool:
    name = one.predicate.rpartition(".")[2]
    if name == "undefined":
        return True
    if name != event.predicate:
        return False
    code = next(code for code in oracle.program.predicates if code.name == one.predicate)
    held = {parameter.name: value for parameter, value in zip(code.parameters, one.arguments, strict=True)}
    return all(
        overlap(box_of_constant(domain), box_of(held[name])) is not False
        for name, domain in event.arguments
        if name in held
    )


# ---- resources and goals ----


def _levels(oracle: PlainOracle) -> Iterator[str]:
    """Levels from the tokens of a resource, where all of their times and quantities are known."""
    natives = {code.name: code.native for code in oracle.program.classes}
    for name, thing in oracle.objects.items():
        native = natives.get(thing.class_name)
        if native not in ("Reservoir", "Reusable") or oracle.mission.repaired >= 0 or _is_used_in_rules(oracle):
            continue
        members = dict(zip(oracle.members[thing.class_name], map(box_of, thing.members), strict=True))
        first = members["initialCapacity" if native == "Reservoir" else "capacity"]
        limits = (members["levelLimitMin"], members.get("levelLimitMax") if native == "Reservoir" else (inf, inf))
        changes: dict[float, float] = {}
        is_known = all(isinstance(one, tuple) for one in (first, *limits))
        for token in oracle.tokens:
            if token.boxes[OBJECT] != frozenset({name}) or token.record.fate == "cut":
                continue
            amount = token.boxes[FIRST_PARAMETER]
            if not isinstance(token.record.start, int) or not isinstance(amount, tuple) or amount[1] - amount[0] > 1:
                is_known = False
                break
            kind = token.code.name.rpartition(".")[2]
            by = (amount[0] + amount[1]) / 2 * (1 if kind == "produce" else -1)
            if kind == "uses" and token.end[0] <= token.start[0]:
                continue
            changes[token.start[0]] = changes.get(token.start[0], 0.0) + by
            if kind == "uses":  # an end that was left open may have come as early as it could
                changes[token.end[0]] = changes.get(token.end[0], 0.0) - by
        if not is_known:
            continue
        level = first[1]  # type: ignore[index]
        for tick in sorted(tick for tick in changes if tick <= oracle.record.last_tick):
            level += changes[tick]
            least, most = limits[0][0], limits[1][1]  # type: ignore[index]
            if not least - _SLACK <= level <= most + _SLACK:
                yield f"{name}: its level is {level:g} at {tick}"
                break


def _is_used_in_rules(oracle: PlainOracle) -> bool:
    """Whether rules use resources without tokens, which the record then does not tell."""
    return any("uses" in str(rule.body) and "name='uses'" in str(rule.body) for rule in oracle.program.rules)


def _goals(
    agent: AgentConfiguration, outcome: Outcome, oracle: PlainOracle, internal: tuple[str, ...]
) -> Iterator[str]:
    """A mandatory goal that was not left open was executed as it was asked for."""
    left = {(goal.timeline, goal.predicate) for goal in outcome.open_goals}
    for goal in agent.goals:
        if not goal.mandatory or goal.timeline not in internal or (goal.timeline, goal.predicate) in left:
            continue
        for token in oracle.tokens:
            at = {START: goal.start, END: goal.end}
            held = dict(zip([one.name for one in token.code.parameters], token.boxes[FIRST_PARAMETER:], strict=True))
            if (
                token.code.name.rpartition(".")[2] == goal.predicate
                and token.boxes[OBJECT] == frozenset({goal.timeline})
                and all(given is None or overlap(token.boxes[index], given) for index, given in at.items())
                and all(
                    overlap(held.get(name), value if isinstance(value, tuple) else box_of(value)) is not False
                    for name, value in goal.parameters
                )
            ):
                break
        else:
            yield f"{goal.timeline}: {goal.predicate} is no open goal, and was never executed"
