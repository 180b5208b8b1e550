"""The missions that trials of a fault are made on, and what one of them has lost that passes with a change."""

from collections.abc import Sequence
from dataclasses import dataclass

from checker.batch.result import MissionResult
from checker.counterfactual.damage import ALIKE, damage_of, lost_alike, unkept_goals, unknown_goals
from runtime.executive.configuration import GoalConfiguration


@dataclass(frozen=True, eq=False, slots=True)
class Missions:
    """Missions of one fault, of which the first is what trials are made on; and some that passed.

    `exercised` are the rules and branches (by number, see `checker.coverage`) that only missions of the fault reached;
    `usual` is what happened in all missions that passed, `passing` the share of these among all.
    """

    failed: Sequence[MissionResult]
    passed: Sequence[MissionResult] = ()
    exercised: frozenset[int] = frozenset()
    usual: frozenset[int] = frozenset()
    passing: float = 0.0
    is_cut: bool = False  # before they end, as nothing is known of what came then
    goals: tuple[GoalConfiguration, ...] = ()  # those of the mission file
    beside: frozenset[str] = frozenset()  # properties that every mission violates that got to its end

    def damage_of(self, result: MissionResult, failed: MissionResult) -> float:
        """What a mission has lost that passes with a change, and failed without."""
        unknown = unknown_goals(failed, self.goals) | unkept_goals(self.passed, self.goals)
        alike = lost_alike(result, failed, self.goals) - unknown
        return damage_of(result, self.is_cut, unknown | alike) + ALIKE * len(alike)

    def is_patched(self, result: MissionResult) -> bool:
        """Whether a mission that passes needed repairs, where those that passed before needed none."""
        return result.losses.repaired > 0 and bool(self.passed) and not any(one.losses.repaired for one in self.passed)

    def is_evasive(self, result: MissionResult) -> bool:
        """Whether a mission lacks what happened in all missions that passed."""
        return result.outcome is not None and not self.usual.issubset(result.outcome.behaviour)
