"""Coverage in, lines of text out: the share of rules and branches that were exercised, and those that were not."""

from typing import Any

from checker.coverage import Coverage, SiteCoverage
from nddl_lang.text.printable import counted

_MOST = 40


def coverage_text(coverage: Coverage) -> str:
    """What no mission exercised, with its lines."""
    rules = [one for one in coverage.sites if not one.branch]
    branches = [one for one in coverage.sites if one.branch]
    flown = counted(coverage.missions, "mission")
    lines = [f"coverage of {flown}: {_share(rules)} rules fired, {_share(branches)} branches taken"]
    for one in coverage.missed[:_MOST]:
        where = f"{one.place.file}:{one.place.line}"
        lines.append(f"  {where}: {_missed(one)}: {one.place.text.strip()}")
    if len(coverage.missed) > _MOST:
        lines.append(f"  {len(coverage.missed) - _MOST} more")
    return "\n".join(lines) + "\n"


def coverage_data(coverage: Coverage) -> dict[str, Any]:
    """The same as plain data."""
    return {
        "missions": coverage.missions,
        "sites": [
            {
                "file": one.place.file,
                "line": one.place.line,
                "column": one.place.column,
                "rule": one.rule,
                "branch": one.branch or None,
                "missions": one.missions,
            }
            for one in coverage.sites
        ],
    }


def _missed(one: SiteCoverage) -> str:
    if not one.branch:
        return f"the rule of {one.rule} never fired"
    return f"in {one.rule}, never {'true' if one.branch == 'then' else 'false'}"


def _share(sites: list[SiteCoverage]) -> str:
    return f"{sum(one.missions > 0 for one in sites)} of {len(sites)}"
