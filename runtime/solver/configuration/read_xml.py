"""Read a solver's configuration from EUROPA's XML: text in, elements with spans out. Nothing outside is ever read."""

import re
from dataclasses import dataclass, field
from xml.parsers import expat

from nddl_lang.text.byte_places import BytePlaces
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source
from runtime.solver.configuration.codes import FORBIDDEN_DOCTYPE, NOT_READABLE
from runtime.solver.configuration.element import Attribute, Element, stretch

_ROOT = re.compile(r"\A\s*(?:<\?.*?\?>\s*|<!--.*?-->\s*)*<Solver\b", re.DOTALL)


class _DoctypeFoundError(Exception):
    """The text declares a document type: entities could follow, so nothing more is read."""


@dataclass(slots=True)
class _Open:
    """An element whose end has not been read."""

    tag: str
    attributes: tuple[Attribute, ...]
    begin: int
    children: list[Element] = field(default_factory=list)


class _Reader:
    """Builds elements while expat reads."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.encoded = source.text.encode("utf-8", "surrogatepass")
        self.places = BytePlaces(self.encoded)
        self.stack = [_Open("", (), 0)]
        self.parser = expat.ParserCreate("utf-8")
        self.parser.ordered_attributes = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.StartDoctypeDeclHandler = self.refuse_doctype

    def offset(self) -> int:
        """Where the parser stands, in characters."""
        return self.places.place(self.parser.CurrentByteIndex)

    def start(self, tag: str, flat: list[str]) -> None:
        begin = self.offset()
        text = self.source.text
        attributes = []
        for name, value in zip(flat[::2], flat[1::2], strict=True):
            found = re.compile(rf"\s({re.escape(name)}\s*=\s*(\"[^\"]*\"|'[^']*'))").search(text, begin)
            first, last = found.span(1) if found else (begin, begin + len(tag) + 1)
            attributes.append(Attribute(name, value, stretch(self.source, first, last)))
        self.stack.append(_Open(tag, tuple(attributes), begin))

    def end(self, _tag: str) -> None:
        done = self.stack.pop()
        span = stretch(self.source, done.begin, done.begin + len(done.tag) + 1)
        self.stack[-1].children.append(Element(done.tag, done.attributes, tuple(done.children), span))

    def refuse_doctype(self, *_declaration: object) -> None:
        raise _DoctypeFoundError


def is_solver_xml(text: str) -> bool:
    """Whether a text in XML, well-formed or not, configures a solver: its root says so."""
    return _ROOT.search(text) is not None


def read_xml(source: Source) -> tuple[Element | None, list[Diagnostic]]:
    """The root element of `source`, or a diagnostic that says where the text is no XML."""
    reader = _Reader(source)
    try:
        reader.parser.Parse(reader.encoded, True)
    except expat.ExpatError as error:
        at = min(source.line_starts[min(error.lineno, len(source.line_starts)) - 1] + error.offset, len(source.text))
        return None, [NOT_READABLE.at(stretch(source, at, at + 1), reason=expat.ErrorString(error.code))]
    except _DoctypeFoundError:
        at = reader.offset()
        return None, [FORBIDDEN_DOCTYPE.at(stretch(source, at, at + len("<!DOCTYPE")))]
    return reader.stack[0].children[0], []
