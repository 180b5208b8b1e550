"""Read a mission file: TOML text in, a `Mission` or diagnostics with places out.

The format is described in docs/mission.md; its parts are those of T-REX's agent file and of the founding paper's batch
file (reference of T-REX, 3.1 and 5.5).
"""

import math
import tomllib
from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path
from typing import cast

from checker.agent_file import read_agent_file
from checker.batch_xml import read_batch
from checker.clock_table import read_clock
from checker.codes import NO_GOALS, NO_OWNER, NOT_TOML
from checker.figures import Figures, read_figures
from checker.goal_fit import goals_out_of_time
from checker.limits import Limit
from checker.mission_table import HELD, MissionText, Table, TomlTable
from checker.named_files import look_at
from checker.parameter_tables import read_parameters
from checker.property_tables import read_properties
from checker.reactor_tables import read_reactors, suggest_owned
from checker.respelt import respelt, rewritten
from checker.unowned import tell_unowned
from nddl_lang.mission_suffixes import AGENT_SUFFIXES
from nddl_lang.syntax.codes import UNDECODABLE
from nddl_lang.text.diagnostic import Diagnostic, Note, Severity
from nddl_lang.text.nearest import nearest
from nddl_lang.text.read import read_source
from nddl_lang.text.source import Source, Span
from nddl_lang.text.toml_places import find_places
from nddl_lang.text.toml_slips import not_toml
from nddl_lang.text.values import toml_value
from runtime.constraints.domains.tags import HALF_INF
from runtime.executive.configuration import (
    AgentConfiguration,
    Bounds,
    CodeConfiguration,
    GoalConfiguration,
    OnFailure,
    ReactorConfiguration,
    Value,
)
from runtime.executive.outcome import SourcePlace
from runtime.user.limit import USUAL

LARGEST_SEED = (1 << 53) - 1  # what JSON readers agree on
MOST_MISSIONS = 1_000_000  # of a batch: each has its place in memory


@dataclass(frozen=True, slots=True)
class CheckConfiguration:
    """How many missions are flown, from which seed, and what rate of failure is still accepted."""

    missions: int = 200
    seed: int = 0
    max_failure_rate: float = 0.0
    confidence: float = 0.95
    time_limit: float = 60.0  # seconds of wall time for one mission
    limits: tuple[tuple[Limit, int], ...] = ()  # on what one mission may lose


@dataclass(frozen=True, eq=False, slots=True)
class Mission:
    """A mission file's meaning; `text` tells where each of its keys stands."""

    text: MissionText
    agent: AgentConfiguration
    check: CheckConfiguration
    needs_range: tuple[str, ...]  # parameters whose range is the base domain in the model
    figures: Figures | None = None

    @property
    def source(self) -> Source:
        """The file as it was read."""
        return self.text.source


def read_mission(path: Path) -> tuple[Mission | None, tuple[Diagnostic, ...]]:
    """Read the file at `path` (or raise OSError); the mission is None where a diagnostic is an error."""
    return parse_mission(read_source(path), path.parent)


def parse_mission(source: Source, root: Path) -> tuple[Mission | None, tuple[Diagnostic, ...]]:
    """Read a mission's text; paths in it are relative to `root`. A file `.xml` or `.cfg` is T-REX's agent file."""
    if source.name.endswith(AGENT_SUFFIXES):
        text, found = read_agent_file(source, root)
        return _mission_of(text, found, root) if found else (None, tuple(text.diagnostics))
    try:
        values = toml_value(source.text)
    except tomllib.TOMLDecodeError as problem:
        return None, (not_toml(NOT_TOML, source, str(problem)),)
    text = MissionText(source, find_places(source.text))
    if (at := source.text.find("\ufffd")) >= 0:
        text.diagnostics.append(UNDECODABLE.at(text.span(at, at + 1), help="save the file as UTF-8"))
    return _mission_of(text, values, root)


def _mission_of(text: MissionText, values: TomlTable, root: Path) -> tuple[Mission | None, tuple[Diagnostic, ...]]:
    top = Table(text, (), values, "a mission file")
    head = top.table("mission", "[mission]", needed=True)
    tables = top.tables("reactor", needed=True)
    reactors, coded = read_reactors(tables, root)
    owned = (*(line for one in reactors for line in one.internal), *(line for one in coded for line in one.internal))
    goals = _read_goals(top.tables("goal"), (*reactors, *coded), text)
    constraints, seconds = _read_constraints(top.table("constraints", "[constraints]"), root)
    parameters, unranged = read_parameters(top.table("parameters", "[parameters]"), top.table("joint", "[joint]"))
    agent = AgentConfiguration(
        name=head.string("name"),
        root=root.as_posix(),
        final_tick=head.whole("final_tick", None, 1),
        reactors=reactors,
        goals=goals,
        parameters=parameters,
        tick=head.number("tick", 1.0, 1e-9, is_finite=True),
        on_failure=cast("OnFailure", head.choice("on_failure", ("abort_agent", "kill_reactor"), "abort_agent")),
        constraints=constraints,
        constraint_seconds=seconds,
        coded=coded,
        properties=read_properties(top.tables("property"), owned),
        order=tuple(name for table in tables if isinstance(name := table.values.get("name"), str)),
        clock=read_clock(top.table("clock", "[clock]"), root),
    )
    check = _read_check(top.table("check", "[check]"))
    figures = read_figures(top.table("figures", "[figures]"), owned)
    if file := head.string("batch", ""):
        agent, check = _with_batch(agent, check, file, root, top)
    head.close()
    top.close()
    tell_unowned(text, reactors, root)
    if head.values.get("final_tick") == agent.final_tick:
        text.diagnostics += goals_out_of_time(agent, text)
    found = text.found()
    if any(diagnostic.severity is Severity.ERROR for diagnostic in found):
        return None, found
    return Mission(text, agent, check, unranged, figures), found


