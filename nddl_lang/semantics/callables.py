"""Which constraints and functions a model may call: the built-in ones, and those that its project adds in Python."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from nddl_lang.semantics.constraints import CONSTRAINTS, ConstraintRow
from nddl_lang.semantics.functions import FUNCTIONS, METHODS, FunctionRow, Receiver
from nddl_lang.syntax.words import BASE_TYPES, GOALS, PLAIN, RELATIONS

# The group of entry points by which installed packages add constraints.
ENTRY_POINTS = "nddlc.constraints"


@dataclass(frozen=True, eq=False, slots=True)
class Callables:
    """Constraints and functions by name; `has_gaps`: the project has more, which could not be read."""

    constraints: Mapping[str, ConstraintRow]
    functions: Mapping[str, FunctionRow]
    has_gaps: bool = False

    def extended(self, constraints: Iterable[ConstraintRow], functions: Iterable[FunctionRow]) -> "Callables":
        """These and some more, whose names must be free."""
        return Callables(
            {**self.constraints, **{row.name: row for row in constraints}},
            {**self.functions, **{row.name: row for row in functions}},
            self.has_gaps,
        )


NATIVE_CALLABLES = Callables(CONSTRAINTS, FUNCTIONS)


def owner_of(name: str) -> str | None:
    """What of the language bears a name already, in words; None where the name is free for a new constraint."""
    if name in CONSTRAINTS:
        return "a built-in constraint"
    if name in FUNCTIONS:
        return "a built-in function"
    if name in RELATIONS:
        return "a temporal relation"
    if (Receiver.NOTHING, name) in METHODS or name in (*BASE_TYPES, *GOALS, *PLAIN):
        return "a word of the language"
    return None
