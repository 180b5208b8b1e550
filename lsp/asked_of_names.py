"""What editors ask about names: hover, navigation, references, rename, hierarchies, symbols and completion."""

from collections.abc import Callable, Iterable
from typing import Any

from lsprotocol import types

from lsp.completion import completions, resolved
from lsp.diagnostics import Conversion
from lsp.document_links import included_files
from lsp.documents import Documents
from lsp.hierarchies import incoming_calls, outgoing_calls, prepare_calls, prepare_types, subtypes, supertypes
from lsp.hover import hover_at, link
from lsp.mission_answers import mission_completions, mission_definition, mission_hover
from lsp.mission_shape import mission_outline
from lsp.mission_texts import OpenMission, place_at
from lsp.mission_uses import MissionUse, symbol_named, throughout
from lsp.navigation import declaration, definition, implementations, type_definition
from lsp.occurrences import Role, Symbol
from lsp.open_text import DocumentContext
from lsp.project import Snapshot
from lsp.references import highlights, occurrence_at
from lsp.rename import RenameError, TextChange, assert_renamable, prepare_rename, rename
from lsp.session import RequestFailed, Session
from lsp.signatures import signature_help
from lsp.symbols import Outlines, workspace_symbols
from nddl_lang.text.source import Span

_NAMELESS = "there is no name that a model declares"
_Asked = types.TextDocumentPositionParams | types.ReferenceParams | types.CompletionParams


def answer_names(session: Session) -> None:
    """Let a session answer them."""
    _answer_navigation(session)
    _answer_rename(session)
    _answer_hierarchies(session)
    _answer_completion(session)


def _offset(view: DocumentContext, params: _Asked) -> int:
    return view.document.lines.offset(params.position)


def _answer_navigation(session: Session) -> None:
    def location(span: Span | None) -> types.Location | None:
        return session.documents.conversion().location(span) if span is not None else None

    def locations(spans: Iterable[Span]) -> list[types.Location]:
        conversion = session.documents.conversion()
        return [conversion.location(span) for span in spans]

    def hover(view: DocumentContext, params: types.HoverParams) -> types.Hover | None:
        shown = hover_at(view, params.position, session.documents.conversion())
        failed = session.results.at(view.document.key, params.position.line)
        if not failed:
            return session.formats.hover(shown)
        before = str(getattr(shown.contents, "value", "")) if shown is not None else ""
        text = "\n\n".join(part for part in (before, *failed) if part)
        place = shown.range if shown is not None else None
        return session.formats.hover(types.Hover(types.MarkupContent(types.MarkupKind.Markdown, text), place))

    def of_mission(
        answer: Callable[[Documents, OpenMission, int, Conversion], Any],
    ) -> Callable[[OpenMission, Any], Any]:
        def answered(mission: OpenMission, params: Any) -> Any:
            offset = mission.lines.offset(params.position)
            return answer(session.documents, mission, offset, session.documents.conversion())

        return answered

    def all_references(snapshot: Snapshot, symbol: Symbol, params: types.ReferenceParams) -> list[types.Location]:
        conversion = session.documents.conversion()
        found, uses = throughout(session.documents, session.missions, snapshot, symbol)
        return [
            *(
                conversion.location(each.span)
                for each in found.found.values()
                if params.context.include_declaration or each.role is not Role.DECLARES
            ),
            *(use.location for use in uses),
        ]

    def references(view: DocumentContext, params: types.ReferenceParams) -> list[types.Location]:
        here = occurrence_at(view, _offset(view, params))
        return all_references(view.snapshot, here.symbol, params) if here is not None else []

    def references_of_mission(mission: OpenMission, params: types.ReferenceParams) -> list[types.Location]:
        here = symbol_named(session.documents, mission, mission.lines.offset(params.position))
        return all_references(*here, params) if here is not None else []

    session.answer(
        types.TEXT_DOCUMENT_HOVER,
        hover,
        of_mission=lambda mission, params: session.formats.hover(of_mission(mission_hover)(mission, params)),
    )
    session.answer(
        types.TEXT_DOCUMENT_DEFINITION,
        lambda view, params: location(definition(view, _offset(view, params))),
        of_mission=of_mission(mission_definition),
    )
    session.answer(
        types.TEXT_DOCUMENT_DECLARATION, lambda view, params: location(declaration(view, _offset(view, params)))
    )
    session.answer(
        types.TEXT_DOCUMENT_TYPE_DEFINITION,
        lambda view, params: location(type_definition(view, _offset(view, params))),
    )
    session.answer(
        types.TEXT_DOCUMENT_IMPLEMENTATION,
        lambda view, params: locations(implementations(session.documents, view, _offset(view, params))),
        nothing=list,
    )
    session.answer(types.TEXT_DOCUMENT_REFERENCES, references, nothing=list, of_mission=references_of_mission)
    session.answer(
        types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT,
        lambda view, params: highlights(view, _offset(view, params)),
        nothing=list,
    )
    outlines = Outlines()
    session.answer(
        types.TEXT_DOCUMENT_DOCUMENT_SYMBOL,
        lambda view, params: outlines.outline(view.parse, view.document.lines),
        nothing=list,
        of_mission=lambda mission, params: mission_outline(mission),
    )

    @session.feature(types.WORKSPACE_SYMBOL)
    async def workspace_symbol(params: types.WorkspaceSymbolParams) -> list[types.SymbolInformation]:
        await session.turn()
        return workspace_symbols(session.documents, params.query)


