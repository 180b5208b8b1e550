"""Reactors written in Python: what they publish and ask for, and that what they do wrong ends them alone."""

from dataclasses import replace
from pathlib import Path

import pytest

from checker.logged import read_mission_log
from checker.mission import read_mission
from checker.models import load_models
from checker.one_flight import FlightSettings, first_departure, fly, read_trace, trace_text
from checker.oracle import judge
from checker.pinned import pinned
from nddlc.main import run
from runtime.executive.outcome import EventKind, Outcome
from tests.executive.flying import history, lines

CLASSES = """#include "TREX.nddl"
class Lamp extends AgentTimeline { predicate Off { } predicate On { int n; } Lamp(Mode m) { super(m, "Off"); } }
enum Hue { red, green }
class Eye extends AgentTimeline {
    predicate Dark { }
    predicate Bright { float p; }
    predicate Hued { Hue hue; }
    Eye(Mode m) { super(m, "Dark"); }
}
"""
OWNER = f"{CLASSES}Lamp::On {{ duration == 5; }} Lamp lamp = new Lamp(Internal); close();"
USER = f"{CLASSES}Eye eye = new Eye(Observe); close();"
MISSION = """
[mission]
name = "eye"
final_tick = 20
on_failure = "{on_failure}"
[[reactor]]
name = "sim"
model = "sim.nddl"
lookahead = 10
internal = ["lamp"]
[[reactor]]
name = "eye"
code = "{code}"
internal = ["eye"]
external = ["lamp"]
[reactor.settings]
level = 0.75
[[reactor]]
name = "user"
model = "user.nddl"
lookahead = 10
external = ["eye"]
"""
CODE = """
from runtime.user.reactor import Reactor

class Eye(Reactor):
    def tick(self, now):
        if now.tick == 0:
            now.publish("eye", "Dark")
            now.ask("lamp", "On", start=(3, 8), n=4)
            self.late = now.ask("lamp", "On", start=(15, 18), n=5)
        elif "lamp" in now.news and now.seen["lamp"].predicate == "On":
            now.publish("eye", "Bright", p=self.settings["level"] * now.seen["lamp"].arguments["n"])
            now.recall(self.late)

class Raises(Reactor):
    def tick(self, now):
        now.wake(4 if now.tick < 4 else now.tick + 1)
        if now.tick == 4:
            return 1 // 0

class Foreign(Reactor):
    def tick(self, now):
        now.publish("lamp", "On", n=1)

class Odd(Reactor):
    def tick(self, now):
        now.publish("eye", "Bright", p=object())

class Generator(Reactor):
    def tick(self, now):
        yield now.publish("eye", "Dark")

class Large(Reactor):
    def tick(self, now):
        now.publish("eye", "Bright", p=10**400)

class Sleeps(Reactor):
    wakes_on = ()

    def tick(self, now):
        if now.tick == 0:
            now.publish("eye", "Dark")
            now.ask("lamp", "On", start=(3, 8), n=4)
            now.wake(10)
            now.wake(10**30)
        else:
            now.publish("eye", "Bright", p=float(now.tick + 100 * len(now.news) + now.seen["lamp"].since))

class Hues(Reactor):
    def tick(self, now):
        now.publish("eye", "Hued", hue=("red", "green")[now.tick % 2])

class Blue(Reactor):
    def tick(self, now):
        now.publish("eye", "Hued", hue="blue")

class Dice(Reactor):
    wakes_on = ("lamp",)

    def tick(self, now):
        now.publish("eye", "Bright", p=float(self.settings["seed"]))

class Deaf(Reactor):
    wakes_on = ("ear",)

class Hangs(Reactor):
    def tick(self, now):
        while now.tick == 0:
            pass
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with the models and the code."""
    (tmp_path / "sim.nddl").write_text(OWNER)
    (tmp_path / "user.nddl").write_text(USER)
    (tmp_path / "code.py").write_text(CODE)
    return tmp_path


def flown(folder: Path, code: str, on_failure: str = "abort_agent", seconds: float = 5.0) -> Outcome:
    """Fly the mission with one of the classes."""
    path = folder / "mission.toml"
    path.write_text(MISSION.format(code=code, on_failure=on_failure))
    mission, found = read_mission(path)
    assert mission is not None, found
    models = load_models(mission)
    assert not models.has_errors
    return pinned(models)(replace(models.agent, constraint_seconds=seconds))(1)


