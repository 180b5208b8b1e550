"""Read a solver's configuration: XML or TOML in, a configuration and diagnostics out."""

import re
from collections.abc import Iterable, Iterator, Sequence

from nddl_lang.text.diagnostic import Code, Diagnostic, Severity
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Source, Span
from runtime.solver.configuration.codes import (
    BOTH_LEVELS,
    EMPTY_VALUES,
    MISPLACED_HANDLER,
    MISSING_ATTRIBUTE,
    NOT_A_NUMBER,
    UNKNOWN_ATTRIBUTE,
    UNKNOWN_CHOICE,
    UNKNOWN_ELEMENT,
    UNKNOWN_FILTER,
    UNKNOWN_HANDLER,
    UNKNOWN_MANAGER,
    WRONG_ROOT,
)
from runtime.solver.configuration.configuration import Configuration, FlawFilter, FlawHandler, FlawManager, Match
from runtime.solver.configuration.element import Attribute, Element, respelt
from runtime.solver.configuration.read_toml import read_toml
from runtime.solver.configuration.read_xml import read_xml
from runtime.solver.configuration.words import (
    CHOICES,
    CONSTRAINTS,
    FILTERS,
    HANDLERS,
    ITERATIONS,
    KEEPS,
    MANAGERS,
    PAIR_ORDERS,
    POLICIES,
    RESOURCE_ORDERS,
    STANDARD,
    TOKEN_ORDERS,
    WINDOW_FILTERS,
)
from runtime.solver.tags import MANAGER_NAMES, NONE, RESOURCE_THREAT, WORST_PRIORITY

_MATCHES = {  # the ways to write an attribute, the one that counts first
    "class_name": ("class-match", "class"),
    "predicate": ("predicate-match", "predicate"),
    "variable": ("var-match", "variable"),
    "parent_class": ("masterClass",),
    "parent_predicate": ("masterPredicate",),
    "parent_relation": ("masterRelation",),
    "token_name": ("tokenName",),
}
_MATCH_NAMES = {name for names in _MATCHES.values() for name in names} | {"label", "component"}
_TABLES = ("guards", "master_guards", "values")  # of a handler in TOML, which are elements in XML
_HANDLER_ATTRIBUTES = {
    "HSTSOpenConditionDecisionPoint": {"choice", "order"},
    "HSTSThreatDecisionPoint": {"order"},
    "ResourceThreatHandler": {"order", "filter", "constraint", "iterate"},
}


def read_configuration(source: Source) -> tuple[Configuration | None, tuple[Diagnostic, ...]]:
    """The configuration that `source` holds, TOML if its name ends so and XML otherwise, or None with an error."""
    _, configuration, complaints = _read(source)
    return configuration, complaints


def _read(source: Source) -> tuple[Element | None, Configuration | None, tuple[Diagnostic, ...]]:
    """The same, with what is written."""
    root, complaints = _elements(source)
    if root is None:
        return None, None, tuple(complaints)
    reading = _Reading(complaints, is_toml=source.name.endswith(".toml"))
    configuration = reading.solver(root)
    refused = any(complaint.severity is Severity.ERROR for complaint in reading.complaints)
    return root, None if refused else configuration, tuple(reading.complaints)


def written_matches(source: Source) -> Iterator[dict[str, Attribute]]:
    """What each filter and handler is to match, by the field of `Match`, as it is written."""
    root, _ = _elements(source)
    waiting = [root] if root is not None else []
    while waiting:
        element = waiting.pop(0)
        waiting += element.children
        if element.tag in ("FlawFilter", "FlawHandler"):
            found = ((field, element.find(*names)) for field, names in _MATCHES.items())
            yield {field: attribute for field, attribute in found if attribute is not None}


def written_managers(source: Source) -> Iterator[tuple[FlawManager, Span]]:
    """The managers of a configuration that can be used, each with the place of its name."""
    root, configuration, _ = _read(source)
    if root is None or configuration is None:
        return
    elements = (child for child in root.children if child.tag != "FlawFilter")
    for manager, element in zip(configuration.managers, elements, strict=True):
        yield manager, (element.find("component") or element).span


def _elements(source: Source) -> tuple[Element | None, list[Diagnostic]]:
    return read_toml(source) if source.name.endswith(".toml") else read_xml(source)


