"""Diagnostics in, workflow commands of GitHub Actions out: each becomes a mark at its line."""

from nddl_lang.text.diagnostic import Diagnostic, Severity

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice", Severity.HINT: "notice"}


def github_line(diagnostic: Diagnostic) -> str:
    """One diagnostic as one line."""
    span = diagnostic.span
    line, column = span.source.locate(span.begin)
    end_line, end_column = span.source.locate(span.finish)
    places = {"file": span.source.name, "line": line, "endLine": end_line}
    if end_line == line:
        places |= {"col": column, "endColumn": max(column, end_column - 1)}
    places["title"] = diagnostic.code.id
    text = "\n".join([diagnostic.message, *([f"help: {diagnostic.help}"] if diagnostic.help is not None else [])])
    properties = ",".join(f"{name}={_property(str(value))}" for name, value in places.items())
    return f"::{_COMMANDS[diagnostic.severity]} {properties}::{_escaped(text)}"


def _escaped(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _escaped(text).replace(":", "%3A").replace(",", "%2C")
