"""What commands print as JSON fits the schemas that are published of it, to the last key."""

import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from checker.batch.result import MissionResult
from checker.batch.worker import Load
from checker.campaign import Campaign
from checker.conditions.condition import Extreme
from checker.counterfactual.ranking import Claim
from checker.counterfactual.tried import TrialsEnd
from checker.excerpts import Excerpts
from checker.findings import Ending
from checker.graph import NodeKind
from checker.limits import Limit
from checker.losses import GoalFate
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.kinds import EditKind
from checker.oracle import Judgement, Verdict
from checker.proofs.conflict import Finding
from checker.report.document import json_report
from checker.sampling.sampler import MissionRole
from checker.schemas import SCHEMAS, schema
from checker.steps import StepKind
from checker.yardstick import Fate
from nddl_lang.text.diagnostic import Severity
from nddlc.main import run
from runtime.executive.outcome import ElementKind, EventKind, Phase, RepairStage
from tests.checker.fake_agent import load_broken, load_split
from tests.checker.test_commands import plug
from tests.cli.test_front import ENDLESS

pytestmark = pytest.mark.once

MODELS = Path("models").resolve()
GPS = MODELS / "gps"
SURVEY = MODELS / "templates" / "survey" / "mission.toml"
CASES = Path("tests/conformance/cases").resolve()
ENUMERATIONS: list[type[Enum]] = [
    *(Claim, EditKind, ElementKind, Ending, EventKind, Extreme, Fate, Finding, GoalFate, MissionRole, NodeKind),
    *(Phase, RepairStage, Severity, StepKind, TrialsEnd, Verdict),
]


def misfits(name: str, document: Any) -> list[str]:
    found = jsonschema.Draft202012Validator(schema(name)).iter_errors(document)
    return [f"{'/'.join(map(str, one.absolute_path))}: {one.message}" for one in found]


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Any]:
    """A function that runs a command in an empty folder and gives what it prints, read as JSON."""
    monkeypatch.chdir(tmp_path)

    def run_and_read(*arguments: str | Path, code: int = 0) -> Any:
        capsys.readouterr()
        assert run([str(one) for one in arguments]) == code
        return json.loads(capsys.readouterr().out)

    yield run_and_read


def objects(node: Any) -> Iterator[dict[str, Any]]:
    """Every schema inside a schema that speaks of an object."""
    if isinstance(node, dict):
        if node.get("type") == "object" or node.get("type") == ["object", "null"]:
            yield node
        for inner in node.values():
            yield from objects(inner)
    elif isinstance(node, list):
        for inner in node:
            yield from objects(inner)


@pytest.mark.parametrize("name", SCHEMAS)
def test_each_is_a_schema_and_stands_alone(name: str, printed: Any) -> None:
    found = printed("schema", name)
    jsonschema.Draft202012Validator.check_schema(found)
    assert found["title"]
    texts = json.dumps(found)
    assert all(f'"#/$defs/{each}"' in texts for each in found.get("$defs", {}))


@pytest.mark.parametrize("name", [one for one in SCHEMAS if "$defs" in schema(one)])
def test_no_object_takes_keys_that_it_does_not_name(name: str) -> None:
    found = list(objects(schema(name)))
    assert found
    assert all("additionalProperties" in one for one in found)


@pytest.mark.parametrize("kind", ENUMERATIONS, ids=lambda kind: kind.__name__)
def test_the_words_are_those_of_the_code(kind: type[Enum]) -> None:
    words = [member.value for member in kind]
    some = [one for one in words if one not in ("achieved", "open", "recalled")] if kind is GoalFate else words
    assert json.dumps(some) in json.dumps([schema(name) for name in SCHEMAS])


def test_the_limits_are_those_of_the_code() -> None:
    limits = schema("report")["$defs"]["report"]["properties"]["limits"]["properties"]
    assert list(limits) == [one.value for one in Limit]


