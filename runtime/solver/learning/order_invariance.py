"""Order invariance: whether variables of equal priority may be decided in any order without changing a verdict.

The order matters only where guards bring new tokens: an earlier one may have fewer merge candidates, or consume from a
tank before it is filled.
"""

from compiler.program import Foreach, Program
from runtime.plan.store.plan import Plan
from runtime.plan.tags import RESOURCE_CONSUMES, RESOURCE_PRODUCES
from runtime.solver.configuration.handler_table import HandlerTable
from runtime.solver.flaws.supports import Supports
from runtime.solver.learning.nogoods import has_any
from runtime.solver.tags import HANDLER_HSTS


def has_loops(program: Program) -> bool:
    """Whether some rule has a `foreach`, whose iterations depend on the decisions before it."""
    return any(has_any(rule.body, (Foreach,)) for rule in program.rules)


def is_order_invariant(program: Program, plan: Plan, table: HandlerTable, supports: Supports) -> bool:
    """Whether the order of variables certainly changes no verdict."""
    if has_loops(program) or any(table.handler_most):
        return False
    if supports.guarded == 0:
        return True
    if any(code.is_action for code in program.predicates) or HANDLER_HSTS in table.handler_code:
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
