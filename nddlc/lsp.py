"""`nddlc lsp`: the language server, for editors to start."""

import click

from lsp.project import ServerSettings
from lsp.server import serve
from nddlc.inputs import chosen_dialect, readable
from runtime.user.output import keep_output_apart


@click.command("lsp")
@click.option("-I", "--include", "directories", multiple=True, metavar="DIR", help="Look for included files here too.")
@click.option("--dialect", type=click.Choice(["nddl3", "nddlc"]), help="The same option as before the command.")
@click.option(
    "--trust", "is_trusted", is_flag=True, help="Run the Python of projects, also if the editor does not say so."
)
@click.option("--stdio", is_flag=True, help="Speak over standard input and output, as is done anyway.")
@click.pass_context
def command(
    ctx: click.Context, directories: tuple[str, ...], dialect: str | None, is_trusted: bool, stdio: bool
) -> int:
    """Serve an editor over standard input and output: complaints while typing, and what is under the cursor."""
    del stdio
    readable((), directories)
    keep_output_apart()  # what a trusted project prints must not get into what the editor reads
    return 0 if serve(ServerSettings(chosen_dialect(ctx, dialect), directories, is_trusted)) else 1
