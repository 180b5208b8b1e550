"""A batch gives the same results however it is flown, and loses nothing whatever happens to it."""

import multiprocessing
import os
import re
import signal
import sqlite3
import sys
import threading
import time
from pathlib import Path
from types import ModuleType

import pytest

from checker.batch.connection import Run, StoreError
from checker.batch.pool import Batch, fly_all
from checker.batch.process import Flyer, WorkerError, keeping_a_worker
from checker.batch.result import MissionResult, read_record, write_record
from checker.batch.store import open_store
from checker.batch.worker import Fly, Load, Task
from checker.mission import read_mission
from checker.models import load_models
from checker.one_flight import FlightSettings
from checker.one_flight import fly as fly_alone
from checker.oracle import Judgement, Verdict
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed
from compiler.program import DomainConstant
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import (
    Abort,
    ChoiceKind,
    Conflict,
    ConflictElement,
    Deadlock,
    Draw,
    ElementKind,
    Event,
    EventKind,
    FailedChoice,
    OpenGoal,
    Outcome,
    Phase,
    PresentChoice,
    Reason,
    ReasonKind,
    RepairStage,
    SourcePlace,
    TimeBounds,
)
from runtime.executive.rendering import trace_json
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import ResourceTerm, Term
from runtime.solver.learning.attempts import Flaw, Resolver, ResolverKind
from tests.checker.fake_agent import load_greedy, load_linked, load_nothing, load_slow, load_troubled


def agent() -> AgentConfiguration:
    mission, _ = read_mission(Path("models/gps/mission.toml"))
    assert mission is not None
    return mission.agent


def load_telling(agent: AgentConfiguration) -> Fly:
    """A fake agent whose missions say what the environment is."""

    def fly_telling(seed: int) -> Outcome:
        raise ValueError(os.environ["HARBOUR"], os.getppid())

    return fly_telling


class Taker:
    """Takes results, and never has enough."""

    def __init__(self) -> None:
        self.results: list[MissionResult] = []

    def take(self, result: MissionResult) -> None:
        self.results.append(result)

    def is_enough(self) -> bool:
        return False


def fly(load: Load, seeds: range, workers: int, time_limit: float = 30.0) -> list[MissionResult]:
    taker = Taker()
    tasks = [Task(number, seed) for number, seed in enumerate(seeds, 1)]
    assert fly_all(Batch(load, agent(), tasks, workers, time_limit), taker) is None
    return sorted(taker.results, key=lambda result: result.number)


def test_one_and_two_workers_agree() -> None:
    one, two = fly(load_linked, range(100), 1), fly(load_linked, range(100), 2)
    assert [write_record(result) for result in one] == [write_record(result) for result in two]
    assert {result.verdict for result in one} == {Verdict.PASS, Verdict.FAIL}


def test_a_mission_of_a_batch_flown_alone_has_the_same_trace() -> None:
    """Whatever the worker flew before it, and however the trace came here (trex 4 row 20)."""
    mission, _ = read_mission(Path("models/gps/mission.toml"))
    assert mission is not None
    models = load_models(mission)
    taker = Taker()
    tasks = [Task(number, mission_seed(7234, number), keeps_trace=True) for number in (15, 16, 17)]
    fly_all(Batch(pinned(models), models.agent, tasks, 1, 60.0), taker)
    assert [one.verdict for one in taker.results] == [Verdict.PASS, Verdict.FAIL, Verdict.PASS]
    for result in taker.results:
        alone = fly_alone(mission, models, FlightSettings(result.seed, {}))
        assert result.outcome is not None
        flown = [trace_json(event) for event in result.outcome.events]
        assert flown == [trace_json(event) for event in alone.outcome.events]
        assert len(flown) > 20


def test_a_result_survives_json() -> None:
    results = fly(load_linked, range(40), 1)
    assert [read_record(MissionResult, write_record(result)) for result in results] == results
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


