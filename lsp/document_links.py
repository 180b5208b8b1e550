"""Document links: a text in its model in; its includes, each with the file that it leads to, out."""

from collections.abc import Iterator

from lsprotocol.types import DocumentLink

from lsp.diagnostics import Conversion
from lsp.open_text import DocumentContext
from nddl_lang.syntax.nodes import ClassDecl, Include


def document_links(view: DocumentContext, conversion: Conversion) -> list[DocumentLink]:
    """One link per include that leads somewhere."""
    lines = view.document.lines
    included = view.snapshot.analysis.loaded.included
    return [
        DocumentLink(lines.range(span.begin + 1, span.finish - 1), conversion.place(included[include])[0])
        for include in _includes(view)
        if include in included and (span := include.path.span).finish - span.begin > 2
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
