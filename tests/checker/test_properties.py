"""Properties are judged over what was executed: by hand-made records, and on the GPS mission."""

import json
import shutil
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any

import pytest

from checker.judge.report import ResourceProfile
from checker.mission import Mission, parse_mission
from checker.models import load_models
from checker.properties import property_fates
from compiler.program import DomainConstant
from nddl_lang.text.source import Source
from nddlc.main import run
from runtime.executive.configuration import (
    AgentConfiguration,
    LevelPattern,
    PropertyConfiguration,
    PropertyKind,
    ReactorConfiguration,
    TokenPattern,
)
from runtime.executive.outcome import Event, EventKind, Phase, PropertyFate
from runtime.executive.record import MissionRecord, ReactorRecord, TokenRecord, Value, ValueRange

GPS = Path("models/gps").resolve()
ARGUMENTS = {"Dive.Down": ("depth", "mode"), "Dive.Up": (), "Radio.On": ()}


def token(line: str, predicate: str, start: Value, end: Value, *given: Value, **more: Any) -> TokenRecord:
    fields: dict[str, Any] = {
        "key": 1, "predicate": predicate, "object": line, "state": "active", "duration": 0, "start": start, "end": end,
        "arguments": given, "merged_into": -1, "origin": "rule", "fate": "over", "tick": 0, "runs": (),
    }  # fmt: skip
    return TokenRecord(**(fields | more))


TOKENS = (
    token("dive", "Dive.Up", 0, 10),
    token("dive", "Dive.Down", 10, 30, 40.0, "FAST"),
    token("dive", "Dive.Up", 30, 50),
    token("dive", "Dive.Down", 50, 80, 55.0, "SLOW"),
    token("dive", "Dive.Up", 80, ValueRange(101, 200)),
    token("radio", "Radio.On", 35, 40),
    token("radio", "Radio.On", 90, 95),
    token("dive", "Dive.Down", 20, 25, 99.0, "FAST", state="merged"),
    token("dive", "Dive.Down", 26, 29, 99.0, "FAST", fate="cut"),
    token("dive", "Dive.Down", ValueRange(120, 130), ValueRange(140, 150), 99.0, "FAST"),
)


def fate(kind: str, pattern: TokenPattern, *, tokens: tuple[TokenRecord, ...] = TOKENS, **given: Any) -> PropertyFate:
    one = PropertyConfiguration("p", PropertyKind(kind), pattern, **given)
    reactor = ReactorConfiguration("r", "m.nddl", internal=("dive", "radio"))
    agent = AgentConfiguration("a", "", 100, (reactor,), properties=(one,))
    record = MissionRecord((ReactorRecord("r", 100, (), (), (), tokens),))
    (found,) = property_fates(agent, ARGUMENTS, record, 100)
    return found


def down(where: str = "", **parameters: Any) -> TokenPattern:
    return TokenPattern("dive", "Down", tuple(parameters.items()), where)


UP, ON = TokenPattern("dive", "Up"), TokenPattern("radio", "On")
LATE_UP = TokenPattern("dive", "Up", (), "start > 60")


