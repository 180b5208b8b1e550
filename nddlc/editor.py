"""The session that `nddlc lsp` serves, with what it asks the checker; loaded after the first answer."""

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from lsp.project import ServerSettings
from lsp.server import make_session
from lsp.session import Session
from nddl_lang.lint.configuration import NAME, PROJECT, find_configuration, read_configuration
from nddl_lang.lint.settings import Settings
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source
from nddlc.main import named
from runtime.user.fault import UserCodeError


def make_editor_session(dialect: str | None, directories: tuple[str, ...], *, is_trusted: bool) -> Session:
    """A session with the settings of the command line."""
    asked = Dialect(dialect) if dialect is not None else None
    return make_session(ServerSettings(asked, directories, is_trusted), _examine)


def _examine(source: Source, root: Path, is_trusted: bool) -> tuple[Diagnostic, ...]:
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
    if "solver" in Path(source.name).name.lower():
        yield from named("runtime.solver.configuration.read:read_configuration")(source)[1]
        return
    mission, found = named("checker.mission:parse_mission")(source, root)
    yield from found
    if mission is not None and (is_trusted or not mission.agent.constraints):
        with suppress(OSError, UserCodeError):
            yield from named("checker.models:load_models")(mission).diagnostics
