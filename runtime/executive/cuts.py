"""Which repair has cut a goal that runs loose from what it held on to, as from what was to end it."""

from dataclasses import dataclass

from runtime.executive.outcome import Conflict, Deadlock, Reason
from runtime.executive.timelines import Goal
from runtime.executive.workbench import Workbench


@dataclass(frozen=True, slots=True)
class Repair:
    """A repair of a reactor: when, its event, and what made it necessary."""

    tick: int
    event: int
    reason: Reason
    conflict: Conflict | None
    deadlock: Deadlock | None = None


class Cuts:
    """The last repair that took from a goal what ran for it, by the number of its request."""

    def __init__(self, bench: Workbench) -> None:
        self.bench = bench
        self.held: dict[int, set[int]] = {}  # before a repair: what runs for each goal that runs
        self.of: dict[int, Repair] = {}

    def note(self, goals: list[Goal], tick: int) -> None:
        """Note what runs for goals, before the first repair of a tick."""
        if not self.held:
            self.held = self._held_by(goals, tick)

    def close(self, goals: list[Goal], repair: Repair) -> None:
        """Find out what a repair has taken from goals."""
        left = self._held_by(goals, repair.tick)
        for number, held in self.held.items():
            if held - left.get(number, set()):
                self.of[number] = repair
        self.held = {}

    def _held_by(self, goals: list[Goal], tick: int) -> dict[int, set[int]]:
        """What goals ask for, by the number of each that runs: the keys of what has begun and was not over before."""
        bench = self.bench
        found: dict[int, set[int]] = {}
        roots: dict[int, list[int]] = {}
        for goal in goals:
            if bench.is_alive(goal.token, goal.token_key) and bench.is_started(goal.token, tick - 1):
                roots.setdefault(bench.stands_for(goal.token), []).append(goal.request.number)
                found[goal.request.number] = set()
        for t in bench.all_tokens() if roots else ():
            numbers = roots.get(bench.root(t), [])
            here = bench.stands_for(t)
            if numbers and here not in roots and bench.is_started(here, tick) and not bench.is_over(here, tick - 1):
                seen = bench.fact_of(here)
                for number in numbers:
                    found[number].add(bench.key(here if seen < 0 else seen))
        return found
