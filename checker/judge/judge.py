"""Judge a mission: programs, outcome and record in, a report with every disagreement out.

The judge evaluates the model over what was executed, in straight code; it asks no propagator, no plan and no solver.
Programs are compiled once and kept.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from checker.judge.bench import Bench, Tok
from checker.judge.bodies import Written
from checker.judge.bulk_timelines import History, Publications
from checker.judge.columns import Array
from checker.judge.draws import Chance
from checker.judge.goals import judge_goals
from checker.judge.operands import BodyFrame
from checker.judge.report import JudgeReport
from checker.judge.resources import judge_resources
from checker.judge.tables import Tables
from checker.judge.timelines import judge_timelines
from checker.judge.tokens import ProgramJudge, compile_program, judge_tokens
from checker.judge.values import UNKNOWN
from checker.judge.written import meanings_of
from compiler.program import Program
from runtime.executive.columns import TokenColumns
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.events import EventLog, single_events
from runtime.executive.outcome import Event, EventKind, Outcome, Phase, Reason, ReasonKind
from runtime.executive.record import NOBODY, MissionRecord, ReactorRecord, TokenRecord, Value
from runtime.user.constraint import Constraint

_FEWEST = 64  # tokens of a record for which tables are worth their cost
_KNOWN: dict[int, tuple[Program, tuple[Constraint, ...], ProgramJudge]] = {}


def _judge_of(program: Program, constraints: Sequence[Constraint] = ()) -> ProgramJudge:
    """The program ready to be judged, compiled when first asked for."""
    known = _KNOWN.get(id(program))
    if known is None or known[0] is not program or known[1] != tuple(constraints):
        if len(_KNOWN) >= 64:
            _KNOWN.clear()
        written: Written = meanings_of(constraints)
        known = _KNOWN[id(program)] = (program, tuple(constraints), compile_program(program, written))
    return known[2]


def judge_mission(
    agent: AgentConfiguration,
    programs: Sequence[Program],
    outcome: Outcome,
    record: MissionRecord,
    constraints: Sequence[Constraint] = (),
    overrides: Mapping[str, float] | None = None,
) -> JudgeReport:
    """Judge everything that the models say of an executed mission; programs are in the order of the reactors."""
    chance = Chance(agent, tuple(programs), outcome.seed, overrides or {})
    by_name = {each.reactor: each for each in few_listed(record).reactors}
    events = single_events(outcome.events)
    failed = {event.reactor for event in events if event.kind in (EventKind.KILL, EventKind.ABORT)}
    repaired = {event.reactor: event.tick for event in events if event.kind is EventKind.RELAX}
    history = _Trace(outcome, events)
    desks: dict[str, tuple[ProgramJudge, Bench]] = {}
    for configuration, program in zip(agent.reactors, programs, strict=True):
        written = by_name.get(configuration.name)
        if written is None:
            continue
        tables = Tables(written.tokens) if isinstance(written.tokens, TokenColumns) else None
        judge = _judge_of(program, constraints)
        bench = Bench(written, agent.final_tick, chance.draws, configuration.name in failed)
        bench.leaves_variables = configuration.solver is not None
        bench.last_repair = repaired.get(configuration.name, -1)
        desks[configuration.name] = (judge, bench)
        _judge_model(judge, bench, tables)
        judge_timelines(
            judge, bench, tables, history.seen_by(configuration.name), configuration.internal, configuration.external
        )
    judge_goals(agent, outcome, events, desks)
    return _summary([bench for _, bench in desks.values()])


def few_listed(record: MissionRecord) -> MissionRecord:
    """The record, columns of few tokens as a tuple of them, which is sooner read than tables."""
    return MissionRecord(
        tuple([one._replace(tokens=tuple(one.tokens)) if _is_few(one.tokens) else one for one in record.reactors])
    )


def _is_few(tokens: Sequence[TokenRecord]) -> bool:
    return len(tokens) < _FEWEST and not isinstance(tokens, tuple)


def breaches(report: JudgeReport) -> tuple[Reason, ...]:
    """What was executed against the model though nothing failed (F11)."""
    found = []
    for one in report.breaches:
        timeline = next((str(value) for name, value in one.values if name == "timeline"), "")
        found.append(Reason(ReasonKind.CUT_OFF, predicate=one.name, timeline=timeline))
    return tuple(found)


def judge_plan(
    program: Program,
    record: ReactorRecord,
    constraints: Sequence[Constraint] = (),
    told: frozenset[str] | None = None,
    *,
    is_whole: bool = False,
) -> tuple[JudgeReport, ReactorRecord]:
    """Judge a plan by itself: no owner and no draws; the plan comes back with the runs that were found out.

    `told` names the classes of whose objects all tokens are known; without it the plan has all tokens up to its last
    tick, and none comes later if it `is_whole`.
    """
    judge = _judge_of(program, constraints)
    bench = Bench(record, record.last_tick, _undrawn)
    bench.infers = True
    bench.leaves_variables = True  # nothing was executed
    bench.told = told
    bench.is_whole = is_whole
    _judge_model(judge, bench, None)
    judge_timelines(judge, bench, None, {}, (), ())
    tokens = tuple([one._replace(runs=tuple(bench.runs.get(one.key, one.runs))) for one in record.tokens])
    return _summary([bench]), record._replace(tokens=tokens)


def _undrawn(parameter: str, ticks: Array) -> None:
    """No draws are known."""


def _judge_model(judge: ProgramJudge, bench: Bench, tables: Tables | None) -> None:
    """Judge the script, the tokens with their rules, and the resources of one reactor."""
    _judge_script(judge, bench)
    judge_tokens(judge, bench, tables)
    judge_resources(judge, bench)


def _judge_script(judge: ProgramJudge, bench: Bench) -> None:
    """Judge global variables and the constraints of the script."""
    for k, name, test in judge.globals:
        value = bench.globals[k]
        if not bench.weigh(test(bench, value)):
            bench.report("domain", name, (), ((name, value),), "its value", "outside of its declaration")
    program = judge.program
    tokens: list[Tok | None] = [None if key == NOBODY else bench.tokens.get(key) for key in bench.record.script_tokens]
    tokens += [None] * (program.script_tokens - len(tokens))
    slots: list[Value] = [UNKNOWN] * program.script_slots
    frame = BodyFrame(bench, None, slots, tokens)
    for step in judge.script:
        step(frame)


class _Trace:
    """What was published in a mission, as each reactor came to see it."""

    def __init__(self, outcome: Outcome, events: Sequence[Event]) -> None:
        self.events = [event for event in events if event.kind is EventKind.OBSERVATION]
        self.columns = outcome.events.published() if isinstance(outcome.events, EventLog) else []
        self.deaths = {(event.tick, event.reactor) for event in events if event.kind is EventKind.KILL}
        self.common = self._told("") if not self.deaths else None

    def seen_by(self, reactor: str) -> History:
        """What `reactor` saw: news of a late death come with the next tick."""
        return self._told(reactor) if self.common is None else self.common

    def _told(self, reactor: str) -> History:
        found: History = {}
        for source, each in self.columns:
            found.setdefault(each.timeline, Publications()).columns.append((source, each))
        for event in self.events:
            one, known = event, found.get(event.timeline)
            if event.predicate == "Failed" and (event.tick, event.reactor) in self.deaths:
                if event.reactor == reactor:
                    continue
                if event.phase is Phase.DELIBERATE:
                    one = replace(event, tick=event.tick + 1)
            if known is None:
                known = found[event.timeline] = Publications()
            known.single.append(one)
        return found


def _summary(benches: Sequence[Bench]) -> JudgeReport:
    """The report of some reactors together."""
    skipped: dict[str, int] = {}
    for bench in benches:
        for reason, count in bench.skipped.items():
            skipped[reason] = skipped.get(reason, 0) + count
    return JudgeReport(
        tuple(one for bench in benches for one in bench.found),
        sum(bench.judged for bench in benches),
        sum(bench.open for bench in benches),
        tuple(sorted(skipped.items())),
        tuple(one for bench in benches for one in bench.profiles),
    )
