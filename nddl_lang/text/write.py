"""Write a file whole or not at all."""

import os
from pathlib import Path

from nddl_lang.text.read import real_path


def write_whole(path: Path, text: str) -> None:
    """Put `text` at `path`: beside it first, then renamed, so that no reader sees half of it; its mode is kept."""
    target = real_path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    beside = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        beside.write_bytes(text.encode("utf-8"))
        if target.exists():
            beside.chmod(target.stat().st_mode)
        beside.replace(target)
    finally:
        beside.unlink(missing_ok=True)
