"""A batch gives the same results however it is flown, and loses nothing whatever happens to it."""

import os
import signal
import threading
import time
from pathlib import Path

import pytest

from checker.batch.pool import Flyer, WorkerError, fly_all
from checker.batch.result import MissionResult, read_result, write_result
from checker.batch.store import Run, StoreError, open_store
from checker.batch.worker import Load, Task
from checker.mission import read_mission
from checker.oracle import Verdict
from runtime.executive.configuration import AgentConfiguration
from tests.checker.fake_agent import load_linked, load_nothing, load_slow, load_troubled


def agent() -> AgentConfiguration:
    mission, _ = read_mission(Path("models/gps/mission.toml"))
    assert mission is not None
    return mission.agent


def fly(load: Load, seeds: range, workers: int, time_limit: float = 30.0) -> list[MissionResult]:
    results: list[MissionResult] = []
    tasks = [Task(number, seed) for number, seed in enumerate(seeds, 1)]
    assert not fly_all(load, agent(), tasks, workers, time_limit, results.append)
    return sorted(results, key=lambda result: result.number)


def test_one_and_two_workers_agree() -> None:
    one, two = fly(load_linked, range(100), 1), fly(load_linked, range(100), 2)
    assert [write_result(result) for result in one] == [write_result(result) for result in two]
    assert {result.verdict for result in one} == {Verdict.PASS, Verdict.FAIL}


def test_a_result_survives_json() -> None:
    results = fly(load_linked, range(40), 1)
    assert [read_result(write_result(result)) for result in results] == results
    failed = next(result for result in results if result.verdict is Verdict.FAIL)
    assert failed.has_trace
    assert failed.outcome is not None
    assert failed.outcome.events


def test_crashes_hangs_and_bugs_cost_one_mission_each() -> None:
    results = fly(load_troubled, range(14), 2, time_limit=1.0)
    assert [result.number for result in results] == list(range(1, 15))
    reasons = {result.number: result.judgement.message for result in results if result.verdict is Verdict.ERROR}
    assert reasons == {
        1: "ValueError: a bug of ours",
        2: "took longer than 1 s",
        3: "the process died (exit code 9)",
        11: "ValueError: a bug of ours",
        12: "took longer than 1 s",
        13: "the process died (exit code 9)",
    }


def test_single_flights_survive_the_process_that_flies_them() -> None:
    with Flyer(load_troubled, agent(), 1.0) as flyer:
        verdicts = [flyer.fly(agent(), 1, seed).verdict for seed in (0, 1, 2, 3)]
    assert verdicts[:3] == [Verdict.ERROR] * 3
    assert verdicts[3] is not Verdict.ERROR


def test_models_that_cannot_be_loaded_end_the_batch() -> None:
    with pytest.raises(WorkerError, match="no such engine"):
        fly(load_nothing, range(3), 2)


def test_an_interrupt_keeps_what_is_finished() -> None:
    results: list[MissionResult] = []
    ended: list[float] = []

    def interrupt() -> None:
        while len(results) < 5:
            time.sleep(0.005)
        ended.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt, daemon=True).start()
    tasks = [Task(number, number) for number in range(1, 2_001)]
    assert fly_all(load_slow, agent(), tasks, 2, 30.0, results.append)
    assert time.monotonic() - ended[0] < 1.0
    assert 5 <= len(results) < 2_000


def test_a_store_keeps_runs_and_resumes_them(tmp_path: Path) -> None:
    results = fly(load_linked, range(5), 1)
    run = Run("abcd1234", "/m.toml", 7, 5)
    path = tmp_path / "deep" / "runs.sqlite"
    with open_store(path) as store:
        assert store.begin(run, keep=True) == {}
        for result in results[:3]:
            store.add(run, result)
    with open_store(path) as store:
        assert store.find("latest") == run == store.find("abc")
        assert store.find("ffff") is None
        assert store.begin(run, keep=True) == {result.number: result for result in results[:3]}
        assert store.result(run.id, 2) == results[1]
        assert store.result(run.id, 4) is None
        other = Run("abff0000", "/n.toml", 7, 5)
        store.begin(other, keep=False)
        assert store.find("ab") is None
        assert store.find("latest") == other
        assert store.run_ids() == [other.id, run.id]
        assert store.begin(run, keep=False) == {}
        assert list(store.results(run.id)) == []


def test_a_store_that_is_no_database_is_refused(tmp_path: Path) -> None:
    (tmp_path / "runs.sqlite").write_text("no database at all, and long enough to be sure of it" * 10)
    with pytest.raises(StoreError, match="cannot be opened"), open_store(tmp_path / "runs.sqlite"):
        pass
