"""A complaint about a misspelt name in a mission file in; the same with the fix that writes the right one out."""

import re
from collections.abc import Collection
from dataclasses import replace

from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix
from nddl_lang.text.nearest import begun, nearest
from nddl_lang.text.source import Span

_COMPARING = re.compile(r"[<>=+*/-]")
_PART = re.compile(r"""\"[^\"]*\"|'[^']*'|[^.\"']+""")


def meant_name(name: str, known: Collection[str]) -> str | None:
    """The known name that was meant by another: its last part, as in `Nav.Hold`, the nearest, or what it begins."""
    last = name.replace("::", ".").rpartition(".")[2]
    return last if last != name and last in known else nearest(name, known) or begun(name, known)


def word_in(span: Span, name: str) -> Span:
    """The part of a dotted key that is `name`, quoted or not; all of the key where none is."""
    at = 0
    for part in _PART.findall(span.text):
        at = span.text.index(part, at)
        if part.strip().strip("\"'") == name:
            start = span.start + at + len(part) - len(part.lstrip())
            return Span(span.anchor, start, start + len(part.strip()))
        at += len(part)
    return span


def respelt(complaint: Diagnostic, name: str, known: Collection[str]) -> Diagnostic:
    """`complaint`, which stands at `name`, with a fix where one of the known names resembles it."""
    close = meant_name(name, known)
    return complaint if close is None else rewritten(complaint, name, close)


def rewritten(complaint: Diagnostic, name: str, meant: str) -> Diagnostic:
    """`complaint` with a fix that writes `meant` for `name`; quotes stay.

    The name stands there alone, behind a dot, or wherever an expression has it as a word.
    """
    span = complaint.span
    before, found, after = span.text.rpartition(name)
    is_last = before.strip("\"'") == "" or before.rstrip("\"'").endswith(".")
    places = [len(before)]
    if not found or not is_last or after.strip("\"'") != "":
        places = [each.start() for each in re.finditer(rf"(?<![\w.]){re.escape(name)}(?![\w.])", span.text)]
        if not places or _COMPARING.search(span.text) is None:
            return complaint
    starts = [span.start + at for at in places]
    edits = tuple(Edit(Span(span.anchor, start, start + len(name)), meant) for start in starts)
    return replace(complaint, fixes=(*complaint.fixes, Fix(f"write `{meant}`", edits, safe=False)))


def written_anew(complaint: Diagnostic, text: str) -> Diagnostic:
    """`complaint` with a fix that writes a text in place of all that it stands at."""
    fix = Fix(f"write `{text}`", (Edit(complaint.span, text),), safe=False)
    return replace(complaint, fixes=(*complaint.fixes, fix))
