"""Includes: a text in its model in; its includes, each as a link to its file, and the files that one may name, out."""

import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from lsprotocol.types import CompletionItem, CompletionItemKind, DocumentLink, TextEdit

from lsp.diagnostics import Conversion
from lsp.open_text import DocumentContext
from lsp.roots import models_below
from nddl_lang.syntax.nodes import ClassDecl, Include

_BEGUN = re.compile(r'[ \t]*#include[ \t]*("?)([^"\n]*)')


def document_links(view: DocumentContext, conversion: Conversion) -> list[DocumentLink]:
    """One link per include that leads somewhere."""
    lines = view.document.lines
    included = view.snapshot.analysis.loaded.included
    return [
        DocumentLink(lines.range(span.begin + 1, span.finish - 1), conversion.place(included[include])[0])
        for include in _includes(view)
        if include in included and (span := include.path.span).finish - span.begin > 2
    ]


def included_files(view: DocumentContext, offset: int, folders: Iterable[Path]) -> list[CompletionItem] | None:
    """The files that may be named at `offset`; None where that is not the path of an include."""
    text, path = view.parse.source.text, view.document.path
    begun = _BEGUN.fullmatch(text, text.rfind("\n", 0, offset) + 1, offset)
    if begun is None or path is None:
        return None if begun is None else []
    end = text.find("\n", offset)
    line_end = end if end >= 0 else len(text)
    quote = text.find('"', offset, line_end)
    place = view.document.lines.range(begun.start(2), quote if quote >= 0 else offset)
    quoted = "{}" if begun[1] else '"{}"'
    names = dict.fromkeys(
        Path(os.path.relpath(file, path.parent)).as_posix()
        for folder in (path.parent, *folders)
        for file in models_below(folder)
        if file != path
    )
    edits = [TextEdit(place, quoted.format(name)) for name in names]
    return [
        CompletionItem(name, kind=CompletionItemKind.File, filter_text=name, text_edit=edit)
        for name, edit in zip(names, edits, strict=True)
    ]


def _includes(view: DocumentContext) -> Iterator[Include]:
    for statement in view.parse.module.statements:
        match statement:
            case Include():
                yield statement
            case ClassDecl(members=members) if members:
                yield from (member for member in members if isinstance(member, Include))
            case _:
                pass
