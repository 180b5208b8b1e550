"""Elements of a conflict in; out: whether the differences of times that they speak of contradict each other already.

A simple temporal network, in Bellman and Ford's way: what is no difference is left out, so True is sure, False is not.
"""

from collections.abc import Iterable, Iterator

from runtime.executive.outcome import ConflictElement
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.statements import Argument, Term

_Edge = tuple[Argument | None, Argument | None, float]  # target - source <= weight; None is tick 0
_SUMS = ("temporalDistance", "addEq")


def contradict(elements: Iterable[ConflictElement]) -> bool:
    """Whether no times can keep all of them."""
    terms = [term for element in elements for term in element.terms]
    bounds: dict[Argument, tuple[float, float]] = {}
    for term in terms:
        match term.name, term.arguments:
            case "bounds", (VariableName() as variable, int() | float() as lower, int() | float() as upper):
                least, most = bounds.get(variable, (float("-inf"), float("inf")))
                bounds[variable] = (max(least, lower), min(most, upper))
            case _:
                pass
    edges = [edge for term in terms for edge in _edges(term, bounds)]
    edges += [(None, variable, upper) for variable, (_, upper) in bounds.items()]
    edges += [(variable, None, -lower) for variable, (lower, _) in bounds.items()]
    nodes = dict.fromkeys(node for source, target, _ in edges for node in (source, target))
    far = dict.fromkeys(nodes, 0.0)
    for _ in nodes:
        is_over = True
        for source, target, weight in edges:
            if far[source] + weight < far[target]:
                far[target], is_over = far[source] + weight, False
        if is_over:
            return False
    return bool(nodes)


def _edges(term: Term, bounds: dict[Argument, tuple[float, float]]) -> Iterator[_Edge]:
    match term.name, term.arguments:
        case "precedence", (source, target, int() | float() as weight):
            yield source, target, weight
        case "leq", (one, other):
            yield other, one, 0.0
        case "eq", (one, other):
            yield other, one, 0.0
            yield one, other, 0.0
        case name, (one, added, result) if name in _SUMS:
            for begin, length in ((one, added), (added, one)):
                least, most = bounds.get(length, (float("-inf"), float("inf")))
                yield begin, result, most
                yield result, begin, -least
        case _:
            pass
