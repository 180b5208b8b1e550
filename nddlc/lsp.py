"""`nddlc lsp`: the language server, for editors to start."""

import click

from lsp.greeting import begin
from lsp.streams import calm_collector, open_wire
from nddlc.main import named
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
    if directories:
        named("nddlc.inputs:readable")((), directories)
    keep_output_apart()  # what a trusted project prints must not get into what the editor reads
    if is_web and port is None:
        raise named("nddlc.inputs:Unusable")("a WebSocket needs a port", "add --port PORT; 0 takes a free one")
    calm_collector()
    with open_wire(port, is_web=is_web, tell=_tell) as wire:
        if wire is None or (begun := begin(wire)) is None:
            return 1
        # Only now is the language loaded, while the editor reads what is offered.
        session = named("nddlc.editor:make_editor_session")(dialect or ctx.obj, directories, is_trusted=is_trusted)
        return 0 if named("lsp.server:serve")(session, wire, begun) else 1


def _tell(port: int) -> None:
    print(f"nddlc: waiting on port {port}", flush=True)
