"""A violated property in, the goals out that lead to what it is about, by the rules of reactors, or to a broken plan.

A promise in time (`reached`, `until`) that was missed rests on when the goals might come that ask for it; a
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

_OWN = "own"  # what a rule asks for on the object of its token
_IN_TIME = (PropertyKind.REACHED, PropertyKind.UNTIL)


def promised_goals(outcome: Outcome, agent: AgentConfiguration, programs: Sequence[Program]) -> frozenset[int]:
    """The goals that lead to what the first violated property promises by some time."""
    found: set[int] = set()
    for kept in of_first_violated(outcome, agent.properties):
        if kept.kind in _IN_TIME:
            pattern = kept.then or kept.pattern
            asking = asking_for(pattern, agent, programs)
            found |= {number for number, goal in enumerate(agent.goals) if _asks_for(goal, pattern, asking)}
    return frozenset(found)


def asking_for(pattern: TokenPattern, agent: AgentConfiguration, programs: Sequence[Program]) -> set[str]:
    """The predicates, without their classes, whose rules lead to what matches on its timeline."""
    reactors = enumerate(agent.reactors)
    users = [number for number, one in reactors if pattern.timeline in (*one.internal, *one.external)]
    return _asking(pattern.predicate, agent, programs, users)


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
        asking = _asking(predicate, agent, programs, range(len(programs))) | {predicate}
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
    asking = {one for each in tokens for one in _asking(each.rpartition(".")[2], agent, programs, everywhere)}
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


def _asking(wanted: str, agent: AgentConfiguration, programs: Sequence[Program], users: Sequence[int]) -> set[str]:
    """The predicates, without their classes, whose rules ask for what is wanted of its users, and so on.

    What a rule asks for on its own timeline leads to users of the same; else to who uses a timeline of the reactor.
    """
    found: set[str] = set()
    waiting = [(tuple(users), wanted)]
    while waiting:
        near, name = waiting.pop()
        for number, rule in [(each, rule) for each in near for rule in programs[each].rules]:
            own = rule.predicate.rpartition(".")[2]
            steps = [step for step in all_instructions(rule.body) if isinstance(step, Child)]
            asked = [step for step in steps if step.predicate.rpartition(".")[2] == name]
            if asked and own not in found:
                found.add(own)
                is_own = all(step.object == _OWN for step in asked)
                waiting.append((near if is_own else _beside(number, agent), own))
    return found


def _beside(number: int, agent: AgentConfiguration) -> tuple[int, ...]:
    """A reactor and those that use one of its timelines, by number."""
    owned = set(agent.reactors[number].internal)
    return tuple(at for at, one in enumerate(agent.reactors) if at == number or owned & set(one.external))
