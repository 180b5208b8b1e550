"""What the plain oracle works with: tokens, tries at a rule, and what a relation demands of two tokens."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from math import inf

from compiler.program import END, START, Guard, Instruction, Post, PredicateCode
from nddl_lang.semantics.relations import RELATIONS, Point
from runtime.executive.record import TokenRecord
from tests.checker.judge.plain_values import Box, Interval, overlap


@dataclass(eq=False, slots=True)
class Token:
    """A token that was executed, and its variables in the order of programs."""

    record: TokenRecord
    code: PredicateCode
    boxes: list[Box]

    @property
    def start(self) -> Interval:
        """When it starts."""
        return times_of(self.boxes[START])

    @property
    def end(self) -> Interval:
        """When it ends."""
        return times_of(self.boxes[END])


def times_of(box: Box) -> Interval:
    return box if isinstance(box, tuple) else (-inf, inf)


@dataclass(frozen=True, slots=True)
class LoopRound:
    """A round of a loop begins: its slot holds this."""

    slot: int
    box: Box


Step = Instruction | LoopRound


@dataclass(eq=False, slots=True)
class Frame:
    """One try at a rule: what its slots hold, and what could not be decided yet."""

    slots: dict[int, Box]
    tokens: dict[int, Token | None]
    pending: list[Post] = field(default_factory=list)
    guards: list[Guard] = field(default_factory=list)

    def copy(self) -> "Frame":
        """The same once more, to go on with another choice."""
        return Frame(dict(self.slots), dict(self.tokens), list(self.pending), list(self.guards))


@dataclass(frozen=True, slots=True)
class Mission:
    """What of a mission a reactor's plan is held against: the draws in force when a token starts, and its ends."""

    final_tick: int
    draw: Callable[[str, int], float | None]  # parameter and tick in, value out; None where nobody knows
    failed: bool = False  # the reactor was lost, with what it had not yet planned
    repaired: int = -1  # tick of its last repair


def narrow(slot: int, box: Box, frame: Frame) -> bool:
    """Leave of a local variable what is in a box; False if nothing is left."""
    before = frame.slots.get(slot)
    if box is None or before is None:
        frame.slots[slot] = before if box is None else box
        return True
    if overlap(before, box) is False:
        return False
    if isinstance(before, frozenset) and isinstance(box, frozenset):
        frame.slots[slot] = before & box
    elif isinstance(before, tuple) and isinstance(box, tuple):
        frame.slots[slot] = max(before[0], box[0]), min(before[1], box[1])
    return True


def hull(boxes: list[Box]) -> Box:
    names = [one for one in boxes if isinstance(one, frozenset)]
    numbers = [one for one in boxes if isinstance(one, tuple)]
    if boxes and len(names) == len(boxes):
        return frozenset().union(*names)
    if boxes and len(numbers) == len(boxes):
        return min(a for a, _ in numbers), max(b for _, b in numbers)
    return None


def distances(relation: str, bounds: tuple[tuple[int, int], ...]) -> Iterable[tuple[Point, Point, float, float]]:
    for number, one in enumerate(RELATIONS[relation].distances):
        lower, upper = bounds[number] if bounds else (one.lower, one.upper)
        far = 2**52 - 1
        yield one.earlier, one.later, (-inf if lower <= -far else lower), (inf if upper >= far else upper)


def may_relate(relation: str, bounds: tuple[tuple[int, int], ...], origin: Token, target: Token) -> bool:
    at = {
        Point.ORIGIN_START: origin.start,
        Point.ORIGIN_END: origin.end,
        Point.TARGET_START: target.start,
        Point.TARGET_END: target.end,
    }
    return all(
        at[later][0] - at[earlier][1] <= most and at[later][1] - at[earlier][0] >= least
        for earlier, later, least, most in distances(relation, bounds)
    )
