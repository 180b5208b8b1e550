"""Single mistakes of a modeler, in whole projects: each is told once, in its line, with the help that mends it.

`nddlc lint mission.toml .` is asked, as a modeler asks; of a model without a mission, `nddlc lint .`.
"""

import json
import shutil
from pathlib import Path

import pytest

from nddlc.main import run
from tests.cli.habits import HABITS, Mistake
from tests.cli.slips_in_templates import SLIPS_IN_TEMPLATES

ROOT = Path(__file__).parents[2] / "models"
Captured = pytest.CaptureFixture[str]


MISTAKES = (
    # Names.
    Mistake("gps/rules.nddl", "== FIX_HITS;", "== FIX_HIT;", "`FIX_HITS`"),
    Mistake("gps/rules.nddl", "Helm.Run run", "Helm.Rnu run", "`Run`"),
    Mistake("gps/rules.nddl", "Nav::Transit", "Nav::Transist", "`Transit`"),
    Mistake("gps/rules.nddl", "object.Surface fix", "object.Surfac fix", "`Surface`"),
    Mistake("gps/rules.nddl", "run.distance ==", "run.distanse ==", "`distance`"),
    Mistake("gps/psim.nddl", "new Gps(Internal)", "new Gps(Internl)", "`Internal`"),
    Mistake("gps/vehicle.nddl", "class Gps extends AgentTimeline", "class Gps extends AgentTimelin", "`AgentTimeline`"),
    Mistake("classic/rover.nddl", "first.rock == hill", "first.rock == hil", "`hill`"),
    Mistake("classic/rover.nddl", "drive.quantity", "drive.quantaty", "`quantity`"),
    Mistake("classic/rover.nddl", "object.battery.consume drive", "object.batery.consume drive", "`battery`"),
    Mistake("classic/jobshop.nddl", "b1 before b2;", "b1 before b22;", "`b2`"),
    Mistake("templates/survey/planner.nddl", "int LEG_MAX;", "Int LEG_MAX;", "`int`"),
    # Files.
    Mistake("templates/blank/planner.nddl", '"vehicle.nddl"', '"vehicel.nddl"', "`vehicle.nddl`"),
    Mistake(
        "templates/blank/planner.nddl", '#include "vehicle.nddl"\n', "", '#include "vehicle.nddl"', "AgentTimeline"
    ),
    Mistake("gps/vehicle.nddl", '#include "TREX.nddl"\n', "", '#include "TREX.nddl"', "class Helm"),
    # Braces, semicolons, and what other languages write.
    Mistake(
        "gps/rules.nddl", "duration <= SURFACE_MAX;\n}", "duration <= SURFACE_MAX;\n}\n}", "`}`", "SURFACE_MAX;\n}\n}"
    ),
    Mistake("gps/rules.nddl", "fix.minHits == FIX_HITS;\n}", "fix.minHits == FIX_HITS;\n", "}", "Nav::Transit {"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration <= GO_WORST", "`;`"),
    Mistake("classic/lamp.nddl", "met_by(Switch.Press p);", "met_by(Switch.Press p)", "`;`"),
    Mistake("classic/lamp.nddl", "Lamp::On {", "Lamp.On {", "`Class::predicate { }`"),
    Mistake("classic/rover.nddl", "class Battery extends Reservoir {", "class Battery extends Reservoir", "`{`"),
    Mistake("classic/rover.nddl", "new Rover(battery);", "Rover(battery);", "`new Rover(...)`"),
    Mistake(
        "templates/rover/planner.nddl", "predicate Visit { float distance; }", "predicate Visit(float distance);", "{"
    ),
    Mistake("templates/survey/vehicle.nddl", 'super(m, "Still")', "super(m, 'Still')", '"'),
    # Operators.
    Mistake("classic/rover.nddl", "    origin != target;", "    origin <> target;", "`!=`"),
    Mistake("classic/jobshop.nddl", "a3.end <= LAST;", "a3.end =< LAST;", "`<=`"),
    Mistake("classic/lamp.nddl", "reading.start == 20;", "reading.start == 20 and reading.end == 30;", "`&&`"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "if (fails = true) {", "`==`"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "if fails {", "("),
    # Relations and constraints.
    Mistake("gps/rules.nddl", "contained_by(Nav", "contained(Nav", "`contained_by`"),
    Mistake("gps/rules.nddl", "up before fix;", "up befor fix;", "`before`"),
    Mistake(
        "templates/rover/planner.nddl", "contains(Drill.Sample sample)", "during(Drill.Sample sample)", "contained_by"
    ),
    Mistake("gps/psim.nddl", "mulEq(span, ground, distance);", "mulEq(span, ground);", "product"),
    Mistake("gps/psim.nddl", "ceil(span)", "ciel(span)", "`ceil`"),
    # Types.
    Mistake("classic/lamp.nddl", "duration >= 5;", 'duration >= "5";', "string"),
    Mistake("classic/rover.nddl", "new Rover(battery)", "new Rover(20.0)", "Battery"),
    # Sampled parameters.
    Mistake("gps/psim.nddl", "sampledParameter(CURRENT)", "sampledParameter(CURRNT)", "`CURRENT`"),
    Mistake("gps/psim.nddl", "sampledParameter(CURRENT)", 'sampledParameter("CURRENT")', "CURRENT"),
    Mistake("gps/psim.nddl", "= [0.1 4.0]", "= [4.0 0.1]", "[0.1 4.0]"),
    # The mission file.
    Mistake("gps/mission.toml", "lookahead = 900", "look_ahead = 900", "`lookahead`"),
    Mistake("gps/mission.toml", 'internal = ["nav"]', 'internal = ["nave"]', "`nav`"),
    Mistake("gps/mission.toml", 'external = ["helm", "gps"]', 'external = ["helm"]', "`gps`"),
    Mistake("gps/mission.toml", "distance = 240.0", 'distance = "240 m"', "number"),
    Mistake("gps/mission.toml", "start = [5, 60]", "start = [60, 5]", "[5, 60]"),
    Mistake("gps/mission.toml", "[parameters.CURRENT]", "[parameters.CURENT]", "`CURRENT`"),
    Mistake("gps/mission.toml", "max_failure_rate = 0.01", "max_failure_rate = 5", "0.05"),
    Mistake("gps/mission.toml", 'model = "psim.nddl"', 'model = "p_sim.nddl"', "`psim.nddl`"),
)

# Others, in which what was found to be told badly is told well.
MORE_MISTAKES = (
    # Words of other languages.
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration ! = GO_WORST;", "`!=`"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration =! GO_WORST;", "`!=`"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration <= Math.ceil(GO_WORST);", "`ceil(...)`"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "assert(duration <= GO_WORST);", "`duration <= GO_WORST;`"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "not(duration > GO_WORST);", "turn the comparison round"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "while (duration < 5) { duration <= GO_WORST; }", "`foreach"),
    Mistake("templates/survey/planner.nddl", "int LEG_MAX;", "var LEG_MAX;", "say which: `bool`, `int`"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration < = GO_WORST;", "`<=`"),
    Mistake("gps/rules.nddl", "fix.minHits == FIX_HITS;\n}", "fix.minhits == FIX_HITS;\n}", "`minHits`"),
    Mistake("gps/rules.nddl", "Nav::Surface {", "nav::Surface {", "`Nav`"),
    Mistake("gps/rules.nddl", "up before fix;", "ascend before fix;", "up"),
    Mistake("gps/psim.nddl", "met_by(Inactive p);", "met_by(inactive p);", "`Inactive`"),
    Mistake("gps/psim.nddl", "new MotionSimulator(Private)", "new Motion(Private)", "`MotionSimulator`"),
    Mistake("gps/psim.nddl", "ticks == ceil(span);", "tick == ceil(span);", "`ticks`"),
    Mistake("gps/navigator.nddl", "SURFACE_MAX = 64;", "SURFACE_MX = 64;", "`SURFACE_MAX`"),
    Mistake("templates/survey/planner.nddl", "drive.distance == length;", "drive.distance == lenght;", "`length`"),
    Mistake("templates/rover/planner.nddl", "send.end == end;", "send.ende == end;", "`end`"),
    Mistake("classic/rover.nddl", "object.rover.At there", "object.Rover.At there", "`rover`"),
    Mistake("classic/jobshop.nddl", "goal(drill.Busy c2);", "goal(drill.busy c2);", "`Busy`"),
    Mistake("gps/navigator.nddl", '#include "rules.nddl"', '#include "rule.nddl"', "`rules.nddl`"),
    Mistake("gps/navigator.nddl", '#include "vehicle.nddl"', "#include vehicle.nddl", "double quotes"),
    Mistake("gps/vehicle.nddl", '#include "TREX.nddl"', '#include "Trex.nddl"', "`TREX.nddl`"),
    Mistake("gps/rules.nddl", "contains(Helm.Ascend up);", "contains Helm.Ascend up;", "("),
    Mistake("gps/rules.nddl", "contains(Helm.Ascend up);", "contains(Helm.Ascend up;", ")"),
    Mistake("gps/rules.nddl", "meets(object.Surface fix);", "meets(object.Surface, fix);", ","),
    Mistake("gps/vehicle.nddl", "predicate Active { int minHits; }", "predicate Active { int minHits }", "`;`"),
    Mistake("gps/vehicle.nddl", "    predicate Ascend { }", "    predicate Ascend;", "{ }"),
    Mistake("gps/vehicle.nddl", 'Gps(Mode m) { super(m, "Inactive"); }', 'Gps(Mode m) { super(m, "Inactive") }', "`;`"),
    Mistake("gps/psim.nddl", "= [-0.3 0.3];", "= [-0.3..0.3];", "`[-0.3 0.3]`"),
    Mistake("gps/psim.nddl", "CRUISE = 1.5;", "CRUISE = 1,5;", "1.5"),
    Mistake("gps/psim.nddl", "ASCENT = 25;", "ASCENT == 25", "`;`"),
    Mistake("gps/psim.nddl", "/// What moves the vehicle.", "# What moves the vehicle.", "//"),
    Mistake("gps/psim.nddl", "/// What moves the vehicle.", "/* What moves the vehicle.", "*/"),
    Mistake("classic/rover.nddl", "class Arm extends Timeline {", "class Arm : Timeline {", "extends"),
    Mistake("classic/rover.nddl", "Place hill = new Place(6);", "Place hill = new Place[6];", "("),
    Mistake("classic/lamp.nddl", "duration >= 5;", "duration => 5;", "`>=`"),
    Mistake("gps/rules.nddl", "GO_WORST = 260;", "GO_WORST = 260.5;", "int"),
    Mistake("gps/psim.nddl", "float CRUISE;", "double CRUISE;", "`float`"),
    Mistake("gps/rules.nddl", "int FIX_HITS;", "integer FIX_HITS;", "`int`"),
    Mistake("classic/rover.nddl", "new Battery(20.0, 0.0, 20.0)", "new Battery(20.0, 20.0)", "Battery"),
    Mistake("classic/rover.nddl", "first.rock == hill;", "first.rock == 6;", "Place"),
    Mistake("classic/rover.nddl", "there.place == rock;", "there == rock;", "place"),
    Mistake("gps/rules.nddl", "run.distance == distance;", "run == distance;", "distance"),
    Mistake("gps/rules.nddl", "up before fix;", "up preceeds fix;", "before"),
    Mistake("gps/rules.nddl", "contains(Gps.Active fix);", "includes(Gps.Active fix);", "contains"),
    Mistake("gps/psim.nddl", "ends(MotionSimulator.Holds m);", "finishes(MotionSimulator.Holds m);", "ends"),
    Mistake("gps/psim.nddl", "met_by(Inactive p);", "metBy(Inactive p);", "`met_by`"),
    Mistake("gps/rules.nddl", "contained_by(Nav.Surface s);", "containedBy(Nav.Surface s);", "`contained_by`"),
    Mistake("templates/rover/planner.nddl", "sample before send;", "sample.before(send);", "before"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "lessThanEq(duration, GO_WORST);", "`leq`"),
    Mistake("gps/psim.nddl", "mulEq(span, ground, distance);", "timesEq(span, ground, distance);", "constraints"),
    Mistake("templates/survey/simulator.nddl", "drive.end + rest == end;", "drive.end + rest = end;", "`==`"),
    Mistake("classic/rover.nddl", "ticks == abs(far);", "ticks == absolute(far);", "abs"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "if (fails == True) {", "true"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "if (fails) then {", "then"),
    Mistake("gps/mission.toml", "final_tick = 900", "final_tick = 900.5", "whole"),
    Mistake("gps/mission.toml", "latency = 2", 'latency = "2"', "number"),
    Mistake("gps/mission.toml", "[check]", "[cheque]", "check"),
    Mistake("gps/mission.toml", "range = [-0.3, 0.3]", "range = [-0.3 0.3]", ","),
    Mistake("gps/mission.toml", "start = [300, 500]", "start = [1300, 1500]", "900"),
    Mistake("gps/mission.toml", "distance = 180.0", "dist = 180.0", "distance"),
    Mistake("gps/mission.toml", 'model = "navigator.nddl"', "model = navigator.nddl", '"'),
    Mistake("gps/mission.toml", 'name = "psim"', 'name = "navigator"', "navigator"),
    Mistake("gps/mission.toml", 'internal = ["helm", "gps", "motion"]', 'internal = "helm"', "["),
    Mistake("gps/mission.toml", "range = [-0.3, 0.3]", "range = [0.3, -0.3]", "[-0.3, 0.3]"),
    Mistake(
        "templates/survey/mission.toml",
        "[goal.parameters]\nlength = 260.0",
        "[goal.parameter]\nlength = 260.0",
        "`parameters`",
    ),
    Mistake("bathymetry/planner.nddl", "chart_depth(water, x, y);", "chart_dept(water, x, y);", "`chart_depth`"),
    Mistake("bathymetry/planner.nddl", "chart_depth(water, x, y);", "chart_depth(water, x);", "y"),
    Mistake("gps/mission.toml", "final_tick = 900", "finaltick = 900", "`final_tick`"),
    Mistake(
        "gps/mission.toml",
        'predicate = "Transit"\nstart = [5, 60]',
        'predicat = "Transit"\nstart = [5, 60]',
        "`predicate`",
    ),
    *HABITS,
    *SLIPS_IN_TEMPLATES,
)


def found_for(mistake: Mistake, folder: Path, captured: Captured) -> tuple[list[dict[str, object]], int]:
    """What lint says of a project with a mistake, and the line that it is to be told in."""
    place, _, name = mistake.file.rpartition("/")
    beside = sorted((ROOT / place).iterdir()) if place != "classic" else [ROOT / mistake.file]
    for path in beside:
        if path.is_file() and not path.name.startswith(("mended", "navigator_mended")):
            shutil.copy(path, folder / path.name)
    text = (folder / name).read_text()
    assert text.count(mistake.right) == 1
    at = text.index(mistake.right)
    changed = text.replace(mistake.right, mistake.wrong)
    (folder / name).write_text(changed)
    blanks = len(mistake.wrong) - len(mistake.wrong.lstrip())
    where = changed.index(mistake.told) + len(mistake.told) - 1 if mistake.told else at + blanks
    missions = ["mission.toml"] if (folder / "mission.toml").exists() else []
    run(["lint", "--format", "json", *missions, "."])
    return json.loads(captured.readouterr().out)["diagnostics"], changed.count("\n", 0, where) + 1


def complaint(mistake: Mistake, folder: Path, captured: Captured) -> str:
    """What is wrong with what lint says; empty where it is right."""
    found, line = found_for(mistake, folder, captured)
    told = "\n".join(json.dumps(each, ensure_ascii=False) for each in found)
    if len(found) != 1:
        return f"{len(found)} messages\n{told}"
    (one,) = found
    if Path(str(one["file"])).name != Path(mistake.file).name or one["line"] != line:
        return f"told elsewhere than in line {line}\n{told}"
    return "" if mistake.help in told.replace('\\"', '"') else f"without `{mistake.help}`\n{told}"


@pytest.mark.parametrize("mistake", MISTAKES + MORE_MISTAKES, ids=lambda each: f"{each.file}: {each.wrong}")
def test_a_mistake_is_told_once_in_its_line_with_help(
    mistake: Mistake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    monkeypatch.chdir(tmp_path)
    assert complaint(mistake, tmp_path, capsys) == ""


def test_there_are_as_many_as_were_promised() -> None:
    assert len(MISTAKES) == 47
    assert len(MORE_MISTAKES) >= 47


@pytest.mark.parametrize("place", sorted({each.file.rpartition("/")[0] for each in MISTAKES} - {"classic"}))
def test_a_project_without_a_mistake_is_in_order(place: str, capsys: Captured) -> None:
    missions = [str(ROOT / place / "mission.toml")]
    assert run(["lint", *missions, str(ROOT / place)]) == 0
    assert "nothing wrong" in capsys.readouterr().out


AGENT = """<Agent name="gps" finalTick="900">
  <EuropaReactor name="navigator" latency="2" lookahead="900" model="navigator.nddl">
    <Internal name="nav"/> <External name="helm"/> <External name="gps"/>
  </EuropaReactor>
  <EuropaReactor name="psim" latency="0" lookahead="1" model="psim.nddl">
    <Internal name="helm"/> <Internal name="gps"/> <Internal name="motion"/>
  </EuropaReactor>
  <Goal on="nav" pred="Transit">
    <Variable name="start"> <int min="5" max="60"/> </Variable>
    <Variable name="distance"> <float value="240.0"/> </Variable>
  </Goal>
</Agent>
"""


@pytest.mark.parametrize(
    ("right", "wrong", "help_text"),
    [
        ('finalTick="900"', 'finaltick="900"', "`finalTick`"),
        ('on="nav"', 'on="nave"', "`nav`"),
        ('pred="Transit"', 'pred="Transist"', "`Transit`"),
        ('name="distance"', 'name="distanse"', "`distance`"),
        ('model="psim.nddl"', 'model="p_sim.nddl"', "`psim.nddl`"),
        ('min="5" max="60"', 'min="60" max="5"', "[5, 60]"),
        ('<External name="gps"/>', '<External name="gsp"/>', "`gps`"),
        ('latency="2"', 'latency="two"', "whole number"),
    ],
)
def test_a_mistake_in_an_agent_file_is_told_once(
    right: str, wrong: str, help_text: str, tmp_path: Path, capsys: Captured
) -> None:
    for path in (ROOT / "gps").glob("*.nddl"):
        shutil.copy(path, tmp_path / path.name)
    (tmp_path / "agent.xml").write_text(AGENT.replace(right, wrong, 1))
    assert run(["lint", "--format", "json", str(tmp_path / "agent.xml")]) == 1
    (one,) = json.loads(capsys.readouterr().out)["diagnostics"]
    assert one["line"] == AGENT.count("\n", 0, AGENT.index(right)) + 1
    assert help_text in json.dumps(one).replace('\\"', '"')


@pytest.mark.parametrize(
    ("right", "wrong", "help_text"),
    [
        ('modules = ["chart.py"]', 'module = ["chart.py"]', "write `modules`"),
        ('modules = ["chart.py"]', 'modules = ["chrt.py"]', "did you mean `chart.py`?"),
        ("[constraints]", "[constraint]", "write `constraints`"),
    ],
)
def test_a_mistake_in_the_settings_is_told_once(
    right: str, wrong: str, help_text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    for path in (ROOT / "bathymetry").iterdir():
        if path.is_file():
            shutil.copy(path, tmp_path / path.name)
    monkeypatch.chdir(tmp_path)
    settings = tmp_path / "nddlc.toml"
    settings.write_text(settings.read_text().replace(right, wrong))
    assert run(["lint", "mission.toml", "."]) == 2
    told = capsys.readouterr().err
    assert told.count("error[") == 1 and help_text in told