@pytest.mark.parametrize(
    ("kind", "pattern", "given", "kept", "tick", "margin"),
    [
        ("reached", down(), {}, True, None, 70.0),
        ("reached", down(depth=55.0), {}, True, None, 20.0),
        ("reached", down(depth=55.0), {"by": 79}, False, 79, -1.0),
        ("reached", down(depth=55.0), {"by": 80}, True, None, 0.0),
        ("reached", down(depth=(50, 60)), {"since": 51}, False, 100, float("-inf")),
        ("reached", TokenPattern("dive", "Up", (), "start > 60"), {}, False, 100, float("-inf")),
        ("never", down("depth > 60"), {}, True, None, 5.0),
        ("never", down("depth > 50"), {}, False, 50, -5.0),
        ("never", down("depth > 50"), {"by": 49}, True, None, 10.0),
        ("never", down("depth >= 55"), {}, False, 50, -1e-300),
        ("never", down(mode="SLOW"), {}, False, 50, float("-inf")),
        ("never", down(mode="SLOW"), {"since": 80}, True, None, float("inf")),
        ("never", TokenPattern("dive", "Sideways"), {}, True, None, float("inf")),
        ("always", TokenPattern("dive", "", (), "duration <= 30"), {"by": 79}, True, None, 0.0),
        ("always", TokenPattern("dive", "", (), "duration < 30"), {"by": 79}, False, 50, -1e-300),
        ("always", TokenPattern("dive", "", (), "duration <= 25 or start == 50"), {"by": 79}, True, None, 5.0),
        ("always", UP, {}, False, 10, float("-inf")),
        # Up goes on since 80, and ends at 101 or later
        ("always", TokenPattern("dive", "Up", (), "duration <= 20"), {}, False, 80, -1.0),
        ("always", TokenPattern("dive", "Up", (), "duration <= 21"), {}, True, None, 0.0),
        ("always", TokenPattern("dive", "Up", (), "duration * 2 <= 40"), {}, False, 80, -2.0),
        ("always", TokenPattern("dive", "Up", (), "duration >= 10"), {}, True, None, 0.0),
        ("always", TokenPattern("dive", "Up", (), "duration >= 30 or start < 60"), {}, True, None, 30.0),
        ("always", TokenPattern("dive", "", (), "duration == 40"), {"since": 80}, True, None, float("inf")),
        ("always", TokenPattern("dive", "", (), "end == 130"), {"since": 80}, True, None, float("inf")),
        ("always", TokenPattern("dive", "", (), "end == 100"), {"since": 80}, False, 80, float("-inf")),
        ("always", TokenPattern("dive", "", (("duration", (25, 28)),)), {"since": 80}, True, None, 1.0),
        ("always", TokenPattern("dive", "", (("duration", (10, 20)),)), {"since": 80}, False, 80, -1.0),
        ("never", TokenPattern("dive", "", (), "duration == 40"), {"since": 80}, True, None, float("inf")),
        ("never", TokenPattern("dive", "Up", (), "duration > 20"), {}, False, 80, -1.0),
        ("never", TokenPattern("dive", "Up", (), "duration > 21"), {}, True, None, 1e-300),
        ("never", TokenPattern("dive", "Up", (), "end <= 100"), {"since": 60}, True, None, float("inf")),
        ("always", down("depth <= 50"), {}, False, 50, -5.0),
        ("always", down("depth <= 60"), {}, True, None, 5.0),
        ("always", UP, {"since": 30, "by": 49}, True, None, float("inf")),
        ("within", down(), {"then": ON, "ticks": 40}, True, None, 0.0),
        ("within", down(), {"then": ON, "ticks": 39}, False, 50, -1.0),
        ("within", UP, {"then": UP, "ticks": 50}, True, None, 0.0),  # by the next one, not by itself
        ("within", UP, {"then": UP, "ticks": 49}, False, 30, -1.0),
        ("within", UP, {"then": TokenPattern("dive"), "ticks": 0}, False, 0, float("-inf")),
        ("within", down(), {"then": ON, "ticks": 0}, False, 10, -40.0),
        (
            "within",
            TokenPattern("dive", "Up", (), "start > 60"),
            {"then": down(), "ticks": 30},
            True,
            None,
            float("inf"),
        ),
        (
            "within",
            TokenPattern("dive", "Up", (), "start > 60"),
            {"then": down(), "ticks": 20},
            False,
            80,
            float("-inf"),
        ),
        ("until", UP, {"then": down()}, True, None, float("inf")),
        ("until", TokenPattern("dive", "", (), "duration <= 20"), {"then": ON}, True, None, 0.0),
        ("until", TokenPattern("dive", "", (), "duration <= 19"), {"then": ON}, False, 10, -1.0),
        ("until", UP, {"then": TokenPattern("radio", "Off")}, False, 10, float("-inf")),
        (
            "until",
            TokenPattern("dive", "", (), "duration <= 99"),
            {"then": TokenPattern("radio", "Off")},
            False,
            100,
            float("-inf"),
        ),
        (
            "until",
            TokenPattern("dive", "", (), "duration <= 19"),
            {"then": TokenPattern("radio", "Off")},
            False,
            10,
            -11.0,
        ),
    ],
)
def test_a_property_has_its_fate(
    kind: str, pattern: TokenPattern, given: dict[str, Any], kept: bool, tick: int | None, margin: float
) -> None:
    is_void = kind == "within" and margin == float("inf")
    assert replace(fate(kind, pattern, **given), seen="") == PropertyFate("p", kept, tick, margin, is_void)


def test_a_condition_without_a_value_is_told_with_why() -> None:
    found = fate("always", TokenPattern("dive", "Up", (), "1 / (start - start) > 0"))
    assert not found.is_kept
    assert "has no value for start = 0: float division by zero" in found.seen


PROFILES = (
    ResourceProfile("other", "tank", 0.0, 10.0, ((0, 5.0),)),
    ResourceProfile("r", "battery", 0.0, 100.0, ((0, 90.0), (20, 40.0), (50, 15.0), (70, 60.0))),
    ResourceProfile("s", "battery", 0.0, 50.0, ((0, 50.0),)),
)


