"""What was sought of a run's faults is kept where more time would have shown no more."""

from types import SimpleNamespace
from typing import Any

import pytest

from checker.counterfactual.ranking import Causes
from checker.counterfactual.tried import TrialsEnd
from checker.findings import Ending
from checker.sought import read_sought, write_sought

pytestmark = pytest.mark.once


@pytest.mark.parametrize("ended", list(TrialsEnd))
def test_a_search_that_was_cut_off_is_not_kept(ended: TrialsEnd) -> None:
    fault = SimpleNamespace(causes=Causes(tried=3, ended=ended), condition=None, bucket=SimpleNamespace(parts=(2, 5)))
    findings: Any = SimpleNamespace(ending=Ending.COMPLETE, is_cut=False, faults=(fault,))
    text = write_sought(findings)
    assert (text is not None) == (ended in (TrialsEnd.COMPLETE, TrialsEnd.FLIGHTS))
    if text is not None:
        (kept,) = read_sought(text)
        assert (kept.parts, kept.causes.tried, kept.condition) == ((2, 5), 3, None)
