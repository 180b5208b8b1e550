"""The answer to `initialize`, ahead of all else: the first message in; what the server offers out.

Loading the types of the protocol and the language takes ten times as long as this answer, so it is given from a table
before. `tests/lsp/test_greeting.py` holds the table to what a session offers by itself.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from lsp.streams import Wire

_ENCODINGS = ("utf-8", "utf-16", "utf-32")
_USUAL_ENCODING = "utf-16"
_OFFERED: dict[str, Any] = {
    "textDocumentSync": {"openClose": True, "change": 2, "save": True},
    "completionProvider": {"triggerCharacters": [".", ":", '"'], "resolveProvider": True},
    "hoverProvider": True,
    "signatureHelpProvider": {"triggerCharacters": ["(", ","], "retriggerCharacters": [")"]},
    "declarationProvider": True,
    "definitionProvider": True,
    "typeDefinitionProvider": True,
    "implementationProvider": True,
    "referencesProvider": True,
    "documentHighlightProvider": True,
    "documentSymbolProvider": True,
    "codeActionProvider": {
        "codeActionKinds": ["quickfix", "refactor", "refactor.extract", "source.fixAll.nddlc"],
        "resolveProvider": True,
    },
    "codeLensProvider": {"resolveProvider": True},
    "documentLinkProvider": {"resolveProvider": False},
    "workspaceSymbolProvider": {"resolveProvider": False},
    "documentFormattingProvider": True,
    "documentRangeFormattingProvider": True,
    "documentOnTypeFormattingProvider": {"firstTriggerCharacter": "}", "moreTriggerCharacter": [";"]},
    "foldingRangeProvider": True,
    "selectionRangeProvider": True,
    "executeCommandProvider": {"commands": ["nddl.check", "nddl.explain", "nddl.certify"]},
    "callHierarchyProvider": True,
    "semanticTokensProvider": {
        "legend": {
            "tokenTypes": [
                *("class", "enum", "enumMember", "type", "method", "variable", "property", "parameter", "event"),
                *("function", "operator", "keyword", "number", "string", "comment"),
            ],
            "tokenModifiers": ["declaration", "modification", "defaultLibrary", "static"],
        },
        "range": True,
        "full": {"delta": True},
    },
    "typeHierarchyProvider": True,
    "inlayHintProvider": {"resolveProvider": False},
    "diagnosticProvider": {"interFileDependencies": True, "workspaceDiagnostics": True, "identifier": "nddlc"},
    "workspace": {"workspaceFolders": {"supported": True, "changeNotifications": True}, "fileOperations": {}},
}


@dataclass(frozen=True, slots=True)
class Greeting:
    """A request that is answered already: its number, and what the answer was chosen by."""

    number: int | str
    encoding: str
    prepares_renames: bool

    def plain(self, params: dict[str, Any]) -> dict[str, Any]:
        """Parameters that make sense, with what the answer was chosen by."""
        told = params.get("capabilities") or {}
        general, text = told.get("general") or {}, told.get("textDocument") or {}
        rename = {**(text.get("rename") or {}), "prepareSupport": self.prepares_renames}
        capabilities = {
            **told,
            "general": {**general, "positionEncodings": [self.encoding]},
            "textDocument": {**text, "rename": rename},
        }
        return {"processId": None, "rootUri": None, **params, "capabilities": capabilities}


@dataclass(frozen=True, slots=True)
class Begun:
    """A session that has begun: the first message, what was answered to it, and the messages that come after it."""

    first: bytes
    greeting: Greeting | None
    rest: Iterator[bytes]


def begin(wire: Wire) -> Begun | None:
    """Wait for the first message, and answer it where it can be; None where the editor is gone before it."""
    messages = wire.messages()
    try:
        first = next(messages, None)
    except (OSError, ValueError):
        return None
    return Begun(first, _greet(wire, first), messages) if first is not None else None


def _greet(wire: Wire, body: bytes) -> Greeting | None:
    """Answer a message that begins a session and reads as it should."""
    try:
        message = json.loads(body)
    except ValueError:
        return None
    match message:
        case {"jsonrpc": "2.0", "id": int() | str() as number, "method": "initialize", "params": dict() as params}:
            greeting = _greeting(number, params)
        case _:
            return None
    if greeting is not None:
        content = json.dumps({"id": number, "jsonrpc": "2.0", "result": _offer(greeting)}).encode()
        wire.write(b"Content-Length: %d\r\n\r\n%b" % (len(content), content) if wire.has_headers else content)
    return greeting


def _greeting(number: int | str, params: dict[str, Any]) -> Greeting | None:
    capabilities = params.get("capabilities")
    encodings = _inside(capabilities, "general", "positionEncodings")
    prepares = _inside(capabilities, "textDocument", "rename", "prepareSupport")
    if not isinstance(capabilities, dict) or isinstance(number, bool):
        return None
    listed = encodings if isinstance(encodings, list) else []
    encoding = next((each for each in listed if each in _ENCODINGS), _USUAL_ENCODING)
    return Greeting(number, encoding, prepares is True)


def _inside(value: Any, *keys: str) -> Any:
    """What stands at the end of the keys; None where they end early."""
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def _offer(greeting: Greeting) -> dict[str, Any]:
    capabilities = {
        **_OFFERED,
        "positionEncoding": greeting.encoding,
        "renameProvider": {"prepareProvider": True} if greeting.prepares_renames else True,
    }
    return {"capabilities": capabilities, "serverInfo": {"name": "nddlc", "version": own_version()}}


def own_version() -> str:
    """The version of this server."""
    try:
        return version("nddlc")
    except PackageNotFoundError:
        return "unknown"
