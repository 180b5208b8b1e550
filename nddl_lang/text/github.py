"""Diagnostics in, workflow commands of GitHub Actions out: each becomes a mark at its line."""

from collections.abc import Mapping

from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.printable import printable

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice", Severity.HINT: "notice"}


def github_line(diagnostic: Diagnostic) -> str:
    """One diagnostic as one line."""
    span = diagnostic.span
    line, column = span.source.locate(span.begin)
    end_line, end_column = span.source.locate(span.finish)
    places: dict[str, str | int] = {"file": span.source.name, "line": line, "endLine": end_line}
    if end_line == line:
        places |= {"col": column, "endColumn": max(column, end_column - 1)}
    places["title"] = diagnostic.code.id
    text = "\n".join([diagnostic.message, *([f"help: {diagnostic.help}"] if diagnostic.help is not None else [])])
    return command_line(_COMMANDS[diagnostic.severity], places, text)


def command_line(command: str, properties: Mapping[str, str | int], text: str) -> str:
    """A workflow command: error, warning or notice, with the place that it marks."""
    written = ",".join(f"{name}={_property(str(value))}" for name, value in properties.items())
    return f"::{command} {written}::{_escaped(text)}"


def _escaped(text: str) -> str:
    escaped = text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")
    return printable(escaped)


def _property(text: str) -> str:
    return _escaped(text).replace(":", "%3A").replace(",", "%2C")
