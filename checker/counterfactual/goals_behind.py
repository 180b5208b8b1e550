"""A violated property in, the goals out that lead to what it is about, by the rules of reactors, or to a broken plan.

A promise in time (`reached`, `within`, `until`) that was missed rests on when the goals might come that ask for it; a
level on how much the goals ask for whose rules changed it.
"""

import math
from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence

from checker.causes import failed_by
from checker.counterfactual.promises import of_first_violated
from checker.culprit import own_elements
from checker.oracle import given_up
from compiler.instructions import all_instructions
from compiler.program import Child, Program
from runtime.executive.configuration import AgentConfiguration, GoalConfiguration, PropertyKind, TokenPattern
from runtime.executive.events import heads_of
from runtime.executive.outcome import Outcome

_IN_TIME = (PropertyKind.REACHED, PropertyKind.WITHIN, PropertyKind.UNTIL)


def promised_goals(outcome: Outcome, agent: AgentConfiguration, programs: Sequence[Program]) -> frozenset[int]:
    """The goals that lead to what the first violated property promises by some time."""
    found: set[int] = set()
    for kept in of_first_violated(outcome, agent.properties):
        if kept.kind in _IN_TIME:
            pattern = kept.then or kept.pattern
            users = [
                number for number, one in enumerate(agent.reactors) if pattern.timeline in one.internal + one.external
            ]
            asking = _asking(pattern.predicate, programs, users)
            found |= {number for number, goal in enumerate(agent.goals) if _asks_for(goal, pattern, asking)}
    return frozenset(found)


def levelled_goals(outcome: Outcome, agent: AgentConfiguration, programs: Sequence[Program]) -> dict[int, float]:
    """The goals that lead to what changed a violated level, each with its share of that change."""
    changes = next((one.changes for one in outcome.properties if not one.is_kept), ())
    amounts: dict[str, float] = defaultdict(float)
    for change in changes:
        for asker, _ in change.askers if (change.amount < 0.0) == (changes[-1].amount < 0.0) else ():
            amounts[asker.rpartition(".")[2]] += abs(change.amount)
    total = sum(amounts.values())
    found: dict[int, float] = {}
    for predicate, amount in amounts.items():
        asking = _asking(predicate, programs, range(len(programs))) | {predicate}
        goals = [number for number, goal in enumerate(agent.goals) if goal.predicate in asking]
        for number in goals if total > 0.0 else ():
            found[number] = max(found.get(number, 0.0), amount / total / len(goals))
    return found


def leading_goals(outcome: Outcome, agent: AgentConfiguration, programs: Sequence[Program]) -> frozenset[int]:
    """The goals that lead to tokens of what broke the plan of the agent that gave up."""
    if given_up(outcome) is None:
        return frozenset()
    elements = own_elements(failed_by(outcome).conflict)
    tokens = {one.token.predicate for each in elements for one in each.variables if one.token is not None}
    everywhere = range(len(programs))
    asking = {one for each in tokens for one in _asking(each.rpartition(".")[2], programs, everywhere)}
    return frozenset(number for number, goal in enumerate(agent.goals) if goal.predicate in asking)


def under_way(goals: Collection[int], outcome: Outcome, agent: AgentConfiguration) -> frozenset[int]:
    """Those of some goals that may have begun and were not over when the mission was."""
    held = {timeline: predicate for *_, timeline, predicate in heads_of(outcome.events)}
    return frozenset(one for one in goals if held.get(agent.goals[one].timeline) == agent.goals[one].predicate)


def far_of(shares: Mapping[int, float], number: int) -> float:
    """How far off a goal is by its share: half of it is as likely half of the fault."""
    return -math.log(shares[number])


def _asks_for(goal: GoalConfiguration, pattern: TokenPattern, asking: set[str]) -> bool:
    is_itself = (goal.timeline, goal.predicate) == (pattern.timeline, pattern.predicate)
    return is_itself or goal.predicate in asking


def _asking(wanted: str, programs: Sequence[Program], users: Sequence[int]) -> set[str]:
    """The predicates, without their classes, whose rules ask for what is wanted of its users, and so on."""
    found: set[str] = set()
    waiting = [(number, wanted) for number in users]
    while waiting:
        number, name = waiting.pop()
        for rule in programs[number].rules:
            own = rule.predicate.rpartition(".")[2]
            children = (step.predicate for step in all_instructions(rule.body) if isinstance(step, Child))
            if own not in found and name in {one.rpartition(".")[2] for one in children}:
                found.add(own)
                waiting += [(other, own) for other in range(len(programs))]
    return found
