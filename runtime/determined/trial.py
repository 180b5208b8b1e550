"""What holds when a token starts, or may hold when a start is tried out beforehand."""

from runtime.determined.present import Present
from runtime.determined.tables import CodeTables
from runtime.determined.tags import ENDING, FOLLOWER, LEAST, MOST, PREDICATE, SLOT


def holds(present: Present, tables: CodeTables, i: int, predicate: int, is_trial: bool) -> bool:
    """Whether a token of a predicate holds on a timeline, or may at the tick that is tried out.

    What holds there now may be over by then: then what follows must be of that predicate, and known.
    """
    n = present.lines
    if present.state[PREDICATE * n + i] != predicate:
        return False
    if present.changed >> i & 1:
        return True
    if not is_trial:
        return not present.state[ENDING * n + i]
    if present.state[MOST * n + present.state[SLOT * n + i]] > present.now:
        return True
    follower = present.state[FOLLOWER * n + i]
    return bool(follower >= 0 and tables.block_predicate[follower] == predicate)


def fits_within(present: Present) -> bool:
    """Whether, of two ends that are ordered, none asks for more than what goes on can last."""
    n = present.lines
    for k in range(present.state[present.pairs]):
        at = present.pairs + 1 + 4 * k
        most = present.state[MOST * n + present.state[SLOT * n + present.state[at + 1]]]
        least = present.state[LEAST * n + present.state[SLOT * n + present.state[at]]]
        if least > most > present.now and present.is_kept(at):
            return False
    return True
