"""What a constraint written outside the engine looks like: resources, and users' relations in Python."""

from abc import ABC, abstractmethod
from collections.abc import Sequence

from runtime.constraints.domains.narrow import raise_to, reduce_to, remove_value
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import CONFLICT_CONSTRAINT, SUPPORT_CONSTRAINT


class External(ABC):
    """A constraint whose meaning is a Python (or compiled) class; subclass it and write `propagate`.

    `propagate` is called after posting and whenever a domain of an argument has changed, any number of times, in any
    order, also during search, so it keeps no state that depends on what it saw (or keeps it by `token` of the
    constraint and recomputes). It reads domains by `low`, `high`, `is_single` of
    `runtime.constraints.domains.narrow`, narrows by the functions of this file, which return False when no value is
    left, and then returns False at once. It must never remove a value that belongs to a solution, and must narrow at
    least until a wrong choice of known values is refused.
    """

    # Whether it may be run in a scratch engine, on copies of its arguments, to check and shrink explanations.
    is_repeatable = True
    # Temporal edges that it read beside the bounds of its arguments.
    edges: Sequence[int] = ()

    @abstractmethod
    def propagate(self, s: Store, c: int) -> bool:
        """Narrow the arguments of constraint `c`; False on a conflict."""


def argument(s: Store, c: int, position: int) -> int:
    """Give the variable at a position of a constraint."""
    return s.slot_variable[s.first[c] + position]


def at_least(s: Store, c: int, v: int, x: float) -> bool:
    """Have constraint `c` raise the lower bound of `v`."""
    return raise_to(s, v, x, c * 4 + SUPPORT_CONSTRAINT)


def at_most(s: Store, c: int, v: int, x: float) -> bool:
    """Have constraint `c` reduce the upper bound of `v`."""
    return reduce_to(s, v, x, c * 4 + SUPPORT_CONSTRAINT)


def never(s: Store, c: int, v: int, x: int) -> bool:
    """Have constraint `c` take a value from a variable that is no float."""
    return remove_value(s, v, x, c * 4 + SUPPORT_CONSTRAINT)


def refuse(s: Store, c: int) -> bool:
    """Have constraint `c` say that it cannot hold, though each of its variables has values; always False."""
    s.note_conflict(CONFLICT_CONSTRAINT, -1, 0, c * 4 + SUPPORT_CONSTRAINT)
    return False
