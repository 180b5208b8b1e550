"""Keep what programs read apart from what a modeler's code writes, also past Python's own streams."""

import os
import sys

_STDOUT, _STDERR = 1, 2


def keep_output_apart() -> None:
    """Give standard output a descriptor of its own; what writes to descriptor 1 from now on reaches standard error.

    Nothing happens where standard output is something else already, as under a test runner or in the language server.
    """
    try:
        if sys.stdout.fileno() != _STDOUT:
            return
        sys.stdout.flush()
        own = os.dup(_STDOUT)
        os.dup2(_STDERR, _STDOUT)
    except (AttributeError, OSError, ValueError):  # a stream that is closed, or has no descriptor
        return
    is_lively = sys.stdout.isatty()
    old = sys.stdout
    sys.stdout = os.fdopen(own, "w", encoding=old.encoding, errors=old.errors, buffering=1 if is_lively else -1)
