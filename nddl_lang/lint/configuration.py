"""Find and read the configuration of a project: `nddlc.toml`, or `[tool.nddlc]` in `pyproject.toml`."""

import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from nddl_lang.lint.codes import NOT_TOML, UNKNOWN_KEY, WRONG_VALUE
from nddl_lang.lint.settings import ProjectModule, Settings
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.parser import MOST_ASKED_FOR, MOST_LEXEMES
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Severity
from nddl_lang.text.nearest import nearest
from nddl_lang.text.read import NotAFileError, read_text, real_path
from nddl_lang.text.source import Anchor, Source, Span
from nddl_lang.text.toml_places import Path as Key
from nddl_lang.text.toml_places import find_places
from nddl_lang.text.toml_slips import not_toml
from nddl_lang.text.values import toml_value

NAME = "nddlc.toml"
PROJECT = "pyproject.toml"
_SEVERITIES: dict[str, Severity | None] = {**{each.value: each for each in Severity}, "off": None}
_FAIL_ON: dict[str, Severity | None] = {**{each.value: each for each in Severity}, "never": None}
_DIALECTS = {each.value: each for each in Dialect}


def find_configuration(directory: Path) -> Path | None:
    """The file that configures what stands in `directory`: the nearest one upwards, None where there is none."""
    directory = real_path(directory)
    for place in (directory, *directory.parents):
        for name in (NAME, PROJECT):
            path = place / name
            if path.is_file() and (name == NAME or _has_section(path)):
                return path
    return None


def settings_in(directory: Path) -> Settings:
    """The settings of what stands in `directory`, as far as they can be read."""
    path = find_configuration(directory)
    return Settings() if path is None else read_configuration(path)[0]


def _has_section(path: Path) -> bool:
    try:
        text = read_text(path) or ""
    except OSError:
        return False  # for the tools of Python to complain about
    if "nddlc" not in text:
        return False
    try:
        return _section(toml_value(text), None) is not None
    except tomllib.TOMLDecodeError:
        return False  # for the tools of Python to complain about


def _section(project: dict[str, Any], missing: Any = MappingProxyType({})) -> Any:
    """What a project says of nddlc."""
    tools = project.get("tool")
    return tools.get("nddlc", missing) if isinstance(tools, dict) else missing


def read_configuration(path: Path, text: str | None = None) -> tuple[Settings, list[Diagnostic]]:
    """The settings in a file, and what is wrong with it; an editor passes the `text` that is not saved yet."""
    try:
        source = Source(str(path), text if text is not None else read_text(path) or "")
    except NotAFileError as problem:
        place = Span(Anchor(Source(str(path), "")), 0, 0)
        return Settings(), [NOT_TOML.at(place, reason=f"it cannot be read: {problem.strerror}")]
    try:
        table = toml_value(source.text)
    except tomllib.TOMLDecodeError as problem:
        return Settings(), [not_toml(NOT_TOML, source, str(problem))]
    prefix: Key = ()
    reader = _Reader(source, path.parent)
    if path.name == PROJECT:
        prefix, table = ("tool", "nddlc"), _section(table)
    settings = reader.read(table, prefix)
    return settings, reader.complaints


