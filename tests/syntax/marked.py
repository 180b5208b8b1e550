"""Mark the complaints about a text in the text itself, and read a text that is marked so.

Below a line stand, as comments, a row of `^` under each place with the code and the message, then what helps. A row
that begins in the first two columns has its `^` right after the slashes and says where it begins: `//^^@1`.
"""

import re
from collections.abc import Iterable

from nddl_lang.text.diagnostic import Diagnostic, Severity

_MARK = re.compile(r"//( *\^+(@\d)? NDDL\d+|( {3}|\t)(help|note|fix\??): )")


def unmarked(text: str) -> str:
    """The text without its marks."""
    return "".join(line for line in _lines(text) if not _MARK.match(line))


def marked(text: str, diagnostics: Iterable[Diagnostic]) -> str:
    """The text with its complaints marked in it."""
    lines: list[str] = []
    complaints = list(diagnostics)
    for number, line in enumerate(text.split("\n"), 1):
        lines.append(line)
        for diagnostic in complaints:
            if diagnostic.span.line == number:
                lines += _marks(line, diagnostic)
    return "\n".join(lines)


def _marks(line: str, diagnostic: Diagnostic) -> list[str]:
    start = diagnostic.span.column - 1
    length = max(1, min(len(diagnostic.span.text.partition("\n")[0]), len(line) - start))
    row = "//" + " " * (start - 2) + "^" * length if start >= 2 else f"//{'^' * length}@{start + 1}"
    severity = "" if diagnostic.severity is Severity.ERROR else f"{diagnostic.severity.value}: "
    marks = [f"{row} {diagnostic.code.id} {severity}{diagnostic.message}"]
    marks += [f"//   note: {note.message}" + _place(note.span) for note in diagnostic.notes]
    if diagnostic.help is not None:
        marks.append(f"//   help: {diagnostic.help}")
    for fix in diagnostic.fixes:
        edits = ", ".join(f"{edit.text!r} at{_place(edit.span)}" for edit in fix.edits)
        marks.append(f"//   fix{'' if fix.safe else '?'}: {fix.title}: {edits}")
    return marks


def _place(span: object) -> str:
    start = getattr(span, "line", None)
    return "" if start is None else f" {start}:{getattr(span, 'column', 0)}"


def _lines(text: str) -> list[str]:
    """The lines of `text` with their ends; other line ends than LF end no line."""
    return [line + "\n" for line in text.split("\n")[:-1]] + [text.split("\n")[-1]]
