"""Order the uses of a resource where they might exceed it."""

from runtime.solver.codes import NO_CHOICE
from runtime.solver.decisions import Decisions
from runtime.solver.queues import Queues


def select_resource(q: Queues, manager: int) -> int:
    """Compare the worst instant of all resources with the best flaw so far."""
    return 0


def mend_resource(q: Queues, stack: Decisions, d: int) -> int:
    """Post the next order of two uses."""
    return NO_CHOICE
