"""A failed mission in, candidates of its mission file out, the likeliest first: tried where no model line mends.

What a goal asks that the conflict speaks of is tried in any case.
"""

from checker.causes import failed_by
from checker.counterfactual.candidates import Candidate, Suspicion
from checker.mission import Mission
from checker.mutation.mission_edits import mission_sites
from runtime.executive.events import single_events
from runtime.executive.outcome import ElementKind, EventKind, Outcome

_SPOKEN, _DEAF, _LOST, _ABORTED, _OTHERS = 0.0, 0.0, 1.0, 2.0, 3.0
_GIVEN_UP = (EventKind.REJECT, EventKind.REFUSE)


def mission_lines(mission: Mission, outcome: Outcome) -> list[Candidate]:
    """The times of goals that found no place, then what says how the reactors plan, that which ended first."""
    given_up = {(one.timeline, one.predicate) for one in single_events(outcome.events) if one.kind in _GIVEN_UP}
    given_up |= {(one.timeline, one.predicate) for one in outcome.open_goals if one.conflict is not None}
    ended = outcome.abort.reactor if outcome.abort is not None else ""
    used = {line for one in mission.agent.reactors for line in one.external}
    conflict = failed_by(outcome).conflict
    elements = conflict.elements if conflict is not None else ()
    asked = [one.place for one in elements if one.kind is ElementKind.REQUEST and one.place is not None]
    found = []
    for (table, number), sites in mission_sites(mission).items():
        if table == "goal":
            goal = mission.agent.goals[number]
            if (goal.timeline, goal.predicate) not in given_up:
                continue
            far = _LOST
        else:
            reactor = mission.agent.reactors[number]
            far = _ABORTED if reactor.name == ended else _OTHERS
            if reactor.lookahead == 0 and used & set(reactor.internal):
                far = _DEAF  # it is asked for nothing
        for site in sites:
            is_spoken = any(site.holds(site.file, place.line) for place in asked)
            source = Suspicion.CONFLICT if is_spoken else Suspicion.TRACE
            found.append(Candidate(site, _SPOKEN if is_spoken else far, source))
    return sorted(found, key=lambda one: one.far)
