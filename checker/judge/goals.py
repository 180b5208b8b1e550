"""Judge goals: what counts as achieved was executed from beginning to end, as it was asked for."""

from collections.abc import Sequence

from checker.judge.bench import Bench, Tok
from checker.judge.timelines import is_cut_short
from checker.judge.tokens import ProgramJudge
from checker.judge.values import lies_within, may_be_equal
from compiler.program import END, FIRST_PARAMETER, START
from runtime.executive.configuration import AgentConfiguration, GoalConfiguration
from runtime.executive.outcome import Event, EventKind, Outcome
from runtime.executive.record import Value, ValueRange


def judge_goals(
    agent: AgentConfiguration, outcome: Outcome, events: Sequence[Event], desks: dict[str, tuple[ProgramJudge, Bench]]
) -> None:
    """Judge the mandatory goals that count as achieved: said to be, or not left open when the mission had its time."""
    said = {event.request for event in events if event.kind is EventKind.ACHIEVED}
    has_ended = outcome.abort is None and outcome.last_tick >= agent.final_tick
    left = [(goal.timeline, goal.predicate) for goal in outcome.open_goals]
    for number, goal in enumerate(agent.goals):
        counts = (goal.timeline, goal.predicate) not in left if has_ended else -1 - number in said
        if not goal.mandatory or not counts:
            continue
        owner = next((one for one in agent.reactors if goal.timeline in one.internal), None)
        if owner is not None and owner.name in desks:
            _judge_goal(*desks[owner.name], goal, has_ended)


def _judge_goal(judge: ProgramJudge, bench: Bench, goal: GoalConfiguration, has_ended: bool) -> None:
    """Judge one goal that counts as achieved; where the flight was cut or aborted, whether it was executed at all."""
    bench.judged += 1
    named = bench.tokens.of(bench.tokens.named(goal.predicate))
    fitting = [tok for tok in named if _is_answer(judge, bench, goal, tok)]
    if any(not is_cut_short(tok) or not has_ended for tok in fitting):
        return
    values: tuple[tuple[str, Value], ...] = (("timeline", goal.timeline), ("asked from", goal.at))
    is_cut = bool(fitting)
    found = "cut off by a repair" if is_cut else "never executed as asked"
    bench.report("goal", goal.predicate, tuple(fitting[:1]), values, "achieved", found, None, is_cut)


def _is_answer(judge: ProgramJudge, bench: Bench, goal: GoalConfiguration, tok: Tok) -> bool:
    """Whether a token is what a goal asks for, executed to its end."""
    if not tok.is_planned or not may_be_equal(tok.record.object, goal.timeline) or not bench.is_over(tok):
        return False
    spans = ((START, goal.start), (END, goal.end))
    if any(given is not None and not lies_within(tok.values[index], *given) for index, given in spans):
        return False
    names = [parameter.name for parameter in judge.predicates[tok.record.predicate].code.parameters]
    return has_arguments(names, tok.values[FIRST_PARAMETER:], goal)


def has_arguments(names: Sequence[str], arguments: Sequence[Value], goal: GoalConfiguration) -> bool:
    """Whether the arguments of a token, by their names, may be what a goal asks for, as far as both say."""
    found = dict(zip(names, arguments, strict=False))
    wanted = ((name, ValueRange(*given) if isinstance(given, tuple) else given) for name, given in goal.parameters)
    return all(name not in found or may_be_equal(found[name], value) for name, value in wanted)
