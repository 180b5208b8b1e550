"""What editors ask about texts: diagnostics, fixes, formatting, colours, hints, folds, links and lenses."""

from collections.abc import Callable, Sequence

from lsprotocol import types

from lsp.document_links import document_links
from lsp.folding import folding_ranges, selection_ranges
from lsp.inlay_hints import inlay_hints
from lsp.lenses import code_lenses, counting
from lsp.mending import (
    can_fix_all,
    fix_all,
    fix_all_of_mission,
    formatting,
    formatting_of_lines,
    formatting_of_statement,
    mends,
    mends_of_mission,
)
from lsp.mission_answers import mission_lenses
from lsp.mission_shape import mission_folds, mission_links
from lsp.mission_texts import OpenMission
from lsp.open_text import DocumentContext
from lsp.refactorings import refactorings
from lsp.semantic_tokens import LEGEND, tokens_between
from lsp.session import Session

_FIX_ALL = "source.fixAll.nddlc"
_Kind = types.CodeActionKind


def answer_text(session: Session) -> None:
    """Let a session answer them."""
    _answer_diagnostics(session)
    _answer_actions(session)
    _answer_formatting(session)
    _answer_tokens(session)
    _answer_shape(session)


def _answer_diagnostics(session: Session) -> None:
    options = types.DiagnosticOptions(inter_file_dependencies=True, workspace_diagnostics=True, identifier="nddlc")

    @session.feature(types.TEXT_DOCUMENT_DIAGNOSTIC, options)
    async def diagnostic(params: types.DocumentDiagnosticParams) -> types.DocumentDiagnosticReport:
        await session.turn()
        return session.pulled.report(params.text_document.uri, params.previous_result_id)

    @session.feature(types.WORKSPACE_DIAGNOSTIC)
    async def workspace_diagnostic(params: types.WorkspaceDiagnosticParams) -> types.WorkspaceDiagnosticReport:
        await session.turn()
        known = {each.uri: each.value for each in params.previous_result_ids}
        return session.pulled.workspace_report(known)


def _answer_actions(session: Session) -> None:
    kinds = [_Kind.QuickFix, _Kind.Refactor, _Kind.RefactorExtract, _FIX_ALL]

    def actions(view: DocumentContext, params: types.CodeActionParams) -> list[types.CodeAction]:
        documents = session.documents
        only = params.context.only
        found = [
            *mends(view, params.range, documents.conversion(), documents.folders),
            *refactorings(documents, view, params.range),
        ]
        if can_fix_all(view.snapshot.diagnostics, view.parse.source.name):
            found += fixing_all(view.document.uri, only, lambda: fix_all(documents, view))
        return wanted(found, only)

    def of_mission(mission: OpenMission, params: types.CodeActionParams) -> list[types.CodeAction]:
        told, only = session.missions.told(mission), params.context.only
        found = mends_of_mission(told, mission, params.range, session.documents.conversion())
        if can_fix_all(told, str(mission.path)):
            found += fixing_all(mission.uri, only, lambda: fix_all_of_mission(session.missions, mission))
        return wanted(found, only)

    def fixing_all(
        uri: str, only: Sequence[types.CodeActionKind | str] | None, edit: Callable[[], types.WorkspaceEdit | None]
    ) -> list[types.CodeAction]:
        action = types.CodeAction("mend all that can be mended safely", _FIX_ALL, data={"uri": uri})
        if not session.resolves_actions:
            if only is None or not _is_wanted(_FIX_ALL, only):
                return []
            action.edit = edit()
        return [action]

    def wanted(
        found: list[types.CodeAction], only: Sequence[types.CodeActionKind | str] | None
    ) -> list[types.CodeAction]:
        return [each for each in found if only is None or _is_wanted(_name(each.kind), only)]

    options = types.CodeActionOptions(kinds, resolve_provider=True)
    session.answer(types.TEXT_DOCUMENT_CODE_ACTION, actions, options, nothing=list, of_mission=of_mission)

    @session.feature(types.CODE_ACTION_RESOLVE)
    async def resolve(action: types.CodeAction) -> types.CodeAction:
        uri = action.data.get("uri") if isinstance(action.data, dict) else None
        view, mission = await session.view(str(uri)), session.missions.find(str(uri))
        if view is not None:
            action.edit = fix_all(session.documents, view)
        elif mission is not None:
            action.edit = fix_all_of_mission(session.missions, mission)
        return action


