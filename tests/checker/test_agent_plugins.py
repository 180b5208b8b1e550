"""Agent files as T-REX 2 has them: plug-ins, roles left to the models, logs played in a reactor's place."""

from pathlib import Path

import pytest

from checker.declared_roles import declared_roles
from checker.flight import fly_programs
from checker.mission import Mission, read_mission
from checker.models import load_models
from checker.pinned import pinned
from runtime.executive.outcome import EventKind, Outcome
from tests.checker.transaction_logs import write_logs

GPS = Path("models/gps").resolve()
GOAL = """<Goal on="nav" pred="Transit"><Variable name="start"><int min="5" max="60"/></Variable>
<Variable name="distance"><float value="240.0"/></Variable></Goal>"""
NAVIGATOR = '<EuropaReactor name="navigator" latency="2" lookahead="900" model="navigator.nddl"/>'
PSIM = '<EuropaReactor name="psim" latency="0" lookahead="1" model="psim.nddl"/>'
PLAYER = """[mission]
name = "gps"
final_tick = 900
[[reactor]]
name = "navigator"
model = "navigator.nddl"
latency = 2
lookahead = 900
[[reactor]]
name = "psim"
code = ":LogPlayer"
internal = ["helm", "gps"]
[reactor.settings]
trace = "flight.jsonl"
reactor = "psim"
"""


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder with the models of gps."""
    for model in GPS.glob("*.nddl"):
        (tmp_path / model.name).write_text(model.read_text())
    return tmp_path


def agent_file(folder: Path, content: str) -> Path:
    file = folder / "agent.cfg"
    file.write_text(f'<Agent name="gps" finalTick="900">{content}</Agent>')
    return file


def mission_in(file: Path) -> Mission:
    mission, found = read_mission(file)
    assert mission is not None, found
    return mission


def complaints(file: Path) -> list[tuple[str, str, str]]:
    return [(one.code.id, one.message, one.help or "") for one in read_mission(file)[1]]


def flown(file: Path, seed: int = 3) -> Outcome:
    models = load_models(mission_in(file))
    assert not models.has_errors, models.diagnostics
    return fly_programs(models.agent, pinned(models).programs_of(models.agent), seed)


def test_what_a_plugin_contains_is_read_and_roles_are_those_of_the_models(place: Path) -> None:
    outside = mission_in(agent_file(place, NAVIGATOR + PSIM + GOAL)).agent
    inside = mission_in(agent_file(place, f'<Plugin name="europa_pg">{NAVIGATOR}{PSIM}</Plugin>{GOAL}')).agent
    assert inside.reactors == outside.reactors
    navigator, psim = inside.reactors
    assert (navigator.internal, navigator.external) == (("nav",), ("helm", "gps"))
    assert psim.internal == ("helm", "gps")  # motion is private
    assert flown(place / "agent.cfg").open_goals == ()


@pytest.mark.parametrize(
    ("declared", "roles"),
    [
        ("Lamp lamp = new Lamp(Internal);", {"internal": ("lamp",), "external": (), "observe": ()}),
        ("Lamp lamp = new Lamp(Mode.External);", {"internal": (), "external": ("lamp",), "observe": ()}),
        ("Lamp lamp = new Lamp(Observe);", {"internal": (), "external": ("lamp",), "observe": ("lamp",)}),
        ("Lamp lamp = new Lamp(Private);", {"internal": (), "external": (), "observe": ()}),
        ("Beacon top = new Beacon();", {"internal": ("top",), "external": (), "observe": ()}),
        ("Beacon top = new Beacon(3, External);", {"internal": (), "external": ("top",), "observe": ()}),
        ("Plain plain = new Plain();", {"internal": (), "external": (), "observe": ()}),
        ("Unknown top = new Unknown(External);", {"internal": (), "external": ("top",), "observe": ()}),
    ],
)
def test_the_role_of_a_timeline_is_what_its_constructors_make_of_it(
    tmp_path: Path, declared: str, roles: dict[str, tuple[str, ...]]
) -> None:
    model = tmp_path / "model.nddl"
    model.write_text(
        """#include "TREX.nddl"