def _with_batch(
    agent: AgentConfiguration, check: CheckConfiguration, file: str, root: Path, top: Table
) -> tuple[AgentConfiguration, CheckConfiguration]:
    """Add what a batch file in XML says of parameters and of the seed that the mission file does not."""
    before = len(top.text.diagnostics)
    look_at(top.text, ("mission", "batch"), root, file)
    if len(top.text.diagnostics) > before:
        return agent, check
    batch, complaints = read_batch(read_source(root / file))
    top.text.diagnostics += complaints
    if batch is None:
        return agent, check
    written = {one.name for one in agent.parameters}
    added = tuple(one for one in batch.parameters if one.name not in written)
    for one, span in zip(batch.parameters, batch.spans, strict=True):
        if one in added:
            top.text.elsewhere[("parameters", one.name)] = span
    if batch.seed is not None and not top.table("check", "[check]").has("seed"):
        check = replace(check, seed=batch.seed)
    return replace(agent, parameters=(*agent.parameters, *added)), check


def _read_check(table: Table) -> CheckConfiguration:
    default = CheckConfiguration()
    check = CheckConfiguration(
        missions=table.whole("missions", default.missions, 1, MOST_MISSIONS),
        seed=table.whole("seed", default.seed, 0, LARGEST_SEED),
        max_failure_rate=table.number("max_failure_rate", default.max_failure_rate, 0.0, 1.0),
        confidence=table.number("confidence", default.confidence, 0.5, 0.999999),
        time_limit=table.number("time_limit", default.time_limit, 0.001),
        limits=tuple((limit, most) for limit in Limit if (most := table.whole(limit.value, -1, 0)) >= 0),
    )
    table.close()
    return check


def _read_constraints(table: Table, root: Path) -> tuple[tuple[str, ...], float]:
    modules = table.strings("modules")
    seconds = table.number("time_limit", USUAL, 0.001)
    table.close()
    for index, file in enumerate(modules):
        look_at(table.text, (*table.path, "modules", index), root, file)
    return modules, seconds


def _entry_places(*tables: Table) -> tuple[tuple[str, SourcePlace], ...]:
    """Where the mission file gives the bounds and the parameters of a goal, by key."""
    found = []
    for table in tables:
        for key in table.values:
            span = table.text.entry_span((*table.path, key))
            found.append((key, table.text.place(span, " ".join(span.text.split()))))
    return tuple(found)


def _read_goals(
    tables: list[Table], reactors: tuple[ReactorConfiguration | CodeConfiguration, ...], text: MissionText
) -> tuple[GoalConfiguration, ...]:
    owners = {timeline: reactor for reactor in reactors for timeline in reactor.internal}
    goals: list[GoalConfiguration] = []
    missing: dict[str, list[Span]] = {}
    for table in tables:
        parameters = table.table("parameters", "[goal.parameters]")
        goal = GoalConfiguration(
            timeline=table.string("timeline"),
            predicate=table.string("predicate"),
            at=table.whole("at", 0, 0),
            mandatory=table.flag("mandatory"),
            start=table.bounds("start"),
            end=table.bounds("end"),
            duration=table.bounds("duration"),
            parameters=tuple((key, _goal_value(parameters, key)) for key in parameters.values),
            recall=table.whole("recall", 0, 1) or None,
            places=_entry_places(table, parameters),
        )
        if goal.recall is not None and goal.recall <= goal.at:
            table.complain_of_value("recall", goal.recall, f"later than `at`, {goal.at}")
        table.close()
        goals.append(goal)
        span = text.value_span((*table.path, "timeline"))
        owner = owners.get(goal.timeline)
        if owner is None and goal.timeline:
            missing.setdefault(goal.timeline, []).append(span)
        elif owner is not None and owner.lookahead == 0:
            text.diagnostics.append(NO_GOALS.at(span, timeline=goal.timeline, reactor=owner.name))
    for timeline, spans in missing.items():
        complaint = _without_owner(text, timeline, spans, [*owners], {one.timeline for one in goals})
        text.unowned.append((timeline, complaint))
    return tuple(goals)


def _without_owner(
    text: MissionText, timeline: str, spans: list[Span], owned: list[str], wanted: Collection[str]
) -> Diagnostic:
    """One complaint of all goals on a timeline that nobody owns; where they agree, it is the owner who misspelt it."""
    close = nearest(timeline, owned)
    if len(spans) > 1 and close is not None and close not in wanted:
        for path in text.places:
            if len(path) == 4 and path[0] == "reactor" and path[2] == "internal":
                span = text.value_span(path)
                if span.text.strip("\"'") == close:
                    notes = tuple(Note("a goal is on it", each) for each in spans)
                    complaint = NO_OWNER.at(span, timeline=timeline, help=f"did you mean `{timeline}`?", notes=notes)
                    return rewritten(complaint, close, timeline)
    notes = tuple(Note("and so is this goal", each) for each in spans[1:])
    complaint = NO_OWNER.at(spans[0], timeline=timeline, help=suggest_owned(timeline, owned), notes=notes)
    return respelt(complaint, timeline, owned)


def _goal_value(table: Table, key: str) -> Value | Bounds:
    value = table.values[key]
    if isinstance(value, list):
        return table.bounds(key) or 0
    if isinstance(value, int | float) and not isinstance(value, bool) and HALF_INF <= abs(value) < math.inf:
        table.complain_of_value(key, value, f"a number {HELD}")
        return 0
    if isinstance(value, int | float | str):
        return value
    table.complain_of_type(key, "a number, a text in quotes, true or false, or a pair [lower, upper] of numbers")
    return 0