def _is_wanted(kind: str, only: Sequence[types.CodeActionKind | str]) -> bool:
    return any(not name or kind == name or kind.startswith(f"{name}.") for name in map(_name, only))


def _name(kind: types.CodeActionKind | str | None) -> str:
    return str(kind.value if isinstance(kind, _Kind) else kind)


def _answer_formatting(session: Session) -> None:
    def of_range(view: DocumentContext, params: types.DocumentRangeFormattingParams) -> list[types.TextEdit]:
        start, end = params.range.start, params.range.end
        last = end.line - 1 if end.character == 0 and end.line > start.line else end.line
        return formatting_of_lines(view.parse, view.document.lines, start.line, last)

    def on_type(view: DocumentContext, params: types.DocumentOnTypeFormattingParams) -> list[types.TextEdit]:
        lines = view.document.lines
        return formatting_of_statement(view.parse, lines, lines.offset(params.position))

    session.answer(
        types.TEXT_DOCUMENT_FORMATTING,
        lambda view, params: formatting(view.parse, view.document.lines),
        nothing=list,
    )
    session.answer(types.TEXT_DOCUMENT_RANGE_FORMATTING, of_range, nothing=list)
    options = types.DocumentOnTypeFormattingOptions("}", [";"])
    session.answer(types.TEXT_DOCUMENT_ON_TYPE_FORMATTING, on_type, options, nothing=list)


def _answer_tokens(session: Session) -> None:
    memory = session.token_memory

    def full(view: DocumentContext, params: types.SemanticTokensParams) -> types.SemanticTokens:
        return memory.full(view)

    def delta(
        view: DocumentContext, params: types.SemanticTokensDeltaParams
    ) -> types.SemanticTokens | types.SemanticTokensDelta:
        return memory.delta(view, params.previous_result_id)

    def part(view: DocumentContext, params: types.SemanticTokensRangeParams) -> types.SemanticTokens:
        lines = view.document.lines
        return types.SemanticTokens(
            tokens_between(view, lines.offset(params.range.start), lines.offset(params.range.end))
        )

    session.answer(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, full, LEGEND)
    session.answer(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL_DELTA, delta, LEGEND)
    session.answer(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE, part, LEGEND)


def _answer_shape(session: Session) -> None:
    session.answer(
        types.TEXT_DOCUMENT_FOLDING_RANGE,
        lambda view, params: folding_ranges(view.parse, view.document.lines),
        nothing=list,
        of_mission=lambda mission, params: mission_folds(mission),
    )
    session.answer(
        types.TEXT_DOCUMENT_SELECTION_RANGE,
        lambda view, params: selection_ranges(view.parse, view.document.lines, params.positions),
        nothing=list,
    )
    session.answer(
        types.TEXT_DOCUMENT_DOCUMENT_LINK,
        lambda view, params: document_links(view, session.documents.conversion()),
        nothing=list,
        of_mission=lambda mission, params: mission_links(mission),
    )
    session.answer(
        types.TEXT_DOCUMENT_INLAY_HINT,
        lambda view, params: inlay_hints(view, params.range, session.hints),
        nothing=list,
    )
    session.answer(
        types.TEXT_DOCUMENT_CODE_LENS,
        lambda view, params: code_lenses(view),
        types.CodeLensOptions(resolve_provider=True),
        nothing=list,
        of_mission=lambda mission, params: [] if session.is_distrusted else mission_lenses(mission),
    )

    @session.feature(types.CODE_LENS_RESOLVE)
    async def resolve(lens: types.CodeLens) -> types.CodeLens:
        match lens.data:
            case {"uri": str(uri), "command": str(command)}:
                view = await session.view(uri)
                if view is not None:
                    lens.command = counting(session.documents, session.missions, view, lens.range.start, command)
            case _:
                pass
        return lens
