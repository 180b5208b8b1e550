"""What lint warns of in, tied to the trials out: which lines it speaks of, and what it says of a cause.

Of 5,909 lines of right models lint warns of 3. After 171 faults made by hand it warned of 10 lines of rules, of which 4
were the changed one.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from checker.counterfactual.candidates import Candidate
from checker.names import relative_name
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Span
from runtime.executive.outcome import SourcePlace

_NAME = re.compile(r"[A-Za-z_]\w*")


@dataclass(frozen=True, slots=True)
class Remark:
    """What lint says of a line, and of which name there."""

    place: SourcePlace
    name: str
    text: str

    def is_about(self, place: SourcePlace) -> bool:
        """Whether it stands at the line of a place."""
        return (self.place.file, self.place.line) == (place.file, place.line)

    def names_one_of(self, text: str) -> bool:
        """Whether a text has the name that it speaks of."""
        return self.name.isidentifier() and re.search(rf"\b{self.name}\b", text) is not None


def remarks_of(findings: Sequence[Diagnostic], root: Path) -> tuple[Remark, ...]:
    """The findings with their places, as causes name these; one for each line that a finding points at."""
    return tuple(
        Remark(
            _place(span, root),
            finding.span.text,
            f"{finding.message} [{finding.code.id}]",
        )
        for finding in findings
        for span in _spans(finding)
    )


def with_remarks(candidates: Sequence[Candidate], findings: Sequence[Diagnostic]) -> list[Candidate]:
    """The candidates, those marked that lint warns of: lines of rules, and constants that such a line names.

    What is declared and not used is not marked.
    """
    spans = [span for finding in findings for span in _spans(finding)]
    lines = {(_file(span), span.line) for span in spans}
    named = {word for span in spans for word in _NAME.findall(span.text)}

    def is_linted(one: Candidate) -> bool:
        stands_there = any(one.site.holds(file, line) for file, line in lines)
        return stands_there if one.site.rule else one.site.named in named and not stands_there

    return [replace(one, is_linted=True) if is_linted(one) else one for one in candidates]


def _spans(finding: Diagnostic) -> Iterator[Span]:
    """Where a finding stands, and the lines that have a part in it."""
    yield finding.span
    yield from (note.span for note in finding.notes if note.span is not None)


def _place(span: Span, root: Path) -> SourcePlace:
    return SourcePlace(relative_name(_file(span), root), span.line, span.column, span.text)


def _file(span: Span) -> str:
    return str(real_path(Path(span.source.name)))
