"""Read T-REX's agent file: XML in, the values and places of a mission file out (reference of T-REX, 3.1).

What is read has the form of `mission.toml`, and is checked with it; only what XML can get wrong is told here.
"""

import os
import re
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from checker.codes import MISSING_KEY, NO_EFFECT, NO_FILE, TWICE, UNKNOWN_ELEMENT, UNKNOWN_KEY, WRONG_TYPE
from checker.first_agent_file import REACTOR, of_second_form
from checker.mission_table import MissionText, TomlTable
from compiler.program import TOKEN_TIMES
from nddl_lang.lint.configuration import settings_in
from nddl_lang.text.diagnostic import Note
from nddl_lang.text.nearest import nearest
from nddl_lang.text.read import read_source
from nddl_lang.text.source import Source, Span
from nddl_lang.text.toml_places import Path as Keys
from nddl_lang.text.toml_places import Stretch
from runtime.solver.configuration.element import Attribute, Element, moved
from runtime.solver.configuration.read_xml import read_xml
from runtime.user.transaction_log import SUFFIX, TransactionLogError, read_transaction_log

_CLOCKS = {
    "StepClock": {"steps": "steps"},
    "RealTimeClock": {"percent_use": "percent_use"},
    "FastClock": {},
    "LogClock": {"file": "log"},
}
_SECONDS = {"hours": 3600.0, "minutes": 60.0, "seconds": 1.0, "millis": 1e-3, "micros": 1e-6}
_AGENT = {"name": "name", "finalTick": "final_tick"}
_AGENT_UNREAD = ("allow_empty", "config")
_MODELLED = {
    "name": "name",
    "latency": "latency",
    "lookahead": "lookahead",
    "model": "model",
    "plan_cfg": "solver",
    "solverConfig": "solver",
    "maxSteps": "max_steps",
    "maxDepth": "max_depth",
}
_FILES = ("model", "solver", "log")
_CODED = {"name": "name", "latency": "latency", "lookahead": "lookahead", "code": "code"}
_PLAYED = {"name": "name", "latency": "latency", "lookahead": "lookahead"}
_UNREAD = ("config", "log", "verbose", "all_plans", "relation_gv")  # what T-REX writes beside the mission
_FLAGS = {"true": True, "1": True, "false": False, "0": False}
_DOMAINS = ("int", "float", "bool", "string", "symbol", "enum", "date", "duration")
_CONTENTS = ("Use", "Plugin", "Goal", "EuropaReactor", "PythonReactor", "LogPlayer", REACTOR, *_CLOCKS)
_EUROPA = "europa_pg"  # T-REX's plug-in of the reactors that are at home here


