"""`nddlc validate`: judge a mission, a recorded one, a trace or a plan written by hand against the model."""

from pathlib import Path
from typing import Any, NamedTuple

import click

from checker.judge.document import record_data
from checker.judge.draws import Chance
from checker.judge.judge import judge_mission, judge_plan
from checker.judge.printed_plan import is_printed, plan_document
from checker.judge.reading import read_json, read_plan, read_record
from checker.judge.rendering import report_data, report_text
from checker.judge.report import JudgeReport
from checker.judge.trace_reading import plan_of_trace
from checker.judge.written_values import DocumentError
from checker.logged import MissionLog, is_log, read_mission_log
from checker.mission import read_mission
from checker.one_flight import read_trace
from checker.pinned import pinned
from checker.proofs.judgement import ProvedJudgement, judgement_data, judgement_text, prove_record
from checker.proofs.operands import names_of
from compiler.lower import compile_model
from compiler.program import Program
from nddl_lang.analysis import Analysis, analyse_file, analyse_text
from nddl_lang.mission_suffixes import MISSION_SUFFIXES
from nddl_lang.repair import repaired
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.render import render
from nddl_lang.text.values import json_text
from nddlc.goals import goals_of
from nddlc.inputs import Unusable, configured, present, readable
from nddlc.mission_trust import models_of
from nddlc.trust import trust_option
from runtime.executive.configuration import AgentConfiguration, ReactorConfiguration
from runtime.executive.mission import MissionPrograms, UnusableModelError, record_mission
from runtime.executive.outcome import RepairStage
from runtime.executive.record import MissionRecord, ReactorRecord
from runtime.executive.recorder import Recorder
from runtime.plan.database import PlanDatabase

_PLAN = "plan"
_MOST_TOKENS = 5000


class _Judged(NamedTuple):
    """What was judged, and what it takes to judge it again; `seed` is None where nothing is known of draws.

    `forgot`: reactors that forgot their past in a repair, and when.
    """

    report: JudgeReport
    agent: AgentConfiguration
    programs: tuple[Program, ...]
    record: MissionRecord
    seed: int | None
    forgot: tuple[tuple[str, int], ...] = ()


@click.command()
@click.argument("plan", metavar="PLAN", type=click.Path(path_type=Path))
@click.option("--mission", "mission_path", type=click.Path(path_type=Path), help="Whose trace or record.")
@click.option("--seed", type=int, default=0, help="Of a mission that is flown here.")
@click.option("--record", "target", type=click.Path(path_type=Path), help="Write the record of what was flown.")
@click.option("--smt", "asks_z3", is_flag=True, help="Have z3 judge it as well, from the text of the model.")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print it.")
@trust_option
def command(
    plan: Path,
    mission_path: Path | None,
    seed: int,
    target: Path | None,
    asks_z3: bool,
    style: str,
    is_trusted: bool,
) -> int:
    """Judge PLAN against its model, by code that shares nothing with the planner.

    PLAN is a mission file (.toml, or T-REX's .xml or .cfg), which is flown; a record or a plan (.json); a trace
    (.jsonl), which needs --mission unless it names its own; or with --mission a log of T-REX (.tr.log), or the
    directory of a mission's logs. docs/validate.md describes the documents. The exit code is 1 where something
    breaks the model. With --smt z3 judges the same values, by what the text of the model demands.
    """
    present(plan)
    present(mission_path)
    try:
        if is_log(plan):
            judged = _logged(plan, mission_path, is_trusted)
        elif plan.is_dir():
            raise Unusable(f"there is no log of T-REX (*.tr.log) in `{plan}`")
        elif plan.suffix in MISSION_SUFFIXES:
            judged = _flown(plan, seed, target, is_trusted)
        elif plan.suffix == ".jsonl":
            judged = _traced(plan, mission_path, is_trusted)
        else:
            judged = _documented(plan, mission_path, is_trusted)
    except DocumentError as problem:
        raise Unusable(f"`{plan}`: {problem}", problem.advice or "docs/validate.md describes the form") from None
    except UnusableModelError as problem:
        raise Unusable(str(problem)) from None
    report, proved = judged.report, _proved(judged) if asks_z3 else None
    if style == "json":
        data = report_data(report) | ({} if proved is None else {"smt": judgement_data(proved)})
        click.echo(json_text(data))
    else:
        click.echo(report_text(report, advises=plan.suffix == ".json"))
        for line in _set_aside(judged):
            click.echo(line)
        if proved is not None:
            click.echo(judgement_text(proved))
    return 0 if report.holds and (proved is None or not proved.broken) else 1


