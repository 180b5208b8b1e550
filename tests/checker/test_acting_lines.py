"""A story tells only lines that the mission came to: of rules that fired, on branches that it took."""

from pathlib import Path

import pytest

from checker.oracle import Verdict
from checker.steps import StepKind
from tests.checker.conditions.campaigns import campaign, flown

pytestmark = pytest.mark.once

RULE = """
    bool quick; quick == (q > 0.5);
    int length;
    if (quick == true) {
        length == ceil(p);
    } else {
        length == ceil(p + 0.25);
    }
    duration <= length + 1;
"""


@pytest.mark.parametrize(("is_quick", "told", "silent"), [(True, "ceil(p)", "0.25"), (False, "0.25", "ceil(p)")])
def test_an_untaken_branch_is_not_told(tmp_path: Path, is_quick: bool, told: str, silent: str) -> None:
    given = campaign(tmp_path, RULE.replace("q > 0.5", "q > -1.0" if is_quick else "q > 2.0"), missions=3)
    failed = next(one for one in flown(given) if one.verdict is Verdict.FAIL)
    steps = given.story(failed, None).steps
    lines = [one.place.text for one in steps if one.kind is StepKind.LINE and one.place is not None]
    assert any(told in line for line in lines) and not any(silent in line for line in lines)
