"""Clocks: how many decisions planners make in a tick, by a rule, by the time of the day, or as another flight did."""

import json
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from checker.clock_table import clock_log, read_clock_log
from checker.mission import parse_mission, read_mission
from checker.models import load_models
from checker.real_time import RealTimeClock
from nddl_lang.text.source import Source
from nddlc.main import run
from runtime.executive.clocks import FastClock, LogClock, StepClock
from runtime.executive.configuration import AgentConfiguration, ClockConfiguration
from runtime.executive.mission import MissionPrograms, record_mission, run_mission
from runtime.executive.outcome import EventKind, Outcome
from tests.programs import programs_of

GPS = Path(__file__).parents[2] / "models" / "gps"
CALM = {"GPS_HIT_RATE": 1.0, "CURRENT": 0.0}


@cache
def gps() -> tuple[AgentConfiguration, MissionPrograms]:
    """The tutorial's mission."""
    mission, _ = read_mission(GPS / "mission.toml")
    assert mission is not None
    agent = load_models(mission).agent
    return agent, programs_of(agent)


def flown_by(clock: FastClock, *, compiles: bool = True) -> Outcome:
    agent, programs = gps()
    return record_mission(agent, programs, 1, CALM, compiles=compiles, clock=clock)[0]


def first_request(outcome: Outcome) -> int:
    """When the planner asked for something first."""
    return next(event.tick for event in outcome.events if event.kind is EventKind.REQUEST and event.reactor)


def told(outcome: Outcome) -> list[tuple[object, ...]]:
    """What happened, without draws and the numbers of tokens: register code draws and counts when a token begins."""
    events = [one for one in outcome.events if one.kind is not EventKind.SAMPLE]
    return [(one.tick, one.kind, one.reactor, one.timeline, one.predicate, one.arguments) for one in events]


class Hand:
    """A clock on the wall that goes on by some seconds whenever somebody looks at it."""

    def __init__(self, by: float) -> None:
        self.time, self.by, self.slept = 100.0, by, 0.0

    def now(self) -> float:
        self.time += self.by
        return self.time

    def sleep(self, seconds: float) -> None:
        self.time += seconds
        self.slept += seconds


def test_a_step_clock_spreads_a_plan_over_several_ticks() -> None:
    fast, clock = FastClock(), StepClock(4)
    at_once, spread = flown_by(fast), flown_by(clock)
    assert fast.counts[0] > 20
    assert max(clock.counts.values()) == 4
    assert sum(clock.counts.values()) >= fast.counts[0]
    assert first_request(at_once) < first_request(spread)
    assert spread.abort is None and not spread.open_goals


def test_who_simulates_is_never_halted() -> None:
    clock = StepClock(1)
    flown_by(clock)
    assert set(clock.counts.values()) == {1}
    assert told(flown_by(StepClock(1))) == told(flown_by(StepClock(1), compiles=False))


def test_skipped_ticks_change_nothing() -> None:
    agent, programs = gps()
    agent = replace(agent, clock=ClockConfiguration(steps=3))
    assert run_mission(agent, programs, 1, CALM, every_tick=True) == run_mission(agent, programs, 1, CALM)


def test_a_log_clock_flies_as_another_clock_did() -> None:
    for clock in (StepClock(2), RealTimeClock(1.0, 0.3, now=(hand := Hand(0.05)).now, sleep=hand.sleep)):
        flown = flown_by(clock)
        assert flown != flown_by(FastClock())
        again = LogClock(clock.counts)
        assert flown_by(again) == flown
        assert again.counts == clock.counts


def test_beyond_its_log_a_log_clock_is_fast() -> None:
    assert flown_by(LogClock({})) == flown_by(FastClock())


def test_real_time_waits_for_each_tick_and_leaves_planners_their_share() -> None:
    hand, begun = Hand(0.001), list[float]()
    clock = RealTimeClock(0.5, 0.1, lambda tick: begun.append(hand.time - 100.0 - 0.5 * tick), hand.now, hand.sleep)
    outcome = flown_by(clock)
    assert min(begun) >= 0.0  # nothing begins before its time
    assert hand.slept == pytest.approx(0.5 * outcome.last_tick, rel=0.02)
    assert max(clock.counts.values()) <= 51  # looks of a millisecond each in a share of 50 ms
    assert clock.latest < 0.01


