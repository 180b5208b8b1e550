"""What trials of changes tell, as plain data: of each line the likeliest change that helps, and what orders them."""

from dataclasses import dataclass
from enum import StrEnum

from checker.counterfactual.candidates import Candidate
from checker.counterfactual.damage import HEAVY
from checker.mutation.edits import SmallEdit

_FAR = 0.1  # what the distance of a line counts beside the cost of its change
_PROVEN = 0.15  # odds of a number that did before the failure what it is there for
_WARNED = 1.0  # odds of a line that lint warns of
_UNTRIED = 0.01  # what was tried in no other mission is behind what helps in all, and before what helps in some


class TrialsEnd(StrEnum):
    """Why no more was tried."""

    COMPLETE = "complete"
    FLIGHTS = "flights"
    SECONDS = "seconds"  # of processor time
    CLOCK = "clock"  # the machine gave it so little of that
    CANCELLED = "cancelled"


@dataclass(frozen=True, eq=False, slots=True)
class LineTrial:
    """A change that makes the mission pass: what is still lost then, and on how many failed missions it helps.

    `spoilt` missions passed before and do not with the change; `is_evasive`: what is usual does not happen then.
    `is_untried`: it was tried on no other mission. `is_freed`: it lets a token end at once that an `==` made last.
    """

    candidate: Candidate
    edit: SmallEdit
    damage: float
    cost: float
    helped: int = 1
    missions: int = 1
    spoilt: int = 0
    is_evasive: bool = False
    is_untried: bool = True
    is_freed: bool = False

    @property
    def takes_away(self) -> bool:
        """Whether it takes a demand away, by its text or by what came of it."""
        return self.is_freed or self.candidate.takes_away(self.edit)

    @property
    def toll(self) -> float:
        """What is lost with the change, and how unlikely it is."""
        return self.damage + self.cost + (HEAVY if self.is_evasive else 0.0)

    @property
    def order(self) -> tuple[bool, float]:
        """Of the changes of one line, the first counts: what takes no demand away is before what does."""
        return self.toll < HEAVY and self.takes_away, self.toll

    @property
    def is_small(self) -> bool:
        """Whether it makes the mission pass with all its goals, and takes no demand away."""
        return self.toll < HEAVY and not self.takes_away

    @property
    def is_clean(self) -> bool:
        """Whether it helps all missions that it was tried on, and spoils none."""
        return self.helped == self.missions and not self.spoilt

    @property
    def weight(self) -> tuple[float, float, float]:
        """What causes are ranked by: missions that fail with it; what is lost, how likely it is, and how far off."""
        seen = _PROVEN * self.candidate.is_proven - _WARNED * self.candidate.is_linted
        change = self.toll + _FAR * self.candidate.far + seen
        return self.spoilt + 1.0 - self.helped / self.missions + _UNTRIED * self.is_untried, change, self.cost


@dataclass(frozen=True, eq=False, slots=True)
class Loose:
    """A variable that too few lines speak of, or a constant that `is_unread` or `is_unset`: a line may be missing.

    `is_uneven`: the other branch of a condition sets the variable. `doubt`: how far off it is, and how usual.
    """

    candidate: Candidate
    variable: str
    is_unread: bool = False
    is_uneven: bool = False
    is_unset: bool = False
    doubt: float = 0.0


@dataclass(frozen=True, eq=False, slots=True)
class Trials:
    """All that was tried for one fault: `causes` are ranked, one for each line."""

    causes: tuple[LineTrial, ...]
    suspects: tuple[Candidate, ...]  # lines in the order of suspicion, tried or not
    lines: int  # that were tried
    flights: int
    ended: TrialsEnd
    loose: tuple[Loose, ...] = ()
    beyond: int = 0  # flights beyond the usual, until a change helped in all missions
