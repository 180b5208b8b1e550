"""A reactor in Python that nothing calls to end what broke a plan: its line is named, and no other is said to mend."""

from pathlib import Path

import pytest

from checker.causes import failed_by
from checker.counterfactual.python_ways import asleep_in
from checker.counterfactual.ranking import Causes, Claim, RankedLine
from checker.counterfactual.rendering import cause_text
from runtime.executive.outcome import SourcePlace
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import failed_mission

pytestmark = pytest.mark.once

CRAWLER = Path(__file__).parent / "unseen" / "crawler"
WITHOUT_WAKE, TOO_SLOW = 4, 3  # the faults: its `now.wake` is gone; its speed is a tenth


@pytest.mark.parametrize("number", [WITHOUT_WAKE, TOO_SLOW])
def test_who_is_never_called_again_is_told_from_who_takes_long(number: int, tmp_path: Path) -> None:
    place = laid_out(CRAWLER, list(faults_in(CRAWLER))[number], tmp_path / "crawler")
    given, failed = failed_mission(place, 1)
    assert failed.outcome is not None
    conflict = failed_by(failed.outcome).conflict
    found = [(name, one.file, one.text) for name, one in asleep_in(failed.outcome, conflict, given.models.agent)]
    publishing = 'now.publish("tracks", "Drive", to=self.goal)'
    assert found == ([("tracks", "tracks.py", publishing)] if number == WITHOUT_WAKE else [])


def test_it_is_not_said_that_no_change_helps_where_one_does() -> None:
    asleep = RankedLine(SourcePlace("tracks.py", 1, 1, ""), "", Claim.ASLEEP, variable="tracks")
    other = RankedLine(SourcePlace("tracks.py", 1, 1, ""), "Job.Shield", Claim.LOOSENS, helped=1, missions=1)
    alone, both = (cause_text(Causes(ranked, 1, 1)) for ranked in ((asleep,), (asleep, other)))
    assert alone.startswith("none of the changes tried")
    assert both.startswith("nothing calls `tracks` any more")