class _Reading:
    """Makes a configuration of elements and gathers what is wrong with them."""

    def __init__(self, complaints: list[Diagnostic], *, is_toml: bool) -> None:
        self.complaints = complaints
        self.is_toml = is_toml

    def solver(self, root: Element) -> Configuration:
        if root.tag != "Solver":
            self.complaints.append(WRONG_ROOT.at(root.span, name=root.tag))
            return Configuration("", (), ())
        filters: list[FlawFilter] = []
        managers = []
        for child in root.children:
            if child.tag == "FlawFilter":
                filters += self.filter(child)
            else:
                managers.append(self.manager(child))
        name = root.find("name")
        return Configuration(name.value if name else "", tuple(filters), tuple(managers))

    def manager(self, element: Element) -> FlawManager:
        named = element.find("component")
        component = named.value if named else element.tag
        component = MANAGERS.get(component, component)
        kind = MANAGER_NAMES.index(component) if component in MANAGER_NAMES else NONE
        known = {"component", "label", "defaultPriority"} | ({"order"} if kind == RESOURCE_THREAT else set())
        if component:
            if kind == NONE:
                self.unknown(UNKNOWN_MANAGER, (named or element).span, component, MANAGER_NAMES)
            self.spare(element, known, ("filter", "handler"))
        else:
            names = {attribute.name: attribute.span for attribute in element.attributes}
            misspelt = nearest("component", names)
            place, help_ = names.get(misspelt or "", element.span), _help(misspelt or "", ("component", *MANAGER_NAMES))
            complaint = MISSING_ATTRIBUTE.at(place, element="manager", name="component", help=help_)
            self.complaints.append(respelt(complaint, misspelt or "", "component", is_key=True))
        default = self.number(element, "defaultPriority", WORST_PRIORITY)
        filters: list[FlawFilter] = []
        handlers: list[FlawHandler] = []
        for child in element.children:
            if child.tag == "FlawFilter":
                filters += self.filter(child)
            elif child.tag == "FlawHandler":
                handlers += self.handler(child, kind, default)
            else:
                self.complaints.append(UNKNOWN_ELEMENT.at(child.span, name=child.tag))
        order = self.words(element, "order", RESOURCE_ORDERS) or ("lower", "most", "earliest")
        if "lower" in order and "upper" in order:
            self.complaints.append(BOTH_LEVELS.at(element.span))
        if not handlers:
            handlers = [FlawHandler(STANDARD.get(kind, ""), priority=default)]
        return FlawManager(component, tuple(filters), tuple(handlers), order)

    def filter(self, element: Element) -> Iterator[FlawFilter]:
        """The filter, unless it leaves out what no reactor plans anyway."""
        component = element.find("component")
        name = component.value if component else "FlawFilter"
        if name not in FILTERS and name not in WINDOW_FILTERS:
            self.unknown(UNKNOWN_FILTER, (component or element).span, name, FILTERS)
        is_horizon = name in ("HorizonFilter", "HorizonVariableFilter")
        self.spare(element, _MATCH_NAMES | ({"policy"} if is_horizon else set()))
        for child in element.children:
            self.complaints.append(UNKNOWN_ELEMENT.at(child.span, name=child.tag))
        policy = self.word(element, "policy", POLICIES)
        if name not in WINDOW_FILTERS:
            yield FlawFilter(name, _match(element), policy)

    def handler(self, element: Element, kind: int, default: float) -> Iterator[FlawHandler]:
        """The handler, unless it mends another kind of flaw."""
        named = element.find("component")
        name = named.value if named else STANDARD.get(kind, "")
        if name not in HANDLERS:
            self.unknown(UNKNOWN_HANDLER, (named or element).span, name, _handlers_of(kind) or HANDLERS)
            return
        if HANDLERS[name][0] != kind:
            if kind != NONE:
                span = (named or element).span
                help_ = _help("", _handlers_of(kind))
                self.complaints.append(MISPLACED_HANDLER.at(span, name=name, manager=MANAGER_NAMES[kind], help=help_))
            return
        self.spare(element, _MATCH_NAMES | {"priority", "maxChoices"} | _HANDLER_ATTRIBUTES.get(name, set()), _TABLES)
        guards, parent_guards, values = [], [], []
        for child in element.children:
            if child.tag == "Guard":
                guards.append(self.pair(child))
            elif child.tag == "MasterGuard":
                parent_guards.append(self.pair(child))
            elif child.tag == "Value" and name == "ValEnum":
                values.append(self.required(child, "val"))
            elif child.tag != "distribution" or name != "Random":
                self.complaints.append(UNKNOWN_ELEMENT.at(child.span, name=child.tag))
        if name == "ValEnum" and not values:
            self.complaints.append(EMPTY_VALUES.at(element.span))
        order = self.words(element, "order", PAIR_ORDERS if kind == RESOURCE_THREAT else TOKEN_ORDERS)
        if not order and name.startswith("HSTS"):
            order = ("early",)
        yield FlawHandler(
            name,
            _match(element),
            tuple(guards),
            tuple(parent_guards),
            self.number(element, "priority", default),
            int(self.number(element, "maxChoices", 0.0)),
            order,
            self.word(element, "choice", CHOICES),
            tuple(values),
            self.word(element, "filter", KEEPS),
            self.word(element, "constraint", CONSTRAINTS),
            self.word(element, "iterate", ITERATIONS),
        )

    def pair(self, element: Element) -> tuple[str, str]:
        return self.required(element, "name"), self.required(element, "value")

    def required(self, element: Element, name: str) -> str:
        attribute = element.find(name)
        if attribute is None:
            self.complaints.append(MISSING_ATTRIBUTE.at(element.span, element=element.tag, name=name))
        return attribute.value if attribute else ""

    def number(self, element: Element, name: str, default: float) -> float:
        attribute = element.find(name)
        if attribute is None:
            return default
        try:
            value = float(attribute.value)
        except ValueError:
            value = -1.0
        if not 0.0 <= value <= WORST_PRIORITY:
            help_ = f"a whole number; 0 is the best, {int(WORST_PRIORITY)} the worst" if "riority" in name else None
            complaint = NOT_A_NUMBER.at(attribute.span, name=self.shown(name), most=int(WORST_PRIORITY), help=help_)
            self.complaints.append(complaint)
            return default
        return value

    def word(self, element: Element, name: str, allowed: tuple[str, ...]) -> str:
        """The value of an attribute that must be one of some words; the first of them where it is not given."""
        return (self.words(element, name, allowed) or allowed)[0]

    def words(self, element: Element, name: str, allowed: tuple[str, ...]) -> tuple[str, ...]:
        attribute = element.find(name)
        if attribute is None:
            return ()
        found = tuple(word.strip() for word in attribute.value.split(","))
        for word in found:
            if word not in allowed:
                choices = ", ".join(f"`{choice}`" for choice in allowed)
                meant = _meant(word, allowed)
                help_ = _question(meant) if meant is not None else None
                complaint = UNKNOWN_CHOICE.at(attribute.span, value=word, name=name, allowed=choices, help=help_)
                self.complaints.append(respelt(complaint, word, meant))
        return tuple(word for word in found if word in allowed)

    def spare(self, element: Element, known: set[str], tables: tuple[str, ...] = ()) -> None:
        """Complain of attributes that nobody reads: they are mostly misspelt, in TOML also for one of `tables`."""
        for attribute in element.attributes:
            if attribute.name not in known:
                shown = [self.shown(name) for name in sorted(known) if not (self.is_toml and "-" in name)]
                shown += tables if self.is_toml else ()
                self.unknown(UNKNOWN_ATTRIBUTE, attribute.span, self.shown(attribute.name), shown, is_key=True)

    def unknown(self, code: Code, span: Span, name: str, known: Iterable[str], *, is_key: bool = False) -> None:
        """Complain of a name that none of the known ones is, with the fix that writes the one that was meant."""
        words = list(known)
        complaint = code.at(span, name=name, help=_help(name, words))
        self.complaints.append(respelt(complaint, name, _meant(name, words), is_key=is_key))

    def shown(self, name: str) -> str:
        """An attribute as the file writes it: `maxChoices` of XML is `max_choices` in TOML."""
        return re.sub(r"[A-Z]", lambda letter: f"_{letter[0].lower()}", name) if self.is_toml else name


