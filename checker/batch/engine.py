"""Name the engine as it is: the sources that read, compile, run and judge models."""

import hashlib
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ENGINE = ("nddl_lang", "compiler", "runtime", "checker")


@cache
def engine_digest() -> str:
    """The SHA-256 of the sources that read, compile, run and judge models; the same in whichever form they run."""
    content = hashlib.sha256()
    for folder in ENGINE:
        for path in sorted((ROOT / folder).rglob("*.py")):
            content.update(path.relative_to(ROOT).as_posix().encode() + b"\0")
            content.update(hashlib.sha256(path.read_bytes()).digest())
    return content.hexdigest()
