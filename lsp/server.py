"""Speak the language server protocol over standard input and output: requests in, answers and complaints out."""

import logging
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, default_converter

from lsp.completion import completions
from lsp.definition import definition_of
from lsp.documents import Documents, Publication
from lsp.hover import hover_at
from lsp.meaning import meaning_at
from lsp.mending import formatting, mends
from lsp.positions import Encoding
from lsp.project import ServerSettings
from lsp.symbols import outline

_logger = logging.getLogger(__name__)


class _Protocol(LanguageServerProtocol):
    """The protocol, but that texts are kept by `Documents`, and that a request always gets an answer."""

    # pygls would keep the texts a second time, and cuts lines in more places than the protocol does.
    lsp_text_document__did_open = None  # type: ignore[assignment]
    lsp_text_document__did_change = None  # type: ignore[assignment]
    lsp_text_document__did_close = None  # type: ignore[assignment]

    def structure_message(self, data: dict[str, Any]) -> Any:
        """Understand a message; whoever asks what cannot be understood is told so."""
        try:
            return super().structure_message(data)
        except JsonRpcException as problem:
            if "id" in data and "method" in data:
                self._send_response(data["id"], error=problem.to_response_error())
            raise


class _Server(LanguageServer):
    """The server, with the documents that it speaks about."""

    def __init__(self, settings: ServerSettings) -> None:
        super().__init__("nddlc", _version(), protocol_cls=_Protocol, converter_factory=default_converter)
        self.settings = settings
        self.documents = Documents(settings)
        self.is_dismissed = False

    def report_server_error(self, error: Exception, source: Any) -> None:
        """Write to the log what went wrong; a box in front of the text would only be in the way."""
        _logger.error("%s %s", error, getattr(error, "data", None) or "")  # pygls keeps the traceback of ours there
        message = types.LogMessageParams(types.MessageType.Error, f"nddlc: {type(error).__name__}: {error}")
        self.window_log_message(message)

    def publish(self, news: Sequence[Publication]) -> None:
        """Tell the editor what is wrong where."""
        for each in news:
            self.text_document_publish_diagnostics(
                types.PublishDiagnosticsParams(each.uri, each.diagnostics, each.version)
            )


def _version() -> str:
    try:
        return version("nddlc")
    except PackageNotFoundError:
        return "unknown"


def _make_server(settings: ServerSettings) -> _Server:
    """A server that knows what to answer."""
    server = _Server(settings)
    _answer_lifecycle(server)
    _answer_edits(server)
    _answer_questions(server)
    return server


def serve(settings: ServerSettings) -> bool:
    """Serve until the editor leaves or is gone; whether it said goodbye first, as it should."""
    server = _make_server(settings)
    server.start_io()
    return server.is_dismissed


def _answer_lifecycle(server: _Server) -> None:
    @server.feature(types.INITIALIZE)
    def initialize(params: types.InitializeParams) -> None:
        encoding = Encoding(server.workspace.position_encoding)
        server.documents = Documents(_settings(server.settings, params.initialization_options), encoding)

    @server.feature(types.SHUTDOWN)
    def shutdown(params: None) -> None:
        server.is_dismissed = True


def _settings(given: ServerSettings, options: Any) -> ServerSettings:
    """The settings of the command line, with include directories and the trust that the editor adds."""
    told = options if isinstance(options, dict) else {}
    directories = told.get("includeDirectories")
    found = directories if isinstance(directories, list) else []
    added = tuple(each for each in found if isinstance(each, str) and "\0" not in each)
    is_trusted = given.is_trusted or told.get("isTrusted") is True
    return ServerSettings(given.dialect, (*given.directories, *added), is_trusted)


def _answer_edits(server: _Server) -> None:
    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def did_open(params: types.DidOpenTextDocumentParams) -> None:
        document = params.text_document
        server.publish(server.documents.open(document.uri, document.version, document.text))

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def did_change(params: types.DidChangeTextDocumentParams) -> None:
        edits = [(getattr(change, "range", None), change.text) for change in params.content_changes]
        document = params.text_document
        server.publish(server.documents.change(document.uri, document.version, edits))

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def did_save(params: types.DidSaveTextDocumentParams) -> None:
        server.publish(server.documents.save(params.text_document.uri))

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(params: types.DidCloseTextDocumentParams) -> None:
        server.publish(server.documents.close(params.text_document.uri))

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def did_change_files(params: types.DidChangeWatchedFilesParams) -> None:
        server.publish(server.documents.refresh())


def _answer_questions(server: _Server) -> None:
    @server.feature(types.TEXT_DOCUMENT_HOVER)
    def hover(params: types.HoverParams) -> types.Hover | None:
        view = server.documents.view(params.text_document.uri)
        return hover_at(view, params.position, server.documents.conversion()) if view is not None else None

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    def definition(params: types.DefinitionParams) -> types.Location | None:
        view = server.documents.view(params.text_document.uri)
        if view is None:
            return None
        analysis = view.snapshot.analysis
        meaning = meaning_at(analysis, view.parse, view.document.lines.offset(params.position))
        span = definition_of(analysis, meaning) if meaning is not None else None
        return server.documents.conversion().location(span) if span is not None else None

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def document_symbol(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        view = server.documents.view(params.text_document.uri)
        return outline(view.parse, view.document.lines) if view is not None else []

    @server.feature(types.TEXT_DOCUMENT_COMPLETION, types.CompletionOptions(trigger_characters=[".", ":"]))
    def completion(params: types.CompletionParams) -> list[types.CompletionItem]:
        view = server.documents.view(params.text_document.uri)
        if view is None:
            return []
        return completions(view.snapshot.analysis, view.parse, view.document.lines.offset(params.position))

    @server.feature(types.TEXT_DOCUMENT_FORMATTING)
    def format_document(params: types.DocumentFormattingParams) -> list[types.TextEdit]:
        view = server.documents.view(params.text_document.uri)
        return formatting(view.parse, view.document.lines) if view is not None else []

    kinds = types.CodeActionOptions([types.CodeActionKind.QuickFix])

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, kinds)
    def code_action(params: types.CodeActionParams) -> list[types.CodeAction]:
        view = server.documents.view(params.text_document.uri)
        return mends(view, params.range, server.documents.conversion()) if view is not None else []
