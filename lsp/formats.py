"""Formats of documentation: Markdown in; for an editor that does not show it, the same as plain text, out."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from lsprotocol.types import (
    CompletionItem,
    Hover,
    MarkupContent,
    MarkupKind,
    SignatureHelp,
    TextDocumentClientCapabilities,
)

_FENCE = re.compile(r"^```.*\n?", re.MULTILINE)
_LINK = re.compile(r"\[([^\]\n]*)\]\([^)\s]*\)")
_MARK = re.compile(r"`|\*\*")


@dataclass(frozen=True, slots=True)
class Formats:
    """Where an editor shows Markdown: in hovers, of completions, of signatures; everywhere unless it says otherwise."""

    in_hover: bool = True
    of_items: bool = True
    of_signatures: bool = True

    def hover(self, shown: Hover | None) -> Hover | None:
        """What is shown at a place."""
        if shown is not None and not self.in_hover and isinstance(shown.contents, MarkupContent):
            shown.contents = MarkupContent(MarkupKind.PlainText, _plain(shown.contents.value))
        return shown

    def item(self, item: CompletionItem) -> CompletionItem:
        """What is shown of something that may stand at a place."""
        if not self.of_items and isinstance(item.documentation, MarkupContent):
            item.documentation = _plain(item.documentation.value)
        return item

    def signatures(self, help_: SignatureHelp | None) -> SignatureHelp | None:
        """What is shown of calls."""
        if help_ is not None and not self.of_signatures:
            for each in help_.signatures:
                if isinstance(each.documentation, MarkupContent):
                    each.documentation = _plain(each.documentation.value)
        return help_


def formats_of(text: TextDocumentClientCapabilities | None) -> Formats:
    """What an editor says that it shows; of what it says nothing about at all, Markdown is assumed."""
    hover = text.hover if text is not None else None
    completion = text.completion if text is not None else None
    item = completion.completion_item if completion is not None else None
    help_ = text.signature_help if text is not None else None
    signature = help_.signature_information if help_ is not None else None
    return Formats(
        hover is None or hover.content_format is None or _has_markdown(hover.content_format),
        item is None or _has_markdown(item.documentation_format),
        signature is None or _has_markdown(signature.documentation_format),
    )


def _has_markdown(formats: Sequence[MarkupKind] | None) -> bool:
    return formats is not None and MarkupKind.Markdown in formats


def _plain(markdown: str) -> str:
    return _MARK.sub("", _LINK.sub(r"\1", _FENCE.sub("", markdown))).strip()