def _answer_rename(session: Session) -> None:
    def prepare(view: DocumentContext, params: _Asked) -> types.PrepareRenamePlaceholder | None:
        try:
            return prepare_rename(session.documents, view, _offset(view, params))
        except RenameError as refusal:
            raise RequestFailed(str(refusal)) from None

    def prepare_in_mission(mission: OpenMission, params: _Asked) -> types.PrepareRenamePlaceholder | None:
        offset = mission.lines.offset(params.position)
        here = symbol_named(session.documents, mission, offset)
        if here is None:
            return None
        place = place_at(mission.text, offset)
        try:
            assert_renamable(session.documents, *here)
        except RenameError as refusal:
            raise RequestFailed(str(refusal)) from None
        return types.PrepareRenamePlaceholder(mission.lines.range(place.begin, place.finish), place.word)

    def carry_out(snapshot: Snapshot, symbol: Symbol, name: str) -> types.WorkspaceEdit:
        found, uses = throughout(session.documents, session.missions, snapshot, symbol)
        try:
            changes = rename(session.documents, snapshot, symbol, found, name)
        except RenameError as refusal:
            raise RequestFailed(str(refusal)) from None
        return _workspace_edit(session, changes, uses if changes else [], name)

    def of_model(view: DocumentContext, params: types.RenameParams) -> types.WorkspaceEdit:
        here = occurrence_at(view, view.document.lines.offset(params.position))
        if here is None:
            raise RequestFailed(_NAMELESS)
        return carry_out(view.snapshot, here.symbol, params.new_name)

    def of_mission(mission: OpenMission, params: types.RenameParams) -> types.WorkspaceEdit:
        here = symbol_named(session.documents, mission, mission.lines.offset(params.position))
        if here is None:
            raise RequestFailed(_NAMELESS)
        return carry_out(*here, params.new_name)

    session.answer(types.TEXT_DOCUMENT_PREPARE_RENAME, prepare, of_mission=prepare_in_mission)
    options = types.RenameOptions(prepare_provider=True)
    session.answer(types.TEXT_DOCUMENT_RENAME, of_model, options, of_mission=of_mission)


def _workspace_edit(
    session: Session, changes: list[TextChange], uses: list[MissionUse], name: str
) -> types.WorkspaceEdit:
    edits: dict[str, list[types.TextEdit]] = {}
    for change in changes:
        key, begin, finish = change.place
        uri, lines = session.documents.lines_of(key)
        edits.setdefault(uri, []).append(types.TextEdit(lines.range(begin, finish), change.text))
    for use in uses:
        edits.setdefault(use.uri, []).append(types.TextEdit(use.location.range, name))
    return types.WorkspaceEdit(edits)


def _answer_hierarchies(session: Session) -> None:
    session.answer(
        types.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY,
        lambda view, params: prepare_calls(view, _offset(view, params), session.documents.conversion()),
    )
    session.answer(
        types.TEXT_DOCUMENT_PREPARE_TYPE_HIERARCHY,
        lambda view, params: prepare_types(view, _offset(view, params), session.documents.conversion()),
    )
    session.answer_item(
        types.CALL_HIERARCHY_INCOMING_CALLS,
        lambda view, at, conversion: incoming_calls(session.documents, view, at, conversion),
    )
    session.answer_item(
        types.CALL_HIERARCHY_OUTGOING_CALLS,
        lambda view, at, conversion: outgoing_calls(session.documents, view, at, conversion),
    )
    session.answer_item(types.TYPE_HIERARCHY_SUPERTYPES, supertypes)
    session.answer_item(
        types.TYPE_HIERARCHY_SUBTYPES,
        lambda view, at, conversion: subtypes(session.documents, view, at, conversion),
    )


def _answer_completion(session: Session) -> None:
    last: list[DocumentContext] = []  # what was completed last, for the details that are asked for next

    def complete(view: DocumentContext, params: types.CompletionParams) -> types.CompletionList:
        last[:] = [view]
        offset = _offset(view, params)
        files = included_files(view, offset, session.documents.folders)
        if files is not None:
            return types.CompletionList(is_incomplete=False, items=files)
        found = completions(view.snapshot.analysis, view.parse, offset, with_snippets=session.has_snippets)
        return types.CompletionList(is_incomplete=False, items=found)

    options = types.CompletionOptions(trigger_characters=[".", ":", '"'], resolve_provider=True)
    session.answer(
        types.TEXT_DOCUMENT_COMPLETION,
        complete,
        options,
        nothing=list,
        of_mission=lambda mission, params: mission_completions(
            session.documents, mission, mission.lines.offset(params.position)
        ),
    )

    @session.feature(types.COMPLETION_ITEM_RESOLVE)
    async def resolve(item: types.CompletionItem) -> types.CompletionItem:
        await session.turn()
        conversion = session.documents.conversion()
        if not last:
            return item
        return session.formats.item(resolved(last[0].snapshot.analysis, item, lambda span: link(conversion, span)))

    session.answer(
        types.TEXT_DOCUMENT_SIGNATURE_HELP,
        lambda view, params: session.formats.signatures(signature_help(view, _offset(view, params))),
        types.SignatureHelpOptions(["(", ","], [")"]),
    )