@pytest.mark.parametrize(
    ("level", "given", "kept", "tick", "margin"),
    [
        (LevelPattern("battery", bounds=(10.0, inf)), {}, True, None, 5.0),
        (LevelPattern("battery", bounds=(20.0, inf)), {}, False, 50, -5.0),
        (LevelPattern("battery", bounds=(20.0, inf)), {"by": 49}, True, None, 20.0),
        (LevelPattern("battery", bounds=(20.0, inf)), {"since": 70}, True, None, 40.0),
        (LevelPattern("battery", bounds=(20.0, inf)), {"since": 60}, False, 60, -5.0),
        (LevelPattern("battery", bounds=(0.0, 85.0)), {}, False, 0, -5.0),
        (LevelPattern("battery", bounds=(0.0, 85.0)), {"since": 20}, True, None, 15.0),
        (LevelPattern("battery", margin=10.0), {}, True, None, 0.0),
        (LevelPattern("battery", margin=12.0), {}, False, 0, -2.0),
        (LevelPattern("battery", "s", margin=1.0), {}, False, 0, -1.0),
        (LevelPattern("tank", margin=5.0), {}, True, None, 0.0),
        (LevelPattern("tank", "r", margin=1.0), {}, False, 0, -inf),
    ],
)
def test_a_level_is_kept_by_its_margin(
    level: LevelPattern, given: dict[str, Any], kept: bool, tick: int | None, margin: float
) -> None:
    one = PropertyConfiguration("p", PropertyKind.LEVEL, level=level, **given)
    agent = AgentConfiguration("a", "", 100, (), properties=(one,))
    (found,) = property_fates(agent, {}, MissionRecord(()), 100, profiles=PROFILES)
    assert (found.is_kept, found.tick) == (kept, tick)
    assert found.margin == pytest.approx(margin, abs=1e-12)


LAMP = """#include "TREX.nddl"
enum Colour { red, green }
class Lamp extends AgentTimeline {
    predicate Off { }
    predicate On { Colour colour; bool bright; int power; }
    Lamp(Mode m) { super(m, "Off"); }
}
Lamp::On { duration == 2; }
Lamp::Off { duration == 2; }
Lamp lamp = new Lamp(Internal);
close();
"""
LAMP_MISSION = """[mission]
name = "lamp"
final_tick = 10
[[reactor]]
name = "sim"
model = "lamp.nddl"
lookahead = 1
internal = ["lamp"]
[[property]]
name = "p"
kind = "never"
timeline = "lamp"
predicate = "On"
where = "CONDITION"
"""


@pytest.mark.parametrize(
    ("condition", "message", "help_"),
    [
        ("power > 3 and bright", "", ""),
        ("bright == true", "has no parameter `true`", "write `parameters = { bright = true }`"),
        ("colour == red", "has no parameter `red`", 'write `parameters = { colour = "red" }`'),
        ("colour == 1", "must be a number for `where` to compare, not of `Colour`", "`parameters = { colour = ... }`"),
    ],
)  # fmt: skip
def test_a_condition_on_what_is_no_number_is_told_how_to_write_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], condition: str, message: str, help_: str
) -> None:
    (tmp_path / "lamp.nddl").write_text(LAMP)
    (tmp_path / "mission.toml").write_text(LAMP_MISSION.replace("CONDITION", condition))
    assert run(["lint", str(tmp_path / "mission.toml"), "--format", "json"]) == (1 if message else 0)
    found = [one for one in json.loads(capsys.readouterr().out)["diagnostics"] if one["severity"] == "error"]
    assert all(message in one["message"] and help_ in one["help"] and one["line"] == 14 for one in found)
    assert bool(found) == bool(message)


# ---- mission files ----

PROPERTY = """
[[property]]
name = "surfaces once"
kind = "always"
timeline = "nav"
predicate = "Transit"
where = "distance <= 300"
"""