@pytest.mark.parametrize(("load", "code"), [(load_split, 1), (load_broken, 3)])
def test_reports_fit(load: Load, code: int, printed: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    plug(monkeypatch, load)
    report = printed("check", GPS / "mission.toml", "--missions", "17", "--format", "json", code=code)
    assert misfits("report", report) == []
    assert misfits("report", json.loads(Path("nddlc-report/report.json").read_text(encoding="utf-8"))) == []
    if load is load_split:
        assert misfits("explain", printed("explain", "latest", "--events", "--format", "json")) == []
        assert misfits("explain", printed("explain", "latest#1", "--format", "json")) == []


def test_reports_of_errors_and_of_an_interrupted_run_fit(tmp_path: Path) -> None:
    mission, _ = read_mission(GPS / "mission.toml")
    assert mission is not None
    campaign = Campaign(mission, load_models(mission), load_split)
    some = replace(campaign.mission, check=replace(campaign.mission.check, missions=12))
    results: list[MissionResult] = list(replace(campaign, mission=some).fly(1, None).results)
    broken = Judgement(Verdict.ERROR, message="KeyError: <'x'>")
    results[2] = replace(results[2], judgement=broken, outcome=None, has_trace=False)
    for ending in Ending:
        findings = replace(campaign.assess(tuple(results)), ending=ending)
        assert misfits("report", json.loads(json_report(findings, Excerpts(GPS)))) == []


@pytest.mark.parametrize(("template", "missions"), [("survey", "15"), ("battery", "4")])
def test_what_real_missions_give_fits(template: str, missions: str, printed: Any) -> None:
    mission = MODELS / "templates" / template / "mission.toml"
    options = ("--missions", missions, "--workers", "1", "--flights", "2", "--coverage", "--format", "json")
    report = printed("check", mission, *options, code=int(template == "survey"))
    assert misfits("report", report) == []
    if template == "survey":
        assert report["faults"], "this is the one that fails"
        story = printed("explain", "latest", "--events", "--format", "json")
        assert misfits("explain", story) == []
        assert [one for event in story["trace"][:40] for one in misfits("trace", event)] == []
        assert misfits("compare", printed("compare", "latest", "latest", "--format", "json")) == []


def test_findings_of_lint_and_of_check_fit(printed: Any) -> None:
    Path("m.toml").write_text('[mission]\nname = "m"\nfinal_tik = 3\n', encoding="utf-8")
    assert misfits("lint", printed("check", "m.toml", "--format", "json", code=2)) == []
    Path("a.nddl").write_text('class A extends B {\n  int x\n}\nA a = new C();\n#include "no.nddl"\n', encoding="utf-8")
    found = printed("lint", "m.toml", "a.nddl", GPS, "--format", "json", code=1)
    assert misfits("lint", found) == []
    assert any(one["fixes"] for one in found["diagnostics"])
    assert any(one["notes"] for one in found["diagnostics"])


def test_mutants_fit(printed: Any) -> None:
    assert misfits("mutate", printed("mutate", SURVEY, "--limit", "2", "--missions", "3", "--json")) == []


@pytest.mark.parametrize("name", ["res_uses_is_an_interval", "res_subclass_of_reservoir", "err_several_syntax_errors"])
def test_loaded_and_planned_models_fit(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    path = str(CASES / f"{name}.nddl")
    for command, *options in (["load"], ["plan", "--explain", "--max-steps", "50"]):
        run([command, path, "--json", *options])
        (line,) = capsys.readouterr().out.splitlines()
        assert misfits(command, json.loads(line, parse_constant=pytest.fail)) == []


def test_a_search_that_ran_out_of_memory_fits(printed: Any) -> None:
    Path("m.nddl").write_text(ENDLESS, encoding="utf-8")
    found = printed("plan", "m.nddl", "--horizon", "0", "inf", "--max-memory", "20", "--json", code=1)
    assert misfits("plan", found) == []
    assert found["solve"]["result"] == "memory"


def test_a_search_that_finds_no_plan_fits(printed: Any) -> None:
    Path("m.nddl").write_text(
        "class T extends Timeline { predicate P { int n; } }\nT t = new T();\n"
        "T::P { duration == 60; }\ngoal(T.P a);\ngoal(T.P b);\n"
        "a.start >= 0; b.start >= 0; a.end <= 100; b.end <= 100; a.n == 1; b.n == 2;\n",
        encoding="utf-8",
    )
    found = printed("plan", "m.nddl", "--horizon", "0", "100", "--explain", "--json", code=1)
    assert misfits("plan", found) == []
    assert found["solve"]["is_complete"]
    assert found["explanation"]


def test_proofs_fit(printed: Any) -> None:
    found = printed("certify", SURVEY, "--bound", "LEG_MAX", "--format", "json", code=1)
    assert misfits("certify", found) == []
    assert found["point"]
    assert found["bounds"][0]["certified"]
    assert misfits("controllability", printed("controllability", SURVEY, "--format", "json", code=1)) == []


def test_judgements_and_records_fit(printed: Any) -> None:
    found = printed("validate", SURVEY, "--smt", "--record", "right.json", "--format", "json")
    assert misfits("validate", found) == []
    record = json.loads(Path("right.json").read_text(encoding="utf-8"))
    assert misfits("record", record) == []
    next(one for each in record["reactors"] for one in each["tokens"])["duration"] = 7
    Path("wrong.json").write_text(json.dumps(record), encoding="utf-8")
    wrong = printed("validate", "wrong.json", "--smt", "--format", "json", code=1)
    assert misfits("validate", wrong) == []
    assert wrong["disagreements"]
    assert wrong["smt"]["broken"]


def test_shrunk_missions_and_stores_fit(printed: Any) -> None:
    printed("check", SURVEY, "--missions", "15", "--workers", "1", "--flights", "0", "--format", "json", code=1)
    assert misfits("shrink", printed("shrink", "latest", "--format", "json")) == []
    store = Path(".nddlc/runs.sqlite")
    assert misfits("store", printed("store", "check", "--format", "json")) == []
    with closing(sqlite3.connect(store)) as connection, connection:
        connection.execute("UPDATE missions SET result = 'x' WHERE number = 3")
    damaged = printed("store", "check", "--format", "json", code=1)
    assert misfits("store", damaged) == []
    assert damaged["missions"]
