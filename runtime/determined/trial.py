"""What holds when a token starts, or may hold when a start is tried out beforehand; which starts the planner orders."""

from runtime.determined.present import Present
from runtime.determined.tables import CodeTables
from runtime.determined.tags import ENDING, FOLLOWER, LEAST, MOST, OWNER, PREDICATE, SLOT, WISH, WISH_FROM


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


def fits_within(present: Present, i: int) -> bool:
    """Whether the token of a timeline may end, and no end that another one bounds asks for more than that has."""
    n = present.lines
    slot = present.state[SLOT * n + i]
    if present.state[LEAST * n + slot] > present.state[MOST * n + slot]:
        return False
    for k in range(present.state[present.pairs]):
        at = present.pairs + 1 + 4 * k
        most = present.state[MOST * n + present.state[SLOT * n + present.state[at + 1]]]
        least = present.state[LEAST * n + present.state[SLOT * n + present.state[at]]]
        if least > most > present.now and present.is_kept(at):
            return False
    return True


def leaves_next(present: Present) -> bool:
    """Whether a token has been ended by a start of this tick, when what is to follow it could no longer be taken in."""
    n = present.lines
    for i in range(n):
        owner = present.state[OWNER * n + i]
        if present.state[FOLLOWER * n + i] >= 0 and present.state[ENDING * n + owner]:
            if not present.changed >> owner & 1:
                return True
    return False


def comes_between(present: Present) -> bool:
    """Whether what was asked for may start where something is to follow first, which begins as late as it may."""
    n = present.lines
    for i in range(n):
        if present.state[FOLLOWER * n + i] < 0 or present.state[WISH * n + i] < 0:
            continue
        if present.state[WISH_FROM * n + i] > present.now:
            continue
        owner = present.state[OWNER * n + i]
        if owner != i and not present.state[ENDING * n + owner]:
            return True
        if owner == i and present.state[ENDING * n + i]:
            if present.state[MOST * n + present.state[SLOT * n + i]] > present.now:
                return True  # nothing but the request would end what holds
    return False


def can_follow(present: Present, tables: CodeTables) -> bool:
    """Whether all that is to follow an end that the lines of its token leave open begins at any time: it is planned."""
    n = present.lines
    for i in range(n):
        block = present.state[FOLLOWER * n + i]
        if block >= 0 and not tables.block_free[block]:
            slot = present.state[SLOT * n + present.state[OWNER * n + i]]
            if present.state[LEAST * n + slot] != present.state[MOST * n + slot]:
                return False
    return True