@dataclass(slots=True)
class _AgentFile:
    """An agent file under reading: the values found so far, by the names of `mission.toml`."""

    text: MissionText
    root: Path
    places: dict[Keys, Stretch]
    mission: TomlTable = field(default_factory=dict)
    reactors: list[TomlTable] = field(default_factory=list)
    goals: list[TomlTable] = field(default_factory=list)
    clock: Element | None = None
    steps: TomlTable = field(default_factory=dict)  # how many there are in a tick, as the clock says
    places_of_files: tuple[Path, ...] = field(init=False)

    def __post_init__(self) -> None:
        self.places_of_files = (Path(), *settings_in(self.root).directories)

    def read(self, agent: Element) -> TomlTable:
        """All of a file; `agent` is its root."""
        if agent.tag != "Agent":
            self.text.diagnostics.append(UNKNOWN_ELEMENT.at(agent.span, tag=agent.tag, parent="an agent file"))
            return {}
        agent = self._with_config(agent)
        agent = of_second_form(agent, self.root, self._found, self.text.diagnostics)
        self._put(("mission",), agent.span)
        self._attributes(agent, self.mission, ("mission",), _AGENT, _AGENT_UNREAD)
        self._contents(agent)
        return {"mission": self.mission, "reactor": self.reactors, "goal": self.goals, "clock": self.steps}

    def _contents(self, parent: Element) -> None:
        """What stands in an agent, a plug-in or its `Else`."""
        for child in parent.children:
            match child.tag:
                case "Goal":
                    self._goal(self._with_config(child))
                case "EuropaReactor":
                    self._reactor(self._with_config(child), _MODELLED)
                case "PythonReactor":
                    self._reactor(self._with_config(child), _CODED)
                case "LogPlayer":
                    self._player(self._with_config(child))
                case "Use":
                    self._use(child)
                case "Plugin":
                    self._plugin(child)
                case tag if tag in _CLOCKS:
                    self._clock(child)
                case "Else" if parent.tag == "Plugin":
                    pass  # what holds where the plug-in is not there
                case _:
                    self._complain_of_element(child, parent.tag, _CONTENTS)

    def _plugin(self, plugin: Element) -> None:
        """A plug-in of T-REX is not loaded: what it contains is read as far as it is at home here, else its `Else`."""
        own = [child for child in plugin.children if child.tag != "Else"]
        otherwise = next((child for child in plugin.children if child.tag == "Else"), None)
        if otherwise is not None and not (own and all(child.tag in _CONTENTS for child in own)):
            self._contents(otherwise)
            return
        name = plugin.find("name")
        if not own and (name is None or name.value != _EUROPA):
            self.text.diagnostics.append(NO_EFFECT.at(plugin.span, what="Plugin", help=_NO_PLUGIN))
        self._contents(plugin)

    def _player(self, element: Element) -> None:
        """What a reactor did, from its log; one of T-REX says as well which timelines it had."""
        named = {attribute.name: attribute for attribute in element.attributes}
        name = named["name"].value if "name" in named else ""
        trace = self._found(named["file"].value if "file" in named else f"{name}{SUFFIX}")
        path: Keys = ("reactor", len(self.reactors))
        place = named["file"].span if "file" in named else element.span
        for key in ((), ("code",), ("settings",), ("settings", "trace")):
            self._put((*path, *key), place if key else element.span)
        table: TomlTable = {"code": ":LogPlayer", "settings": {"trace": trace}}
        if trace.endswith(SUFFIX):
            with suppress(OSError, TransactionLogError):  # told where the settings are looked at
                log = read_transaction_log(self.root / trace)
                table |= {"internal": list(log.provided), "external": list(log.used)}
        else:
            table["settings"] = {"trace": trace, "reactor": name}
        self._attributes(element, table, path, _PLAYED, (*_UNREAD, "file"))
        self.reactors.append(table | self._timelines(element, path, is_coded=True))

    def _with_config(self, element: Element) -> Element:
        """An element with what the file named by `config` adds; what stands in the element itself counts first."""
        named = element.find("config")
        if named is None:
            return element
        file = self.root / self._found(named.value)
        if not file.is_file():
            self.text.diagnostics.append(NO_FILE.at(named.span, path=named.value))
            return element
        found, diagnostics = read_xml(read_source(file))
        self.text.diagnostics += diagnostics
        if found is None:
            return element
        # The mission's places are those of one file, so what comes from another stands where that is named.
        own = {attribute.name for attribute in element.attributes}
        added = tuple(Attribute(one.name, one.value, named.span) for one in found.attributes if one.name not in own)
        children = tuple(moved(child, named.span) for child in found.children)
        return Element(element.tag, element.attributes + added, children + element.children, element.span)

    def _reactor(self, element: Element, known: dict[str, str]) -> None:
        path: Keys = ("reactor", len(self.reactors))
        table: TomlTable = {}
        self._put(path, element.span)
        if known is _CODED:
            settings: TomlTable = {}
            given = tuple(one for one in element.attributes if one.name not in _CODED and one.name not in _UNREAD)
            for attribute in given:
                settings[attribute.name] = _value(attribute.value)
                self._put((*path, "settings", attribute.name), attribute.span)
            if given:
                table["settings"] = settings
                self._put((*path, "settings"), element.span)
            self._attributes(element, table, path, known, (*_UNREAD, *(one.name for one in given)))
        else:
            same = element.find("synch_cfg")
            if same is not None:
                self.text.diagnostics.append(NO_EFFECT.at(same.span, what="synch_cfg", help=_ONE_SOLVER))
            self._attributes(element, table, path, known, (*_UNREAD, "synch_cfg"))
        table |= self._timelines(element, path, is_coded=known is _CODED)
        self.reactors.append(table)

    def _timelines(self, element: Element, path: Keys, *, is_coded: bool) -> TomlTable:
        """The timelines that a reactor declares, by the keys of a mission file."""
        lines: dict[str, list[str]] = {"internal": [], "external": [], "observe": []}
        for child in element.children:
            key = child.tag.lower()
            name = child.find("name")
            if child.tag not in ("Internal", "External"):
                self._complain_of_element(child, element.tag, ("Internal", "External"))
            elif name is None:
                self.text.diagnostics.append(MISSING_KEY.at(child.span, table=f"<{child.tag}>", key="name"))
            else:
                self._put((*path, key, len(lines[key])), name.span)
                lines[key].append(name.value)
                self._attributes(child, {}, (), {"name": "name"}, ("goals", "listen"))
                if self._only_observes(child, is_coded=is_coded):
                    self._put((*path, "observe", len(lines["observe"])), name.span)
                    lines["observe"].append(name.value)
        return {key: names for key, names in lines.items() if names}

    def _only_observes(self, timeline: Element, *, is_coded: bool) -> bool:
        """Whether a reactor with a model never asks for anything there: `goals="false"`, of timelines that it uses."""
        asks = True
        for attribute in timeline.attributes:
            if attribute.name not in ("goals", "listen"):
                continue
            given = _FLAGS.get(attribute.value)
            if given is None:
                wanted, found = "`true` or `false`", f"`{attribute.value}`"
                self.text.diagnostics.append(
                    WRONG_TYPE.at(attribute.span, key=attribute.name, wanted=wanted, found=found)
                )
            elif attribute.name == "goals" and timeline.tag == "External" and not is_coded:
                asks = given
            elif given is not (attribute.name == "goals"):  # the other value is what happens anyway
                advice = _ASKS_ITSELF if attribute.name == "goals" else _NO_PLANS
                self.text.diagnostics.append(NO_EFFECT.at(attribute.span, what=attribute.name, help=advice))
        return not asks

    def _goal(self, element: Element) -> None:
        path: Keys = ("goal", len(self.goals))
        table: TomlTable = {}
        parameters: TomlTable = {}
        self._put(path, element.span)
        known = {"on": "timeline", "pred": "predicate", "at": "at", "mandatory": "mandatory"}
        self._attributes(element, table, path, known, ("config", "id"))
        for child in element.children:
            name = child.find("name")
            if child.tag != "Variable":
                self._complain_of_element(child, "Goal", ("Variable",))
            elif name is None:
                self.text.diagnostics.append(MISSING_KEY.at(child.span, table="<Variable>", key="name"))
            else:
                is_time = name.value in TOKEN_TIMES
                keys: Keys = (*path, name.value) if is_time else (*path, "parameters", name.value)
                self._put(keys, name.span, child.span)
                (table if is_time else parameters)[name.value] = self._domain(child, name.value)
        if parameters:
            table["parameters"] = parameters
            self._put((*path, "parameters"), element.span)
        self.goals.append(table)

    def _domain(self, variable: Element, name: str) -> object:
        """The value of a variable, or `[min, max]`."""
        domains = [child for child in variable.children if child.tag in _DOMAINS]
        for child in variable.children:
            if child not in domains:
                self._complain_of_element(child, "Variable", _DOMAINS)
        if len(domains) != 1:
            found = f"{len(domains)} of them"
            self.text.diagnostics.append(
                WRONG_TYPE.at(variable.span, key=name, wanted="one domain, such as `int`", found=found)
            )
            return 0
        (domain,) = domains
        inner = [value for child in domain.children if child.tag == "elem" and (value := child.find("value"))]
        single = domain.find("value") or (inner[0] if len(inner) == 1 else None)
        if single is not None:
            is_text = domain.tag in ("string", "symbol", "enum")
            return single.value if is_text else _value(single.value)
        bounds = [domain.find(key) for key in ("min", "max")]
        if domain.children or not any(bounds):
            self.text.diagnostics.append(
                WRONG_TYPE.at(domain.span, key=name, wanted="a value, or `min` and `max`", found="something else")
            )
            return 0
        ends = (float("-inf"), float("inf"))
        return [end if given is None else _value(given.value) for given, end in zip(bounds, ends, strict=True)]

    def _use(self, element: Element) -> None:
        file = element.find("file")
        if file is None:
            self.text.diagnostics.append(MISSING_KEY.at(element.span, table="<Use>", key="file"))
        elif not (self.root / self._found(file.value)).is_file():
            self.text.diagnostics.append(NO_FILE.at(file.span, path=file.value))

    def _clock(self, element: Element) -> None:
        """A clock says how long a tick is, and how many steps of planners there are in it."""
        if self.clock is not None:
            first = (Note("first here", self.clock.span),)
            self.text.diagnostics.append(TWICE.at(element.span, what="a clock", name=element.tag, notes=first))
            return
        self.clock = element
        self._put(("clock",), element.span)
        if element.tag == "LogClock" and element.find("file") is None:
            self.steps["log"] = "clock.xml"  # T-REX's name for it
        is_timed = element.tag in ("RealTimeClock", "FastClock")
        units = tuple(_SECONDS) if is_timed else ()
        self._attributes(element, self.steps, ("clock",), _CLOCKS[element.tag], (*_UNREAD, *_SECONDS), units)
        seconds = 0.0
        for attribute in element.attributes:
            factor, value = _SECONDS.get(attribute.name), _value(attribute.value)
            if factor is not None and isinstance(value, int | float) and not isinstance(value, bool):
                seconds += factor * value
                self._put(("mission", "tick"), attribute.span)
            elif factor is not None:
                self.text.diagnostics.append(
                    WRONG_TYPE.at(attribute.span, key=attribute.name, wanted="a number", found="a text")
                )
        if seconds and is_timed:
            self.mission["tick"] = seconds

    def _attributes(
        self,
        element: Element,
        table: TomlTable,
        path: Keys,
        known: dict[str, str],
        unread: tuple[str, ...],
        read: tuple[str, ...] = (),
    ) -> None:
        """Put the attributes of an element into a table; those without a meaning, nor `read` elsewhere, are told."""
        for attribute in element.attributes:
            close = nearest(attribute.name, [*known, *read]) if attribute.name not in unread else None
            key = known.get(attribute.name, known.get(close or ""))
            if key is not None:
                is_text = key in ("name", "model", "solver", "code", "timeline", "predicate", "log")
                text = self._found(attribute.value) if key in _FILES else attribute.value
                table[key] = text if is_text else _value(text)
                self._put((*path, key), attribute.span)
            if attribute.name not in known and attribute.name not in unread:
                names = ", ".join([*known, *read]) or "none"
                advice = f"did you mean `{close}`?" if close else f"known attributes: {names}"
                self.text.diagnostics.append(
                    UNKNOWN_KEY.at(attribute.span, key=attribute.name, table=f"<{element.tag}>", help=advice)
                )

    def _found(self, name: str) -> str:
        """A file that is named, from the agent file's folder on: T-REX looks in several, which `include` names here."""
        found = next((place / name for place in self.places_of_files if (self.root / place / name).is_file()), None)
        return name if found is None else Path(os.path.relpath(self.root / found, self.root)).as_posix()

    def _complain_of_element(self, element: Element, parent: str, known: tuple[str, ...]) -> None:
        close = nearest(element.tag, list(known))
        is_reactor = known is _CONTENTS and element.find("latency") is not None
        others = _FOREIGN if is_reactor else "known elements: " + ", ".join(known)
        advice = f"did you mean `{close}`?" if close else others
        self.text.diagnostics.append(
            UNKNOWN_ELEMENT.at(element.span, tag=element.tag, parent=f"<{parent}>", help=advice)
        )

    def _put(self, path: Keys, key: Span, value: Span | None = None) -> None:
        stood = value or key
        self.places.setdefault(path, Stretch((key.begin, key.end), (stood.begin, stood.end)))


