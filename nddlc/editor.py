"""The session that `nddlc lsp` serves, with what it asks the checker; loaded after the first answer."""

from pathlib import Path

from lsp.project import ServerSettings
from lsp.server import make_session
from lsp.session import Session
from nddl_lang.lint.configuration import NAME, PROJECT, read_configuration
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
    if Path(source.name).name in (NAME, PROJECT):
        return tuple(read_configuration(Path(source.name))[1])
    if "solver" in Path(source.name).name.lower():
        return tuple(named("runtime.solver.configuration.read:read_configuration")(source)[1])
    mission, found = named("checker.mission:parse_mission")(source, root)
    if mission is None or (mission.agent.constraints and not is_trusted):
        return tuple(found)
    try:
        return (*found, *named("checker.models:load_models")(mission).diagnostics)
    except (OSError, UserCodeError):
        return tuple(found)