def _set_aside(judged: _Judged) -> list[str]:
    """What a reader of a trace has to know where a plan does not hold that a repair had forgotten in part."""
    found = {one.reactor for one in judged.report.disagreements}
    return [
        f"help: `{reactor}` forgot its past in the repair at tick {tick}: from then on its executive kept no rule that "
        "speaks of what was over; here all is judged"
        for reactor, tick in judged.forgot
        if reactor in found
    ]


def _proved(judged: _Judged) -> ProvedJudgement:
    """What z3 says of the same values; draws that are made again and again are left to the judge."""
    count = sum(len(each.tokens) for each in judged.record.reactors)
    if count > _MOST_TOKENS:
        raise Unusable(f"{count} tokens are too many for z3 (at most {_MOST_TOKENS})", "judge a shorter mission")
    draws = {}
    if judged.seed is not None:
        chance = Chance(judged.agent, judged.programs, judged.seed, {})
        for each in judged.agent.parameters:
            value = chance.draw(each.name, 0)
            if each.mode == "inter" and isinstance(value, (int, float)):
                draws[each.name] = float(value)
    return prove_record(judged.agent, judged.programs, judged.record, draws)


def _flown(path: Path, seed: int, target: Path | None, is_trusted: bool) -> _Judged:
    agent, programs = _loaded(path, is_trusted)
    outcome, record = record_mission(agent, programs, seed)
    if target is not None:
        text = json_text({"mission": str(path), "seed": seed, **record_data(record)})
        draft = target.with_name(target.name + ".part")
        draft.write_text(text + "\n", encoding="utf-8")
        draft.replace(target)
    report = judge_mission(agent, programs.programs, outcome, record, programs.constraints)
    return _Judged(report, agent, programs.programs, record, seed)


def _loaded(path: Path, is_trusted: bool, *, is_named: bool = True) -> tuple[AgentConfiguration, MissionPrograms]:
    mission, found = read_mission(path)
    _refuse(found, "the mission file is in error: nothing was judged")
    assert mission is not None
    models = models_of(mission, is_trusted=is_trusted, is_named=is_named)
    _refuse(models.diagnostics, "the models are in error: nothing was judged")
    return models.agent, pinned(models).programs_of(models.agent)


def _refuse(found: tuple[Diagnostic, ...], problem: str) -> None:
    errors = [one for one in found if one.severity is Severity.ERROR]
    if errors:
        click.echo("\n".join(render(one) for one in errors), err=True)
        raise Unusable(problem)


def _traced(path: Path, mission_path: Path | None, is_trusted: bool) -> _Judged:
    try:
        whose = mission_path or read_trace(path).mission
    except ValueError as problem:
        raise Unusable(f"`{path}`: {problem}", "name the mission file with --mission") from None
    readable((str(whose),), ())
    _text(path)
    return _observed(read_mission_log(path), whose, is_trusted, is_named=mission_path is not None)


def _logged(path: Path, mission_path: Path | None, is_trusted: bool) -> _Judged:
    if mission_path is None:
        raise Unusable(f"`{path}` does not say of which mission it is", "name the mission file with --mission")
    try:
        log = read_mission_log(path)
    except ValueError as problem:
        raise Unusable(f"`{path}` is no log of T-REX: {problem}") from None
    return _observed(log, mission_path, is_trusted, is_named=True)


def _observed(log: MissionLog, whose: Path, is_trusted: bool, *, is_named: bool) -> _Judged:
    """What was observed on the timelines of each reactor, judged against its model."""
    agent, programs = _loaded(whose, is_trusted, is_named=is_named)
    reports, plans = [], []
    for place, program in zip(agent.reactors, programs.programs, strict=True):
        timelines = (*place.internal, *place.external)
        base = _base(program, place.name, programs)
        plan = plan_of_trace(log.events, timelines, base, program, last=log.last_tick, step=log.step)
        seen = [line for line in timelines if line in log.timelines]
        told = frozenset(each.class_name for each in plan.objects if each.name in seen)
        report, followed = judge_plan(program, plan, programs.constraints, told)
        reports.append(report)
        plans.append(followed._replace(reactor=place.name))
    owned = {line for lines in _owned(agent) for line in lines}
    foreign = [
        f"`{line}`, a timeline that no reactor of the mission owns" for line in log.timelines if line not in owned
    ]
    cut_off = [f"what came after the end of `{name}`, which breaks off" for name in log.cut_off]
    report = JudgeReport(
        tuple(one for report in reports for one in report.disagreements),
        sum(report.judged for report in reports),
        sum(report.open for report in reports),
        (*(row for report in reports for row in report.skipped), *((reason, 1) for reason in (*foreign, *cut_off))),
    )
    repairs = [one for one in log.events if one.get("stage") == RepairStage.FORGET_PAST]
    forgot = tuple((str(one["reactor"]), int(one["tick"])) for one in repairs)
    return _Judged(report, agent, programs.programs, MissionRecord(tuple(plans)), None, forgot)


