"""Tell which of the two dialects a text is written in."""

import re
from enum import Enum

_DECLARATION = re.compile(r"\ufeff?\s*//+\s*nddlc\s*:\s*dialect\s*=\s*(\w+)")


class Dialect(Enum):
    """`nddl3` is what EUROPA accepts; `nddlc`, the default, adds what modelers miss."""

    NDDL3 = "nddl3"
    NDDLC = "nddlc"


def declared_dialect(text: str) -> Dialect | None:
    """The dialect that the first line of `text` asks for, as in `// nddlc: dialect=nddl3`."""
    match = _DECLARATION.match(text)
    if match is None:
        return None
    return next((dialect for dialect in Dialect if dialect.value == match[1]), None)
