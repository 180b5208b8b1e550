"""`nddlc validate`: missions, records, traces and plans written by hand."""

import json
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run
from runtime.executive.rendering import event_data
from tests.checker.judge.missions import surveying

ROOT = Path(__file__).resolve().parents[3]
MISSION = str(ROOT / "models/gps/mission.toml")
MODEL = ROOT / "models/gps/navigator.nddl"
PLAN: dict[str, Any] = {
    "model": str(MODEL),
    "last_tick": 150,
    "tokens": [
        {"predicate": "Nav.Hold", "object": "nav", "start": 0, "end": 5},
        {"predicate": "Nav.Transit", "object": "nav", "start": 5, "end": 100, "arguments": {"distance": 240.0}},
        {"predicate": "Nav.Surface", "object": "nav", "start": 100, "end": 150, "arguments": {"minHits": 10}},
        {"predicate": "Helm.Run", "object": "helm", "start": 6, "end": 100, "arguments": {"distance": 240.0}},
        {"predicate": "Helm.Ascend", "object": "helm", "start": 101, "end": 126},
        {"predicate": "Gps.Active", "object": "gps", "start": 130, "end": 150, "arguments": {"minHits": 10}},
    ],
}


def written(folder: Path, data: dict[str, Any]) -> str:
    """A document in a file."""
    path = folder / "plan.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    return str(path)


def changed(token: int, **fields: Any) -> dict[str, Any]:
    """The plan with a token changed."""
    tokens = [{**each, **fields} if k == token else each for k, each in enumerate(PLAN["tokens"])]
    return {**PLAN, "tokens": tokens}


def test_a_plan_by_hand_holds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["validate", written(tmp_path, PLAN)]) == 0
    assert "0 disagreements" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("plan", "line"),
    [
        (changed(5, start=120), "`up before fix` does not hold"),
        (changed(5, arguments={"minHits": 9}), "`fix.minHits == minHits` does not hold"),
        (changed(3, end=99), "`run.end == end` does not hold"),
        (changed(0, end=6), "overlap on `nav`"),
        (changed(4, predicate="Helm.Run", arguments={"distance": 1.0}), "no token of the plan fits"),
        (changed(5, start={"between": [127, 128]}, end=160), "no token of the plan fits"),
        (changed(5, arguments={"minHits": {"one_of": [8, 9]}}), "`fix.minHits == minHits` does not hold"),
    ],
)
def test_a_broken_plan_is_told_by_its_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], plan: dict[str, Any], line: str
) -> None:
    assert run(["validate", written(tmp_path, plan)]) == 1
    assert line in capsys.readouterr().out


OVEN = """
Reusable power = new Reusable(3.0, 0.0);
enum Tone { low, high }
class Oven extends Timeline { predicate Heat { int level; float warmth; Tone tone; } }
class Table extends Timeline { predicate Served { } }
Oven::Heat {
  duration >= 5;
  warmth == 20.0 + level * 10.5;
  if (level >= 4) { tone == high; } else { tone == low; }
  before [1 3] (Table.Served s);
  equals(power.uses load);
  load.quantity == 2.0;
}
Oven oven = new Oven();
Oven other = new Oven();
Table table = new Table();
close();
"""


def heat(**fields: Any) -> dict[str, Any]:
    """A plan for the oven; `fields` are of its first token, its arguments among them."""
    arguments = {"level": 5, "warmth": 72.5, "tone": "high"} | fields.pop("arguments", {})
    return {
        "model": "oven.nddl",
        "tokens": [
            {"predicate": "Oven.Heat", "object": "oven", "start": 0, "end": 10, "arguments": arguments} | fields,
            {"predicate": "Table.Served", "object": "table", "start": 12, "end": 20},
            {"predicate": "Reusable.uses", "object": "power", "start": 0, "end": 10, "arguments": {"quantity": 2.0}},
        ],
    }


def twice(tokens: list[int]) -> dict[str, Any]:
    """The plan for the oven, with some tokens once more, on other objects."""
    plan = heat()
    plan["tokens"] += [plan["tokens"][k] | ({"object": "other"} if not k else {}) for k in tokens]
    return plan


@pytest.mark.parametrize(
    ("plan", "said"),
    [
        (
            heat(arguments={"warmth": 70.0}),
            "`warmth == 20.0 + level * 10.5` does not hold (Oven.Heat#0): warmth = 70.0, computed = 72.5",
        ),
        (
            heat(arguments={"tone": "low"}),
            "`tone == high` does not hold (Oven.Heat#0): tone = low, within = if (level >= 4)",
        ),
        (
            heat(arguments={"level": 2, "warmth": 41.0}),
            "`tone == low` does not hold (Oven.Heat#0): tone = high, within = else of if (level >= 4)",
        ),
        (heat(end=6), "Oven.Heat#0.end = 6, Table.Served#1.start = 12, distance at most = 3"),
        (heat(duration=9), "the duration is not the time from start to end"),
        (twice([0, 2]), "the level of `power` is below 0 (Reusable.uses#2, Reusable.uses#4): level = -1.0, tick = 0"),
        (
            twice([1]),
            "overlap on `table`: both at once, where one token follows the other (Table.Served#1, Table.Served#3)",
        ),
    ],
)
def test_a_broken_plan_is_told_with_what_is_in_the_way(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], plan: dict[str, Any], said: str
) -> None:
    (tmp_path / "oven.nddl").write_text(OVEN, encoding="utf-8")
    assert run(["validate", written(tmp_path, plan)]) == 1
    out = capsys.readouterr().out
    assert said in out and "help: " in out and "#" in out.partition("is the token with the key")[0]


