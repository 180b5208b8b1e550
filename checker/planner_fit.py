"""Hold what planners ask for against who does it: requests that nobody takes, uses of resources that nobody orders."""

from collections.abc import Iterator, Mapping

from checker.codes import NO_REQUESTS, NO_THREATS
from checker.mission import Mission
from checker.named_objects import named_objects, resources_of
from compiler.instructions import all_instructions
from compiler.program import Child, Program
from nddl_lang.text.diagnostic import Diagnostic, Note
from runtime.executive.configuration import CodeConfiguration, ReactorConfiguration
from runtime.executive.outlines import forms_of
from runtime.solver.configuration.configuration import Configuration, default_configuration, with_resources

_DO_NOT_ACT = ("Observe", "Private")


def unordered_resources(
    mission: Mission, programs: Mapping[str, Program], configured: Mapping[str, Configuration | None]
) -> Iterator[Diagnostic]:
    """Complain of planners whose model has resources, and whose solver does not order the tokens that use them."""
    for number, reactor in enumerate(mission.agent.reactors):
        resources = resources_of(programs[reactor.model])
        solver = default_configuration() if reactor.solver is None else configured[reactor.solver]
        if reactor.lookahead < 2 or not resources or solver is None:
            continue
        # The default leaves resources out; a file that names no such manager orders them together with timelines.
        managers = solver.managers if reactor.solver is None else with_resources(solver).managers
        if any(manager.component == "ResourceThreatManager" for manager in managers):
            continue
        key = "model" if reactor.solver is None else "solver"
        if reactor.solver is None:
            where = "under `solver`" if mission.text.source.name.endswith(".toml") else "as `plan_cfg`"
            advice = f"name a file with a `ResourceThreatManager` {where} (docs/cookbook.md shows one)"
        else:
            table = '[[manager]] with `component = "ResourceThreatManager"`'
            entry = table if reactor.solver.endswith(".toml") else "`<ResourceThreatManager/>`"
            advice = f"add a {entry} to {reactor.solver}"
        span = mission.text.value_span((*mission.text.reactor_path(number), key))
        yield NO_THREATS.at(span, resource=resources[0], reactor=reactor.name, help=advice)


def vain_requests(mission: Mission, number: int, program: Program, modes: Mapping[str, str]) -> Iterator[Diagnostic]:
    """Complain of timelines that a planner asks tokens of, and whose owner takes no requests; `modes` by timeline.

    What a rule may look back at may be met by what was observed, and is not told.
    """
    reactor = mission.agent.reactors[number]
    placed: list[ReactorConfiguration | CodeConfiguration] = [*mission.agent.reactors, *mission.agent.coded]
    owners = {timeline: one for one in placed for timeline in one.internal}
    past = {program.predicates[each].name for each in forms_of(program).looked_back}
    asked = {
        child.predicate.rpartition(".")[0]: child
        for rule in program.rules
        for child in all_instructions(rule.body)
        if isinstance(child, Child) and child.predicate not in past
    }
    classes = named_objects(program)
    for index, timeline in enumerate(reactor.external):
        owner, child = owners.get(timeline), asked.get(classes.get(timeline, ""))
        is_observed = timeline in reactor.observe or modes.get(timeline) in _DO_NOT_ACT
        if owner is None or child is None or owner.lookahead > 0 or is_observed or owner is reactor:
            continue
        yield NO_REQUESTS.at(
            mission.text.value_span((*mission.text.reactor_path(number), "external", index)),
            timeline=timeline,
            owner=owner.name,
            help=f"give `{owner.name}` a `lookahead` of 1, or list `{timeline}` under `observe` if nothing is asked",
            notes=(Note("asked for here", child.span),),
        )
