"""TOML of a solver's configuration (docs/plan.md): text in, the elements that the XML would have out, with spans."""

import re
import tomllib
from collections.abc import Iterator

from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Source, Span
from nddl_lang.text.toml_places import Path, find_places
from nddl_lang.text.toml_slips import not_toml
from nddl_lang.text.values import toml_value
from runtime.solver.configuration.codes import NOT_READABLE, UNKNOWN_ELEMENT
from runtime.solver.configuration.element import Attribute, Element, respelt, stretch
from runtime.solver.configuration.read_xml import is_solver_xml

_Table = dict[str, object]
_KEYS = ("name", "filter", "manager")
_TABLE = re.compile(r"^[ \t]*\[\[?[ \t]*(?:manager|filter)\b", re.MULTILINE)


def read_toml(source: Source) -> tuple[Element | None, list[Diagnostic]]:
    """The root element of `source`, or a diagnostic that says where the text is no TOML or no configuration."""
    try:
        table = toml_value(source.text)
    except tomllib.TOMLDecodeError as error:
        return None, [not_toml(NOT_READABLE, source, str(error))]
    return _Converter(source).convert(table)


def is_solver_toml(text: str) -> bool:
    """Whether a text in TOML, well-formed or not, configures a solver: its tables are managers or filters."""
    return _TABLE.search(text) is not None


def is_solver_text(name: str, text: str) -> bool:
    """Whether the text of a file, well-formed or not, configures a solver."""
    return is_solver_toml(text) if name.endswith(".toml") else is_solver_xml(text)


class _Converter:
    """Makes elements of tables."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.places = find_places(source.text)
        self.complaints: list[Diagnostic] = []

    def convert(self, table: _Table) -> tuple[Element, list[Diagnostic]]:
        """The root element, and what had no meaning."""
        children: list[Element] = []
        for name, value in table.items():
            if name == "filter":
                children += [self.element("FlawFilter", *one) for one in self.tables(value, (name,))]
            elif name == "manager":
                children += [self.manager(*one) for one in self.tables(value, (name,))]
            elif name != "name":
                self.complain((name,))
        first = stretch(self.source, 0, len(self.source.line(1)))
        title = Attribute("name", str(table.get("name", "")), first)
        return Element("Solver", (title,), tuple(children), first), self.complaints

    def manager(self, table: _Table, path: Path) -> Element:
        children: list[Element] = []
        plain = dict(table)
        for name, tag in (("filter", "FlawFilter"), ("handler", "FlawHandler")):
            if name in plain:
                children += [self.element(tag, *one) for one in self.tables(plain.pop(name), (*path, name))]
        tag = str(plain.get("component", ""))
        return Element(tag, tuple(self.attributes(plain, path)), tuple(children), self.span(path))

    def element(self, tag: str, table: _Table, path: Path) -> Element:
        span = self.span(path)
        children: list[Element] = []
        plain = {}
        for name, value in table.items():
            if name in ("guards", "master_guards") and isinstance(value, dict):
                guard = "Guard" if name == "guards" else "MasterGuard"
                for variable, wanted in value.items():
                    pair = (Attribute("name", variable, span), Attribute("value", _text(wanted), span))
                    children.append(Element(guard, pair, (), span))
            elif name == "values" and isinstance(value, list):
                children += [Element("Value", (Attribute("val", _text(v), span),), (), span) for v in value]
            else:
                plain[name] = value
        return Element(tag, tuple(self.attributes(plain, path)), tuple(children), span)

    def attributes(self, table: _Table, path: Path) -> Iterator[Attribute]:
        for name, value in table.items():
            text = ",".join(map(_text, value)) if isinstance(value, list) else _text(value)
            yield Attribute(_camel(name), text, self.span((*path, name)))

    def tables(self, value: object, path: Path) -> list[tuple[_Table, Path]]:
        """The tables of an array, or a single one, with their paths."""
        if isinstance(value, dict):
            return [(value, path)]
        if isinstance(value, list) and all(isinstance(entry, dict) for entry in value):
            return [(entry, (*path, number)) for number, entry in enumerate(value)]
        self.complain(path)
        return []

    def span(self, path: Path) -> Span:
        """A key and its value; of a table, the name in its header."""
        while path and path not in self.places:  # a key with escapes
            path = path[:-1]
        place = self.places.get(path)
        return stretch(self.source, place.key[0], place.value[1]) if place else stretch(self.source, 0, 0)

    def complain(self, path: Path) -> None:
        name = ".".join(part for part in path if isinstance(part, str))
        meant = nearest(name, _KEYS) if len(path) == 1 else None
        advice = f"did you mean `{meant}`?" if meant is not None else None
        complaint = UNKNOWN_ELEMENT.at(self.span(path), name=name, help=advice)
        self.complaints.append(respelt(complaint, name, meant, is_key=True))


def _text(value: object) -> str:
    """A TOML value as the XML would have it."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _camel(name: str) -> str:
    """`master_class` as `masterClass`."""
    head, *tail = name.split("_")
    return head + "".join(word.capitalize() for word in tail)
