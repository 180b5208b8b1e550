"""A failed mission and its models in, ranked causes out: candidates, trials in memory, and where they stand."""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from checker.batch.process import Flyer
from checker.batch.result import MissionResult
from checker.causes import failed_by
from checker.codes import OUT_OF_TIME
from checker.counterfactual.candidates import Candidate, candidates_of
from checker.counterfactual.damage import HEAVY, voided_of
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.effort import Bounds, Stopwatch
from checker.counterfactual.loose_ends import loose_ends
from checker.counterfactual.mission_lines import mission_lines
from checker.counterfactual.missions import Missions
from checker.counterfactual.moments import with_durations
from checker.counterfactual.python_ways import asleep_in
from checker.counterfactual.ranking import Causes, Claim, RankedLine, rank
from checker.counterfactual.remarks import remarks_of, with_remarks
from checker.counterfactual.trials import try_out
from checker.counterfactual.tried import Trials
from checker.counterfactual.usage import usage_of
from checker.coverage import Universe
from checker.culprit import checks_of, is_of_values, lacking_in
from checker.limits import Limit
from checker.mission import Mission
from checker.mutation.additions import with_additions
from checker.mutation.arguments import with_arguments
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import OUTSIDE
from checker.mutation.labels import labels_of
from checker.mutation.mission_edits import agent_with
from checker.mutation.shared_objects import with_shared
from checker.mutation.successors import with_successors
from checker.mutation.told_by_text import with_told
from checker.mutation.variant import Overlay, load_graph, load_over, with_edit
from checker.oracle import Verdict, given_up, judge_losses, judged_beside
from checker.proofs.places import text_of
from checker.sampling.sampler import with_point
from compiler.program import Program
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import read_text, real_path
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.events import single_events
from runtime.executive.outcome import ElementKind, Outcome


@dataclass(frozen=True, eq=False, slots=True)
class Suspended:
    """What trials need beside the failed missions: the models as they were flown, and a process that flies."""

    agent: AgentConfiguration
    programs: Sequence[Program]
    limits: tuple[tuple[Limit, int], ...]
    flyer: Flyer
    overlay: Overlay = ()
    mission: Mission | None = None  # whose file is tried too
    findings: tuple[Diagnostic, ...] = ()  # what lint warns of in the models, and of goals without enough time
    beside: frozenset[str] = frozenset()  # properties that may be violated: what is sought is the cause of another end


class CauseSearch:
    """Finds the causes of several faults, each within `bounds`, all together in so many seconds of the processor."""

    def __init__(self, world: Suspended, bounds: Bounds, seconds: float = math.inf) -> None:
        self._world, self._seconds = world, seconds
        self._bounds = replace(bounds, spent=lambda: time.process_time() + world.flyer.processor_seconds)
        self._watch = Stopwatch(self._bounds.spent)

    @property
    def _left(self) -> float:
        """The seconds that are left; none where the machine has given no time for long."""
        return 0.0 if self._watch.is_starved(self._seconds) else self._seconds - self._watch.seconds

    def causes(self, missions: Missions) -> Causes:
        """The causes of one fault."""
        bounds = replace(self._bounds, seconds=min(self._bounds.seconds, max(self._left, 0.0)))
        first = missions.failed[0]
        beside = _beside(first, missions.beside)
        trials = find_causes(missions, _apart(self._world, first, beside), bounds)
        root = Path(self._world.agent.root)
        found = rank(trials, root, _raised_in(first), _asleep_in(first, self._world.agent))
        remarks = remarks_of(self._world.findings, root)
        return replace(found, flown=first.number, remarks=remarks, aside=_aside(first), beside=tuple(sorted(beside)))

    def mends(self, cause: RankedLine, failed: MissionResult, beside: frozenset[str] = frozenset()) -> bool:
        """Whether the change of a cause makes another failed mission pass, with all goals; False where time is over."""
        left = min(self._left, self._bounds.seconds)
        if cause.change is None or cause.claim is Claim.EVADES or left <= 0.0 or self._bounds.flights == 0:
            return False
        result = _fly(_apart(self._world, failed, _beside(failed, beside)), cause.change, failed, left)
        damage = _as_flown(Missions([failed]), self._world.agent).damage_of(result, failed)
        return result.verdict is Verdict.PASS and damage + voided_of(result, failed) < HEAVY


def _aside(failed: MissionResult) -> tuple[str, ...]:
    """The properties that a mission violated beside the first one: each has a cause of its own."""
    return tuple(one.name for one in failed.judgement.also)


def _beside(failed: MissionResult, beside: frozenset[str]) -> frozenset[str]:
    """Of the properties that missions violate anyway, those that a failure has nothing to do with: none of a P1."""
    return frozenset() if failed.judgement.broken is not None else beside


def _apart(world: Suspended, failed: MissionResult, beside: frozenset[str]) -> Suspended:
    """The same, where missions are not judged by what was violated beside the first property, or another failure."""
    kept = tuple(one for one in world.agent.properties if one.name not in _aside(failed))
    return replace(world, agent=replace(world.agent, properties=kept), beside=beside)


