"""`nddlc lsp`: the language server, for editors to start."""

from pathlib import Path

import click

from lsp.project import ServerSettings
from lsp.server import serve
from nddl_lang.lint.configuration import NAME, PROJECT, read_configuration
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source
from nddlc.inputs import Unusable, chosen_dialect, readable
from nddlc.main import named
from runtime.user.fault import UserCodeError
from runtime.user.output import keep_output_apart


@click.command("lsp")
@click.option("-I", "--include", "directories", multiple=True, metavar="DIR", help="Look for included files here too.")
@click.option("--dialect", type=click.Choice(["nddl3", "nddlc"]), help="The same option as before the command.")
@click.option(
    "--trust", "is_trusted", is_flag=True, help="Run the Python of projects, also if the editor does not say so."
)
@click.option("--port", type=click.IntRange(0, 65535), help="Wait for the editor on this port of this machine.")
@click.option("--websocket", "is_web", is_flag=True, help="Speak over a WebSocket on that port.")
@click.option("--stdio", is_flag=True, help="Speak over standard input and output, as is done anyway.")
@click.pass_context
def command(
    ctx: click.Context,
    directories: tuple[str, ...],
    dialect: str | None,
    is_trusted: bool,
    port: int | None,
    is_web: bool,
    stdio: bool,
) -> int:
    """Serve an editor over standard input and output: complaints while typing, and what is under the cursor."""
    del stdio
    readable((), directories)
    keep_output_apart()  # what a trusted project prints must not get into what the editor reads
    if is_web and port is None:
        raise Unusable("a WebSocket needs a port", "add --port PORT; 0 takes a free one")
    settings = ServerSettings(chosen_dialect(ctx, dialect), directories, is_trusted)
    return 0 if serve(settings, _examine, port, is_web=is_web) else 1


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
