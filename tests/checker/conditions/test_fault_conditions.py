"""What a report says of when missions fail holds on fresh missions, or is marked: one fault of a model of others."""

from pathlib import Path

import pytest

from tests.checker.conditions.fault_conditions import printed_conditions
from tests.checker.fault_study import faults_in

UNSEEN = Path(__file__).resolve().parents[1] / "unseen"

pytestmark = pytest.mark.once


@pytest.mark.slow
def test_what_is_printed_of_a_fault_holds_on_fresh_missions(tmp_path: Path) -> None:
    folder = UNSEEN / "bioreactor"
    fault = list(faults_in(folder))[7]  # a limit below the longest way
    (printed,) = printed_conditions(folder, fault, tmp_path / "model", 40, 120, 60.0)
    assert printed.condition.parameters == ("WAY",)
    assert printed.failing > 10
    assert printed.is_honest
