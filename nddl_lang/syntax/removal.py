"""A place in, the edit that takes its text away out."""

from nddl_lang.syntax.nodes import VariableDecl
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span


def removal(span: Span) -> Edit:
    """Take away `span`, and the whole lines where nothing else stands on them."""
    text, begin, finish = span.source.text, span.begin, span.finish
    start, end = begin, finish
    while start > 0 and text[start - 1] in " \t":
        start -= 1
    while end < len(text) and text[end] in " \t\r":
        end += 1
    is_alone = (start == 0 or text[start - 1] == "\n") and (end == len(text) or text[end] == "\n")
    if is_alone:
        return Edit(_widened(span, start, min(end + 1, len(text))), "")
    while finish < len(text) and text[finish] in " \t":
        finish += 1
    return Edit(_widened(span, begin, finish), "")


def _widened(span: Span, begin: int, finish: int) -> Span:
    offset = span.anchor.offset
    return Span(span.anchor, begin - offset, finish - offset)


def undeclare(node: VariableDecl, index: int, *, safe: bool) -> Fix:
    """Take name number `index` out of a declaration, and the declaration where it was the only one."""
    name = node.declarators[index].name.name
    title = f"remove `{name}`"
    if len(node.declarators) == 1:
        return Fix(title, (removal(node.span),), safe)
    mine = node.declarators[index].span
    if index == 0:
        gap = _widened(mine, mine.begin, node.declarators[1].span.begin)
    else:
        gap = _widened(mine, node.declarators[index - 1].span.finish, mine.finish)
    return Fix(title, (Edit(gap, ""),), safe)