class Lamp extends AgentTimeline { predicate On { } Lamp(Mode m) { super(m, "On"); } }
class Beacon extends Lamp {
    int rate;
    Beacon() { super(Internal); rate = 1; }
    Beacon(int r, Mode m) { super(m); rate = r; }
}
class Plain extends Timeline { predicate P { } Plain() { } }
"""
        + declared
    )
    assert declared_roles(model) == roles


def test_timelines_that_a_mission_lists_are_all_that_its_reactor_has(place: Path) -> None:
    listed = NAVIGATOR.replace("/>", '><Internal name="nav"/><External name="helm"/><External name="gps" goals="0"/>')
    agent = mission_in(agent_file(place, f"{listed}</EuropaReactor>{PSIM}{GOAL}")).agent
    assert agent.reactors[0].observe == ("gps",)


def test_files_are_looked_for_where_the_project_says(place: Path) -> None:
    """As T-REX does in the folders of TREX_PATH."""
    (place / "cfg").mkdir()
    text = agent_file(place, NAVIGATOR + PSIM + GOAL).read_text()
    (place / "cfg" / "agent.cfg").write_text(text)
    assert {code for code, _, _ in complaints(place / "cfg" / "agent.cfg")} == {"NDDL708", "NDDL710"}
    (place / "nddlc.toml").write_text('include = ["."]\n')
    agent = mission_in(place / "cfg" / "agent.cfg").agent
    assert [one.model for one in agent.reactors] == ["../navigator.nddl", "../psim.nddl"]
    assert flown(place / "cfg" / "agent.cfg").open_goals == ()


def test_where_a_plugin_holds_what_is_not_at_home_here_its_else_counts(place: Path) -> None:
    plugin = f'<Plugin name="sea_pg"><Sea name="sea" latency="0"/><Else message="no sea">{PSIM}</Else></Plugin>'
    agent = mission_in(agent_file(place, NAVIGATOR + plugin + GOAL)).agent
    assert [one.name for one in agent.reactors] == ["navigator", "psim"]
    assert complaints(agent_file(place, NAVIGATOR + PSIM + '<Plugin name="view_pg"><Else/></Plugin>' + GOAL)) == []


def test_a_reactor_of_a_plugin_is_told_with_what_can_stand_in_its_place(place: Path) -> None:
    plugin = '<Plugin name="sea_pg"><Vehicle name="auv" latency="0"/></Plugin>'
    ((code, message, advice),) = complaints(agent_file(place, NAVIGATOR + PSIM + plugin + GOAL))
    assert (code, message) == ("NDDL726", "no element `Vehicle` in <Plugin>")
    assert "<LogPlayer" in advice
    (one,) = complaints(agent_file(place, NAVIGATOR + PSIM + '<Plugin name="view_pg"/>' + GOAL))
    assert one[0] == "NDDL727"


def test_a_log_is_played_in_the_place_of_its_reactor(place: Path) -> None:
    real = flown(agent_file(place, NAVIGATOR + PSIM + GOAL))
    write_logs(place, real, {"psim": ("helm", "gps")})
    player = '<LogPlayer name="psim" latency="0" lookahead="1"/>'
    played = flown(agent_file(place, NAVIGATOR + player + GOAL))
    kinds = (EventKind.OBSERVATION, EventKind.REQUEST)
    told = [
        [(one.tick, one.kind, one.reactor, one.timeline, one.predicate) for one in outcome.events if one.kind in kinds]
        for outcome in (real, played)
    ]
    assert [one for one in told[0] if one[3] != "motion"] == told[1]
    assert len(told[1]) > 10


@pytest.mark.parametrize(
    ("old", "new", "code", "words", "advice"),
    [
        ('trace = "flight.jsonl"\n', "", "NDDL703", "needs the key `trace`", ""),
        ('reactor = "psim"\n', "", "NDDL703", "needs the key `reactor`", ""),
        ('"flight.jsonl"', '"flights.jsonl"', "NDDL708", "no file `flights.jsonl`", "did you mean `flight.jsonl`?"),
        (
            '"flight.jsonl"',
            '"psim.nddl"',
            "NDDL737",
            "`psim.nddl` cannot be played: it is no trace",
            "nddlc run --trace",
        ),
        ('reactor = "psim"', 'reactor = "psin"', "NDDL737", "it has no reactor `psin`", "did you mean `psim`?"),
        ('"flight.jsonl"', '"bad.tr.log"', "NDDL737", "cannot be played: line 1", "nddlc run --trace"),
    ],
)
def test_a_log_that_cannot_be_played_is_told(
    place: Path, old: str, new: str, code: str, words: str, advice: str
) -> None:
    (place / "flight.jsonl").write_text('{"tick":0,"kind":"observation","reactor":"psim","timeline":"helm"}\n')
    (place / "bad.tr.log").write_text("<Logs/>")
    file = place / "mission.toml"
    file.write_text(PLAYER)
    assert complaints(file) == []
    file.write_text(PLAYER.replace(old, new))
    ((found, message, help_text),) = complaints(file)
    assert found == code
    assert words in message
    assert advice in help_text


def test_what_an_owner_that_says_nothing_never_began_is_no_disagreement(place: Path) -> None:
    """A repair takes what was to begin out of the plan at the very tick: the judge took it for begun."""
    (place / "flight.jsonl").write_text('{"tick":0,"kind":"observation","reactor":"psim","timeline":"helm"}\n')
    goal = '[[goal]]\ntimeline = "nav"\npredicate = "Transit"\nstart = [5, 60]\nparameters = { distance = 240.0 }\n'
    file = place / "mission.toml"
    for lookahead in (0, 1):
        told = f'[[reactor]]\nlookahead = {lookahead}\nname = "psim"'
        file.write_text(PLAYER.replace('[[reactor]]\nname = "psim"', told) + goal)
        (place / "flight.jsonl").write_text('{"tick":0,"kind":"recall","reactor":"psim","request":7,"arguments":{}}\n')
        outcome = flown(file)
        assert any(one.kind is EventKind.RELAX for one in outcome.events)
