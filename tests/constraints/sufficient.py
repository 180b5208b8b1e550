"""Sufficient explanations: causes widened until they are inconsistent by themselves, for the judges of explanations.

Of a conflict at level 0, whose past is forgotten, the engine's own explanation may lack something.
"""

from runtime.constraints.domains.tags import SUPPORT_CONSTRAINT, SUPPORT_EDGE, SUPPORT_RESTRICTION
from runtime.constraints.engine import Engine
from runtime.constraints.explanation.cause import Cause
from runtime.constraints.explanation.explain import cause_of
from runtime.constraints.minimisation.minimise import Scratch

_MOST_ROUNDS = 50


def sufficient(engine: Engine) -> list[Cause]:
    """Give causes of the present conflict that are inconsistent by themselves."""
    scratch = Scratch(engine)
    causes = engine.explain()
    for _ in range(_MOST_ROUNDS):
        if scratch.refutes(causes):
            return causes
        more = _neighbours(scratch, causes)
        if len(more) == len(causes):
            return causes
        causes = more
    return causes


def _neighbours(scratch: Scratch, causes: list[Cause]) -> list[Cause]:
    """Give the causes and all that shares a variable with them."""
    engine = scratch.engine
    found = dict.fromkeys(causes)
    for v in dict.fromkeys(v for cause in causes for v in scratch.arguments(cause)):
        if engine.constant[v]:
            continue
        supports = [4 * c + SUPPORT_CONSTRAINT for c in engine.constraints_of(v)]
        supports += [4 * e + SUPPORT_EDGE for e in engine.edges_of(v)]
        supports += [4 * r + SUPPORT_RESTRICTION for r in engine.restrictions_of(v)]
        found.update(dict.fromkeys(cause for s in supports if (cause := cause_of(engine, s)) is not None))
    return list(found)
