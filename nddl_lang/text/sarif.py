"""Results in, a SARIF 2.1.0 log out, for code hosts that show findings at their lines."""

from collections.abc import Iterable
from typing import Any

from nddl_lang.text.diagnostic import Diagnostic, Edit, Severity
from nddl_lang.text.source import Span
from nddl_lang.text.values import json_text

_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note", Severity.HINT: "note"}


def sarif_log(rules: list[dict[str, Any]], results: list[dict[str, Any]]) -> str:
    """One run of nddlc as SARIF text."""
    driver = {"name": "nddlc", "rules": rules}
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}
    document = {"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}
    return json_text(document) + "\n"


def sarif_of(diagnostics: Iterable[Diagnostic]) -> str:
    """Diagnostics as SARIF text, with the fixes that keep the meaning."""
    found = list(diagnostics)
    codes = list(dict.fromkeys(each.code for each in found))
    rules = [
        {
            "id": code.id,
            "shortDescription": {"text": code.template},
            "defaultConfiguration": {"level": _LEVELS[code.severity]},
        }
        for code in codes
    ]
    indices = {code: number for number, code in enumerate(codes)}
    return sarif_log(rules, [_result(each, indices[each.code]) for each in found])


def _result(diagnostic: Diagnostic, index: int) -> dict[str, Any]:
    text = diagnostic.message if diagnostic.help is None else f"{diagnostic.message} ({diagnostic.help})"
    remarks = [note.message for note in diagnostic.notes if note.span is None]
    result: dict[str, Any] = {
        "ruleId": diagnostic.code.id,
        "ruleIndex": index,
        "level": _LEVELS[diagnostic.severity],
        "message": {"text": "; ".join([text, *remarks])},
        "locations": [{"physicalLocation": _physical(diagnostic.span)}],
    }
    related = [
        {"id": number, "message": {"text": note.message}, "physicalLocation": _physical(note.span)}
        for number, note in enumerate(diagnostic.notes)
        if note.span is not None
    ]
    if related:
        result["relatedLocations"] = related
    fixes = [
        {"description": {"text": fix.title}, "artifactChanges": [_change(edit) for edit in fix.edits]}
        for fix in diagnostic.fixes
        if fix.safe
    ]
    if fixes:
        result["fixes"] = fixes
    return result


def _change(edit: Edit) -> dict[str, Any]:
    replacement = {"deletedRegion": _region(edit.span), "insertedContent": {"text": edit.text}}
    return {"artifactLocation": _artifact(edit.span), "replacements": [replacement]}


def _physical(span: Span) -> dict[str, Any]:
    return {"artifactLocation": _artifact(span), "region": _region(span)}


def _artifact(span: Span) -> dict[str, Any]:
    return {"uri": uri_of(span.source.name)}


def uri_of(name: str) -> str:
    """The name of a file as a reference in a SARIF log."""
    kept = "/-._~"
    return "".join(
        letter
        if letter.isascii() and (letter.isalnum() or letter in kept)
        else "".join(f"%{byte:02X}" for byte in letter.encode("utf-8", "replace"))
        for letter in name.replace("\\", "/")
    )


def _region(span: Span) -> dict[str, int]:
    line, column = span.source.locate(span.begin)
    end_line, end_column = span.source.locate(span.finish)
    return {"startLine": line, "startColumn": column, "endLine": end_line, "endColumn": end_column}
