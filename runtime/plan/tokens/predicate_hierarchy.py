"""Hierarchy of predicates of one name through their classes: which one a child has, and who may merge with whom.

Class D that extends C has C's predicates as its own: a token of `D.p` is also one of `C.p`, so a token of `C.p` may
merge into it, and what a rule asks for on the rule's own object is a predicate of the class that the token has.
"""

from runtime.plan.store.plan import Plan
from runtime.plan.tags import HEAD_PREDICATE, LIST_PREDICATE, LISTS, NONE


def is_kind_of(plan: Plan, predicate: int, other: int) -> bool:
    """Whether a token of `predicate` is also one of `other`."""
    while predicate >= 0:
        if predicate == other:
            return True
        predicate = plan.predicate_parent[predicate]
    return False


def own_predicate(plan: Plan, predicate: int, parent: int) -> int:
    """`predicate`, which a rule names, as the class of the rule's token has it."""
    class_ = plan.predicate_class[plan.rows.predicate[parent]]
    found = plan.predicate_at[class_ * plan.suffixes + plan.predicate_suffix[predicate]]
    return found if found >= 0 else predicate


def active_head(plan: Plan, predicate: int) -> int:
    """The list of active tokens that those of `predicate` are on, with all of related predicates."""
    return HEAD_PREDICATE + plan.predicate_root[predicate]


def first_active(plan: Plan, predicate: int) -> int:
    """The active token of `predicate` with the lowest key."""
    return on_list(plan, plan.rows.head_first[active_head(plan, predicate)], predicate)


def next_active(plan: Plan, t: int, predicate: int) -> int:
    """The active token of `predicate` that comes after `t`."""
    return on_list(plan, plan.rows.link_after[LISTS * t + LIST_PREDICATE], predicate)


def on_list(plan: Plan, t: int, predicate: int) -> int:
    """`t`, or the next token on its list that is one of `predicate`."""
    while t >= 0 and not is_kind_of(plan, plan.rows.predicate[t], predicate):
        t = plan.rows.link_after[LISTS * t + LIST_PREDICATE]
    return t if t >= 0 else NONE
