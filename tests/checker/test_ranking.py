"""Loose ends stand before what was flown with half a success only where they are near and unusual."""

from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.ranking import Claim, rank
from checker.counterfactual.trials import LineTrial, Loose, Trials, TrialsEnd
from checker.mutation.edits import EditKind, EditSite, SmallEdit


def candidate(line: int, text: str) -> Candidate:
    edit = SmallEdit(EditKind.CONSTANT, "/m.nddl", 0, 1, "6", "12", line)
    return Candidate(EditSite("/m.nddl", line, 1, line, "T.P", (1, 9), text, (edit,)), 0.25, Suspicion.CONFLICT)


@pytest.mark.parametrize(("doubt", "first"), [(1.0, Claim.LOOSE_END), (6.0, Claim.PARTLY)])
def test_a_doubtful_loose_end_comes_after_what_was_flown(doubt: float, first: Claim) -> None:
    tried = candidate(3, "n <= 6;")
    trial = LineTrial(tried, tried.site.edits[0], 0.0, 1.0, helped=1, missions=2)
    loose = Loose(candidate(5, "contains(T.Q q);"), "q.n", doubt=doubt)
    causes = rank(Trials((trial,), (tried,), 1, 4, TrialsEnd.COMPLETE, (loose,)), Path("/"))
    assert next(one.claim for one in causes.ranked) is first
    assert {one.claim for one in causes.ranked} == {Claim.PARTLY, Claim.LOOSE_END}