def test_a_tick_that_takes_too_long_makes_the_next_one_late() -> None:
    hand = Hand(0.4)
    clock = RealTimeClock(0.1, now=hand.now, sleep=hand.sleep)
    outcome = flown_by(clock)
    assert clock.latest > 0.3
    assert outcome.last_tick == gps()[0].final_tick  # late, and no tick is left out


def test_the_steps_of_a_flight_are_a_file() -> None:
    clock = StepClock(4)
    flown_by(clock)
    counts, found = read_clock_log(Source("clock.xml", clock_log(clock, 0.5)))
    assert dict(counts) == clock.counts and found == []


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("<Clock><tick value='0'/></Clock>", "NDDL703"),
        ("<Clock><tick value='0' count='-1'/></Clock>", "NDDL705"),
        ("<Clock><tick value='0' count='1'/><tick value='0' count='2'/></Clock>", "NDDL707"),
        ("<Clock><tock value='0' count='1'/></Clock>", "NDDL726"),
        ("<Agent/>", "NDDL726"),
        ("<Clock>", "NDDL751"),
    ],
)
def test_what_is_no_log_of_a_clock_is_told(text: str, code: str) -> None:
    assert [one.code.id for one in read_clock_log(Source("clock.xml", text))[1]] == [code]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A copy of the tutorial's mission."""
    for file in GPS.iterdir():
        (tmp_path / file.name).write_text(file.read_text())
    return tmp_path


def test_a_mission_file_and_an_agent_file_have_the_same_clocks(folder: Path) -> None:
    (folder / "c.xml").write_text('<Clock><tick value="3" count="12"/></Clock>')
    (folder / "p.py").write_text("class P: ...\n")
    toml = (GPS / "mission.toml").read_text()
    logged = ClockConfiguration(counts=((3, 12),))
    for table, element, wanted in (
        ("steps = 7", '<StepClock steps="7"/>', ClockConfiguration(7)),
        ('log = "c.xml"', '<LogClock file="c.xml"/>', logged),
        ("percent_use = 40", '<RealTimeClock millis="500" percent_use="40"/>', ClockConfiguration(share=0.4)),
        ("", '<FastClock seconds="1"/>', ClockConfiguration()),
    ):
        files = {
            "m.toml": f"{toml}\n[clock]\n{table}\n",
            "a.xml": f'<Agent name="a" finalTick="9">{element}<PythonReactor name="p" code="p.py:P"/></Agent>',
        }
        for name, text in files.items():
            mission, found = parse_mission(Source(name, text), folder)
            assert mission is not None, found
            assert mission.agent.clock == wanted


def test_a_log_and_a_number_of_steps_exclude_each_other(folder: Path) -> None:
    (folder / "c.xml").write_text("<Clock/>")
    toml = (folder / "mission.toml").read_text()
    for table, code in (
        ('steps = 3\nlog = "c.xml"', "NDDL705"),
        ('log = "d.xml"', "NDDL708"),
        ('log = "."', "NDDL724"),
        ('log = "a\\u0000b"', "NDDL708"),
        ("percent_use = 3", "NDDL705"),
    ):
        mission, found = parse_mission(Source("mission.toml", f"{toml}\n[clock]\n{table}\n"), folder)
        assert mission is None and [one.code.id for one in found] == [code]


def test_a_flight_in_real_time_is_flown_again_from_its_trace(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    mission = folder / "mission.toml"
    text = mission.read_text()
    monkeypatch.chdir(folder)
    words = ["--param", "GPS_HIT_RATE=1.0", "--real-time", "--clock", "c.xml", "--trace", "t.jsonl"]
    for seconds in ("1e-5", "1e-3"):  # who has so little time may plan too late, or not at all
        mission.write_text(text.replace("tick = 1.0", f"tick = {seconds}"))
        assert run(["run", "mission.toml", *words]) in (0, 1)
        assert f"a tick of {float(seconds):g} s began" in capsys.readouterr().out
        head = json.loads((folder / "t.jsonl").read_text().splitlines()[0])
        counts, _ = read_clock_log(Source("c.xml", (folder / "c.xml").read_text()))
        assert head["steps"] == [list(one) for one in counts] != []
        assert run(["replay", "t.jsonl"]) == 0
        assert capsys.readouterr().out.startswith("the same: ")
