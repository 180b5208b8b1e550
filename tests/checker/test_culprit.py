"""What an element of a conflict is worth telling."""

from math import inf

import pytest

from checker.culprit import is_unbounded
from runtime.executive.outcome import ConflictElement, ElementKind
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import Term

OPENS = VariableName("slot.opens", "int", TokenName("Campaign.Fly", 5))


@pytest.mark.parametrize(
    ("says", "is_idle"),
    [
        (Term("bounds", (OPENS, -inf, inf)), True),
        (Term("bounds", (OPENS, -inf, inf), ("evening", "noon")), False),
        (Term("bounds", (OPENS, 3, inf)), False),
        (Term("leq", (OPENS, 3)), False),
        (None, False),
    ],
)
def test_what_may_be_anything_is_no_step(says: Term | None, is_idle: bool) -> None:
    element = ConflictElement(ElementKind.DECLARATION, None, "", None, says, ())
    assert is_unbounded(element) is is_idle