def test_right_plans_for_the_oven_hold(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "oven.nddl").write_text(OVEN, encoding="utf-8")
    open_ended = heat(end={"between": [9, 11]}, arguments={"tone": {"one_of": ["low", "high"]}})
    open_ended["tokens"][2]["end"] = {"between": [9, 11]}
    for plan in (heat(), open_ended, twice([]), heat(arguments={"level": 2, "warmth": 41.0, "tone": "low"})):
        assert run(["validate", written(tmp_path, plan)]) == 0
        assert ", 0 disagreements" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("plan", "complaint"),
    [
        ({"tokens": []}, "it names no `model`"),
        ({**PLAN, "model": "nowhere.nddl"}, "there is no model"),
        (changed(0, predicate="Nav.Fly"), "no predicate `Nav.Fly`"),
        (changed(1, arguments={"speed": 1.0}), "no parameter `speed`"),
        (changed(1, start=[1, 2]), "`start`: [1, 2] is not a whole number"),
        (changed(1, start="5"), '`start`: "5" is not a whole number'),
        (changed(1, start=100, end=5), "ends at 5, before it starts at 100"),
        (changed(1, begin=5), "has a key `begin`, which says nothing"),
        (changed(1, arguments={"distance": "far"}), '`distance`: "far" is not a number'),
        (changed(2, arguments={"minHits": 9.5}), "`minHits`: 9.5 is not a whole number"),
        (changed(2, arguments={"minHits": {"between": [9, 8]}}), "nothing lies between 9 and 8"),
        (changed(2, arguments={"minHits": {"one_of": []}}), "is no range"),
        (changed(1, arguments={"distance": float("nan")}), "`NaN` is no number of JSON"),
        (changed(1, arguments={"distance": float("inf")}), "`Infinity` is no number of JSON"),
        (changed(1, predicate="Transit"), "write `Nav.Transit`"),
        (changed(1, predicate="Nav.Transid"), "did you mean `Nav.Transit`?"),
        (changed(1, object="nab"), "did you mean `nav`?"),
        (changed(1, object="helm"), "`helm` is of the class `Helm`, not `Nav`"),
        (changed(1, state="merged"), "lacks `merged_into`"),
        (changed(1, state="merged", merged_into=77), "there is no token 77"),
        (changed(1, key=0), "two tokens have the key 0"),
        (changed(1, runs=[{"rule": "Transit"}]), "`rule` is a number from 0"),
        ({**PLAN, "members": {"navy": []}}, "the model has no object `navy`"),
        (changed(1, state="asleep"), "`state` is one of"),
        ({**PLAN, "globals": {"SURFACE": 1}}, "no global variable `SURFACE`"),
    ],
)
def test_a_document_of_another_form_is_unusable(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], plan: dict[str, Any], complaint: str
) -> None:
    assert run(["validate", written(tmp_path, plan)]) == 2
    assert complaint in capsys.readouterr().err


def test_a_record_is_written_and_judged_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "record.json"
    assert run(["validate", MISSION, "--seed", "3", "--record", str(path)]) == 0
    assert run(["validate", str(path), "--mission", MISSION]) == 0
    data = json.loads(path.read_text(encoding="utf-8"))
    data["reactors"][1]["tokens"][3]["arguments"] = [230.0]
    path.write_text(json.dumps(data), encoding="utf-8")
    capsys.readouterr()
    assert run(["validate", str(path), "--mission", MISSION, "--format", "json"]) == 1
    report = json.loads(capsys.readouterr().out)
    assert {one["kind"] for one in report["disagreements"]} >= {"constraint", "observation"}


def test_a_trace_is_judged(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    events = [event_data(event) for event in surveying(0).outcome.events]
    path = tmp_path / "trace.jsonl"
    path.write_text("\n".join(json.dumps(event) for event in events), encoding="utf-8")
    assert run(["validate", str(path), "--mission", MISSION]) == 0
    late = next(event for event in events if event["predicate"] == "Ascend" and event["kind"] == "observation")
    late["tick"] += 7
    path.write_text("\n".join(json.dumps(event) for event in events), encoding="utf-8")
    assert run(["validate", str(path), "--mission", MISSION]) == 1
    assert "does not hold" in capsys.readouterr().out
    assert run(["validate", str(path)]) == 2


def test_a_trace_names_its_mission(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "trace.jsonl"
    assert run(["run", MISSION, "--until", "60", "--trace", str(path)]) in (0, 1)
    assert run(["validate", str(path)]) == 0
    capsys.readouterr()
    path.write_text(path.read_text(encoding="utf-8").replace("mission.toml", "elsewhere.toml", 1), encoding="utf-8")
    assert run(["validate", str(path)]) == 2
    assert "no file" in capsys.readouterr().err
