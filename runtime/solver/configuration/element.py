"""A configuration as it is written, in XML or TOML: elements with attributes, children and spans."""

from dataclasses import dataclass

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
