"""Read a text that marks its own complaints, and mark the complaints in a text.

Under a line with complaints stand comments: a row of `^` below the place with the code and the message, then what
helps and where to look. `//^^^` right after the slashes marks from the first character of the line.
"""

import re

from nddl_lang.text.diagnostic import Diagnostic, Severity

_MARK = re.compile(r"\s*//( *\^+ \w+\d+| (help|note( \d+)?|fix\??):)")


def unmarked(text: str) -> str:
    """The text without its marks."""
    return "".join(line for line in text.splitlines(keepends=True) if not _MARK.match(line))


def marked(text: str, diagnostics: tuple[Diagnostic, ...]) -> str:
    """The text with its complaints marked in it; of a syntax code only the code, as its words are tested elsewhere."""
    lines: list[str] = []
    for number, line in enumerate(text.splitlines(), 1):
        lines.append(line)
        here = [diagnostic for diagnostic in diagnostics if diagnostic.span.line == number]
        for diagnostic in sorted(here, key=lambda diagnostic: diagnostic.span.column):
            lines += _marks(line, diagnostic)
    return "\n".join(lines) + "\n"


def _marks(line: str, diagnostic: Diagnostic) -> list[str]:
    start = diagnostic.span.column - 1
    length = max(1, min(len(diagnostic.span.text.partition("\n")[0]), len(line) - start))
    if start >= 3 or (start == 2 and line[:2].strip()):
        row = "//" + " " * (start - 2) + "^" * length
    else:
        row = "//" + "^" * max(1, start + length - 2)
    if diagnostic.code.id < "NDDL2":
        return [f"{row} {diagnostic.code.id}"]
    kind = "" if diagnostic.severity is Severity.ERROR else f"{diagnostic.severity.value}: "
    marks = [f"{row} {diagnostic.code.id} {kind}{diagnostic.message}"]
    if diagnostic.help is not None:
        marks.append(f"// help: {diagnostic.help}")
    for note in diagnostic.notes:
        place = f" {note.span.line}" if note.span is not None else ""
        marks.append(f"// note{place}: {note.message}")
    marks += [f"// fix{'' if fix.safe else '?'}: {fix.title}" for fix in diagnostic.fixes]
    return marks