def test_it_publishes_asks_and_takes_back(folder: Path) -> None:
    outcome = flown(folder, "code.py:Eye")
    assert judge(outcome).code == ""
    assert history(outcome, "lamp") == ["0 Off", "3 On(n=4)", "8 Off"]
    assert history(outcome, "eye") == ["0 Dark", "3 Bright(p=3.0)"]
    assert lines(outcome, "request", "recall") == [
        "0 request eye lamp On(n=4)",
        "0 request eye lamp On(n=5)",
        "3 recall eye lamp On(n=5)",
    ]


def test_it_sleeps_through_what_it_does_not_want_to_be_woken_by(folder: Path) -> None:
    outcome = flown(folder, "code.py:Sleeps")
    assert history(outcome, "lamp") == ["0 Off", "3 On(n=4)", "8 Off"]
    assert history(outcome, "eye") == ["0 Dark", "10 Bright(p=18.0)"]


@pytest.mark.parametrize(
    ("name", "code", "tick"),
    [(name, "F9", 0) for name in ("Foreign", "Odd", "Deaf", "Generator", "Large", "Blue")] + [("Raises", "F7", 4)],
)
def test_what_it_does_wrong_ends_it(folder: Path, name: str, code: str, tick: int) -> None:
    outcome = flown(folder, f"code.py:{name}")
    assert outcome.abort is not None
    assert (outcome.abort.code, outcome.abort.tick, outcome.abort.reactor) == (code, tick, "eye")
    assert outcome.abort.reason.message


@pytest.mark.parametrize(("name", "text"), [("Raises", "return 1 // 0"), ("Hangs", "while now.tick == 0:")])
def test_it_is_told_by_its_line_from_wherever_it_is_flown(
    folder: Path, name: str, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its file was known by another name from outside of its folder, and the message said `code.py:1`."""
    line = next(number for number, each in enumerate(CODE.splitlines(), 1) if text in each)
    for place, seen in ((folder, Path()), (folder.parent, Path(folder.name)), (Path("/"), folder)):
        monkeypatch.chdir(place)
        abort = flown(seen, f"code.py:{name}", seconds=0.2).abort
        assert abort is not None
        assert abort.reason.message.startswith((f"code.py:{line}: ", f"code.py:{line + 1}: ")), abort.reason.message


def test_the_others_go_on(folder: Path) -> None:
    outcome = flown(folder, "code.py:Raises", "kill_reactor")
    assert outcome.last_tick == 20 and judge(outcome).code == "F7"
    assert history(outcome, "eye") == ["4 Failed"]
    assert [event.reactor for event in outcome.events if event.kind is EventKind.KILL] == ["eye"]


def test_what_does_not_come_back_is_stopped(folder: Path) -> None:
    outcome = flown(folder, "code.py:Hangs", seconds=0.2)
    assert outcome.abort is not None and outcome.abort.code == "F7"
    assert "did not come back" in outcome.abort.reason.message


def test_a_name_that_its_enum_does_not_have_is_told(folder: Path) -> None:
    abort = flown(folder, "code.py:Blue").abort
    assert abort is not None and "`hue` is 'blue', which is no Hue (red, green)" in abort.reason.message


def test_a_trace_is_explained_by_the_seed_of_its_flight(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = folder / "mission.toml"
    path.write_text(MISSION.format(code="code.py:Dice", on_failure="abort_agent"))
    monkeypatch.chdir(folder)
    assert run(["run", "--seed", "77", "--trace", "sea.jsonl"]) == 0
    assert read_mission_log(folder / "sea.jsonl").seed == 77
    capsys.readouterr()
    run(["explain", "sea.jsonl", "--mission", "mission.toml"])
    told = capsys.readouterr().out
    assert "played from the log: sim" in told and "departs" not in told


@pytest.mark.parametrize("name", ["Eye", "Hues"])
def test_a_log_player_does_what_was_done(folder: Path, name: str) -> None:
    path = folder / "mission.toml"
    path.write_text(MISSION.format(code=f"code.py:{name}", on_failure="abort_agent"))
    mission, _ = read_mission(path)
    assert mission is not None
    flight = fly(mission, load_models(mission), FlightSettings(1, {}))
    trace = folder / "trace.jsonl"
    trace.write_text(trace_text(flight, path, trace))
    assert first_departure(read_trace(trace), flight) is None
    played = MISSION.format(code=":LogPlayer", on_failure="abort_agent")
    path.write_text(played.replace("level = 0.75", f'trace = "{trace.as_posix()}"\nreactor = "eye"'))
    again, found = read_mission(path)
    assert again is not None, found
    models = load_models(again)
    replayed = pinned(models)(models.agent)(1)
    shown = ("observation", "request", "recall")
    assert lines(replayed, *shown) == lines(flight.outcome, *shown)