@pytest.mark.skipif(sys.platform == "win32", reason="there is no limit of memory there")
def test_a_mission_that_needs_too_much_memory_or_has_no_end_is_an_error_and_the_next_is_flown() -> None:
    results = fly(load_greedy, range(1, 5), 1)
    told = {one.seed: one.judgement.message for one in results if one.judgement.verdict is Verdict.ERROR}
    assert told == {2: "there was not enough memory for it", 3: "no end was found"}
    assert len(results) == 4


def test_single_flights_survive_the_process_that_flies_them() -> None:
    with Flyer(load_troubled, agent(), 1.0) as flyer:
        assert flyer.processor_seconds == 0.0
        verdicts = [flyer.fly(agent(), 1, seed).verdict for seed in (0, 1, 2, 3)]
        taken = flyer.processor_seconds
        flyer.dismiss()
        assert flyer.processor_seconds >= taken > 0.0  # what those took that have ended is known
    assert verdicts[:3] == [Verdict.ERROR] * 3
    assert verdicts[3] is not Verdict.ERROR


def test_a_worker_is_kept_for_later_flights_where_that_is_wanted() -> None:
    others = {process.pid for process in multiprocessing.active_children()}

    def alive() -> set[int | None]:
        return {process.pid for process in multiprocessing.active_children()} - others

    configuration = agent()
    with keeping_a_worker():
        tasks = [Task(number, number) for number in range(1, 5)]
        assert fly_all(Batch(load_linked, configuration, tasks, 2, 30.0), Taker()) is None
        kept = alive()
        assert len(kept) == 1
        for seed in (1, 2):
            with Flyer(load_linked, configuration, 30.0) as flyer:
                assert flyer.fly(configuration, 1, seed).verdict is not Verdict.ERROR
                assert alive() == kept
        with Flyer(load_troubled, configuration, 30.0) as flyer:
            assert flyer.fly(configuration, 1, 4).verdict is not Verdict.ERROR
            assert alive() > kept
    assert not alive()
    assert fly_all(Batch(load_linked, configuration, tasks, 2, 30.0), Taker()) is None
    assert not alive()


def test_models_that_cannot_be_loaded_end_the_batch() -> None:
    with pytest.raises(WorkerError, match="no such engine"):
        fly(load_nothing, range(3), 2)


def test_an_interrupt_keeps_what_is_finished() -> None:
    taker = Taker()
    results = taker.results
    ended: list[float] = []

    def interrupt() -> None:
        while len(results) < 5:
            time.sleep(0.005)
        ended.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt, daemon=True).start()
    tasks = [Task(number, number) for number in range(1, 2_001)]
    assert fly_all(Batch(load_slow, agent(), tasks, 2, 30.0), taker) is signal.SIGINT
    assert time.monotonic() - ended[0] < 1.0
    assert 5 <= len(results) < 2_000


def test_a_signal_that_comes_with_the_last_result_is_told() -> None:
    class Stopping(Taker):
        def take(self, result: MissionResult) -> None:
            super().take(result)
            if len(self.results) == 3:
                os.kill(os.getpid(), signal.SIGTERM)

    taker = Stopping()
    tasks = [Task(number, number) for number in range(1, 4)]
    assert fly_all(Batch(load_linked, agent(), tasks, 1, 30.0), taker) is signal.SIGTERM
    assert len(taker.results) == 3


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
        assert store.results(run.id) == ()


def test_a_store_that_is_no_database_is_refused(tmp_path: Path) -> None:
    (tmp_path / "runs.sqlite").write_text("no database at all, and long enough to be sure of it" * 10)
    with pytest.raises(StoreError, match="is no store of nddlc"), open_store(tmp_path / "runs.sqlite"):
        pass


