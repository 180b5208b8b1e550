"""A session's life: its beginning and end, its texts, settings, folders and files."""

from pathlib import Path
from typing import Any

from lsprotocol import types

from lsp.check_results import REPORT
from lsp.documents import Documents
from lsp.formats import formats_of
from lsp.positions import Encoding
from lsp.project import ServerSettings
from lsp.session import Session
from lsp.uris import path_of

_WATCHED = ("**/*.nddl", "**/nddlc.toml", "**/pyproject.toml", "**/mission*.toml", "**/nddlc-report/report.json")


def answer_life(session: Session) -> None:
    """Let a session begin, follow what the editor does, and end."""
    _answer_lifecycle(session)
    _answer_edits(session)
    _answer_surroundings(session)


def _answer_lifecycle(session: Session) -> None:
    @session.feature(types.INITIALIZE)
    def initialize(params: types.InitializeParams) -> None:
        encoding = Encoding(session.workspace.position_encoding)
        session.begin(Documents(_settings(session.settings, params.initialization_options), encoding))
        session.configure(params.initialization_options)
        told = params.initialization_options
        session.is_distrusted = isinstance(told, dict) and told.get("isTrusted") is False
        session.shows_results = isinstance(told, dict) and told.get("showsResults") is True
        session.documents.folders = _folders(session)
        text = params.capabilities.text_document
        session.is_pulled = text is not None and text.diagnostic is not None
        session.has_snippets = _has_snippets(text)
        session.formats = formats_of(text)

    @session.feature(types.INITIALIZED)
    def initialized(params: types.InitializedParams) -> None:
        workspace = session.client_capabilities.workspace
        watching = workspace.did_change_watched_files if workspace is not None else None
        if watching is not None and watching.dynamic_registration:
            watchers = [types.FileSystemWatcher(pattern) for pattern in _WATCHED]
            options = types.DidChangeWatchedFilesRegistrationOptions(watchers)
            wanted = types.Registration("files", types.WORKSPACE_DID_CHANGE_WATCHED_FILES, options)
            session.client_register_capability(types.RegistrationParams([wanted]))

    @session.feature(types.SHUTDOWN)
    def shutdown(params: None) -> None:
        session.is_dismissed = True


def _has_snippets(text: types.TextDocumentClientCapabilities | None) -> bool:
    completion = text.completion if text is not None else None
    item = completion.completion_item if completion is not None else None
    return bool(item is not None and item.snippet_support)


def _settings(given: ServerSettings, options: Any) -> ServerSettings:
    """The settings of the command line, with include directories and the trust that the editor adds."""
    told = options if isinstance(options, dict) else {}
    directories = told.get("includeDirectories")
    found = directories if isinstance(directories, list) else []
    added = tuple(each for each in found if isinstance(each, str) and "\0" not in each)
    is_trusted = given.is_trusted or told.get("isTrusted") is True
    return ServerSettings(given.dialect, (*given.directories, *added), is_trusted)


def _folders(session: Session) -> tuple[Path, ...]:
    """The folders of the workspace, or its root where it has none."""
    uris = list(session.workspace.folders) or [session.workspace.root_uri or ""]
    return tuple(path for uri in uris if (path := path_of(uri)) is not None)


def _answer_edits(session: Session) -> None:
    @session.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def did_open(params: types.DidOpenTextDocumentParams) -> None:
        document = params.text_document
        if (path := path_of(document.uri)) is not None:
            session.results.look(path, session.documents.folders)
        if session.missions.is_mission(document.uri):
            mission = session.missions.open(document.uri, document.version, document.text)
            if mission is not None:
                session.judge_mission(mission)
        else:
            session.publish(session.documents.open(document.uri, document.version, document.text))

    @session.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def did_change(params: types.DidChangeTextDocumentParams) -> None:
        edits = [(getattr(change, "range", None), change.text) for change in params.content_changes]
        document = params.text_document
        if (mission := session.missions.change(document.uri, document.version, edits)) is not None:
            session.judge_soon(mission)
        elif session.documents.edit(document.uri, document.version, edits):
            session.analyse_soon()

    @session.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def did_save(params: types.DidSaveTextDocumentParams) -> None:
        session.publish(session.documents.save(params.text_document.uri))
        session.judge_missions()

    @session.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(params: types.DidCloseTextDocumentParams) -> None:
        session.token_memory.forget(params.text_document.uri)
        if not session.close_mission(params.text_document.uri):
            session.publish(session.documents.close(params.text_document.uri))


def _answer_surroundings(session: Session) -> None:
    @session.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def did_change_files(params: types.DidChangeWatchedFilesParams) -> None:
        for each in params.changes:
            path = path_of(each.uri)
            if path is not None and path.name == REPORT.name:
                for mission in session.missions_known():
                    session.results.look(mission, session.documents.folders)
        session.publish(session.documents.refresh())
        session.judge_missions()

    @session.feature(types.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS)
    def did_change_folders(params: types.DidChangeWorkspaceFoldersParams) -> None:
        session.documents.folders = _folders(session)
        session.publish(session.documents.refresh())

    @session.feature(types.WORKSPACE_DID_CHANGE_CONFIGURATION)
    def did_change_configuration(params: types.DidChangeConfigurationParams) -> None:
        told = params.settings if isinstance(params.settings, dict) else {}
        told = told["nddlc"] if isinstance(told.get("nddlc"), dict) else told
        session.configure(told)
        session.publish(session.documents.configure(_settings(session.settings, told)))
