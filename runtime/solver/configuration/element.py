"""A configuration as it is written, in XML or TOML: elements with attributes, children and spans."""

import re
from dataclasses import dataclass, replace

from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix
from nddl_lang.text.source import Anchor, Source, Span


@dataclass(frozen=True, slots=True)
class Attribute:
    """A name and a value, and where they are written."""

    name: str
    value: str
    span: Span


@dataclass(frozen=True, slots=True)
class Element:
    """A tag, its attributes in order, its children in order, and where it begins."""

    tag: str
    attributes: tuple[Attribute, ...]
    children: "tuple[Element, ...]"
    span: Span

    def find(self, *names: str) -> Attribute | None:
        """The first attribute that has one of `names`, in the order of `names`."""
        for name in names:
            for attribute in self.attributes:
                if attribute.name == name:
                    return attribute
        return None


def stretch(source: Source, begin: int, end: int) -> Span:
    """The span of some characters of `source`."""
    return Span(Anchor(source), begin, max(begin, end))


def moved(element: Element, span: Span) -> Element:
    """An element as if it were written, with all that is in it, at another place."""
    attributes = tuple(Attribute(one.name, one.value, span) for one in element.attributes)
    return Element(element.tag, attributes, tuple(moved(child, span) for child in element.children), span)


def respelt(complaint: Diagnostic, word: str, meant: str | None, *, is_key: bool = False) -> Diagnostic:
    """`complaint`, which stands at a key and its value, with the fix that writes `meant` for `word` there.

    Without `meant`, or where the word is not written as it is read, it is left as it is.
    """
    span = complaint.span
    found = list(re.finditer(rf"(?<![\w-]){re.escape(word)}(?![\w-])", span.text)) if word and meant is not None else []
    if not found or meant is None:
        return complaint
    start = span.start + found[0 if is_key else -1].start()
    edit = Edit(Span(span.anchor, start, start + len(word)), meant)
    return replace(complaint, fixes=(*complaint.fixes, Fix(f"write `{meant}`", (edit,), safe=is_key)))
