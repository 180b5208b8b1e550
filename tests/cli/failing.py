"""A subcommand that has a bug."""

import click


@click.command()
def command() -> None:
    """Fail."""
    raise ZeroDivisionError("nobody foresaw this")
