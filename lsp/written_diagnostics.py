"""Complaints about a file in, the notification of them as JSON out; what was written before is not written again."""

import json
from collections.abc import Callable, Container
from typing import Any

from lsprotocol import types


class WrittenDiagnostics:
    """The JSON of each complaint that was told of a file, until the file is forgotten.

    An error anywhere takes the findings back for a moment: what was written is kept until more is.
    """

    def __init__(self, plain: Callable[[Any], Any]) -> None:
        self._write = json.JSONEncoder(default=plain).encode
        self.known: dict[str, dict[int, tuple[types.Diagnostic, str]]] = {}  # URI -> identity -> as it was written
        self._silent: set[str] = set()  # URIs of which nothing is told now

    def body(self, notification: types.PublishDiagnosticsNotification) -> str:
        """The notification as it is sent."""
        params = notification.params
        uri = params.uri
        before = self.known.get(uri, {})
        now = {id(each): before.get(id(each)) or (each, self._write(each)) for each in params.diagnostics}
        if now:
            self._silent.discard(uri)
        else:
            self._silent.add(uri)
        if now and len(now) >= len(before):
            self.known[uri] = now
        version = f'"version": {params.version}, ' if params.version is not None else ""
        complaints = ", ".join([now[id(each)][1] for each in params.diagnostics])
        told = f'{{"uri": {self._write(uri)}, {version}"diagnostics": [{complaints}]}}'
        return f'{{"jsonrpc": "2.0", "method": "{notification.method}", "params": {told}}}'

    def forget(self, shown: Container[str]) -> None:
        """Forget the files of which nothing is told, but for those that are `shown` again once they are whole."""
        for uri in [each for each in self._silent if each not in shown]:
            self._silent.discard(uri)
            self.known.pop(uri, None)
