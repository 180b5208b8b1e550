"""Hold one top-level statement: its lexemes, and what became of them."""

from typing import Any

from nddl_lang.text.diagnostic import Code, Diagnostic
from nddl_lang.text.source import Anchor, Span


class Piece:
    """A top-level statement with the blanks and comments before it; offsets are relative to `anchor`.

    `kinds`, `texts`, `starts` and `ends` are its lexemes; `docs` maps the start of a lexeme to the doc comment
    above it. `mends` are braces to put in before a lexeme, or, where the text is empty, lexemes to leave out, in order.
    `reach` tells how far the text was looked at: an edit beyond it leaves the piece as it is. `size` counts lexemes,
    comments, and complaints of single characters.
    """

    __slots__ = (
        "anchor",
        "broken",
        "comments",
        "diagnostics",
        "docs",
        "ends",
        "has_former_words",
        "is_cut_short",
        "is_too_deep",
        "kinds",
        "length",
        "mends",
        "reach",
        "size",
        "starts",
        "statements",
        "texts",
    )

    def __init__(self, anchor: Anchor) -> None:
        self.anchor = anchor
        self.length = 0
        self.reach = 0
        self.size = 0
        self.kinds: list[str] = []
        self.texts: list[str] = []
        self.starts: list[int] = []
        self.ends: list[int] = []
        self.comments: list[tuple[int, int]] = []
        self.docs: dict[int, str] = {}
        self.mends: list[tuple[int, str]] = []
        self.has_former_words = False
        self.is_cut_short = False
        self.is_too_deep = False
        self.broken: list[tuple[int, int]] = []
        self.diagnostics: list[Diagnostic] = []
        self.statements: tuple[Any, ...] = ()

    def span(self, start: int, end: int) -> Span:
        """The text from `start` to `end`."""
        return Span(self.anchor, start, end)

    def report(self, code: Code, start: int, end: int, **values: Any) -> None:
        """Add a complaint about the text from `start` to `end`."""
        self.diagnostics.append(code.at(Span(self.anchor, start, end), **values))

    def forget(self, code: Code, span: Span) -> None:
        """Take back complaints of `code` inside `span`: a wider one says it all."""
        self.diagnostics = [
            one for one in self.diagnostics if one.code is not code or not span.start <= one.span.start < span.end
        ]

    @property
    def text(self) -> str:
        """The characters of the piece."""
        offset = self.anchor.offset
        return self.anchor.source.text[offset : offset + self.length]
