"""What is wrong in a place in; the edits that mend it out."""

from collections.abc import Iterable, Iterator
from difflib import SequenceMatcher
from itertools import pairwise
from pathlib import Path

from lsprotocol.types import CodeAction, CodeActionKind, Position, Range, TextEdit, WorkspaceEdit

from lsp.diagnostics import Conversion
from lsp.documents import Documents
from lsp.meaning import piece_at
from lsp.mission_texts import MissionTexts, OpenMission
from lsp.open_text import DocumentContext
from lsp.positions import Lines
from lsp.refactorings import additions
from nddl_lang.formatter.format import format_parse
from nddl_lang.lint.mending import mend
from nddl_lang.syntax.incremental import common_ends
from nddl_lang.syntax.parser import Parse
from nddl_lang.text.diagnostic import Diagnostic, Fix


def mends_of_mission(
    found: Iterable[Diagnostic], mission: OpenMission, place: Range, conversion: Conversion
) -> list[CodeAction]:
    """The fixes of complaints about a mission file that touch `place`, as actions."""
    begin, finish = mission.lines.offset(place.start), mission.lines.offset(place.end)
    return [
        _action(diagnostic, fix, conversion)
        for diagnostic in found
        if diagnostic.span.begin <= finish and begin <= diagnostic.span.finish
        for fix in diagnostic.fixes
    ]


def mends(
    view: DocumentContext, place: Range, conversion: Conversion, folders: Iterable[Path] = ()
) -> list[CodeAction]:
    """The fixes of all complaints that touch `place`, as actions; those that keep the meaning are preferred."""
    lines = view.document.lines
    begin, finish = lines.offset(place.start), lines.offset(place.end)
    actions = []
    for diagnostic in view.snapshot.diagnostics:
        if _touches(view, diagnostic, begin, finish):
            actions += [_action(diagnostic, fix, conversion) for fix in diagnostic.fixes]
            shown = [conversion.shown(diagnostic)]
            actions += [
                CodeAction(title, CodeActionKind.QuickFix, shown, edit=edit)
                for title, edit in additions(view, diagnostic, folders, conversion)
            ]
    return actions


def fix_all(documents: Documents, view: DocumentContext) -> WorkspaceEdit | None:
    """The edit that carries out all fixes of a text that keep the meaning; None where there is nothing to mend."""
    text = view.parse.source.text
    after = mend(text, lambda changed: documents.probe(view.document.key, changed).diagnostics).text
    return _written(view.document.uri, view.document.lines, after)


def fix_all_of_mission(missions: MissionTexts, mission: OpenMission) -> WorkspaceEdit | None:
    """The same for a mission file or a solver's configuration."""
    after = mend(mission.text, lambda changed: missions.probe(mission, changed)).text
    return _written(mission.uri, mission.lines, after)


def _written(uri: str, lines: Lines, after: str) -> WorkspaceEdit | None:
    edits = list(_difference(lines, after))
    return WorkspaceEdit({uri: edits}) if edits else None


def can_fix_all(found: Iterable[Diagnostic], name: str) -> bool:
    """Whether something in the text of that name can be mended without a change of meaning."""
    return any(
        fix.safe and all(edit.span.source.name == name for edit in fix.edits)
        for diagnostic in found
        for fix in diagnostic.fixes
    )


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


def formatting_of_lines(parse: Parse, lines: Lines, first: int, last: int) -> list[TextEdit]:
    """What brings the lines from `first` to `last`, from 0, into the style."""
    wanted = format_parse(parse).text
    if wanted == lines.text:
        return []
    old, new = _cut(lines), _cut(Lines(wanted, lines.encoding))
    edits = []
    for begin, finish, start, end in _hunks(old, new):
        if begin <= last and (finish > first or begin == finish >= first):
            edits.append(TextEdit(Range(Position(begin, 0), _line_start(lines, finish)), "".join(new[start:end])))
    return edits


def _hunks(old: list[str], new: list[str]) -> Iterator[tuple[int, int, int, int]]:
    """What lines of the old text become what lines of the new one; a line whose words stay becomes one line."""
    before, after = (["".join(line.split()) for line in lines] for lines in (old, new))
    for tag, begin, finish, start, end in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        if tag != "equal":
            yield begin, finish, start, end
            continue
        for shift in range(finish - begin):
            if old[begin + shift] != new[start + shift]:
                yield begin + shift, begin + shift + 1, start + shift, start + shift + 1


def formatting_of_statement(parse: Parse, lines: Lines, offset: int) -> list[TextEdit]:
    """What brings the top-level statement that ends at `offset` or holds it into the style."""
    piece = piece_at(parse, max(0, offset - 1))
    if piece is None or not piece.starts or piece.diagnostics:
        return []
    begin, finish = piece.anchor.offset + piece.starts[0], piece.anchor.offset + piece.ends[-1]
    return formatting_of_lines(parse, lines, lines.position(begin).line, lines.position(finish).line)


def _cut(lines: Lines) -> list[str]:
    starts = [*lines.starts, len(lines.text)]
    cut = [lines.text[begin:end] for begin, end in pairwise(starts)]
    return cut if cut[-1] else cut[:-1]


def _line_start(lines: Lines, line: int) -> Position:
    return Position(line, 0) if line < len(lines.starts) else lines.position(len(lines.text))
