"""Our diagnostics in, the editor's out, file by file."""

from collections.abc import Callable, Mapping

from lsprotocol.types import (
    CodeDescription,
    DiagnosticRelatedInformation,
    DiagnosticSeverity,
    DiagnosticTag,
    Location,
    Range,
)
from lsprotocol.types import Diagnostic as Shown

from lsp.links import page_of
from lsp.positions import Encoding, Lines
from nddl_lang.lint.unused import UNUSED
from nddl_lang.semantics.codes import FORMER_CONSTRAINT, NATIVE_CLASS
from nddl_lang.syntax.codes import FORMER_RELATION, FORMER_SIGNATURE, FORMER_WORD, INCLUDE_AGAIN
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.source import Source, Span

_SEVERITIES = {
    Severity.ERROR: DiagnosticSeverity.Error,
    Severity.WARNING: DiagnosticSeverity.Warning,
    Severity.INFO: DiagnosticSeverity.Information,
    Severity.HINT: DiagnosticSeverity.Hint,
}
_TAGS = {
    **{code.id: [DiagnosticTag.Unnecessary] for code in (NATIVE_CLASS, INCLUDE_AGAIN, *UNUSED)},
    **{
        code.id: [DiagnosticTag.Deprecated]
        for code in (FORMER_WORD, FORMER_RELATION, FORMER_SIGNATURE, FORMER_CONSTRAINT)
    },
}
_SOURCE = "nddlc"


class Conversion:
    """Turns places in our sources into places in the editor's files; `open_lines` are those that exist already."""

    def __init__(self, encoding: Encoding, uri: Callable[[Source], str], open_lines: Mapping[str, Lines]) -> None:
        self._encoding = encoding
        self._uri = uri
        self._open_lines = open_lines
        self._known: dict[Source, tuple[str, Lines]] = {}

    def place(self, source: Source) -> tuple[str, Lines]:
        """The file that `source` is, and its lines."""
        known = self._known.get(source)
        if known is None:
            uri = self._uri(source)
            lines = self._open_lines.get(uri)
            if lines is None or lines.text != source.text:
                lines = Lines(source.text, self._encoding)
            known = self._known[source] = uri, lines
        return known

    def range(self, span: Span) -> Range:
        """Where `span` stands in its file."""
        return self.place(span.source)[1].range(span.begin, span.finish)

    def location(self, span: Span) -> Location:
        """The file and place of `span`."""
        return Location(self.place(span.source)[0], self.range(span))

    def shown(self, diagnostic: Diagnostic) -> Shown:
        """What the editor shows of one diagnostic: notes with a place become links, all else is text."""
        code = diagnostic.code.id
        lines = [diagnostic.message]
        lines += [f"note: {note.message}" for note in diagnostic.notes if note.span is None]
        if diagnostic.help is not None:
            lines.append(f"help: {diagnostic.help}")
        related = [
            DiagnosticRelatedInformation(self.location(note.span), note.message)
            for note in diagnostic.notes
            if note.span is not None
        ]
        page = page_of(code)
        fixes = [{"title": fix.title, "isSafe": fix.safe} for fix in diagnostic.fixes]
        return Shown(
            self.range(diagnostic.span),
            "\n".join(lines),
            _SEVERITIES[diagnostic.severity],
            code,
            CodeDescription(page) if page is not None else None,
            _SOURCE,
            _TAGS.get(code),
            related or None,
            {"fixes": fixes} if fixes else None,
        )
