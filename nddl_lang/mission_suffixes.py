"""How a file is known that describes a mission: by the end of its name, nddlc's own or an agent file of T-REX's."""

import re
from pathlib import Path

from nddl_lang.text.read import NotAFileError, read_text

AGENT_SUFFIXES = (".xml", ".cfg")
MISSION_SUFFIXES = (".toml", *AGENT_SUFFIXES)
MISSION_HEAD = re.compile(r"^[ \t]*\[[ \t]*mission[ \t]*\]", re.MULTILINE)  # the table that one of ours has


def mission_text(path: Path) -> str | None:
    """The text of a file with the head of a mission; None where it is none, no file, or too large. Raises OSError."""
    try:
        text = read_text(path)
    except NotAFileError:
        return None
    return text if text is not None and MISSION_HEAD.search(text) is not None else None
