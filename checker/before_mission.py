"""Token that a plan has put before the mission: a flight's record in, what was never carried out for that out.

Of the time before tick 0 nothing is known, so what a rule asks of it is taken to have been there (docs/agent.md). Where
the token that asks begins later, the planner might have done it, and did not have to: mostly a line is missing.
"""

from runtime.executive.configuration import AgentConfiguration
from runtime.executive.record import MissionRecord, TokenRecord, ValueRange


def put_before(agent: AgentConfiguration, record: MissionRecord) -> tuple[tuple[str, str, str], ...]:
    """Predicate, timeline, and the predicate of who asked for it, each once, in the order of the record."""
    roles = {each.name: (*each.internal, *each.external) for each in agent.reactors}
    found: dict[tuple[str, str, str], None] = {}
    for reactor in record.reactors:
        shared = roles.get(reactor.reactor, ())
        early = {one.key: one for one in reactor.tokens if one.origin == "rule" and _is_before(one)}
        for asker in reactor.tokens if early else ():
            if isinstance(asker.start, int) and 0 < asker.start <= reactor.last_tick:
                for key in (child for run in asker.runs for child in run.children):
                    if key in early and (name := str(early[key].object)) in shared:
                        found[early[key].predicate, name, asker.predicate] = None
    return tuple(found)


def _is_before(token: TokenRecord) -> bool:
    end = token.end.upper if isinstance(token.end, ValueRange) else token.end
    return token.state == "active" and isinstance(end, int | float) and end <= 0
