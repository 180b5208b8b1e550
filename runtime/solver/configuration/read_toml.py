"""Read a solver's configuration from TOML: text in, the elements that the XML would have, with spans, out.

name = "quick"
[[filter]]
component = "HorizonFilter"
[[manager]]
component = "UnboundVariableManager"
default_priority = 0
[[manager.filter]]
variable = "start"
[[manager.handler]]
component = "ValEnum"
guards = { mode = "fast" }
values = ["b", "a"]
"""

import re
import tomllib
from collections.abc import Iterator

from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source, Span
from nddl_lang.text.toml_places import toml_of
from runtime.solver.configuration.codes import NOT_READABLE, UNKNOWN_ELEMENT
from runtime.solver.configuration.element import Attribute, Element, stretch

PLACE = re.compile(r"\(at line (\d+), column (\d+)\)")
HEADER = re.compile(r"\s*\[\[?\s*([\w.-]+)\s*\]\]?")
KEY = re.compile(r"\s*([\w-]+)\s*=")
TABLES = {"filter": "FlawFilter", "handler": "FlawHandler"}


def read_toml(source: Source) -> tuple[Element | None, list[Diagnostic]]:
    """The root element of `source`, or a diagnostic that says where the text is no TOML or no configuration."""
    try:
        table = tomllib.loads(toml_of(source.text))
    except tomllib.TOMLDecodeError as error:
        found = PLACE.search(str(error))
        at = source.line_starts[int(found[1]) - 1] + int(found[2]) - 1 if found else len(source.text)
        reason = PLACE.sub("", str(error)).strip().lower()
        return None, [NOT_READABLE.at(stretch(source, at, at + 1), reason=reason)]
    return _Converter(source).convert(table)


class _Converter:
    """Makes elements of tables; the n-th table of a header is found again in the text for its span."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.headers: dict[str, list[int]] = {}
        for number, line in enumerate(source.text.splitlines(), 1):
            header = HEADER.match(line)
            if header:
                self.headers.setdefault(header[1], []).append(number)
        self.taken: dict[str, int] = {}
        self.complaints: list[Diagnostic] = []

    def convert(self, table: dict[str, object]) -> tuple[Element, list[Diagnostic]]:
        """The root element, and what had no meaning."""
        children = []
        for name, value in table.items():
            if name == "filter":
                children += [self.element("FlawFilter", entry, "filter") for entry in self.tables(value, name, 1)]
            elif name == "manager":
                children += [self.manager(entry) for entry in self.tables(value, name, 1)]
            elif name != "name":
                self.complain(name, 1)
        attributes = (Attribute("name", str(table.get("name", "")), self.line_span(1)),)
        return Element("Solver", attributes, tuple(children), self.line_span(1)), self.complaints

    def manager(self, table: dict[str, object]) -> Element:
        line = self.next_line("manager")
        children = []
        plain = {}
        for name, value in table.items():
            if name in TABLES:
                entries = self.tables(value, f"manager.{name}", line)
                children += [self.element(TABLES[name], entry, f"manager.{name}") for entry in entries]
            else:
                plain[name] = value
        tag = str(plain.pop("component", ""))
        return Element(tag, tuple(self.attributes(plain, line)), tuple(children), self.line_span(line))

    def element(self, tag: str, table: dict[str, object], header: str) -> Element:
        line = self.next_line(header)
        span = self.line_span(line)
        children = []
        plain = {}
        for name, value in table.items():
            if name in ("guards", "master_guards") and isinstance(value, dict):
                guard = "Guard" if name == "guards" else "MasterGuard"
                for variable, wanted in value.items():
                    pair = (Attribute("name", variable, span), Attribute("value", as_text(wanted), span))
                    children.append(Element(guard, pair, (), span))
            elif name == "values" and isinstance(value, list):
                children += [Element("Value", (Attribute("val", as_text(v), span),), (), span) for v in value]
            else:
                plain[name] = value
        return Element(tag, tuple(self.attributes(plain, line)), tuple(children), span)

    def attributes(self, table: dict[str, object], line: int) -> Iterator[Attribute]:
        for name, value in table.items():
            if isinstance(value, list):
                text = ",".join(as_text(item) for item in value)
            else:
                text = as_text(value)
            yield Attribute(camel(name), text, self.key_span(name, line))

    def tables(self, value: object, name: str, line: int) -> list[dict[str, object]]:
        if isinstance(value, dict):
            return [value]
        if isinstance(value, list) and all(isinstance(entry, dict) for entry in value):
            return value
        self.complain(name, line)
        return []

    def next_line(self, header: str) -> int:
        lines = self.headers.get(header, [])
        index = self.taken.get(header, 0)
        self.taken[header] = index + 1
        return lines[index] if index < len(lines) else 1

    def key_span(self, name: str, line: int) -> Span:
        for number in range(line, len(self.source.line_starts) + 1):
            text = self.source.line(number)
            found = KEY.match(text)
            if found and found[1] == name:
                begin = self.source.line_starts[number - 1] + found.start(1)
                return stretch(self.source, begin, self.source.line_starts[number - 1] + len(text))
            if number > line and HEADER.match(text):
                break
        return self.line_span(line)

    def line_span(self, line: int) -> Span:
        begin = self.source.line_starts[line - 1]
        return stretch(self.source, begin, begin + len(self.source.line(line)))

    def complain(self, name: str, line: int) -> None:
        self.complaints.append(UNKNOWN_ELEMENT.at(self.key_span(name.rpartition(".")[2], line), name=name))


def as_text(value: object) -> str:
    """A TOML value as the XML would have it."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def camel(name: str) -> str:
    """`master_class` as `masterClass`."""
    head, *tail = name.split("_")
    return head + "".join(word.capitalize() for word in tail)
