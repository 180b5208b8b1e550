"""`nddlc cluster`: start a Dask cluster on this machine, for a try of `nddlc check --cluster`."""

import os
import time
from importlib.util import find_spec

import click

from nddlc.check import cores
from nddlc.inputs import Unusable
from nddlc.main import named


@click.command()
@click.option("--workers", type=click.IntRange(1), help="Processes; by default one per core.")
@click.option("--port", type=click.IntRange(0, 65535), default=8786, help="Of the scheduler; 0 picks a free one.")
def command(workers: int | None, port: int) -> int:
    """Start a scheduler and workers on this machine; Ctrl-C ends them.

    It listens on this machine only: whoever reaches a Dask scheduler can run any code there.
    """
    if find_spec("distributed") is None:
        raise Unusable("a cluster needs the package `distributed`", "install `nddlc[cluster]`")
    os.environ.setdefault("DASK_DISTRIBUTED__DIAGNOSTICS__NVML", "False")
    make = named("distributed:LocalCluster")
    count = workers or cores()
    with make(
        n_workers=count, threads_per_worker=1, processes=True, host="127.0.0.1", scheduler_port=port,
        dashboard_address=None,
    ) as cluster:  # fmt: skip
        click.echo(f"{count} workers; nddlc check MISSION --cluster {cluster.scheduler_address}")
        try:
            while True:
                time.sleep(3600.0)
        except KeyboardInterrupt:
            click.echo("ended", err=True)
    return 0
