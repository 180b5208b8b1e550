"""Translate T-REX 1's agent file: its elements in, those of T-REX 2 that tell the same agent out.

A reactor there is `<TeleoReactor component=.../>`. Which model it has is no attribute: `AGENT.REACTOR.nddl`.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from checker.codes import MISSING_KEY, NO_FILE, WRONG_TYPE
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.nearest import nearest
from nddl_lang.text.read import read_source
from runtime.solver.configuration.element import Attribute, Element, moved
from runtime.solver.configuration.read_xml import read_xml

REACTOR = "TeleoReactor"
_INCLUDE = "Include"
_COMPONENT = "DeliberativeReactor"  # what has a model
_OTHERS = (
    "reactors in C++ are not here: let a simulator in NDDL (`DeliberativeReactor`) or a reactor in Python "
    "(`<PythonReactor name=... code=.../>`) own their timelines, or play a trace (`<LogPlayer file=.../>`)"
)
_CYCLE = "it is being read already"
_RENAMED = {"lookAhead": "lookahead", "solverConfig": "plan_cfg"}


@dataclass(frozen=True, slots=True)
class _FirstAgentFile:
    """An agent file under translation; `found` looks for a file where the project looks for files."""

    root: Path
    found: Callable[[str], str]
    diagnostics: list[Diagnostic]
    agent: Element

    def elements(self, elements: Iterable[Element], files: tuple[Path, ...]) -> Iterator[Element]:
        """Elements with what they include in their place; `files` are those that are being read."""
        for element in elements:
            if element.tag == _INCLUDE:
                yield from self.included(element, files)
            elif element.tag == REACTOR:
                yield from self.reactor(element)
            else:
                yield element

    def included(self, element: Element, files: tuple[Path, ...]) -> Iterator[Element]:
        name = element.find("name")
        if name is None:
            self.diagnostics.append(MISSING_KEY.at(element.span, table=f"<{_INCLUDE}>", key="name"))
            return
        file = self.root / self.found(name.value)
        if not file.is_file() or file in files:
            self.diagnostics.append(NO_FILE.at(name.span, path=name.value, help=_CYCLE if file in files else None))
            return
        root, diagnostics = read_xml(read_source(file))
        self.diagnostics.extend(diagnostics)
        if root is not None:
            yield from self.elements(moved(root, name.span).children, (*files, file))

    def reactor(self, element: Element) -> Iterator[Element]:
        component = element.find("component")
        if component is None:
            self.diagnostics.append(MISSING_KEY.at(element.span, table=f"<{REACTOR}>", key="component"))
        elif component.value == _COMPONENT:
            yield self.planner(element)
        else:
            close = nearest(component.value, (_COMPONENT,))
            help_ = f"did you mean `{close}`?" if close else _OTHERS
            found = f"`{component.value}`"
            wanted = f"`{_COMPONENT}`"
            self.diagnostics.append(
                WRONG_TYPE.at(component.span, key="component", wanted=wanted, found=found, help=help_)
            )

    def planner(self, element: Element) -> Element:
        """A reactor with a model; without a look-ahead it plans to the end of the mission."""
        attributes = list(_renamed(element))
        name, final_tick = element.find("name"), self.agent.find("finalTick")
        agent = self.agent.find("name")
        if name is not None and agent is not None:
            model = self.found(f"{agent.value}.{name.value}.nddl")
            attributes.append(Attribute("model", model, name.span))
        if element.find("lookAhead") is None and final_tick is not None:
            attributes.append(Attribute("lookahead", final_tick.value, final_tick.span))
        return Element("EuropaReactor", tuple(attributes), element.children, element.span)


def _renamed(element: Element) -> Iterator[Attribute]:
    for attribute in element.attributes:
        if attribute.name != "component":
            yield Attribute(_RENAMED.get(attribute.name, attribute.name), attribute.value, attribute.span)


def of_second_form(agent: Element, root: Path, found: Callable[[str], str], diagnostics: list[Diagnostic]) -> Element:
    """An agent file whose reactors are written as T-REX 2 writes them; what cannot be is told in `diagnostics`."""
    translated = _FirstAgentFile(root, found, diagnostics, agent).elements(agent.children, ())
    return Element(agent.tag, agent.attributes, tuple(translated), agent.span)
