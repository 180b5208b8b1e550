"""Show diagnostics to people, with the text they are about, and to programs as plain data."""

from collections.abc import Iterator
from typing import Any

from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note, Severity
from nddl_lang.text.excerpt import around, excerpt
from nddl_lang.text.printable import printable
from nddl_lang.text.source import Source, Span

_NEAR = 500  # characters of a long line beside a mend
_RESET = "\x1b[0m"
_BOLD = "\x1b[1m"
_GUTTER = "\x1b[1;34m"
_GREEN = "\x1b[32m"
_RED = "\x1b[31m"
_COLOURS = {
    Severity.ERROR: "\x1b[1;31m",
    Severity.WARNING: "\x1b[1;33m",
    Severity.INFO: "\x1b[1;34m",
    Severity.HINT: "\x1b[1;36m",
}


def render(diagnostic: Diagnostic, *, colour: bool = False) -> str:
    """`diagnostic` with the text it is about, its notes, and what to do, in lines that end with a line end."""
    return "\n".join(_Page(diagnostic, colour).lines()) + "\n"


class _Page:
    """The lines of one diagnostic; all its excerpts share one gutter."""

    def __init__(self, diagnostic: Diagnostic, colour: bool) -> None:
        self._diagnostic = diagnostic
        self._colour = colour
        spans = [diagnostic.span, *(note.span for note in diagnostic.notes if note.span is not None)]
        spans += [edit.span for fix in diagnostic.fixes for edit in fix.edits]
        last = max(span.source.locate(span.finish)[0] for span in spans)
        self._gutter = len(str(last))

    def lines(self) -> Iterator[str]:
        diagnostic = self._diagnostic
        severity = diagnostic.severity
        head = self._paint(f"{severity.value}[{diagnostic.code.id}]", _COLOURS[severity])
        yield head + self._paint(f": {diagnostic.message}", _BOLD)
        yield from self._place(diagnostic.span, _COLOURS[severity], "^")
        remarks = [f"note: {printable(note.message)}" for note in diagnostic.notes if note.span is None]
        if diagnostic.help is not None:
            remarks.append(f"help: {diagnostic.help}")
        if remarks:
            yield self._bar()
        for remark in remarks:
            yield f"{self._sign('=')} {remark}"
        for note in diagnostic.notes:
            if note.span is not None:
                yield self._paint(f"note: {printable(note.message)}", _BOLD)
                yield from self._place(note.span, _GUTTER, "-")
        for fix in diagnostic.fixes:
            yield from self._fix(fix)

    def _place(self, span: Span, colour: str, mark: str) -> Iterator[str]:
        source = span.source
        line, column = source.locate(span.begin)
        arrow = self._paint(" " * self._gutter + "-->", _GUTTER)
        yield f"{arrow} {printable(source.name)}:{line}:{column}"
        yield self._bar()
        for number, text, carets in excerpt(span, mark):
            if number is None:
                yield self._paint(text, _GUTTER)
                continue
            yield f"{self._paint(f'{number:>{self._gutter}} |', _GUTTER)} {text}".rstrip()
            if carets:
                yield f"{self._bar()} {self._paint(carets, colour)}"

    def _fix(self, fix: Fix) -> Iterator[str]:
        """What the lines look like before and after the mend."""
        safety = "" if fix.safe else " (check the meaning)"
        yield self._paint(f"help: {printable(fix.title)}{safety}", _BOLD)
        for source, edits in _by_source(fix.edits):
            begin = min(edit.span.begin for edit in edits)
            finish = max(edit.span.finish for edit in edits)
            first, last = source.locate(begin)[0], source.locate(finish)[0]
            # Of a line that is very long only what is near is looked at: there may be as many mends as it has words.
            start = max(source.line_starts[first - 1], begin - _NEAR)
            end = max(min(source.line_end(last), finish + _NEAR), finish)
            after = apply_edits(source.text[start:end], edits, start)
            yield self._bar()
            edited = begin - start  # in the first line
            before = source.text[start:end].split("\n")
            for offset, line in enumerate(before[: last + 1 - first]):
                yield self._changed(first + offset, "-", line.removesuffix("\r"), _RED, 0 if offset else edited)
            for offset, line in enumerate(after.split("\n") if after else []):
                yield self._changed(first + offset, "+", line.removesuffix("\r"), _GREEN, 0 if offset else edited)

    def _changed(self, number: int, sign: str, line: str, colour: str, at: int) -> str:
        mark = self._paint(f"{number:>{self._gutter}}", _GUTTER)
        return f"{mark} {self._paint(f'{sign} {around(line, at)}'.rstrip(), colour)}"

    def _bar(self) -> str:
        return self._sign("|")

    def _sign(self, sign: str) -> str:
        return self._paint(f"{' ' * self._gutter} {sign}", _GUTTER)

    def _paint(self, text: str, colour: str) -> str:
        return f"{colour}{text}{_RESET}" if self._colour else text


def _by_source(edits: tuple[Edit, ...]) -> list[tuple[Source, list[Edit]]]:
    found: dict[Source, list[Edit]] = {}
    for edit in edits:
        found.setdefault(edit.span.source, []).append(edit)
    return list(found.items())


def apply_edits(text: str, edits: list[Edit], offset: int = 0) -> str:
    """`text`, which begins at `offset` of its source, after `edits`; of two that overlap the later is left out."""
    parts: list[str] = []
    at = 0
    for edit in sorted(edits, key=lambda edit: (edit.span.begin, edit.span.finish)):
        begin, finish = edit.span.begin - offset, edit.span.finish - offset
        if begin < at:
            continue
        parts += (text[at:begin], edit.text)
        at = finish
    return "".join(parts) + text[at:]


# ---- for programs ----


def as_dict(diagnostic: Diagnostic) -> dict[str, Any]:
    """`diagnostic` as plain data; lines and columns count characters from 1, the end is not included."""
    return {
        "code": diagnostic.code.id,
        "severity": diagnostic.severity.value,
        "kind": diagnostic.code.kind,
        "message": diagnostic.message,
        **_place_of(diagnostic.span),
        "help": diagnostic.help,
        "notes": [_note(note) for note in diagnostic.notes],
        "fixes": [_fix(fix) for fix in diagnostic.fixes],
    }


def _place_of(span: Span) -> dict[str, Any]:
    source = span.source
    line, column = source.locate(span.begin)
    end_line, end_column = source.locate(span.finish)
    return {
        "file": source.name,
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
    }


def _note(note: Note) -> dict[str, Any]:
    return {"message": note.message} | ({} if note.span is None else _place_of(note.span))


def _fix(fix: Fix) -> dict[str, Any]:
    edits = [{**_place_of(edit.span), "text": edit.text} for edit in fix.edits]
    return {"title": fix.title, "safe": fix.safe, "edits": edits}