def test_a_store_of_another_version_is_refused_by_its_name(tmp_path: Path) -> None:
    path = tmp_path / "runs.sqlite"
    with open_store(path) as store:
        store.begin(Run("abcd1234", "/m.toml", 7, 5), keep=True)
    with open_store(path) as store:
        assert store.run_ids() == ["abcd1234"]
    connection = sqlite3.connect(path)
    connection.execute("PRAGMA user_version = 0")
    connection.close()
    with (
        pytest.raises(StoreError, match=r"of an older nddlc: it has format 1, this one reads format 5"),
        open_store(path),
    ):
        pass


def test_whatever_an_event_carries_survives_json() -> None:
    spot = VariableName("spot", "symbol", TokenName("Rover.At", 4), True, "rover")
    terms = (Term("bounds", (spot, 1, 2), ("a", "b")), Term("leq", (spot, 2.5)))
    full = ResourceTerm("battery", 1, 3, 4, 2.0, 1.0, 0.5, False, True, (("Rover.At#4", 2.0),))
    place = SourcePlace("m.nddl", 1, 2, "x;")
    conflict = Conflict(
        (
            ConflictElement(ElementKind.DECISION, place, "Rover.At", spot.token, terms[0], terms),
            ConflictElement(ElementKind.RESOURCE, None, "", None, full, (Term("resource", ("battery",)),)),
            ConflictElement(ElementKind.SHARED_END, None, "", spot.token, None, (), ("At", "rover")),
        )
    )
    inner = Deadlock(Flaw(2, "Rover.At#4"), tried=(FailedChoice(Resolver(ResolverKind.REJECT), conflict),))
    choice = PresentChoice(ChoiceKind.NEXT, spot.token)
    deadlock = Deadlock(None, "rover", (FailedChoice(choice, None, inner),))
    bounds = TimeBounds((0, 3), (-4503599627370495, 5), (1, 9))
    domain = DomainConstant("int", "int", (3, 4), None)
    reason = Reason(ReasonKind.NO_INSERTION, spot.token, tick=3)
    events = (
        Event(3, Phase.REPAIR, EventKind.RELAX, "rover", stage=RepairStage.REPLAN, reason=reason, conflict=conflict),
        Event(
            3, Phase.DISPATCH, EventKind.REQUEST, "", "rover", "At", (("n", domain),), (0,), bounds=bounds, request=-1
        ),
        Event(4, Phase.SYNCHRONISE, EventKind.SAMPLE, "rover", draw=Draw("P", 4, 1.5, 1.0)),
        Event(5, Phase.END, EventKind.ABORT, "rover", code="F4", reason=reason, deadlock=deadlock),
    )
    abort = Abort("F4", 5, "rover", ("rover",), reason, conflict, 1, 3, (conflict,), deadlock)
    goal = OpenGoal("rover", "At", (("n", domain),), reason, 1)
    outcome = Outcome(7, 5, 9, abort, (Draw("P", 4, 1.5, 1.0),), events, (goal,))
    result = MissionResult(1, 7, Judgement(Verdict.FAIL, "F4", reason), outcome, has_trace=True)
    assert read_record(MissionResult, write_record(result)) == result
    assert write_record(read_record(MissionResult, write_record(result))) == write_record(result)


def test_a_worker_has_the_environment_of_now_and_never_runs_the_program_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = ModuleType("__main__")
    program.__file__ = str(tmp_path / "program.py")
    (tmp_path / "program.py").write_text("raise SystemExit(5)\n", encoding="utf-8")
    monkeypatch.setitem(sys.modules, "__main__", program)
    told = []
    for harbour in ("Brest", "Kiel"):
        monkeypatch.setenv("HARBOUR", harbour)
        with Flyer(load_telling, agent(), 30.0) as flyer:
            told.append(flyer.fly(agent(), 1, 1).judgement.message)
    copied = re.fullmatch(r"ValueError: \('Brest', (\d+)\)", told[0])
    assert copied is not None
    assert told[1] == f"ValueError: ('Kiel', {copied.group(1)})"
    assert int(copied.group(1)) != os.getpid()  # but of what has imported all that flies
    assert sys.modules["__main__"] is program
