"""Single mistakes of a modeler, in whole projects: each is told once, in its line, with the help that mends it.

`nddlc lint mission.toml .` is asked, as a modeler asks; of a model without a mission, `nddlc lint .`.
"""

import json
import shutil
from dataclasses import dataclass
from pathlib import Path

import pytest

from nddlc.main import run

ROOT = Path(__file__).parents[2] / "models"
Captured = pytest.CaptureFixture[str]


@dataclass(frozen=True)
class Mistake:
    """`right`, once in a file, is typed as `wrong`; the message is in the line with `told`, and says `help`."""

    file: str
    right: str
    wrong: str
    help: str
    told: str = ""  # the line of the message, where it is another than the one that was changed


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


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda each: f"{each.file}: {each.wrong}")
def test_a_mistake_is_told_once_in_its_line_with_help(
    mistake: Mistake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    monkeypatch.chdir(tmp_path)
    assert complaint(mistake, tmp_path, capsys) == ""


def test_there_are_as_many_as_were_promised() -> None:
    assert len(MISTAKES) == 47


@pytest.mark.parametrize("place", sorted({each.file.rpartition("/")[0] for each in MISTAKES} - {"classic"}))
def test_a_project_without_a_mistake_is_in_order(place: str, capsys: Captured) -> None:
    missions = [str(ROOT / place / "mission.toml")]
    assert run(["lint", *missions, str(ROOT / place)]) == 0
    assert "nothing wrong" in capsys.readouterr().out
