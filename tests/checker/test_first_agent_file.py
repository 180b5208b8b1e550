"""Agent files of T-REX 1: the same agent as one of T-REX 2 tells, and one message for what is not at home here."""

from pathlib import Path

import pytest

from checker.flight import fly_programs
from checker.mission import Mission, read_mission
from checker.models import load_models
from nddlc.main import run
from tests.programs import programs_of

HEAD = """#include "TREX.nddl"
class Buoy extends AgentTimeline { predicate Adrift { } predicate Moored { } Buoy(Mode m) { super(m, "Adrift"); } }
"""
OWNER = "Buoy buoy = new Buoy(Internal); close(); fact(buoy.Moored m); m.duration == 3;"
USER = "Buoy buoy = new Buoy(External); close(); rejectable(buoy.Moored m); m.start == 6;"
SOLVER = """<Solver name="plain">
  <FlawFilter component="DeliberationFilter"/>
  <ThreatManager defaultPriority="0"><FlawHandler component="StandardThreatHandler"/></ThreatManager>
  <OpenConditionManager defaultPriority="0">
    <FlawFilter component="NoGoals"/><FlawHandler component="StandardOpenConditionHandler"/>
  </OpenConditionManager>
  <OpenConditionManager defaultPriority="9">
    <FlawFilter component="GoalsOnly"/><FlawHandler component="StandardOpenConditionHandler"/>
  </OpenConditionManager>
</Solver>
"""
KIND = 'component="DeliberativeReactor" solverConfig="plain.cfg"'
REACTORS = f"""<TeleoReactor name="shore" {KIND} lookAhead="20" latency="1"/>
<TeleoReactor name="sea" {KIND} lookAhead="1" latency="0" log="1"/>
"""


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder with an agent `bay` of two reactors."""
    (tmp_path / "bay.sea.nddl").write_text(HEAD + OWNER)
    (tmp_path / "bay.shore.nddl").write_text(HEAD + USER)
    (tmp_path / "plain.cfg").write_text(SOLVER)
    return tmp_path


def agent_file(folder: Path, content: str, final_tick: str = "12") -> Path:
    file = folder / "bay.cfg"
    file.write_text(f'<Agent name="bay" finalTick="{final_tick}">{content}</Agent>')
    return file


def complaints(file: Path) -> list[tuple[str, str]]:
    return [(one.code.id, one.message) for one in read_mission(file)[1]]


def mission_in(file: Path) -> Mission:
    mission, found = read_mission(file)
    assert mission is not None, found
    assert not found
    return mission


def test_reactors_have_the_models_of_their_names(place: Path) -> None:
    mission = mission_in(agent_file(place, REACTORS))
    shore, sea = mission.agent.reactors
    assert (shore.model, shore.lookahead, shore.latency, shore.solver) == ("bay.shore.nddl", 20, 1, "plain.cfg")
    assert (shore.internal, shore.external) == ((), ("buoy",))
    assert (sea.model, sea.lookahead, sea.internal) == ("bay.sea.nddl", 1, ("buoy",))
    models = load_models(mission)
    assert models.diagnostics == ()
    outcome = fly_programs(models.agent, programs_of(models.agent), 1)
    seen = [(one.tick, one.predicate) for one in outcome.events if one.kind.value == "observation"]
    assert seen == [(0, "Moored"), (3, "Adrift"), (6, "Moored")]


def test_without_a_look_ahead_a_reactor_plans_to_the_end(place: Path) -> None:
    agent = mission_in(agent_file(place, REACTORS.replace('lookAhead="20" ', ""))).agent
    assert agent.reactors[0].lookahead == 12


def test_an_included_file_stands_where_it_is_named(place: Path) -> None:
    (place / "crew.cfg").write_text(f"<Config>{REACTORS}</Config>")
    agent = mission_in(agent_file(place, '<Include name="crew.cfg"/>')).agent
    assert [one.name for one in agent.reactors] == ["shore", "sea"]


def test_what_the_agent_names_by_config_is_read_too(place: Path) -> None:
    (place / "crew.cfg").write_text(f"<Config>{REACTORS}</Config>")
    file = place / "bay.cfg"
    file.write_text('<Agent name="bay" finalTick="12" config="crew.cfg"/>')
    assert [one.name for one in mission_in(file).agent.reactors] == ["shore", "sea"]


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ('<Include name="none.cfg"/>', ("NDDL708", "there is no file `none.cfg`")),
        ("<Include/>", ("NDDL703", "<Include> needs the key `name`")),
        (
            '<TeleoReactor name="sea" component="DeliberateReactor" lookAhead="1" latency="0"/>',
            ("NDDL704", "`component` must be `DeliberativeReactor`, not `DeliberateReactor`"),
        ),
        (
            '<TeleoReactor name="sea" lookAhead="1" latency="0"/>',
            ("NDDL703", "<TeleoReactor> needs the key `component`"),
        ),
    ],
)
def test_what_cannot_be_read_is_told(place: Path, content: str, expected: tuple[str, str]) -> None:
    assert complaints(agent_file(place, REACTORS.splitlines()[1] + content)) == [expected]


def test_a_file_that_includes_itself_is_told(place: Path) -> None:
    (place / "crew.cfg").write_text('<Config><Include name="crew.cfg"/></Config>')
    assert complaints(agent_file(place, f'{REACTORS}<Include name="crew.cfg"/>')) == [
        ("NDDL708", "there is no file `crew.cfg`")
    ]


def test_an_adapter_in_c_names_what_can_stand_in_for_it(place: Path) -> None:
    adapter = '<TeleoReactor name="sea" component="RadioAdapter" lookAhead="1" latency="0" config="radio.cfg"/>'
    (place / "radio.cfg").write_text("<Config/>")
    found = read_mission(agent_file(place, adapter))[1]
    (told,) = [one for one in found if one.code.id == "NDDL704"]
    assert "a reactor in Python" in (told.help or "")


def test_an_agent_without_an_end_is_told(place: Path) -> None:
    found = complaints(agent_file(place, REACTORS, final_tick="forever"))
    assert found == [("NDDL704", '`final_tick` must be a whole number, not the text "forever"')]


def test_it_is_converted_to_a_mission_file(place: Path) -> None:
    file = agent_file(place, REACTORS)
    assert run(["convert", str(file), "--output", str(place / "mission.toml")]) == 0
    assert mission_in(place / "mission.toml").agent.reactors == mission_in(file).agent.reactors
