"""URIs of files, as editors write them: URIs in, paths out; and back."""

import os
from pathlib import Path
from urllib.parse import unquote, urlsplit


def path_of(uri: str) -> Path | None:
    """The file that `uri` names; None where it names none, such as a text that was never saved."""
    try:
        parts = urlsplit(uri)
    except ValueError:
        return None
    if parts.scheme != "file":
        return None
    host = f"//{parts.netloc}" if parts.netloc not in ("", "localhost") else ""
    path = Path(_native(host + parts.path))
    return path if path.is_absolute() and _can_be_a_name(path) else None


def _native(path: str) -> str:
    """The path of a URI as the system writes it: on Windows `/c:/a` is `c:/a`."""
    decoded = unquote(path)
    return decoded[1:] if os.name == "nt" and decoded[2:3] == ":" else decoded


def _can_be_a_name(path: Path) -> bool:
    try:
        return b"\0" not in os.fsencode(path)
    except UnicodeEncodeError:
        return False


def uri_of(path: Path) -> str:
    """What an editor calls the file at `path`."""
    return Path(os.path.abspath(path)).as_uri()  # noqa: PTH100  (links stay as they are)


def key_of(path: Path) -> str:
    """What is the same for all ways to name one file; never raises."""
    try:
        return os.path.realpath(path)
    except (OSError, ValueError):
        return str(path)
