"""The session that `nddlc lsp` serves, with what it asks the checker; loaded after the first answer."""

import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from lsp.project import ServerSettings, read_only
from lsp.server import make_session
from lsp.session import Session
from nddl_lang.lint.codes import UNUSABLE_MODULE
from nddl_lang.lint.configuration import NAME, PROJECT, find_configuration, read_configuration
from nddl_lang.lint.settings import Settings
from nddl_lang.semantics.callables import Callables
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source, Span
from nddlc.known import known_callables
from nddlc.main import named
from runtime.solver.configuration.read_toml import is_solver_text
from runtime.user.fault import UserCodeError


def make_editor_session(dialect: str | None, directories: tuple[str, ...], *, is_trusted: bool) -> Session:
    """A session with the settings of the command line."""
    asked = Dialect(dialect) if dialect is not None else None
    return make_session(ServerSettings(asked, directories, is_trusted, known_to_editor), examine_for_editor)


def known_to_editor(settings: Settings, is_trusted: bool) -> tuple[Callables, tuple[Diagnostic, ...]]:
    """What models of a project may call; where its Python, or that of a package, fails, what is known without it."""
    failed = _rehearsed(settings) if is_trusted else None
    if failed is not None:
        callables = read_only(settings, is_trusted)[0]
        return replace(callables, has_gaps=True), (failed,)
    try:
        return known_callables(settings, is_trusted=is_trusted)
    except UserCodeError as mistake:
        print(f"nddlc: {mistake}", file=sys.stderr)  # editors keep what a server says there
        return read_only(settings, is_trusted)


def _rehearsed(settings: Settings) -> Diagnostic | None:
    """What is wrong with the modules of a project, where its configuration names the one that fails."""
    modules = settings.modules
    return _mistake([each.path for each in modules], settings.seconds, lambda at: modules[at].span)


def _mistake(files: list[Path], seconds: float | None, place: Callable[[int], Span]) -> Diagnostic | None:
    """What is wrong with modules that are to be run; `place` tells where each is named."""
    failed = named("nddlc.rehearsal:rehearse")(files, seconds) if files else None
    if failed is None:
        return None
    at, mistake = failed
    return UNUSABLE_MODULE.at(place(at), reason=str(mistake), help=mistake.advice)


def examine_for_editor(source: Source, root: Path, is_trusted: bool) -> tuple[Diagnostic, ...]:
    """All that is wrong with a mission file, a configuration, a solver's, or what a mission asks of its models.

    The checker is loaded for the first mission file. Python that a mission names is run only for who is trusted.
    """
    path = Path(source.name)
    if path.name in (NAME, PROJECT):
        return tuple(read_configuration(path, source.text)[1])
    configured = find_configuration(path.parent)
    settings = read_configuration(configured)[0] if configured is not None else Settings()
    return tuple(settings.choose(_complaints(source, root, is_trusted)))


def _complaints(source: Source, root: Path, is_trusted: bool) -> Iterator[Diagnostic]:
    is_named_so = source.name.endswith(".toml") and "solver" in Path(source.name).name.lower()
    if is_named_so or is_solver_text(source.name, source.text):
        yield from named("checker.solver_file:examine_solver")(source, root)
        return
    mission, found = named("checker.mission:parse_mission")(source, root)
    yield from found
    if mission is None or (mission.agent.constraints and not is_trusted):
        return
    agent = mission.agent
    files = [Path(agent.root) / each for each in agent.constraints]
    place = mission.text.value_span
    failed = _mistake(files, agent.constraint_seconds, lambda at: place(("constraints", "modules", at)))
    if failed is not None:
        yield failed
    else:
        with suppress(OSError, UserCodeError):
            yield from named("checker.models:load_models")(mission).diagnostics
