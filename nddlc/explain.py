"""`nddlc explain`: why one mission of a run failed, from the value that was drawn to the line that gave way."""

from pathlib import Path

import click

from checker.batch.connection import LATEST, StoreError
from checker.batch.explanations import kept_page
from checker.counterfactual.effort import MOST_FLIGHTS, MOST_SECONDS, Bounds
from nddlc.fitting import say
from nddlc.inputs import STORE, Unusable, mission_of_run, present
from nddlc.main import named
from nddlc.trust import trust_option


@click.command()
@click.argument("what", metavar="RUN[#MISSION]", default=LATEST)
@click.option("--mission", "mission_path", type=click.Path(path_type=Path), help="Whose log RUN is.")
@click.option(
    "--format", "style", type=click.Choice(["text", "json", "dot", "svg"]), default="text", help="How to print it."
)
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where runs are kept.")
@click.option("-v", "--verbose", count=True, help="Show all causes and the causal graph; -vv more of it.")
@click.option("--flights", type=click.IntRange(0), default=MOST_FLIGHTS, help=f"Trials at most ({MOST_FLIGHTS}).")
@click.option("--seconds", type=click.FloatRange(0.0), default=MOST_SECONDS, help=f"For these ({MOST_SECONDS:g}).")
@click.option("--events", is_flag=True, help="Print the whole trace too.")
@trust_option
def command(
    what: str,
    mission_path: Path | None,
    style: str,
    store_path: Path,
    verbose: int,
    flights: int,
    seconds: float,
    events: bool,
    is_trusted: bool,
) -> int:
    """Explain why a mission failed.

    RUN is the id that `nddlc check` printed, a mission file for its last run, or `latest`. Without a mission the first
    failed one is explained. With --mission it is a log of T-REX (.tr.log), a directory of such logs, or a trace
    (.jsonl) of that mission: the reactors that ask nobody do what is on record, the others plan anew with the models
    as they are.
    """
    present(mission_path)
    name, mission = (what, None) if mission_path is not None else mission_of_run(what)
    try:
        if mission_path is None and style == "text" and not verbose and not events:
            page = kept_page(store_path, name or LATEST, mission, flights)
            if page is not None:
                say(page)
                return 0
        explained: int = named("nddlc.explanation:explain")(  # only now: what flies missions is large
            name or LATEST,
            mission,
            mission_path=mission_path,
            style=style,
            store_path=store_path,
            verbose=verbose,
            bounds=Bounds(flights, seconds),
            events=events,
            is_trusted=is_trusted,
        )
        return explained
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None
