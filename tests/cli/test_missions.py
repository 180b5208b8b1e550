"""`nddlc run`, `replay` and `gold`: one mission flown, flown again, and kept as it was accepted."""

import json
import shutil
from pathlib import Path

import pytest

from nddlc.main import run
from nddlc.run import sorts_of
from runtime.executive.outcome import Event, EventKind, Phase

ORDER = Path(__file__).parents[1] / "executive" / "missions" / "order_of_requests"
CASES = ORDER.parents[1] / "cases"
REPAIR = Path(__file__).parents[1] / "executive" / "missions" / "repair"


def flown(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str]:
    """Exit code and output of a command."""
    code = run([*arguments])
    return code, capsys.readouterr().out


@pytest.fixture
def mission(tmp_path: Path) -> Path:
    """A copy of a mission."""
    shutil.copytree(ORDER, tmp_path / "m")
    return tmp_path / "m" / "mission.toml"


def test_a_mission_that_passes(mission: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, shown = flown(capsys, "run", str(mission))
    assert code == 0
    assert "order, seed 0: PASS at tick 400" in shown
    assert any(line.startswith("path") and "|Leg" in line for line in shown.splitlines())


def test_a_mission_that_fails_under_a_given_value(capsys: pytest.CaptureFixture[str]) -> None:
    code, shown = flown(capsys, "run", str(REPAIR / "mission.toml"), "--param", "D=25")
    assert code == 1 and "FAIL F1" in shown
    assert flown(capsys, "run", str(REPAIR / "mission.toml"), "--param", "D=5")[0] == 0


def test_values_of_unknown_parameters_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert flown(capsys, "run", str(REPAIR / "mission.toml"), "--param", "E=25")[0] == 2
    for given, said in (
        ("D=x", "`D` takes a number, not `x`"),
        ("D", "`D` gives no value"),
        ("D=", "`D=` gives no value"),
    ):
        assert run(["run", str(REPAIR / "mission.toml"), "--param", given]) == 2
        told = capsys.readouterr().err
        assert told == f"nddlc: {said}\n  help: write `D=` and a number\n"


def test_a_file_that_ends_otherwise_may_be_meant(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("mission.toml", "planner.nddl"):
        Path(name).write_text("", encoding="ascii")
    for name, meant in (("mission.tml", "mission.toml"), ("planer.toml", "planner.nddl")):
        assert run(["check", name]) == 2
        assert capsys.readouterr().err == f"nddlc: no file `{name}`\n  help: did you mean `{meant}`?\n"


def test_a_mission_may_be_stopped_before_its_end(mission: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, shown = flown(capsys, "run", str(mission), "--until", "50")
    assert code == 0 and "at tick 50" in shown


def test_a_trace_is_flown_again(mission: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trace = tmp_path / "trace.jsonl"
    assert flown(capsys, "run", str(mission), "--trace", str(trace))[0] == 0
    events = [json.loads(line) for line in trace.read_text().splitlines()]
    assert events[0]["kind"] == "mission" and events[-1]["kind"] == "end"
    code, shown = flown(capsys, "replay", str(trace))
    assert code == 0 and shown.startswith("the same: ")
    model = mission.parent / "b.nddl"
    model.write_text(model.read_text().replace("30", "31"))
    code, shown = flown(capsys, "replay", str(trace))
    assert code == 1 and "the models are not those of the trace" in shown and "departs at line" in shown


def test_events_that_look_alike_are_told_with_what_differs(mission: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trace = mission.parent / "t.jsonl"
    assert run(["run", str(mission), "--trace", str(trace)]) == 0
    lines = trace.read_text().splitlines()
    number = next(n for n, line in enumerate(lines) if '"kind":"request"' in line.replace(": ", ":"))
    event = json.loads(lines[number])
    event["start"] = [event["start"][0], event["start"][1] + 7]
    lines[number] = json.dumps(event)
    trace.write_text("\n".join(lines) + "\n")
    capsys.readouterr()
    code, shown = flown(capsys, "replay", str(trace))
    was, now = (line.partition(":")[2].strip() for line in shown.splitlines()[-2:])
    assert code == 1 and was != now
    assert f"start {event['start']}" in was
    assert f"start {[event['start'][0], event['start'][1] - 7]}" in now


def test_what_is_no_trace_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "t.jsonl"
    for content in (b'{"kind": "observation"}\n', b"[mission]\n", b"\xff\xfe\n", b""):
        file.write_bytes(content)
        assert run(["replay", str(file)]) == 2
        said = capsys.readouterr().err
        assert "is no trace: its first line" in said and "help: `nddlc run MISSION --trace FILE` writes one" in said


def test_what_was_accepted_is_compared(mission: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert flown(capsys, "gold", "diff", str(mission))[0] == 2
    assert flown(capsys, "gold", "accept", str(mission), "--by", "Ada")[0] == 0
    assert flown(capsys, "gold", "diff", str(mission)) == (0, "nothing differs\n")
    assert flown(capsys, "gold", "show", str(mission))[1].startswith("accepted by Ada at ")
    model = mission.parent / "b.nddl"
    model.write_text(f"// Only said.\n\n{model.read_text()}// So is this.\n")
    code, shown = flown(capsys, "gold", "diff", str(mission))
    assert code == 0 and "nothing differs" in shown
    model.write_text(model.read_text().replace("30", "31"))
    code, shown = flown(capsys, "gold", "diff", str(mission))
    assert code == 1
    assert "the models have changed since Ada accepted them" in shown
    assert "tick 35, nav\n  - observation Hold by nav" in shown


def test_a_goal_that_nothing_ends_is_told_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["new", "retry"]) == 0
    planner = tmp_path / "retry" / "planner.nddl"
    planner.write_text(planner.read_text().replace("    held.end == end;\n", ""))
    mission = tmp_path / "retry" / "mission.toml"
    more = '[[goal]]\ntimeline = "task"\npredicate = "Fetch"\nmandatory = true\n'
    mission.write_text(
        mission.read_text().replace("[parameters.LUCK]", f"{more}start = 150\n\n{more}at = 250\n\n[parameters.LUCK]")
    )
    capsys.readouterr()
    assert run(["run", "retry/mission.toml"]) == 1
    said = capsys.readouterr().out
    assert "open: Fetch: it began at tick 150, and nothing has ended it\n" in said
    mission.write_text(mission.read_text().replace("final_tick", 'on_failure = "kill_reactor"\nfinal_tick', 1))
    planner.write_text(planner.read_text().replace("contains(", "duration <= 3; contains(", 1))
    assert run(["run", "retry/mission.toml"]) == 1
    assert "killed at tick" in capsys.readouterr().out
    assert "open: Fetch: its time to be sent had not come\n" in said


def test_a_goal_that_a_determined_simulator_has_begun_is_told_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["new", "deadline"]) == 0
    simulator, mission = tmp_path / "deadline" / "simulator.nddl", tmp_path / "deadline" / "mission.toml"
    simulator.write_text(simulator.read_text().replace("duration == heating + 30;", "duration >= heating;"))
    text = mission.read_text().replace('"lab"\npredicate = "Analyse"', '"oven"\npredicate = "Bake"')
    mission.write_text("\n".join(line for line in text.splitlines() if not line.startswith("end = ")))
    capsys.readouterr()
    assert run(["run", "deadline/mission.toml"]) == 1
    assert "open: Bake: it began at tick 10, and nothing has ended it\n" in capsys.readouterr().out


PROPERTY = """
[[property]]
name = "never on a leg"
kind = "never"
timeline = "path"
predicate = "Leg"
"""


def test_a_broken_property_is_named(mission: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = mission.read_text()
    mission.write_text(text.replace("[check]", f"{PROPERTY}\n[check]") if "[check]" in text else text + PROPERTY)
    code, shown = flown(capsys, "run", str(mission))
    assert code == 1 and "FAIL P1" in shown
    assert "  the property `never on a leg` is violated at tick " in shown


def test_the_message_of_a_line_is_told_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["new", "retry", "--template", "retry"]) == 0
    model = Path("retry/planner.nddl")
    model.write_text(model.read_text().replace("ATTEMPTS = 3;", "ATTEMPTS = 1;"))
    capsys.readouterr()
    assert run(["run", "retry/mission.toml", "--seed", "6"]) == 1
    assert 'attempt < ATTEMPTS : "no attempt is left"\n' in capsys.readouterr().out


def test_what_takes_turns_is_told_once_each() -> None:
    first, second = (Event(1, Phase.REPAIR, EventKind.RELAX, one) for one in ("a", "b"))
    other = Event(1, Phase.REPAIR, EventKind.REJECT, "a")
    assert sorts_of([first, other] * 3) == [[first] * 3, [other] * 3]
    assert sorts_of([first, second, other, first]) == [[first], [second], [other], [first]]


def test_a_flight_that_was_cut_says_what_may_still_come(mission: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, whole = flown(capsys, "run", str(mission))
    assert "flown to tick" not in whole
    _, shown = flown(capsys, "run", str(mission), "--until", "2")
    assert "  flown to tick 2 only, and judged as far: the mission ends at " in shown
    assert " of its goals may still be achieved" in shown


def test_a_goal_that_came_back_is_not_counted_as_lost(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    told = (
        "achieved 1, open 0, recalled 1; requests between reactors 2, rejected 1 (1 came back), refused 0, recalled 1"
    )
    folder = CASES / "rejected_request_comes_back"
    assert told in flown(capsys, "run", str(folder / "mission.toml"))[1]
    shutil.copytree(folder, tmp_path / "late")
    file = tmp_path / "late/mission.toml"
    file.write_text(file.read_text().replace("mandatory = true", "mandatory = true\nrecall = 35"))
    assert told in flown(capsys, "run", str(file))[1]  # what is over cannot be taken back
