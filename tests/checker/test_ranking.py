"""Loose ends stand before what was flown with half a success only where they are near and unusual."""

from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.ranking import Claim, rank
from checker.counterfactual.tried import LineTrial, Loose, Trials, TrialsEnd
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind


def candidate(line: int, text: str) -> Candidate:
    edit = SmallEdit(EditKind.CONSTANT, "/m.nddl", 0, 1, "6", "12", line)
    return Candidate(EditSite("/m.nddl", line, 1, line, "T.P", (1, 9), text, (edit,)), 0.25, Suspicion.CONFLICT)


@pytest.mark.parametrize(
    ("doubt", "is_uneven", "first"),
    [(1.0, False, Claim.PARTLY), (1.0, True, Claim.UNEVEN), (6.0, True, Claim.PARTLY)],
)
def test_a_doubtful_loose_end_comes_after_what_was_flown(doubt: float, is_uneven: bool, first: Claim) -> None:
    tried = candidate(3, "n <= 6;")
    trial = LineTrial(tried, tried.site.edits[0], 0.0, 1.0, helped=1, missions=2)
    loose = Loose(candidate(5, "contains(T.Q q);"), "q.n", is_uneven=is_uneven, doubt=doubt)
    causes = rank(Trials((trial,), (tried,), 1, 4, TrialsEnd.COMPLETE, (loose,)), Path("/"))
    assert next(one.claim for one in causes.ranked) is first
    assert {one.claim for one in causes.ranked} == {Claim.PARTLY, Claim.UNEVEN if is_uneven else Claim.LOOSE_END}


def test_of_the_loose_ends_at_one_line_the_likeliest_is_told() -> None:
    head = candidate(5, "T::P")
    loose = Loose(head, "THIN", is_unread=True, doubt=1.0), Loose(head, "number", doubt=3.0)
    causes = rank(Trials((), (), 1, 4, TrialsEnd.COMPLETE, loose), Path("/"))
    assert [one.variable for one in causes.ranked] == ["THIN"]


def test_beside_what_mends_a_parameter_that_few_lines_speak_of_is_not_told() -> None:
    tried = candidate(3, "n <= 6;")
    trial = LineTrial(tried, tried.site.edits[0], 0.0, 1.0)
    loose = (
        Loose(candidate(5, "contains(T.Q q);"), "q.n", doubt=1.0),
        Loose(candidate(7, "T::R"), "THIN", is_unread=True),
    )
    causes = rank(Trials((trial,), (tried,), 1, 4, TrialsEnd.COMPLETE, loose), Path("/"))
    assert [one.claim for one in causes.ranked] == [Claim.MENDS, Claim.UNREAD]
