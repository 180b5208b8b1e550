"""Find where a statement that was not understood ends."""

from collections.abc import Callable

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.tables import END

_BRACKETS = frozenset(("(", "[", "{", "SET"))
_OPENERS = {")": "(", "]": "["}


def end_of_statement(
    kinds: list[str], first: int, index: int, begins_next: Callable[[int], bool] = lambda _: False
) -> int:
    """The lexeme after the statement that begins at `first` and went wrong at `index`.

    It ends with its `;`, with the block that belongs to it, before the `}` of the block around it, or where
    `begins_next` says that another one begins.
    """
    stack: list[str] = []
    at = first
    while kinds[at] != END:
        kind = kinds[at]
        if at >= index and at > first and "{" not in stack and begins_next(at):
            return at
        if kind in _BRACKETS:
            stack.append(kind)
        elif kind == ")" or kind == "]":
            if stack and stack[-1] == _OPENERS[kind]:
                stack.pop()
        elif kind == ";":
            was_open = False
            while stack and stack[-1] != "{":
                was_open = stack.pop() == "("
            if not stack and at >= index:
                return at + 1 + (was_open and kinds[at + 1] == ")")
        elif kind == "}":
            while stack and stack[-1] in "([":
                stack.pop()
            if not stack:
                return max(at, index)
            if stack.pop() == "{" and not stack and at >= index and kinds[at + 1] != "else":
                return at + 1
        at += 1
    return at


def _misaligned_brace(kinds: list[str], b: Builder) -> int | None:
    """The `{` that has the `}` of an outer block, to judge by how far both lines are indented."""
    source, offset = b.anchor.source, b.anchor.offset
    open_braces: list[tuple[int, int]] = []
    for index, kind in enumerate(kinds):
        if kind == "{" or kind == "SET":
            line = source.line(source.locate(offset + b.starts[index])[0])
            open_braces.append((index, len(line) - len(line.lstrip())))
        elif kind == "}" and open_braces and b.texts[index]:
            number, column = source.locate(offset + b.starts[index])
            opener, indent = open_braces.pop()
            line = source.line(number)
            if column - 1 == len(line) - len(line.lstrip()) and column - 1 < indent:
                return opener
    return None


def _end_by_indentation(b: Builder, opener: int) -> int | None:
    """The first lexeme behind the `{` at `opener` that begins a line which is no deeper than that of the `{`."""
    source, offset = b.anchor.source, b.anchor.offset
    line = source.line(source.locate(offset + b.starts[opener])[0])
    deepest = len(line) - len(line.lstrip())
    for index in range(opener + 1, len(b.starts)):
        if "\n" in source.text[offset + b.ends[index - 1] : offset + b.starts[index]]:
            if source.locate(offset + b.starts[index])[1] - 1 <= deepest:
                return index
    return None


def unclosed_block(b: Builder, opener: int, index: int) -> tuple[int, int | None]:
    """The `{` that is never closed, and the lexeme before which its block should end.

    Where a block inside has taken the `}` of the one at `opener`, which would end at `index`, indentation tells both.
    """
    better = _misaligned_brace(b.kinds, b)
    return (opener, index) if better is None else (better, _end_by_indentation(b, better))
