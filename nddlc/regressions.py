"""What `nddlc check` does first: fly the regression cases beside the mission file, and tell which fail again."""

from pathlib import Path

import click

from checker.campaign import Campaign
from checker.oracle import Verdict
from checker.regression import RegressionError, read_cases, regressions_path
from checker.rendering import failure_text
from nddlc.inputs import Unusable


def regressions_hold(campaign: Campaign, file: Path, *, is_told: bool) -> bool:
    """Whether all cases pass; with `is_told` what fails is printed, else it goes to standard error."""
    place = regressions_path(file)
    try:
        flown = campaign.regressions(read_cases(place))
    except RegressionError as problem:
        raise Unusable(str(problem), f"mend `{place}`, or remove the case") from None
    failed = [(case, result) for case, result in flown if result.verdict is not Verdict.PASS]
    if flown and is_told:
        click.echo(f"regression cases: {len(flown) - len(failed)} of {len(flown)} pass")
    for case, result in failed:
        why = failure_text(result.judgement, result.open_goals)
        click.echo(f"  case `{case.name}` fails again ({case.was}): {result.judgement.code} {why}", err=not is_told)
    return not failed
