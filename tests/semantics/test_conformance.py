"""Whatever of the conformance suite can be judged from the text alone is judged as the suite says."""

import json
from pathlib import Path
from typing import Any

import pytest

from nddl_lang.analysis import analyse_file
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.diagnostic import Diagnostic, Severity

CASES = Path(__file__).parent.parent / "conformance" / "cases"


def first_error(path: Path) -> Diagnostic | None:
    """The first error of a case in the order of execution."""
    diagnostics = analyse_file(path, Dialect.NDDL3, [CASES / "include"]).diagnostics
    return next((each for each in diagnostics if each.severity is Severity.ERROR), None)


def verdict(path: Path, expect: dict[str, Any]) -> str | None:
    """What is wrong with the judgement of a case, None if nothing is."""
    error = first_error(path)
    if error is None:
        return None if expect["load"] == "ok" or expect.get("also_accept") == "ok" else "accepted"
    if expect["load"] == "ok":
        return None if expect.get("also_accept") == "error" else f"refused: {error.message}"
    if expect["line"] not in (None, error.span.line):
        return f"line {error.span.line} in place of {expect['line']}: {error.message}"
    if error.code.kind != expect["error_kind"] and expect.get("also_accept") != "ok":
        return f"kind {error.code.kind} in place of {expect['error_kind']}: {error.message}"
    return None


@pytest.mark.parametrize("prefix", sorted({path.stem.partition("_")[0] for path in CASES.glob("*.json")}))
def test_errors_stand_where_the_suite_expects_them(prefix: str) -> None:
    found = {}
    for path in sorted(CASES.glob(f"{prefix}_*.json")):
        complaint = verdict(path.with_suffix(".nddl"), json.loads(path.read_text(encoding="utf-8"))["expect"])
        if complaint is not None:
            found[path.stem] = complaint
    assert found == {}