def _handlers_of(kind: int) -> list[str]:
    """The handlers that mend flaws of a manager."""
    return [name for name, (mended, *_) in HANDLERS.items() if mended == kind]


def _help(name: str, known: Iterable[str]) -> str:
    """Which of the known words was meant, else all of them."""
    words = list(known)
    meant = _meant(name, words)
    return _question(meant) if meant is not None else "there are: " + ", ".join(f"`{word}`" for word in words)


def _question(meant: str) -> str:
    return f"did you mean `{meant}`?"


def _meant(name: str, words: Sequence[str]) -> str | None:
    """The word that was meant by `name`, None where that is not plain."""
    within = [word for word in words if name and name.casefold() in word.casefold()]
    return nearest(name, words) or (within[0] if len(within) == 1 else None) or _of_same_parts(name, words)


def _of_same_parts(name: str, words: Sequence[str]) -> str | None:
    """The word that has all parts of `name`: `ResourceManager` is short for `ResourceThreatManager`."""
    parts = re.findall("[A-Z][a-z]+", name)
    found = [word for word in words if parts and all(part in word for part in parts)]
    return found[0] if len(found) == 1 else None


def _match(element: Element) -> Match:
    """The match attributes of a filter or handler."""
    found = {field: element.find(*names) for field, names in _MATCHES.items()}
    return Match(**{field: attribute.value for field, attribute in found.items() if attribute is not None})