_NO_PLUGIN = 'reactors in Python are loaded by `<PythonReactor code="file.py:Class"/>`'
_FIRST_ELEMENT = re.compile(r"\ufeff?(?:\s|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>]*>)*<Agent\b", re.DOTALL)
_FOREIGN = (
    "reactors of T-REX's plug-ins are not here: let a simulator in NDDL (`<EuropaReactor model=.../>`) or a reactor in "
    "Python (`<PythonReactor code=.../>`) own their timelines, or play their log (`<LogPlayer file=.../>`)"
)
_ASKS_ITSELF = "the owner decides what it takes, and a reactor in Python what it asks for"
_NO_PLANS = "plans are not published, only observations"
_ONE_SOLVER = "the present is synchronised with the flaw handling of `plan_cfg`"


def is_agent(source: Source) -> bool:
    """Whether a text in XML is an agent file, by its first element."""
    return _FIRST_ELEMENT.match(source.text) is not None


def read_agent_file(source: Source, root: Path) -> tuple[MissionText, TomlTable | None]:
    """The values of an agent file; None where it is no XML. What is wrong with it stands in the text's diagnostics."""
    places: dict[Keys, Stretch] = {}
    text = MissionText(source, places)
    agent, diagnostics = read_xml(source)
    text.diagnostics += diagnostics
    return text, None if agent is None else _AgentFile(text, root, places).read(agent)


def _value(text: str) -> bool | int | float | str:
    """What the text of an attribute says: a truth value, a number, or itself."""
    if text in ("true", "false"):
        return text == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
