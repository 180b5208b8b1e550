"""One editor session: the server of the protocol with the documents it speaks about, and when it analyses them.

Whatever has arrived is looked at before anything is computed: edits only change texts and are analysed once, in their
newest state; a question that is taken back before its turn is never computed.
"""

import asyncio
import gc
import inspect
import logging
from collections.abc import Callable, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from lsprotocol import types
from pygls.exceptions import JsonRpcException, JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, default_converter, lsp_method

from lsp.check_results import CheckResults
from lsp.diagnostics import Conversion
from lsp.documents import Documents
from lsp.formats import Formats
from lsp.greeting import Greeting, own_version
from lsp.inlay_hints import HintSettings
from lsp.malformed import sensible
from lsp.mission_texts import Examine, MissionTexts, OpenMission
from lsp.open_text import DocumentContext, Publication
from lsp.project import ServerSettings
from lsp.pulled import PulledDiagnostics
from lsp.refusals import RefusedMessage, refusals
from lsp.semantic_tokens import TokenMemory
from lsp.written_diagnostics import WrittenDiagnostics

_logger = logging.getLogger(__name__)
_MISTAKES_HELD = (100, 1000, 10_000)  # of each generation of the collector
_PAUSE = 0.3  # seconds without an edit before repairs are tried
_TRIALS = 4  # of repairs between two looks at what has arrived
_OF_ANSWERS = ("result", "error")


def _is_worth_a_line(record: logging.LogRecord) -> bool:
    """Whether a record of pygls tells of a mistake; a question without an answer is none."""
    return record.exc_info is None or not isinstance(record.exc_info[1], RequestFailed)


logging.getLogger("pygls.protocol.json_rpc").addFilter(_is_worth_a_line)


class RequestFailed(JsonRpcException):
    """A question that has no answer, for a reason that the user should read."""

    CODE = int(types.LSPErrorCodes.RequestFailed)
    MESSAGE = "the request failed"


class _Protocol(LanguageServerProtocol):
    """The protocol, but that texts are kept by `Documents`, and that a request always gets an answer."""

    # pygls would keep the texts a second time, and cuts lines in more places than the protocol does.
    lsp_text_document__did_open = None  # type: ignore[assignment]
    lsp_text_document__did_change = None  # type: ignore[assignment]
    lsp_text_document__did_close = None  # type: ignore[assignment]
    # It would keep notebooks too, which nobody here reads.
    lsp_notebook_document__did_open = None  # type: ignore[assignment]
    lsp_notebook_document__did_change = None  # type: ignore[assignment]
    lsp_notebook_document__did_close = None  # type: ignore[assignment]

    greeting: Greeting | None = None  # a request that is answered already

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.written = WrittenDiagnostics(self._serialize_message)
        self._is_begun = False

    def take(self, message: Any) -> None:
        """Look at a message, or say why not."""
        refused = list(refusals(message, is_begun=self._is_begun, is_dismissed=self._shutdown))
        for each in refused:
            self.refuse(each)
        if not refused:
            if "method" in message:
                message = {key: value for key, value in message.items() if key not in _OF_ANSWERS}
            understood = self.structure_message(message)
            self._is_begun |= message.get("method") == types.INITIALIZE
            self.handle_message(understood)

    def refuse(self, refusal: RefusedMessage) -> None:
        """Answer a message that is not looked at."""
        _logger.error("refused: %s", refusal.reason)
        if refusal.is_answered:
            self._send_data(refusal.response())

    def _send_data(self, data: Any) -> None:
        """Send a message; complaints that were sent before are not written again."""
        if self.writer is None or not isinstance(data, types.PublishDiagnosticsNotification):
            super()._send_data(data)
            return
        content = self.written.body(data).encode()
        self.writer.write(
            b"Content-Length: %d\r\n\r\n%b" % (len(content), content) if self._include_headers else content
        )

    def structure_message(self, data: dict[str, Any]) -> Any:
        """Understand a message; whoever asks what cannot be understood is told so."""
        try:
            return super().structure_message(data)
        except JsonRpcException as problem:
            if self.greeting is not None and data.get("method") == types.INITIALIZE:
                self._server.report_server_error(problem, JsonRpcException)
                left = sensible(data["params"], types.InitializeParams, self._converter.structure)
                return super().structure_message({**data, "params": self.greeting.plain(left)})
            if "id" in data and "method" in data:
                self._send_response(data["id"], error=problem.to_response_error())
            raise

    def _execute_handler(
        self,
        msg_id: int | str,
        handler: Callable[..., Any],
        callback: Callable[[Any], None],
        args: tuple[Any, ...] | None = None,
        kwargs: dict[str, Any] | None = None,
    ) -> None:
        """Carry out what a message asks for, and forget it then: pygls keeps the end of each notification for good."""

        def end(future: Any) -> None:
            if self._request_futures.get(msg_id) is future:
                del self._request_futures[msg_id]
            callback(future)

        super()._execute_handler(msg_id, handler, end, args, kwargs)

    @lsp_method(types.WORKSPACE_EXECUTE_COMMAND)
    async def lsp_workspace__execute_command(self, params: types.ExecuteCommandParams) -> Any:  # type: ignore[override]
        """Carry out a command, which ends where its request is taken back: pygls would let it run on."""
        handler = self.fm.commands.get(params.command)
        if handler is None:
            raise JsonRpcInvalidParams.of(ValueError(f"there is no command `{params.command}`"))
        try:
            arguments = inspect.signature(handler).bind(*(params.arguments or ())).args
        except TypeError as problem:
            raise JsonRpcInvalidParams.of(problem) from None
        return await handler(*arguments)

    def _send_response(self, msg_id: int | str, result: Any = None, error: Any = None) -> None:
        """Answer a request, unless it is answered already."""
        if self.greeting is not None and self.greeting.number == msg_id:
            self.greeting = None
        else:
            super()._send_response(msg_id, result, error)


