"""What is open in the editor: a text, the model that it is seen in, and what is told about it."""

from dataclasses import dataclass
from pathlib import Path

from lsprotocol.types import Diagnostic as Shown

from lsp.positions import Lines
from lsp.project import Snapshot
from nddl_lang.syntax.parser import Parse


@dataclass(slots=True)
class Document:
    """A text that is open in the editor, with the version that the editor gave it."""

    uri: str
    key: str
    name: str
    path: Path | None
    version: int
    lines: Lines


@dataclass(frozen=True, slots=True)
class Publication:
    """All that is wrong with one file now; `version` is that of its open text, None where it is not open."""

    uri: str
    version: int | None
    diagnostics: tuple[Shown, ...]


@dataclass(frozen=True, eq=False, slots=True)
class DocumentContext:
    """An open text as part of its model: what requests about it are answered from."""

    document: Document
    snapshot: Snapshot
    parse: Parse
