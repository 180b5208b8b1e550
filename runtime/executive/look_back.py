"""Looking back: which predicates the rules of a program may ask for when their tokens are over."""

from collections.abc import Iterable
from math import inf

from compiler.program import Child, Guard, Instruction, ObjectLoop, Program
from nddl_lang.semantics.relations import RELATIONS, Point


def looked_back(program: Program) -> tuple[int, ...]:
    """The predicates of which a rule may ask for a token that is over before the rule's own token begins, in order."""
    names = {name for rule in program.rules for name in _names(rule.body, set())}
    return tuple(number for number, each in enumerate(program.predicates) if each.name.rpartition(".")[2] in names)


def _names(body: Iterable[Instruction], early: set[int]) -> set[str]:
    """The predicates, without their classes, that a body looks back at; `early` are the slots that do so far."""
    found: set[str] = set()
    for step in body:
        match step:
            case Child(slot=slot, predicate=predicate, relation=relation, origin=origin, bounds=bounds):
                if origin in early or _may_precede(relation, bounds):
                    early.add(slot)
                    found.add(predicate.rpartition(".")[2])
            case Guard(then=then, otherwise=otherwise):
                found |= _names(then, early) | _names(otherwise, early)
            case ObjectLoop(body=inner):
                found |= _names(inner, early)
            case _:
                pass
    return found


def _may_precede(relation: str, bounds: tuple[tuple[int, int], ...]) -> bool:
    """Whether the target of a relation may end before its origin begins, by what the relation says of their times."""
    # Shortest distances from each point to the target's end; tokens last a tick at least.
    least = dict.fromkeys(Point, -inf) | {Point.TARGET_END: 0.0}
    steps: list[tuple[Point, Point, int]] = []
    for k, each in enumerate(RELATIONS[relation].distances):
        lower, upper = bounds[k] if k < len(bounds) else (each.lower, each.upper)
        steps += [(each.earlier, each.later, lower), (each.later, each.earlier, -upper)]
    steps += [(Point.ORIGIN_START, Point.ORIGIN_END, 1), (Point.TARGET_START, Point.TARGET_END, 1)]
    for _ in Point:
        for earlier, later, length in steps:
            least[earlier] = max(least[earlier], least[later] + length)
    return least[Point.ORIGIN_START] < 0
