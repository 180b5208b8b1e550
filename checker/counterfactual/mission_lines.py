"""A failed mission in, candidates of its mission file out, the likeliest first: tried where no model line mends."""

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.mission import Mission
from checker.mutation.mission_edits import mission_sites
from runtime.executive.events import single_events
from runtime.executive.outcome import EventKind, Outcome

_DEAF, _LOST, _ABORTED, _OTHERS = 0.0, 1.0, 2.0, 3.0
_GIVEN_UP = (EventKind.REJECT, EventKind.REFUSE)


def mission_lines(mission: Mission, outcome: Outcome) -> list[Candidate]:
    """The times of goals that found no place, then what says how the reactors plan, that which ended first."""
    given_up = {(one.timeline, one.predicate) for one in single_events(outcome.events) if one.kind in _GIVEN_UP}
    given_up |= {(one.timeline, one.predicate) for one in outcome.open_goals if one.conflict is not None}
    ended = outcome.abort.reactor if outcome.abort is not None else ""
    used = {line for one in mission.agent.reactors for line in one.external}
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
        found += [Candidate(site, far, Suspicion.TRACE) for site in sites]
    return sorted(found, key=lambda one: one.far)
