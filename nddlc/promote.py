"""`nddlc promote`: a failed mission becomes a regression case, which `nddlc check` flies first from then on."""

import re
from pathlib import Path

import click

from checker.batch.connection import LATEST
from checker.regression import RegressionCase, RegressionError, cases_text, read_cases, regressions_path
from nddlc.inputs import STORE, Unusable, write_text
from nddlc.shrink import shrunk_lines, shrunk_mission
from nddlc.trust import trust_option


@click.command()
@click.argument("what", metavar="RUN[#MISSION]", default=LATEST)
@click.option("--name", help="The name of the case; by default what failed and where.")
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where runs are kept.")
@trust_option
def command(what: str, name: str | None, store_path: Path, is_trusted: bool) -> int:
    """Shrink a failed mission and keep it as a regression case.

    It is written beside the mission file, in `MISSION.regressions.toml`; `nddlc check` flies it first, and holds only
    if it passes. A case of the same name is replaced.
    """
    found = shrunk_mission(what, store_path, is_trusted)
    shrunk = found.shrunk
    place = regressions_path(found.mission_file)
    title = name or re.sub(r"[^A-Za-z0-9]+", "-", found.was).strip("-")[:60]
    # It ends when the mission does: by the early end of the shrunk one no goal could be achieved, mended or not.
    case = RegressionCase(title, shrunk.result.seed, found.was, goals=shrunk.goals, parameters=shrunk.values)
    try:
        cases = [one for one in read_cases(place) if one.name != title]
    except RegressionError as problem:
        raise Unusable(str(problem)) from None
    write_text(place, cases_text([*cases, case]))
    click.echo("\n".join(shrunk_lines(found)))
    click.echo(f"kept as case `{title}` in `{place.name}`; `nddlc check` flies it first")
    return 0
