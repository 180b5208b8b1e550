"""Have z3 judge a conflict: its terms in, whether they cannot hold together out, with the elements that matter."""

from dataclasses import dataclass
from enum import Enum

import z3

from checker.smt.terms import Vocabulary
from runtime.executive.outcome import Conflict

# Work in z3's own unit, not in seconds, so that the answer does not depend on the machine; about two seconds here.
EFFORT = 20_000_000


class Finding(Enum):
    """What z3 says of a conflict."""

    CONFIRMED = "confirmed"  # the terms cannot hold together
    REFUTED = "not confirmed"  # they can: the engine saw more than the terms say, or is wrong
    UNKNOWN = "undecided"  # z3 gave up


@dataclass(frozen=True, slots=True)
class Confirmation:
    """z3's answer. `core` numbers the elements of a set that already contradicts itself; nothing in it is superfluous.

    `untranslated` names the terms that z3 was not told; a confirmation without them is a confirmation all the more.
    """

    finding: Finding
    core: tuple[int, ...]
    untranslated: tuple[str, ...]


def confirm(conflict: Conflict, effort: int = EFFORT) -> Confirmation:
    """Ask z3 whether the elements of `conflict` can hold together (the engine said they cannot)."""
    words = Vocabulary(conflict)
    solver = z3.Solver()
    solver.set("rlimit", effort)
    solver.add(*words.base())
    untranslated: list[str] = []
    marks = [z3.Bool(f"element {number}") for number in range(len(conflict.elements))]
    for mark, element in zip(marks, conflict.elements, strict=True):
        for term in element.terms:
            claim = words.encode(term)
            if claim is None:
                untranslated.append(term.name)
            else:
                solver.add(z3.Implies(mark, claim))
    missing = tuple(dict.fromkeys(untranslated))
    needed = [number for number, element in enumerate(conflict.elements) if element.terms]
    answer = solver.check(*[marks[number] for number in needed])
    if answer != z3.unsat:
        return Confirmation(Finding.REFUTED if answer == z3.sat else Finding.UNKNOWN, (), missing)
    return Confirmation(Finding.CONFIRMED, _shrink(solver, marks, needed), missing)


def _shrink(solver: z3.Solver, marks: list[z3.BoolRef], needed: list[int]) -> tuple[int, ...]:
    """Leave out one element after the other, the first first, while the rest still contradicts itself."""
    core = {str(mark) for mark in solver.unsat_core()}
    kept = [number for number in needed if str(marks[number]) in core]
    for number in list(kept):
        rest = [other for other in kept if other != number]
        if solver.check(*[marks[other] for other in rest]) == z3.unsat:
            kept = rest
    return tuple(kept)
