"""Models as they would be with other texts, in memory: read, compiled and flown without a file being written."""

from collections.abc import Callable
from functools import cache, lru_cache, partial
from pathlib import Path

from checker.batch.worker import Fly
from checker.flight import fly_programs, load_code, load_solver
from checker.mutation.edits import SmallEdit, edited
from compiler.lower import compile_model
from compiler.program import Program
from nddl_lang.analysis import Analyser
from nddl_lang.lint.configuration import settings_in
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import LoadedModules, load_module_graph
from nddl_lang.syntax.parser import MOST_ASKED_FOR, Parse, parse, parse_members
from nddl_lang.text.read import read_over
from nddl_lang.text.source import Source
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms
from runtime.executive.outcome import Outcome
from runtime.user.library import Library, load_library

Overlay = tuple[tuple[str, str], ...]  # real paths of files, and their texts
_MOST_PARSES = 256
_MOST_PROGRAMS = 32


class _UnreadableEditError(ValueError):
    """A text that no longer is a model."""


def open_over(overlay: Overlay) -> Callable[[Path], str | None]:
    """Opens files as `overlay` has them, and others as they are."""
    return read_over({Path(name): text for name, text in overlay})


def with_edit(overlay: Overlay, edit: SmallEdit) -> Overlay:
    """The overlay with one more edit, of the text that its file has in it."""
    text = open_over(overlay)(Path(edit.file))
    assert text is not None
    return (*(one for one in overlay if one[0] != edit.file), (edit.file, edited(text, edit)))


def load_over(overlay: Overlay, agent: AgentConfiguration, *, tells_on: bool = True) -> Fly:
    """Compile the models of `agent` with texts of files replaced; the result flies one mission per call.

    Without `tells_on` only the verdict of a failure is told in full (see `fly_programs`). What the change does not
    reach is compiled once per process. Of what is no model each flight raises `_UnreadableEditError`.
    """
    root = Path(agent.root)
    reader = _reader(root, agent.constraints, agent.constraint_seconds)
    try:
        programs = tuple(reader.program(root / each.model, overlay) for each in agent.reactors)
    except _UnreadableEditError as problem:
        return partial(_raise, problem)  # when it is to fly: the process has other trials to make
    solvers = tuple(_solver(root, each.solver) for each in agent.reactors)
    code = _code(root, agent.coded)
    return partial(fly_programs, agent, MissionPrograms(programs, solvers, reader.constraints, code), tells_on=tells_on)


def _raise(problem: _UnreadableEditError, _: int) -> Outcome:
    raise problem


_solver, _code = cache(load_solver), cache(load_code)


@lru_cache(maxsize=_MOST_PARSES)
def _parsed(name: str, text: str, dialect: Dialect, is_in_class: bool) -> Parse:
    source = Source(name, text)
    return (parse_members if is_in_class else parse)(source, dialect, MOST_ASKED_FOR)


def load_graph(path: Path, overlay: Overlay) -> LoadedModules:
    """A model with all that it includes; texts that were parsed before are not parsed again."""
    settings = settings_in(path.parent)
    return load_module_graph(
        path,
        settings.directories,
        settings.dialect,
        open_text=open_over(overlay),
        most=MOST_ASKED_FOR,  # that it is not too large was seen before
        parse_text=lambda _, source, dialect, is_in_class: _parsed(source.name, source.text, dialect, is_in_class),
    )


class _Reader:
    """Compiles models again and again, of which most stays as it was."""

    def __init__(self, library: Library) -> None:
        self.constraints = library.constraints
        self._callables = library.callables
        self._analysers: dict[Path, Analyser] = {}
        self._programs: dict[tuple[Path, tuple[Parse, ...]], Program] = {}

    def program(self, path: Path, overlay: Overlay) -> Program:
        """The compiled model at `path`."""
        loaded = load_graph(path, overlay)
        key = (path, loaded.parses)
        if key not in self._programs:
            analysis = self._analysers.setdefault(path, Analyser(self._callables)).analyse(loaded)
            if analysis.has_errors:
                raise _UnreadableEditError(str(path))
            while len(self._programs) >= _MOST_PROGRAMS:
                self._programs.pop(next(iter(self._programs)))
            self._programs[key] = compile_model(analysis)
        return self._programs[key]


@lru_cache(maxsize=4)
def _reader(root: Path, constraints: tuple[str, ...], seconds: float) -> _Reader:
    return _Reader(load_library(root, constraints, seconds=seconds))
