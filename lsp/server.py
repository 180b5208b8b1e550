"""The language server: settings in; a session that answers everything that editors ask, served over a stream, out."""

import gc

from lsp.asked_of_names import answer_names
from lsp.asked_of_text import answer_text
from lsp.commands import answer_commands
from lsp.life import answer_life
from lsp.mission_texts import Examine
from lsp.project import ServerSettings
from lsp.session import Session
from lsp.transport import serve_standard_streams, serve_tcp, serve_websocket


def make_session(settings: ServerSettings, examine: Examine) -> Session:
    """A session that knows what to answer."""
    session = Session(settings, examine)
    answer_life(session)
    answer_names(session)
    answer_text(session)
    answer_commands(session)
    return session


def calm_collector() -> None:
    """Look for garbage rarely: what an open model consists of lives long, and to look through it costs a keystroke."""
    gc.set_threshold(200_000, 50, 100)


def serve(settings: ServerSettings, examine: Examine, port: int | None = None, *, is_web: bool = False) -> bool:
    """Serve until the editor leaves or is gone; whether it said goodbye first, as it should.

    `examine` tells what is wrong with a mission file. Over standard input and output, or, with a port, over a
    connection that another program on this machine opens: plain, or a WebSocket if it `is_web`.
    """
    session = make_session(settings, examine)
    calm_collector()
    try:
        if port is None:
            serve_standard_streams(session)
        else:
            serve_port = serve_websocket if is_web else serve_tcp
            serve_port(session, port, lambda free: print(f"nddlc: waiting on port {free}", flush=True))
    except (KeyboardInterrupt, SystemExit):
        pass  # pygls ends the process after `exit`
    return session.is_dismissed
