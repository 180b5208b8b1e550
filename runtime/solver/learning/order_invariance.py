"""Say whether a model leaves the search free to decide variables of equal priority in any order.

As long as no token comes in, the order changes nothing: what is left after all of them are decided is the same. Tokens
come in when guards fire. Then who is there first may merge with fewer others, or take from a tank before it is filled.
"""

from compiler.program import ObjectLoop, Program
from runtime.plan.store.plan import Plan
from runtime.plan.tags import RESOURCE_CONSUMES, RESOURCE_PRODUCES
from runtime.solver.configuration.handler_table import Treatments
from runtime.solver.flaws.supports import Supports
from runtime.solver.learning.nogoods import has_any
from runtime.solver.tags import HANDLER_HSTS


def has_loops(program: Program) -> bool:
    """Whether some rule has a `foreach`: it settles what its variable may be, so that all hangs on what came before."""
    return any(has_any(rule.body, (ObjectLoop,)) for rule in program.rules)


def is_any_order_right(program: Program, plan: Plan, treatments: Treatments, supports: Supports) -> bool:
    """Whether the order of variables changes no verdict for certain."""
    if has_loops(program) or any(treatments.handler_most):
        return False
    if supports.guarded == 0:
        return True
    if any(code.is_action for code in program.predicates) or HANDLER_HSTS in treatments.handler_code:
        return False
    numbers = {code.name: number for number, code in enumerate(program.predicates)}
    bases = {code.name: code.base for code in program.classes}
    for number, code in enumerate(program.predicates):
        if not supports.is_guarded(number):
            continue
        if plan.predicate_resource[number] in (RESOURCE_PRODUCES, RESOURCE_CONSUMES):
            return False
        if f"{bases[code.class_name]}.{code.name.rpartition('.')[2]}" in numbers:
            return False  # it may merge with one of its base class, but that one not with it
    return True
