"""Search for a plan: what is open and the goals in, a plan and what became of each goal out."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

from tests.executive.second.description import Part
from tests.executive.second.levels import within_levels
from tests.executive.second.network import ContradictionError
from tests.executive.second.plan import Goal, Plan
from tests.executive.second.present import bound

MOST = 3000  # places that one search tries

Found = tuple[Plan, dict[Goal, str]]  # goals are placed or rejected


class TooHardError(Exception):
    """A search that goes one by one takes too long."""


@dataclass(slots=True)
class Search:
    """What a reactor may plan at a tick: tokens that may begin at `earliest` and within the horizon."""

    part: Part
    tick: int
    earliest: int
    horizon: int
    final: int
    tried: int = 0

    def found(self, plan: Plan, goals: list[Goal]) -> Found | None:
        """A plan with all goals that may begin within the horizon, the earliest first, or without some of them."""
        near = []
        for goal in goals:
            low = max(goal.start[0], self.earliest)
            if (low <= self.horizon or goal.start[1] < self.earliest) and low < self.final:
                near.append(goal)
        return self._search(plan, sorted(near, key=self._order), True)

    def _order(self, goal: Goal) -> tuple[int, int, int]:
        """By the priorities of the solver's table, then the earliest start, then the asking."""
        first = self.part.first
        place = first.index(goal.predicate) if goal.predicate in first else 0
        return place, max(goal.start[0], self.earliest), goal.order

    def _search(self, plan: Plan, goals: list[Goal], counts: bool) -> Found | None:
        """Depth first: goals, then what else is open, the earliest first; to reject a goal is the last choice."""
        self.tried += 1
        if self.tried > MOST:
            raise TooHardError
        if goals:
            options = self._placements(plan, goals[0])
            states = {goals[0]: "placed"}
        else:
            one = self._next_open(plan)
            if one is None:
                kept = list(islice(within_levels(plan), 2 if counts else 1))
                if not kept:
                    return None
                kept[0].choices += len(kept) > 1
                return kept[0], {}
            options, states = plan.resolved(one), {}
        first: Found | None = None
        for option in options:
            option.decisions += 1
            found = self._search(option, goals[1:], counts and first is None)
            if found is None:
                continue
            if first is not None:
                if _rejected(found[1]) <= _rejected(first[1]):
                    first[0].choices += 1
                    break
                continue
            first = found[0], states | found[1]
            if not counts:
                break
        if first is None and goals:
            found = self._search(plan, goals[1:], counts)
            if found is not None:
                first = found[0], {goals[0]: "rejected"} | found[1]
                first[0].decisions += 1
        return first

    def _placements(self, plan: Plan, goal: Goal) -> Iterator[Plan]:
        trial = plan.copy()
        try:
            here = trial.new(goal.timeline, goal.predicate, goal=goal)
            token = trial.tokens[here]
            trial.net.within(token.start, max(goal.start[0], self.earliest), goal.start[1])
            bound(trial, here, goal)
            for name, value in goal.arguments.items():
                trial.net.within(token.arguments[name], value, value)
        except ContradictionError:
            return
        yield from trial.resolved(here)

    def _next_open(self, plan: Plan) -> int | None:
        for one in sorted(plan.open(), key=lambda number: (plan.window(number)[0], number)):
            low = plan.window(one)[0]
            if low > self.horizon or (low >= self.final and low > self.tick):
                continue
            own = plan.tokens[one].timeline in self.part.internal
            if own and self.part.lookahead <= 1 and not _hangs_on_goal(plan, one):
                continue
            return one
        return None


def _hangs_on_goal(plan: Plan, number: int | None) -> bool:
    while number is not None:
        if plan.goals_of[number]:
            return True
        number = plan.tokens[number].parent
    return False


def _rejected(states: dict[Goal, str]) -> int:
    return sum(state == "rejected" for state in states.values())
