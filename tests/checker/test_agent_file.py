"""T-REX's agent file tells the same agent as `mission.toml`, and its mistakes are told with their places."""

from pathlib import Path

import pytest

from checker.mission import read_mission
from nddlc.main import run
from runtime.executive.configuration import AgentConfiguration

GPS = Path("models/gps").resolve()
AGENT = """<?xml version="1.0"?>
<Agent name="gps" finalTick="900">
  <RealTimeClock millis="500"/>
  <Use file="rules.nddl"/>
  <EuropaReactor name="navigator" latency="2" lookahead="900" config="navigator.xml" log="1" maxSteps="50"/>
  <EuropaReactor name="psim" latency="0" lookahead="1" model="psim.nddl">
    <Internal name="helm"/><Internal name="gps"/><Internal name="motion"/>
  </EuropaReactor>
  <Goal on="nav" pred="Transit" mandatory="true">
    <Variable name="start"><int min="5" max="60"/></Variable>
    <Variable name="end"><int max="800"/></Variable>
    <Variable name="distance"><float value="240.0"/></Variable>
  </Goal>
</Agent>
"""
NAVIGATOR = """<EuropaReactor model="navigator.nddl" latency="7">
  <Internal name="nav"/><External name="helm" goals="1"/><External name="gps"/>
</EuropaReactor>
"""
TOML = """
[mission]
name = "gps"
final_tick = 900
tick = 0.5
[[reactor]]
name = "navigator"
model = "navigator.nddl"
latency = 2
lookahead = 900
internal = ["nav"]
external = ["helm", "gps"]
max_steps = 50
[[reactor]]
name = "psim"
model = "psim.nddl"
latency = 0
lookahead = 1
internal = ["helm", "gps", "motion"]
[[goal]]
timeline = "nav"
predicate = "Transit"
mandatory = true
start = [5, 60]
end = [-inf, 800]
parameters = { distance = 240.0 }
"""


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder with the models of gps and the parts of an agent file."""
    for model in GPS.glob("*.nddl"):
        (tmp_path / model.name).write_text(model.read_text())
    (tmp_path / "navigator.xml").write_text(NAVIGATOR)
    (tmp_path / "mission.toml").write_text(TOML)
    (tmp_path / "agent.xml").write_text(AGENT)
    return tmp_path


def agent_in(file: Path) -> AgentConfiguration:
    mission, found = read_mission(file)
    assert mission is not None, found
    return mission.agent


def test_both_files_tell_the_same_agent(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert agent_in(place / "agent.xml") == agent_in(place / "mission.toml")
    ends = []
    for name in ("agent.xml", "mission.toml"):
        code = run(["run", str(place / name), "--param", "GPS_HIT_RATE=1.0"])
        ends.append((code, capsys.readouterr().out))
    assert ends[0] == ends[1]
    assert "gps, seed 0" in ends[0][1]


@pytest.mark.parametrize(
    ("old", "new", "code", "words", "at"),
    [
        ('lookahead="900', 'lookahed="900', "NDDL702", "no key `lookahed` in <EuropaReactor>", "lookahed="),
        ('finalTick="900"', 'finalTick="soon"', "NDDL704", "must be a whole number", "finalTick="),
        ("<Use file", "<Uses file", "NDDL726", "no element `Uses` in <Agent>", "<Uses"),
        ('file="rules', 'file="rulez', "NDDL708", "there is no file `rulez.nddl`", "file="),
        ('<Internal name="motion"/>', "<Internal/>", "NDDL703", "<Internal> needs the key `name`", "<Internal/>"),
        ('on="nav"', 'on="nev"', "NDDL710", "no reactor owns the timeline `nev`", 'on="nev'),
        ('<int max="800"/>', "", "NDDL704", "one domain", '<Variable name="end"'),
        ("</Agent>", "", "NDDL751", "no element found", None),
        ('<RealTimeClock millis="500"/>', "<StepClock/><FastClock/>", "NDDL709", "a clock `FastClock`", "<FastClock"),
        ('model="psim.nddl"', 'synch_cfg="s.xml" model="psim.nddl"', "NDDL727", "no effect", "synch_cfg"),
        ('<Internal name="gps"/>', '<Internal name="gps" goals="0"/>', "NDDL727", "`goals` has no effect", "goals="),
        ('<Internal name="gps"/>', '<Internal name="gps" listen="1"/>', "NDDL727", "`listen` has no effect", "listen"),
        ('<Internal name="gps"/>', '<Internal name="gps" goals="no"/>', "NDDL704", "`true` or `false`, not", "goals="),
        ('model="navigator.nddl"', 'model="nobody.nddl"', "NDDL708", "no file `nobody.nddl`", "config="),
    ],
)
def test_mistakes_are_told_with_their_places(
    place: Path, old: str, new: str, code: str, words: str, at: str | None
) -> None:
    text = AGENT.replace("<Uses", "<Use").replace(old, new)
    if old in NAVIGATOR:
        (place / "navigator.xml").write_text(NAVIGATOR.replace(old, new))
    if new.startswith("<Uses"):
        text = text.replace("</Use>", "</Uses>")
    (place / "agent.xml").write_text(text)
    _, found = read_mission(place / "agent.xml")
    (one,) = [each for each in found if each.code.id == code]
    assert words in one.message
    if at is not None:
        assert one.span.begin == text.index(at)


def test_the_units_of_a_clock_are_among_its_known_attributes(place: Path) -> None:
    text = AGENT.replace('<RealTimeClock millis="500"/>', '<FastClock tick="10"/>')
    (place / "agent.xml").write_text(text)
    _, found = read_mission(place / "agent.xml")
    (one,) = [each for each in found if each.code.id == "NDDL702"]
    assert one.help == "known attributes: hours, minutes, seconds, millis, micros"


@pytest.mark.parametrize(("given", "observed"), [("1", ()), ("true", ()), ("0", ("helm",)), ("false", ("helm",))])
def test_who_sends_no_goals_to_a_timeline_only_observes_it(place: Path, given: str, observed: tuple[str, ...]) -> None:
    (place / "navigator.xml").write_text(NAVIGATOR.replace('goals="1"', f'goals="{given}" listen="false"'))
    navigator = agent_in(place / "agent.xml").reactors[0]
    assert (navigator.external, navigator.observe) == (("helm", "gps"), observed)


def test_reactors_in_python_have_their_settings(place: Path) -> None:
    reactor = '<PythonReactor name="probe" code="probe.py:Probe" level="3" ratio="0.5"><External name="gps"/>'
    (place / "probe.py").write_text("class Probe: ...\n")
    (place / "agent.xml").write_text(AGENT.replace("</Agent>", f"{reactor}</PythonReactor></Agent>"))
    (coded,) = agent_in(place / "agent.xml").coded
    assert (coded.file, coded.class_name, coded.external) == ("probe.py", "Probe", ("gps",))
    assert coded.settings == (("level", 3), ("ratio", 0.5))


def test_an_agent_file_is_converted_to_a_mission_file(place: Path) -> None:
    text = AGENT.replace(
        "<Goal on", '<PythonReactor name="eye" code="eye.py:Eye" level="0.5" label="a &quot;b&quot;"/><Goal on'
    )
    (place / "eye.py").write_text("class Eye:\n    pass\n")
    (place / "agent.xml").write_text(text.replace("<RealTimeClock", "<!-- said once --><RealTimeClock"))
    written = place / "converted.toml"
    assert run(["convert", str(place / "agent.xml"), "--output", str(written)]) == 0
    assert agent_in(written) == agent_in(place / "agent.xml")
    assert "[reactor.settings]\nlevel = 0.5\n" in written.read_text()


def test_an_agent_file_with_a_mistake_is_not_converted(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (place / "agent.xml").write_text(AGENT.replace("<Use file", "<Uses file"))
    assert run(["convert", str(place / "agent.xml")]) == 2
    assert "no element `Uses`" in capsys.readouterr().err
