"""One failed mission in, its story out: the steps from what was drawn to the line where the agent gave up."""

from dataclasses import dataclass

from checker.batch.result import MissionResult
from checker.causes import blame, culprit, draws_behind, events_to_abort, in_telling_order
from checker.findings import Fault
from checker.influence import Influence
from checker.oracle import CODE_NAMES
from checker.sampling.wording import describe, number
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.outcome import Cause, Event, Outcome, Place

ORIGINS = {"clock": " (by the clock)", "observation": " (as observed)", "order": " (by the order of tokens)"}


@dataclass(frozen=True, slots=True)
class Step:
    """One link of the chain: when (None: always), why in a line, and where that is written.

    `kind` is draw, line (of the model, on the way of the draw), event, cause (of the conflict), fault or abort.
    `limits` are the lines that set what the faulty line compares with.
    """

    kind: str
    tick: int | None
    reason: str
    place: Place | None
    limits: tuple[Place, ...] = ()


@dataclass(frozen=True, slots=True)
class Story:
    """Why one mission failed; `fault` ties it to the others that failed alike."""

    number: int
    seed: int
    code: str
    title: str
    last_tick: int
    final_tick: int
    steps: tuple[Step, ...]
    fault: Fault | None


def tell(result: MissionResult, agent: AgentConfiguration, influence: Influence, fault: Fault | None) -> Story:
    """The story of a mission that failed and whose outcome is at hand."""
    outcome = result.outcome
    assert outcome is not None
    parameters = _suspects(outcome, fault)
    draws = _draws(outcome, agent, influence, parameters)
    shown = _tokens_of(outcome, influence, parameters)
    indices = {*shown, *(index for index in events_to_abort(outcome, parameters) if index >= min(shown, default=0))}
    way = [outcome.events[index] for index in sorted(indices)]
    if draws:
        way = [event for event in way if event.kind != "sample"]
    steps = [
        *draws,
        *(_event(event) for event in way),
        *_conflict(outcome),
        _end(outcome, result),
    ]
    return Story(
        result.number,
        result.seed,
        result.judgement.code,
        result.judgement.reason,
        outcome.last_tick,
        outcome.final_tick,
        tuple(_without_repeats(steps)),
        fault,
    )


def _suspects(outcome: Outcome, fault: Fault | None) -> tuple[str, ...]:
    """The parameters that the story begins with: those with a threshold, else those that the abort depends on."""
    if fault is not None and fault.thresholds:
        return tuple(threshold.parameter for threshold in fault.thresholds)
    return draws_behind(outcome)


def _tokens_of(outcome: Outcome, influence: Influence, parameters: tuple[str, ...]) -> list[int]:
    """The last observations of the tokens whose rules the draws act through: where a draw shows outside its reactor."""
    found: list[int] = []
    for predicate in dict.fromkeys(
        rule.rpartition(".")[2] for name in parameters for rule, _ in influence.get(name, ())
    ):
        shown = [
            index
            for index, event in enumerate(outcome.events)
            if event.kind == "observation" and event.text.partition("(")[0] == predicate
        ]
        found += shown[-1:]
    return found


def _draws(
    outcome: Outcome, agent: AgentConfiguration, influence: Influence, parameters: tuple[str, ...]
) -> list[Step]:
    by_name = {parameter.name: parameter for parameter in agent.parameters}
    steps: list[Step] = []
    for name in parameters:
        drawn = [draw for draw in outcome.draws if draw.parameter == name]
        if not drawn:
            continue
        draw, lines = drawn[-1], influence.get(name, ())
        clipped = "" if draw.raw == draw.value else f" (drawn {number(draw.raw)}, then clipped)"
        reason = f"{name} is {number(draw.value)}{clipped}{_manner(by_name.get(name))}"
        tick = draw.tick if name in by_name and by_name[name].mode == "intra" else None
        steps.append(Step("draw", tick, reason, lines[0][1] if lines else _sampled_at(outcome, name)))
        steps += [Step("line", None, f"it acts through the rule of {rule}", place) for rule, place in lines[1:]]
    return steps


def _manner(parameter: ParameterConfiguration | None) -> str:
    return f": {describe(parameter)}" if parameter is not None else ""


def _sampled_at(outcome: Outcome, name: str) -> Place | None:
    """The line that samples a parameter, if the conflict knows it."""
    conflict = outcome.abort.conflict if outcome.abort else None
    for cause in conflict.causes if conflict else ():
        if any(term.name == "sampledParameter" and term.arguments[1] == name for term in cause.terms):
            return cause.place
    return None


def _event(event: Event) -> Step:
    about = f" on {event.timeline}" if event.timeline else ""
    who = {"": "the mission file"}.get(event.reactor, event.reactor)
    match event.kind:
        case "observation":
            reason = f"{who} publishes {event.timeline} = {event.text}"
        case "request":
            reason = f"{who} requests {event.text}{about}"
        case "sample":
            reason = f"{who} draws {event.text}"
        case "relax":
            reason = f"{who} repairs its plan: {event.text}"
        case _:
            reason = f"{who}: {event.kind} {event.text}{about}"
    return Step("event", event.tick, reason, None)


def _conflict(outcome: Outcome) -> list[Step]:
    """The causes of the conflict, from the draw outwards, the line to blame last."""
    conflict = outcome.abort.conflict if outcome.abort else None
    if conflict is None:
        return []
    guilty = culprit(conflict)
    found = blame(conflict)
    steps = [
        Step("cause", None, _because(cause), cause.place)
        for index, cause in ((index, conflict.causes[index]) for index in in_telling_order(conflict))
        if index != guilty and cause.kind != "sample" and cause.place not in found.limits
    ]
    if guilty is not None:
        cause = conflict.causes[guilty]
        steps.append(Step("fault", None, _because(cause), cause.place, found.limits))
    return steps


def _because(cause: Cause) -> str:
    """What a cause did, whose it is, and, where no line of the model says it, what does."""
    whose = f"{cause.token}: " if cause.token and cause.token not in cause.because else ""
    return f"{whose}{cause.because}{ORIGINS.get(cause.kind, '')}"


def _end(outcome: Outcome, result: MissionResult) -> Step:
    code = result.judgement.code
    name = CODE_NAMES.get(code, result.judgement.reason)
    if outcome.abort is None:
        return Step("abort", outcome.last_tick, f"the mission fails ({code}: {name})", None)
    repairs = f" after {outcome.abort.relaxes} repairs" if outcome.abort.relaxes else ""
    return Step("abort", outcome.abort.tick, f"{outcome.abort.reactor} gives up{repairs} ({code}: {name})", None)


def _without_repeats(steps: list[Step]) -> list[Step]:
    """The steps with those left out whose line the story has told already, the fault excepted."""
    kept: list[Step] = []
    told: set[tuple[str, int]] = set()
    guilty = next((step.place for step in steps if step.kind == "fault"), None)
    for step in steps:
        if step.place is not None and step.kind != "fault":
            key = (step.place.file, step.place.line)
            if key in told or step.place == guilty:
                continue
            told.add(key)
        kept.append(step)
    return kept
