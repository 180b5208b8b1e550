"""What is wrong in a place in; the edits that mend it out."""

from collections.abc import Iterator

from lsprotocol.types import CodeAction, CodeActionKind, Range, TextEdit, WorkspaceEdit

from lsp.diagnostics import Conversion
from lsp.documents import DocumentContext
from lsp.positions import Lines
from nddl_lang.formatter.format import format_parse
from nddl_lang.syntax.incremental import common_ends
from nddl_lang.syntax.parser import Parse
from nddl_lang.text.diagnostic import Diagnostic, Fix


def mends(view: DocumentContext, place: Range, conversion: Conversion) -> list[CodeAction]:
    """The fixes of all complaints that touch `place`, as actions; those that keep the meaning are preferred."""
    lines = view.document.lines
    begin, finish = lines.offset(place.start), lines.offset(place.end)
    return [
        _action(diagnostic, fix, conversion)
        for diagnostic in view.snapshot.diagnostics
        if diagnostic.fixes and _touches(view, diagnostic, begin, finish)
        for fix in diagnostic.fixes
    ]


def _touches(view: DocumentContext, diagnostic: Diagnostic, begin: int, finish: int) -> bool:
    span = diagnostic.span
    return span.source is view.parse.source and span.begin <= finish and begin <= span.finish


def _action(diagnostic: Diagnostic, fix: Fix, conversion: Conversion) -> CodeAction:
    changes: dict[str, list[TextEdit]] = {}
    for edit in fix.edits:
        location = conversion.location(edit.span)
        changes.setdefault(location.uri, []).append(TextEdit(location.range, edit.text))
    title = fix.title if fix.safe else f"{fix.title} (check the meaning)"
    return CodeAction(
        title,
        CodeActionKind.QuickFix,
        [conversion.shown(diagnostic)],
        fix.safe or None,
        edit=WorkspaceEdit(changes),
    )


def formatting(parse: Parse, lines: Lines) -> list[TextEdit]:
    """What brings the text into the style; nothing where it has it already."""
    return list(_difference(lines, format_parse(parse).text))


def _difference(lines: Lines, wanted: str) -> Iterator[TextEdit]:
    if wanted == lines.text:
        return
    prefix, suffix = common_ends(lines.text, wanted)
    # Between CR and LF no editor can place a cursor.
    while prefix and lines.text[prefix - 1] == "\r":
        prefix -= 1
    while suffix and lines.text[len(lines.text) - suffix] == "\n":
        suffix -= 1
    place = lines.range(prefix, len(lines.text) - suffix)
    yield TextEdit(place, wanted[prefix : len(wanted) - suffix])