class _Reader:
    """Reads one table of settings and collects what is wrong with it."""

    def __init__(self, source: Source, directory: Path) -> None:
        self._source = source
        self._directory = directory
        self._places = find_places(source.text)
        self.complaints: list[Diagnostic] = []

    def read(self, table: Any, prefix: Key) -> Settings:
        """The settings that the table holds."""
        if not isinstance(table, Mapping):
            self._wrong(prefix, prefix[-1], "a table of settings")
            table = {}
        readers: dict[str, Callable[[Key, Any], dict[str, Any]]] = {
            "select": lambda key, value: {"select": tuple(self._codes(key, value))},
            "ignore": lambda key, value: {"ignore": tuple(self._codes(key, value))},
            "include": lambda key, value: {"directories": tuple(self._directories(key, value))},
            "dialect": lambda key, value: {"dialect": self._one_of(key, value, _DIALECTS)},
            "fail-on": lambda key, value: {"fail_on": self._one_of(key, value, _FAIL_ON, Severity.WARNING)},
            "max-lexemes": lambda key, value: {"most_lexemes": self._count(key, value)},
            "constraints": self._constraints,
            "severity": lambda key, value: {"severities": tuple(self._weights(key, value))},
        }
        settings = Settings(folder=self._directory)
        for name, value in table.items():
            key = (*prefix, name)
            reader = readers.get(name)
            if reader is None:
                self._unknown(key, name, readers)
            else:
                settings = replace(settings, **reader(key, value))
        return settings

    def _codes(self, key: Key, value: Any) -> Iterator[str]:
        for index, item in enumerate(self._texts(key, value)):
            if is_code(item):
                yield item
            else:
                self._wrong((*key, index), item, "a code such as `NDDL501`, or the beginning of one")

    def _directories(self, key: Key, value: Any) -> Iterator[Path]:
        for index, item in enumerate(self._texts(key, value)):
            directory = self._directory / item
            if directory.is_dir():
                yield directory
            else:
                self._wrong((*key, index), item, "a directory, seen from this file")

    def _constraints(self, key: Key, value: Any) -> dict[str, Any]:
        if not isinstance(value, dict):
            self._wrong(key, key[-1], "a table, as in `[constraints]` with `modules`")
            return {}
        found: dict[str, Any] = {}
        for name, item in value.items():
            place = (*key, name)
            match name:
                case "modules":
                    found["modules"] = tuple(self._modules(place, item))
                case "time_limit" if isinstance(item, int | float) and not isinstance(item, bool) and item > 0:
                    found["seconds"] = float(item)
                case "time_limit":
                    self._wrong(place, name, "a number of seconds above 0")
                case _:
                    self._unknown(place, name, {"modules": None, "time_limit": None})
        return found

    def _modules(self, key: Key, value: Any) -> Iterator[ProjectModule]:
        for index, item in enumerate(self._texts(key, value)):
            path = self._directory / item
            if path.is_file():
                yield ProjectModule(path, self._span((*key, index)))
            else:
                self._wrong((*key, index), item, "a Python file, seen from this file", self._file_meant(item))

    def _file_meant(self, name: str) -> str | None:
        """The Python file of that folder that a name was meant to be."""
        folder = (self._directory / name).parent
        with suppress(OSError, ValueError):
            close = nearest(Path(name).name, sorted(each.name for each in folder.glob("*.py")))
            return None if close is None else Path(name).with_name(close).as_posix()
        return None

    def _weights(self, key: Key, value: Any) -> Iterator[tuple[str, Severity | None]]:
        if not isinstance(value, dict):
            self._wrong(key, key[-1], 'a table of codes, as in `NDDL501 = "off"`')
            return
        for code, word in value.items():
            place = (*key, code)
            if not is_code(code):
                self.complaints.append(UNKNOWN_KEY.at(self._span(place, of_key=True), key=code))
            elif not isinstance(word, str) or word not in _SEVERITIES:
                self._wrong(place, code, _choices(_SEVERITIES))
            else:
                yield code, _SEVERITIES[word]

    def _one_of(self, key: Key, value: Any, choices: dict[str, Any], otherwise: Any = None) -> Any:
        if isinstance(value, str) and value in choices:
            return choices[value]
        self._wrong(key, key[-1], _choices(choices))
        return otherwise

    def _count(self, key: Key, value: Any) -> int:
        if isinstance(value, int) and not isinstance(value, bool) and 0 < value <= MOST_ASKED_FOR:
            return value
        self._wrong(key, key[-1], f"a whole number from 1 to {MOST_ASKED_FOR}")
        return MOST_LEXEMES

    def _texts(self, key: Key, value: Any) -> list[str]:
        if isinstance(value, list) and all(isinstance(item, str) for item in value):
            return value
        self._wrong(key, key[-1], "a list of texts", f'["{value}"]' if isinstance(value, str) else None)
        return []

    def _wrong(self, key: Key, name: str | int, wanted: str, meant: str | None = None) -> None:
        help_ = None if meant is None else f"did you mean `{meant}`?"
        self.complaints.append(WRONG_VALUE.at(self._span(key), help=help_, key=name, wanted=wanted))

    def _unknown(self, key: Key, name: str, known: dict[str, Any]) -> None:
        span = self._span(key, of_key=True)
        meant = nearest(name, known)
        fixes = (Fix(f"write `{meant}`", (Edit(span, meant),)),) if meant is not None else ()
        help_ = None if meant else f"there are {', '.join(f'`{each}`' for each in known)}"
        self.complaints.append(UNKNOWN_KEY.at(span, help=help_, fixes=fixes, key=name))

    def _span(self, key: Key, *, of_key: bool = False) -> Span:
        stretch = self._places.get(key)
        begin, finish = (0, 0) if stretch is None else stretch.key if of_key else stretch.value
        return Span(Anchor(self._source), begin, finish)


def _choices(choices: dict[str, Any]) -> str:
    *most, last = (f"`{choice}`" for choice in choices)
    return f"{', '.join(most)} or {last}"


def is_code(text: str) -> bool:
    """Whether a text is a code or the beginning of one."""
    return text.startswith("NDDL") and len(text) <= 7 and (text[4:].isdigit() or text == "NDDL")