class Session(LanguageServer):
    """The server, with the documents that it speaks about."""

    def __init__(self, settings: ServerSettings, examine: Examine = lambda *_: ()) -> None:
        super().__init__("nddlc", own_version(), protocol_cls=_Protocol, converter_factory=default_converter)
        self.settings = settings
        self._examine = examine
        self.begin(Documents(settings))
        self._due_missions: dict[str, OpenMission] = {}
        self.is_dismissed = False
        self.is_pulled = False  # the editor asks for diagnostics, so none are pushed
        self.is_distrusted = False  # the user has said that the workspace is not trusted
        self.has_snippets = False
        self.formats = Formats()
        self.shows_results = False  # the editor shows itself how a command ended
        self.hints = HintSettings()
        self.token_memory = TokenMemory()
        self._is_due = False
        self._pause: asyncio.TimerHandle | None = None
        self._mistakes = 0

    def report_server_error(self, error: Exception, source: Any) -> None:
        """Write to the log what went wrong; a box in front of the text would only be in the way."""
        self._mistakes += 1
        # An exception and the frames of its traceback hold each other, and the message with them.
        due = [generation for generation, held in enumerate(_MISTAKES_HELD) if self._mistakes % held == 0]
        if due:
            gc.collect(due[-1])
        if isinstance(error, RequestFailed):
            return
        _logger.error("%s %s", error, getattr(error, "data", None) or "")  # pygls keeps the traceback of ours there
        message = types.LogMessageParams(types.MessageType.Error, f"nddlc: {type(error).__name__}: {error}")
        self.window_log_message(message)

    def take(self, message: Any) -> None:
        """Look at a message, as JSON."""
        assert isinstance(self.protocol, _Protocol)
        self.protocol.take(message)

    def refuse(self, refusal: RefusedMessage) -> None:
        """Answer a message that is not looked at."""
        assert isinstance(self.protocol, _Protocol)
        self.protocol.refuse(refusal)

    def begin_answered(self, greeting: Greeting | None) -> None:
        """The request that begins the session is answered already, where there is a `greeting`."""
        assert isinstance(self.protocol, _Protocol)
        self.protocol.greeting = greeting

    def begin(self, documents: Documents) -> None:
        """Speak about these documents."""
        self.documents = documents
        self.missions = MissionTexts(self._examine, documents.encoding, is_trusted=documents.settings.is_trusted)
        self.mission_complaints: dict[str, tuple[types.Diagnostic, ...]] = {}
        self.results = CheckResults(documents)
        documents.others = self.results.diagnostics
        self.pulled = PulledDiagnostics(documents, self.mission_complaints)

    def configure(self, told: Any) -> None:
        """Take over what the user has set: `{"inlayHints": {"relations": false}}`."""
        hints = told.get("inlayHints") if isinstance(told, dict) else None
        if isinstance(hints, dict):
            wanted = {each.name: hints.get(each.name) is not False for each in fields(HintSettings)}
            self.hints = HintSettings(**wanted)

    @property
    def resolves_actions(self) -> bool:
        """Whether the editor asks for the edit of an action once that is chosen."""
        text = self.client_capabilities.text_document
        action = text.code_action if text is not None else None
        support = action.resolve_support if action is not None else None
        return support is not None and "edit" in support.properties

    def publish(self, news: Sequence[Publication], *, is_late: bool = False) -> None:
        """Tell the editor what is wrong where, or that it should ask again; `is_late`: what it may have asked for."""
        self._repair_later(_PAUSE)
        if not self.is_pulled:
            for each in news:
                self.text_document_publish_diagnostics(
                    types.PublishDiagnosticsParams(each.uri, each.diagnostics, each.version)
                )
            assert isinstance(self.protocol, _Protocol)
            self.protocol.written.forget(self.documents.shown_uris())
        elif is_late or len(news) > 1 or any(each.version is None for each in news):
            support = self.client_capabilities.workspace
            if support is not None and support.diagnostics is not None and support.diagnostics.refresh_support:
                self.workspace_diagnostic_refresh(None)

    def analyse(self) -> None:
        """Analyse what was edited since, and tell what is wrong now."""
        self._is_due = False
        try:
            self.publish(self.documents.analyse())
            due, self._due_missions = self._due_missions, {}
            for mission in due.values():
                self.judge_mission(mission)
        except Exception as mistake:
            self.report_server_error(mistake, None)

    def _repair_later(self, seconds: float) -> None:
        """Look on for repairs of models with errors, once nothing has been edited for so long."""
        if self._pause is not None:
            self._pause.cancel()
            self._pause = None
        if self.documents.is_in_repair:
            self._pause = asyncio.get_running_loop().call_later(seconds, self._repair)

    def _repair(self) -> None:
        try:
            news = self.documents.repair(_TRIALS)
            if news:
                self.publish(news, is_late=True)
            elif not self._is_due:
                self._repair_later(0)
        except Exception as mistake:
            self.report_server_error(mistake, None)

    def analyse_soon(self) -> None:
        """Analyse after whatever has arrived by now."""
        if not self._is_due:
            self._is_due = True
            asyncio.get_running_loop().call_soon(self.analyse)

    async def turn(self) -> None:
        """Let what has arrived by now be looked at first, then analyse."""
        await asyncio.sleep(0)
        if self._is_due:
            self.analyse()

    async def view(self, uri: str) -> DocumentContext | None:
        """An open text with its model, in the newest state."""
        await self.turn()
        return self.documents.view(uri)

    def judge_missions(self) -> None:
        """Tell what is wrong with the open mission files now that their models may have changed."""
        for mission in self.missions.all():
            self.judge_mission(mission)

    def missions_known(self) -> list[Path]:
        """Open mission files and models: where missions may lie."""
        opened = [document.path for document in self.documents.open_documents() if document.path is not None]
        return [*(mission.path for mission in self.missions.all()), *opened]

    def judge_soon(self, mission: OpenMission) -> None:
        """Judge a mission file after whatever has arrived by now."""
        self._due_missions[mission.uri] = mission
        self.analyse_soon()

    def close_mission(self, uri: str) -> bool:
        """A mission file is no longer open; whether it was one."""
        if not self.missions.close(uri):
            return False
        del self.mission_complaints[uri]
        self._due_missions.pop(uri, None)
        if not self.is_pulled:
            self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, []))
        return True

    def judge_mission(self, mission: OpenMission) -> None:
        """Tell what is wrong with a mission file."""
        found = self.missions.complaints(mission, self.documents.conversion())
        self.mission_complaints[mission.uri] = found
        if not self.is_pulled:
            told = types.PublishDiagnosticsParams(mission.uri, found, mission.version)
            self.text_document_publish_diagnostics(told)

    def answer_item(self, feature: str, answer: Callable[[DocumentContext, int, Conversion], list[Any]]) -> None:
        """Answer a question about an item of a hierarchy, which stands where its name does."""

        async def handler(params: Any) -> list[Any]:
            await self.turn()
            view = self.documents.context(params.item.uri)
            if view is None:
                return []
            at = view.document.lines.offset(params.item.selection_range.start)
            return answer(view, at, self.documents.conversion())

        self.feature(feature)(handler)

    def answer(
        self,
        feature: str,
        answer: Callable[[DocumentContext, Any], Any],
        options: Any = None,
        nothing: Callable[[], Any] = lambda: None,
        of_mission: Callable[[OpenMission, Any], Any] | None = None,
    ) -> None:
        """Answer a question about an open text or mission file; `nothing` makes the answer about any other."""

        async def handler(params: Any) -> Any:
            uri = params.text_document.uri
            view = await self.view(uri)
            if view is not None:
                return answer(view, params)
            mission = self.missions.find(uri) if of_mission is not None else None
            if of_mission is None or mission is None or mission.is_agent_file:
                return nothing()
            return of_mission(mission, params)

        self.feature(feature, options)(handler)
