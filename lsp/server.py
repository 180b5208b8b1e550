"""The language server: settings in; a session that answers everything that editors ask, served over a wire, out."""

import asyncio
import gc
import linecache
from contextlib import suppress
from itertools import chain

from lsp.asked_of_names import answer_names
from lsp.asked_of_text import answer_text
from lsp.commands import answer_commands
from lsp.greeting import Begun
from lsp.life import answer_life
from lsp.mission_texts import Examine
from lsp.project import ServerSettings
from lsp.session import Session
from lsp.streams import Wire
from lsp.transport import pump


def make_session(settings: ServerSettings, examine: Examine) -> Session:
    """A session that knows what to answer."""
    session = Session(settings, examine)
    answer_life(session)
    answer_names(session)
    answer_text(session)
    answer_commands(session)
    return session


def serve(session: Session, wire: Wire, begun: Begun) -> bool:
    """Serve until the editor leaves or is gone; whether it said goodbye first, as it should."""
    session.begin_answered(begun.greeting)
    session.protocol.set_writer(wire, include_headers=wire.has_headers)
    linecache.clearcache()  # attrs leaves the text of every method there that it wrote
    gc.collect()
    gc.freeze()  # what is loaded by now stays
    with suppress(KeyboardInterrupt, SystemExit):  # pygls ends the process after `exit`
        asyncio.run(pump(session, chain((begun.first,), begun.rest)))
    return session.is_dismissed
