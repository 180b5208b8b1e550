"""Carry out the fixes of findings, again and again until none is left, and never one that leads to a new error."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from nddl_lang.text.diagnostic import Diagnostic, Fix, Severity
from nddl_lang.text.read import decode, read_named
from nddl_lang.text.render import apply_edits

Check = Callable[[str], tuple[Diagnostic, ...]]
_MOST_ROUNDS = 1000  # that change the text; what is refused is finite, and not counted


@dataclass(frozen=True, slots=True)
class Mended:
    """A text after its fixes; `count` tells how many were carried out, `left` what is still found."""

    text: str
    count: int
    left: tuple[Diagnostic, ...]


def text_to_mend(path: Path) -> str | None:
    """The text of a file; None where it is no UTF-8 text, which could not be written back as it was."""
    content = read_named(path)
    text = decode(content)
    return text if text.encode() == content else None


def mend(text: str, check: Check, *, unsafe: bool = False) -> Mended:
    """Carry out the fixes of what `check` finds in `text`, which is one file; fixes that reach others are left out."""
    found = check(text)
    refused: set[tuple[str, str, str]] = set()
    seen = {text}
    count = 0
    while len(seen) <= _MOST_ROUNDS:
        chosen = _disjoint(found, text, refused, unsafe=unsafe)
        if not chosen:
            break
        after = _applied(text, [fix for _, fix in chosen])
        result = check(after)
        if after in seen or _has_new_error(found, result):
            if len(chosen) > 1:  # one of them is at fault: carry out the first alone
                chosen = chosen[:1]
                after = _applied(text, [chosen[0][1]])
                result = check(after)
            if after in seen or _has_new_error(found, result):
                refused.add(_name(chosen[0][0], chosen[0][1]))
                continue
        seen.add(after)
        text, found, count = after, result, count + len(chosen)
    return Mended(text, count, found)


def _disjoint(
    found: tuple[Diagnostic, ...], text: str, refused: set[tuple[str, str, str]], *, unsafe: bool
) -> list[tuple[Diagnostic, Fix]]:
    """One fix of each finding, as far as they stand apart from each other."""
    chosen: list[tuple[Diagnostic, Fix]] = []
    taken: list[tuple[int, int]] = []
    for diagnostic in found:
        for fix in diagnostic.fixes:
            if fix.is_choice or not (fix.safe or unsafe) or _name(diagnostic, fix) in refused:
                continue
            if any(edit.span.source.text is not text and edit.span.source.text != text for edit in fix.edits):
                continue
            places = [(edit.span.begin, edit.span.finish) for edit in fix.edits]
            if all(finish < begin or last < start for start, last in places for begin, finish in taken):
                chosen.append((diagnostic, fix))
                taken += places
            break
    return chosen


def _applied(text: str, fixes: list[Fix]) -> str:
    return apply_edits(text, [edit for fix in fixes for edit in fix.edits])


def _name(diagnostic: Diagnostic, fix: Fix) -> tuple[str, str, str]:
    return diagnostic.code.id, diagnostic.message, fix.title


def _has_new_error(before: tuple[Diagnostic, ...], after: tuple[Diagnostic, ...]) -> bool:
    """Whether there is an error of a kind that was not there so often before."""
    counts = [Counter(each.code.id for each in found if each.severity is Severity.ERROR) for found in (before, after)]
    return bool(counts[1] - counts[0])
