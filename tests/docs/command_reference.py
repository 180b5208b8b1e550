"""The reference of the command line and its man page, made from the commands; run it to write them anew."""

from collections.abc import Iterator
from html import escape
from pathlib import Path

import click

from nddlc.main import COMMANDS, nddlc

DOCS = Path(__file__).parents[2] / "docs"
_HEAD = """\
# Command line

Made from the commands by `python -m tests.docs.command_reference`; `nddlc COMMAND --help` prints the same.
"""
_MAN_HEAD = r""".TH NDDLC 1 "" "nddlc" "NDDL models"
.ad l
.SH NAME
nddlc \- check, run and explain NDDL models
.SH SYNOPSIS
.B nddlc
[OPTIONS] COMMAND [ARGS]...
"""


def pages() -> dict[str, str]:
    """What each file in `docs` is to hold."""
    return {"commands.md": _HEAD + "".join(_markdown()), "nddlc.1": "".join(_man())}


def _commands() -> Iterator[tuple[click.Context, click.Command]]:
    top = click.Context(nddlc, info_name="nddlc")
    yield top, nddlc
    for name in COMMANDS:
        command = nddlc.get_command(top, name)
        assert command is not None
        yield click.Context(command, info_name=name, parent=top), command


def _markdown() -> Iterator[str]:
    for ctx, command in _commands():
        yield f"\n## {ctx.command_path}\n\n```\n{_usage(ctx)}\n```\n\n{_help(command)}\n"
        options = list(_options(ctx, command))
        if options:
            yield "\n| option | |\n| --- | --- |\n"
        for words, meaning in options:
            yield f"| {_code(words)} | {_cell(meaning)} |\n"
        if isinstance(command, click.Group) and command is not nddlc:
            for name in command.list_commands(ctx):
                inner = command.get_command(ctx, name)
                assert inner is not None
                below = click.Context(inner, info_name=name, parent=ctx)
                yield f"\n### {below.command_path}\n\n```\n{_usage(below)}\n```\n\n{_help(inner)}\n"
                for words, meaning in _options(below, inner):
                    yield f"\n* `{words}`: {meaning}"
                yield "\n"


def _man() -> Iterator[str]:
    yield _MAN_HEAD
    for ctx, command in _commands():
        yield f".SH {_roff(ctx.command_path).upper()}\n.B {_roff(_usage(ctx))}\n.PP\n{_roff(_help(command))}\n"
        for words, meaning in _options(ctx, command):
            yield f".TP\n.B {_roff(words)}\n{_roff(meaning)}\n"
    yield (
        ".SH EXIT STATUS\n0 holds; 1 findings; 2 the command or its configuration is unusable; 3 a bug of nddlc; "
        "130 interrupted.\n"
    )


def _usage(ctx: click.Context) -> str:
    return " ".join([ctx.command_path, *ctx.command.collect_usage_pieces(ctx)]).rstrip()


def _help(command: click.Command) -> str:
    return "\n\n".join(" ".join(part.split()) for part in (command.help or "").split("\n\n"))


def _options(ctx: click.Context, command: click.Command) -> Iterator[tuple[str, str]]:
    for parameter in command.get_params(ctx):
        record = parameter.get_help_record(ctx) if isinstance(parameter, click.Option) else None
        if record is not None:
            yield record


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _code(text: str) -> str:
    """A cell of code: within backquotes the renderer of the site would show the backslash before a bar."""
    return f"`{text}`" if "|" not in text else f"<code>{escape(text).replace('|', '&#124;')}</code>"


def _roff(text: str) -> str:
    escaped = text.replace("\\", "\\e").replace("-", "\\-").replace("\n.", "\n\\&.").replace("\n'", "\n\\&'")
    return escaped.replace("|", "|\\:")


def main() -> None:
    """Write the files."""
    for name, text in pages().items():
        (DOCS / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
