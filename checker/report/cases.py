"""Regression cases that fail in, what marks their lines out: those that fail alike together, at the line to blame."""

from dataclasses import dataclass

from checker.batch.result import MissionResult
from checker.buckets import group_failures
from checker.findings import Findings, regressed
from checker.oracle import CODE_NAMES, Verdict
from checker.rendering import failure_text
from checker.report.sentences import case_name
from nddl_lang.text.printable import counted
from runtime.executive.outcome import SourcePlace

_MOST_NAMES = 8


@dataclass(frozen=True, slots=True)
class FailingCases:
    """Cases that fail alike; `must_pass` if the check fails for one of them."""

    code: str
    names: tuple[str, ...]
    why: str
    places: tuple[SourcePlace, ...]
    must_pass: bool

    @property
    def title(self) -> str:
        """What fails, and how many."""
        name = CODE_NAMES.get(self.code, "could not be flown")
        return f"{self.code} {name}: {counted(len(self.names), 'regression case')} still {self._verb}"

    @property
    def text(self) -> str:
        """Why, and the names of the cases."""
        more = len(self.names) - _MOST_NAMES
        listed = ", ".join(self.names[:_MOST_NAMES]) + (f" and {more} more" if more > 0 else "")
        return f"{self.why}: {listed}"

    @property
    def _verb(self) -> str:
        return "fails" if len(self.names) == 1 else "fail"


def failing_cases(findings: Findings) -> list[FailingCases]:
    """The cases that do not pass: failures by their line, then those that could not be flown by what was said of it."""
    names = {one.result.number: case_name(one) for one in findings.cases}
    must = {one.result.number for one in regressed(findings.cases, findings.rate.limit)}
    results = tuple(one.result for one in findings.cases if not one.passes)
    found = [
        FailingCases(
            bucket.code,
            tuple(names[number] for number in bucket.missions),
            failure_text(bucket.judgement, bucket.open_goals, bucket.refusal),
            tuple(dict.fromkeys(one for one in (bucket.culprit.place, *bucket.culprit.limits) if one is not None)),
            not must.isdisjoint(bucket.missions),
        )
        for bucket in group_failures(results)
    ]
    errors: dict[tuple[str, str], list[MissionResult]] = {}
    for one in results:
        if one.verdict is Verdict.ERROR:
            errors.setdefault((one.judgement.code or Verdict.ERROR.value, failure_text(one.judgement)), []).append(one)
    for (code, why), members in errors.items():
        numbers = [one.number for one in members]
        found.append(FailingCases(code, tuple(names[one] for one in numbers), why, (), not must.isdisjoint(numbers)))
    return found