def read(text: str) -> tuple[Mission | None, list[tuple[int, str]]]:
    source = Source("models/gps/mission.toml", (GPS / "mission.toml").read_text() + text)
    mission, found = parse_mission(source, Path("models/gps"))
    if mission is not None:
        found = (*found, *load_models(mission).diagnostics)
    first = source.text.count("\n") - text.count("\n")
    return mission, [(one.span.source.locate(one.span.begin)[0] - first, one.message) for one in found]


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ('"nav"', '"nva"', 5, "no reactor owns the timeline `nva`"),
        ('"Transit"', '"Transt"', 6, "`Nav` has no predicate `Transt`"),
        ("distance <=", "distnce <=", 7, "`Transit` has no parameter `distnce`"),
        ("distance <= 300", "distance <=", 7, "`where` must be arithmetic over the arguments of a token"),
        ('"always"', '"allways"', 4, "`kind` cannot be `allways`"),
        ('kind = "always"', "", 2, "[[property]] needs the key `kind`"),
        ('kind = "always"', 'kind = "within"', 2, "[[property]] needs the key `then`"),
        ('where = "distance <= 300"', "parameters = { distance = \"far\" }", 7, "`distance` of `Nav.Transit` must be"),
        ('where = "distance <= 300"', "parameters = { dist = 3 }", 7, "`Transit` has no parameter `dist`"),
    ],
)  # fmt: skip
def test_a_mistake_in_a_property_is_named_where_it_stands(old: str, new: str, line: int, message: str) -> None:
    assert read(PROPERTY)[1] == []
    _, found = read(PROPERTY.replace(old, new))
    assert any(at == line and message in text for at, text in found), found


@pytest.fixture
def gps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(GPS, tmp_path / "gps", ignore=shutil.ignore_patterns(".*", "nddlc-*"))
    monkeypatch.chdir(tmp_path)
    return tmp_path / "gps" / "mission.toml"


@pytest.mark.once
@pytest.mark.parametrize(("by", "kept"), [(200, True), (60, False)])
@pytest.mark.parametrize("kind", ["reached", "until"])
def test_what_is_due_later_is_not_violated_where_a_flight_is_cut_off(kind: str, by: int, kept: bool) -> None:
    """`nddlc run --until 60` called a promise for tick 200 violated."""
    then = LATE_UP if kind == "until" else None
    pattern = down(depth=77.0) if kind == "reached" else TokenPattern("dive")
    one = PropertyConfiguration("p", PropertyKind(kind), pattern, by=by, then=then)
    reactor = ReactorConfiguration("r", "m.nddl", internal=("dive", "radio"))
    agent = AgentConfiguration("a", "", 300, (reactor,), properties=(one,))
    record = MissionRecord((ReactorRecord("r", 70, (), (), (), TOKENS[:3]),))
    (found,) = property_fates(agent, ARGUMENTS, record, 70, is_cut=True)
    assert found.is_kept == kept
    (ended,) = property_fates(agent, ARGUMENTS, record, 70)
    assert not ended.is_kept


def test_missions_fail_by_a_property_that_they_break(gps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = gps.read_text()
    few = ["--missions", "6", "--seed", "3", "--flights", "0"]
    gps.write_text(text + PROPERTY.replace("300", "200"))
    assert run(["check", "gps/mission.toml", *few]) == 1
    after = capsys.readouterr().out
    assert "P1 a property of the mission was violated" in after
    assert "the property `surfaces once` is violated at tick" in after
    gps.write_text(text + PROPERTY)
    assert run(["check", "gps/mission.toml", *few, "--max-failure-rate", "1"]) == 0
    assert "P1" not in capsys.readouterr().out


def test_what_only_code_publishes_is_judged_by_its_events() -> None:
    def seen(tick: int, predicate: str, *given: tuple[str, DomainConstant]) -> Event:
        return Event(tick, Phase.OBSERVE, EventKind.OBSERVATION, "lookout", "whales", predicate, given)

    near = ("distance", DomainConstant("int", "int", (40, 40), None))
    events = (
        seen(0, "Nothing"),
        seen(20, "Seen", near),
        seen(20, "Nothing"),
        seen(30, "Seen", near),
        seen(60, "Nothing"),
    )
    one = PropertyConfiguration(
        "p", PropertyKind("within"), TokenPattern("whales", "Seen", ()), ticks=10, then=TokenPattern("dive", "Down", ())
    )
    reactors = (ReactorConfiguration("r", "m.nddl", internal=("dive", "radio")),)
    record = MissionRecord((ReactorRecord("r", 100, (), (), (), TOKENS),))

    def found(one: PropertyConfiguration) -> PropertyFate:
        agent = AgentConfiguration("a", "", 100, reactors, properties=(one,))
        return property_fates(agent, ARGUMENTS, record, 100, events)[0]

    assert found(one) == PropertyFate("p", False, 30, -10.0)
    silent = PropertyConfiguration("p", PropertyKind("never"), TokenPattern("buoy", "Seen", ()))
    assert found(silent) == PropertyFate("p", True, None, inf)
    far = TokenPattern("whales", "Seen", (), "distance >= 50 and duration >= 30")
    assert found(PropertyConfiguration("p", PropertyKind("always"), far)) == PropertyFate("p", False, 30, -10.0)