def sites_in(agent: AgentConfiguration, overlay: Overlay = ()) -> list[EditSite]:
    """The sites of all models of an agent, those of a text that several include once."""
    root = Path(agent.root)
    found: dict[tuple[str, int, str], EditSite] = {}
    for model in dict.fromkeys(each.model for each in agent.reactors):
        for site in sites_of(load_graph(root / model, overlay)):
            found.setdefault((site.file, site.first, site.text), site)
    sites = with_arguments(
        with_shared(list(found.values())), [read_text(root / name) or "" for name in agent.constraints]
    )
    return with_told(with_successors(with_durations(with_additions(sites, labels_of(agent.goals, sites)))))


def _as_flown(missions: Missions, agent: AgentConfiguration) -> Missions:
    """The missions with what their agent says of all of them."""
    return replace(missions, is_cut=agent.until is not None, goals=agent.goals)


def find_causes(missions: Missions, world: Suspended, bounds: Bounds) -> Trials:
    """Try small changes on the first of the failed missions, see `try_out`."""
    outcome = missions.failed[0].outcome
    assert outcome is not None
    missions = _as_flown(missions, world.agent)
    sampled = {parameter.name for parameter in world.agent.parameters}
    checks = _checks_in(outcome, Path(world.agent.root))
    sites = [
        replace(site, is_check=(site.file, site.first, site.column) in checks)
        for site in sites_in(world.agent, world.overlay)
        if site.named not in sampled
    ]
    graph = Dependence(world.programs, sites)
    sites_reached = Universe(world.programs).sites
    exercised = [site.span for number, site in enumerate(sites_reached) if number in missions.exercised]
    labels = labels_of(missions.goals, sites)
    usage = usage_of(sites, passing=missions.passing, is_late=is_late(missions.failed[0]), labels=labels)
    models = {each.model: program for each, program in zip(world.agent.reactors, world.programs, strict=True)}
    text = text_of(world.agent, models)
    agent = world.agent
    candidates = candidates_of(outcome, graph, Path(agent.root), agent.properties, exercised, text, coded=agent.coded)
    candidates = with_remarks(candidates, [one for one in world.findings if one.code is not OUT_OF_TIME])
    supplying = graph.supplying(lacking_in(failed_by(outcome).conflict))
    last: Sequence[Candidate] = ()
    if world.mission is not None:
        last = mission_lines(world.mission, outcome, supplying, world.findings, world.programs)
    bounds = bounds.grown(sum(len(one.site.edits) for one in candidates), len(outcome.events))
    trials = try_out(candidates, missions, usage, partial(_fly, world), bounds, last, graph.beside)
    return replace(trials, loose=loose_ends(graph, candidates, usage))


def _checks_in(outcome: Outcome, root: Path) -> set[tuple[str, int, int]]:
    """File, line and column of the constraints that only compare what is given, in the conflict of a failed mission."""
    places = [one.place for one in checks_of(failed_by(outcome).conflict) if one.place is not None]
    return {(str(real_path(root / place.file)), place.line, place.column) for place in places}


def _raised_in(failed: MissionResult) -> RankedLine | None:
    """The line of the project's Python that raised, where that ended a mission."""
    abort = given_up(failed.outcome) if failed.outcome is not None else None
    if abort is None or abort.reason.raised is None:
        return None
    return RankedLine(abort.reason.raised, "", Claim.RAISED, variable=abort.reactor)


def _asleep_in(failed: MissionResult, agent: AgentConfiguration) -> list[RankedLine]:
    """The lines of the project's Python that published what broke a plan, where nothing calls it to end that."""
    if failed.outcome is None:
        return []
    asleep = asleep_in(failed.outcome, failed_by(failed.outcome).conflict, agent)
    return [RankedLine(place, "", Claim.ASLEEP, variable=reactor) for reactor, place in asleep]


def is_late(failed: MissionResult) -> bool:
    """Whether a mission failed, or lost more than it may, as something took too long, not by a level or value."""
    outcome = failed.outcome
    assert outcome is not None
    conflict = failed_by(outcome).conflict
    if failed.judgement.exceeded is not None:
        conflict = next((one.conflict for one in single_events(outcome.events) if one.conflict is not None), None)
    is_level = conflict is not None and any(one.kind is ElementKind.RESOURCE for one in conflict.elements)
    is_lost = outcome.abort is not None or bool(outcome.open_goals) or failed.judgement.exceeded is not None
    return is_lost and not is_level and not (conflict is not None and is_of_values(conflict))


def _fly(world: Suspended, edit: SmallEdit, mission: MissionResult, most_seconds: float) -> MissionResult:
    agent, overlay = world.agent, world.overlay
    if edit.kind not in OUTSIDE:
        overlay = with_edit(overlay, edit)
    elif world.mission is not None:
        agent = agent_with(world.mission, agent, edit)
    load = partial(load_over, overlay, tells_on=False)
    agent = with_point(agent, mission.point)
    # What passes is asked what it did in a moment, and may fail by the limits.
    result = world.flyer.fly(agent, mission.number, mission.seed, load, keeps_trace=True, most_seconds=most_seconds)
    judgement = judged_beside(result.judgement, world.beside)
    return replace(result, judgement=judge_losses(judgement, result.losses, world.limits))
