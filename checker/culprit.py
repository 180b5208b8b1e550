"""A conflict in, the line where draw and model collide out: the written limit farthest from what the world did.

The elements of a conflict hang together by the variables they share. Workers read this file for each mission.
"""

import math
from dataclasses import dataclass

from compiler.program import TOKEN_TIMES
from runtime.executive.outcome import Conflict, ConflictElement, ElementKind, SourcePlace
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.statements import Term

# Kinds of elements that no line of the model can help.
_WORLD = (
    ElementKind.SAMPLE,
    ElementKind.OBSERVATION,
    ElementKind.REQUEST,
    ElementKind.CLOCK,
)
_BOUNDING = (ElementKind.CONSTRAINT, ElementKind.DURATION)
_VALUES = (ElementKind.ASSIGNMENT, ElementKind.DECLARATION)
_HELPING = {"levelLimitMin": "produce", "levelLimitMax": "consume"}
_GIVEN = (*_VALUES, ElementKind.REQUEST)
# Kinds of elements that say when something may be.
_TIMING = (ElementKind.CLOCK, ElementKind.RELATION, ElementKind.ORDER, ElementKind.LONGEST, ElementKind.SHARED_END)
_LIMITS = ("leq", "lt", "neq", "bounds", "withinBounds", "precedes", "strictlyPrecedes")


@dataclass(frozen=True, slots=True)
class Culprit:
    """The element of a conflict where draw and model collide, and the lines that set what it compares with.

    `number` is its index in the conflict, -1 where no element is written anywhere; then `at` may name a line.
    """

    number: int = -1
    element: ConflictElement | None = None
    limits: tuple[SourcePlace, ...] = ()
    at: SourcePlace | None = None

    @property
    def place(self) -> SourcePlace | None:
        """Its line in the model."""
        return self.element.place if self.element is not None else self.at


def is_value(element: ConflictElement | None) -> bool:
    """Whether an element says what something is, which breaks nothing but by the lines that compare with it."""
    return element is not None and element.kind in _VALUES


def culprit_of(conflict: Conflict | None) -> Culprit:
    """The written limit that stands farthest from what the world did, sooner one of the reactor that broke."""
    if conflict is None:
        return Culprit()
    elements = conflict.elements
    neighbours = _neighbours(conflict)
    roots = _roots(conflict, (ElementKind.SAMPLE,)) or _roots(conflict, _WORLD)
    far = _distances(neighbours, roots)
    own = set(own_elements(conflict))
    checks = checks_of(conflict)
    candidates = [
        (0 if element in checks else _rank(element), element not in own, -far.get(number, len(elements)), -number)
        for number, element in enumerate(elements)
        if element.place is not None and element.kind not in _WORLD
    ]
    if not candidates:
        return Culprit()
    chosen = -min(candidates)[-1]
    limits = [
        element.place
        for number, element in enumerate(elements)
        if number in neighbours[chosen] and element.kind in _VALUES and element.place != elements[chosen].place
    ]
    return Culprit(chosen, elements[chosen], tuple(place for place in dict.fromkeys(limits) if place is not None))


def checks_of(conflict: Conflict | None) -> list[ConflictElement]:
    """The constraints that only compare what constructors, constants and requests give: even `==` sets nothing."""
    elements = conflict.elements if conflict is not None else ()
    given = {variable for element in elements if element.kind in _GIVEN for variable in element.variables}
    constraints = [element for element in elements if element.kind is ElementKind.CONSTRAINT]
    return [element for element in constraints if element.variables and given.issuperset(element.variables)]


def lacking_in(conflict: Conflict | None) -> frozenset[tuple[str, str]]:
    """The resources that a conflict finds too empty or too full, each with the event that more of would help."""
    elements = conflict.elements if conflict is not None else ()
    levels = (one for element in elements if element.kind is ElementKind.RESOURCE for one in element.variables)
    named = [one.name.rpartition(".") for one in levels if one.token is None]
    return frozenset((resource, _HELPING[limit]) for resource, _, limit in named if limit in _HELPING)


def own_elements(conflict: Conflict | None) -> list[ConflictElement]:
    """The elements of the reactor that a conflict arose in, and of those whose tokens it observed.

    What is left out are lines of reactors that only asked for something.
    """
    if conflict is None:
        return []
    reactors = [next((one.reactor for one in element.variables), "") for element in conflict.elements]
    own = {"", next((one for one in reversed(reactors) if one), "")}
    own |= {one.reactor for each in conflict.elements if each.kind is ElementKind.SHARED_END for one in each.variables}
    return [element for element, one in zip(conflict.elements, reactors, strict=True) if one in own]


def is_of_values(conflict: Conflict) -> bool:
    """Whether a conflict holds whenever it comes: what its lines compute can be no duration, or no value at all."""
    return not any(
        _is_timed(element) or (element.kind in _BOUNDING and _is_limit(element)) for element in conflict.elements
    )


def is_unbounded(element: ConflictElement) -> bool:
    """Whether it says of a variable that it may be anything: the lines about it tell what it is."""
    match element.says:
        case Term("bounds", (_, lower, upper), ()):
            return lower == -math.inf and upper == math.inf
        case _:
            return False


def in_telling_order(conflict: Conflict, last: int) -> list[int]:
    """The numbers of the elements from the draws outwards, `last` at the end; as given where nothing was drawn."""
    neighbours = _neighbours(conflict)
    roots = _roots(conflict, (ElementKind.SAMPLE,))
    far = _distances(neighbours, roots)
    unknown = len(conflict.elements) if roots else 0
    return sorted(range(len(conflict.elements)), key=lambda number: (number == last, far.get(number, unknown), number))


def _neighbours(conflict: Conflict) -> list[set[int]]:
    """For each element those that speak of the same variable."""
    found: list[set[int]] = [set() for _ in conflict.elements]
    speakers: dict[VariableName, set[int]] = {}
    for number, element in enumerate(conflict.elements):
        for variable in element.variables:
            speakers.setdefault(variable, set()).add(number)
    for together in speakers.values():
        for number in together:
            found[number] |= together - {number}
    return found


def _roots(conflict: Conflict, kinds: tuple[ElementKind, ...]) -> list[int]:
    return [number for number, element in enumerate(conflict.elements) if element.kind in kinds]


def _distances(neighbours: list[set[int]], roots: list[int]) -> dict[int, int]:
    """How many steps each element is away from the nearest of the roots, where one is connected."""
    far = dict.fromkeys(roots, 0)
    front = roots
    while front:
        reached = {other for number in front for other in neighbours[number] if other not in far}
        far |= dict.fromkeys(reached, far[front[0]] + 1)
        front = sorted(reached)
    return far


def _is_timed(element: ConflictElement) -> bool:
    """Whether an element says when something may be, or was asked to be."""
    is_told = element.kind in _WORLD and any(one.name in TOKEN_TIMES for one in element.variables)
    return element.kind in _TIMING or is_told


def _is_limit(element: ConflictElement) -> bool:
    """Whether an element bounds one value by another."""
    return any(term.name in _LIMITS for term in element.terms)


def _rank(element: ConflictElement) -> int:
    """How likely a line is the mistaken one: written limits before values before relations before the rest."""
    match element.kind:
        case kind if kind in _BOUNDING and _is_limit(element):
            return 0
        case ElementKind.ASSIGNMENT | ElementKind.DECLARATION:
            return 1
        case ElementKind.RELATION | ElementKind.ORDER:
            return 2
        case _:
            return 3