def _owned(agent: AgentConfiguration) -> list[tuple[str, ...]]:
    return [*(one.internal for one in agent.reactors), *(one.internal for one in agent.coded)]


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as problem:
        raise DocumentError(f"it is no text: {problem}") from None


def _documented(path: Path, mission_path: Path | None, is_trusted: bool) -> _Judged:
    data: Any = read_json(_text(path))
    if not isinstance(data, dict):
        raise DocumentError("it is no object of JSON")
    if "reactors" in data:
        return _recorded(path, data, mission_path, is_trusted)
    name = data["file"] if is_printed(data) else data.get("model")
    if not isinstance(name, str):
        raise DocumentError("it names no `model`")
    model = next((each for each in _places(path, name, is_printed=is_printed(data)) if each.is_file()), None)
    if model is None:
        raise DocumentError(f"there is no model `{path.parent / name}`")
    reactor = data.get("reactor")
    analysis = _analysed(model, reactor if is_printed(data) and isinstance(reactor, str) else None)
    _refuse(repaired(analysis).diagnostics, "the model is in error: nothing was judged")
    program = compile_model(analysis)
    base = _base(program, _PLAN)
    if is_printed(data):
        data = plan_document(data, program, base)
    plan = read_plan(data, base, program)._replace(reactor=_PLAN)
    report, followed = judge_plan(program, plan, is_whole="last_tick" not in data)
    names = names_of(program)
    timelines = tuple(each.name for each in plan.objects if names.is_kind_of(each.class_name, "Timeline"))
    last = max([plan.last_tick, *[one.end for one in plan.tokens if isinstance(one.end, int)]])
    reactor = ReactorConfiguration(_PLAN, str(model), internal=timelines)
    agent = AgentConfiguration(_PLAN, str(path.parent), last, (reactor,))
    return _Judged(report, agent, (program,), MissionRecord((followed,)), None)


def _places(path: Path, name: str, *, is_printed: bool) -> tuple[Path, ...]:
    """Where the model of a plan may be: beside the document; one that a command named, where this one runs."""
    return (path.parent / name, Path(name)) if is_printed else (path.parent / name,)


def _analysed(model: Path, reactor: str | None) -> Analysis:
    """The analysis of a model, or of the goals of a mission file with the model of their planner."""
    text = None
    if model.suffix in MISSION_SUFFIXES:
        model, text, _, _ = goals_of(model, reactor)
    settings = configured(model)
    if text is not None:
        return analyse_text(str(model), text, settings.dialect, settings.directories, most=settings.most_lexemes)
    return analyse_file(model, settings.dialect, settings.directories, most=settings.most_lexemes)


def _recorded(path: Path, data: dict[str, Any], mission_path: Path | None, is_trusted: bool) -> _Judged:
    named = mission_path or (path.parent / data["mission"] if isinstance(data.get("mission"), str) else None)
    if named is None or not named.is_file():
        raise DocumentError("the mission that it names is not there; say where with --mission")
    agent, programs = _loaded(named, is_trusted, is_named=mission_path is not None)
    places = zip(agent.reactors, programs.programs, strict=True)
    models = {place.name: program for place, program in places}
    bases = {name: _base(program, name, programs) for name, program in models.items()}
    record: MissionRecord = read_record(data, bases, models)
    seed = data.get("seed", 0)
    seed = seed if isinstance(seed, int) else 0
    # What was published is what the mission publishes when it is flown again.
    outcome, _ = record_mission(agent, programs, seed)
    report = judge_mission(agent, programs.programs, outcome, record, programs.constraints)
    return _Judged(report, agent, programs.programs, record, seed)


def _base(program: Program, name: str, programs: MissionPrograms | None = None) -> ReactorRecord:
    """The model as it is loaded: its objects and global variables."""
    database = PlanDatabase(program, None, programs.constraints if programs is not None else ())
    fault = database.run_script()
    if fault is not None:
        raise UnusableModelError(f"{fault.span.source.name}:{fault.span.line}: {fault.message}")
    return Recorder(database, name).close()._replace(script_tokens=(), tokens=())
