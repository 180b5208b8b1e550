"""Messages to the session: bodies from a wire in, each looked at in its turn.

A thread reads, so that what arrives while something is computed is known as soon as that is done.
"""

import asyncio
import json
import logging
import threading
from collections.abc import Iterator

from lsp.refusals import unreadable
from lsp.session import Session

_logger = logging.getLogger(__name__)


async def pump(session: Session, messages: Iterator[bytes]) -> None:
    """Have each message looked at, until there are no more."""
    loop = asyncio.get_running_loop()
    is_over = asyncio.Event()

    def read_all() -> None:
        try:
            for body in messages:
                loop.call_soon_threadsafe(receive, session, body)
        except (OSError, ValueError):
            _logger.debug("the editor is gone")
        loop.call_soon_threadsafe(is_over.set)

    # A daemon: it may wait for a message while the process ends.
    threading.Thread(target=read_all, daemon=True).start()
    await is_over.wait()


def receive(session: Session, body: bytes) -> None:
    """Look at one message."""
    try:
        message = json.loads(body)
    except (ValueError, RecursionError) as problem:
        session.refuse(unreadable(str(problem)))
        return
    try:
        session.take(message)
    except Exception as mistake:  # of whoever wrote the message
        session.report_server_error(mistake, None)
