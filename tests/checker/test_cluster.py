"""A Dask cluster flies what processes do, and a mission that dies costs itself only."""

import os
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.batch.pool import Batch
from checker.batch.result import MissionResult, write_record
from checker.batch.worker import Fly, Load, Task
from checker.oracle import Verdict
from nddlc.main import run
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import Outcome
from tests.checker.fake_agent import load_linked, load_slow
from tests.checker.test_batch import Taker, agent, fly

pytestmark = pytest.mark.once

distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
    ) as cluster:
        yield cluster.scheduler_address


def fly_there(address: str, load: Load, seeds: range) -> list[MissionResult]:
    cluster = pytest.importorskip("checker.batch.cluster")
    taker = Taker()
    tasks = [Task(number, seed) for number, seed in enumerate(seeds, 1)]
    ended = cluster.Cluster(address).fly(Batch(load, agent(), tasks, 2, 30.0), taker)
    assert ended is None
    return sorted(taker.results, key=lambda result: result.number)


def load_mortal(agent: AgentConfiguration) -> Fly:
    """A fake agent that kills its process in the mission with seed 7, whoever flies it."""
    inner = load_linked(agent)

    def fly_mortal(seed: int) -> Outcome:
        if seed == 7:
            os.kill(os.getpid(), signal.SIGKILL)
            time.sleep(5.0)
        return inner(seed)

    return fly_mortal


@pytest.mark.slow
def test_a_cluster_gives_what_workers_give(address: str) -> None:
    there, here = fly_there(address, load_linked, range(40)), fly(load_linked, range(40), 2)
    assert [write_record(result) for result in there] == [write_record(result) for result in here]


@pytest.mark.slow
def test_a_dying_process_costs_one_mission(address: str) -> None:
    results = fly_there(address, load_mortal, range(24))
    assert [result.number for result in results] == list(range(1, 25))
    assert [result.seed for result in results if result.verdict is Verdict.ERROR] == [7]


@pytest.mark.slow
def test_a_cluster_without_workers_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pytest.importorskip("checker.batch.cluster"), "_DESERTED", 1.0)
    with distributed.LocalCluster(n_workers=1, host="127.0.0.1", dashboard_address=None) as deserted:
        deserted.scale(0)
        results = fly_there(deserted.scheduler_address, load_linked, range(3))
    assert [result.judgement.message for result in results] == ["the cluster has no worker left"] * 3


@pytest.mark.once
@pytest.mark.slow
def test_reports_are_the_same_however_many_fly(
    address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    gps = str(Path("models/gps/mission.toml").resolve())
    monkeypatch.chdir(tmp_path)
    told = []
    for how in (["--workers", "1"], ["--workers", "2"], ["--cluster", address]):
        for sampler, flights in (("random", "1"), ("adaptive", "0")):
            arguments = ["check", gps, "--missions", "18", "--flights", flights, "--no-store", "--format", "json"]
            assert run([*arguments, "--sampler", sampler, *how]) == 1
            told.append((sampler, capsys.readouterr().out))
    assert len(set(told)) == 2


@pytest.mark.slow
def test_what_a_cluster_leaves_when_it_goes_away_ends_as_an_error() -> None:
    """Scheduler and workers end in the middle of a batch: what was flown counts, and nothing is raised."""
    module = pytest.importorskip("checker.batch.cluster")
    cluster = distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
    )

    class Leaver(Taker):
        def is_enough(self) -> bool:
            if len(self.results) > 20 and cluster.status.name == "running":
                cluster.close()
            return False

    taker = Leaver()
    tasks = [Task(number, number) for number in range(1, 1001)]
    assert module.Cluster(cluster.scheduler_address).fly(Batch(load_slow, agent(), tasks, 1, 30.0), taker) is None
    assert sorted(one.number for one in taker.results) == list(range(1, 1001))
    reasons = {one.judgement.message for one in taker.results if one.verdict is Verdict.ERROR}
    assert reasons == {"the cluster has no worker left"}
    assert sum(one.verdict is not Verdict.ERROR for one in taker.results) > 20


def test_an_address_where_no_cluster_answers_is_a_mistake_of_who_gave_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    module = pytest.importorskip("checker.batch.cluster")
    monkeypatch.setattr(module, "_ANSWER", "1s")
    mission = str(Path("models/gps/mission.toml").resolve())
    for address in ("tcp://127.0.0.1:1", "nowhere", "x://y"):
        assert run(["check", mission, "--missions", "3", "--no-store", "--cluster", address]) == 2
        told = capsys.readouterr().err
        assert f"no cluster answers at `{address}`" in told and "help: start one with `nddlc cluster`" in told
