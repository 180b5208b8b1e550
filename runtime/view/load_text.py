"""State of a loaded model as text: tokens, variables, sequences on timelines."""

from collections.abc import Iterator

from runtime.plan.readout.state import PlanState
from runtime.view.plan_text import HEAD, token_cells
from runtime.view.table import table


def lines(plan: PlanState, width: int | None, *, may_be_relieved: bool = False) -> Iterator[str]:
    """What a modeler wants to see of one model, line by line; a level out of bounds may be relieved by what is open."""
    if plan.tokens:
        yield from table(HEAD, (token_cells(token, is_full=True) for token in plan.tokens), width)
        yield ""
    variables = [(name, str(domain)) for name, domain in {**plan.variables, **plan.rule_variables}.items()]
    if variables:
        yield from table(("variable", "domain"), variables, width)
        yield ""
    for timeline, sequence in plan.sequences.items():
        if sequence:
            yield f"{timeline}: {' then '.join(sequence)}"
    if plan.is_consistent:
        yield "consistent"
    elif may_be_relieved:
        yield "inconsistent as it stands: a level is out of bounds, which tokens that are still open may mend"
    else:
        yield "inconsistent: no plan can satisfy this model"
