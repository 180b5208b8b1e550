"""The published schema of mission files knows the keys that the reader asks for, and no others."""

import json
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from checker.mission import parse_mission
from checker.mission_table import Table
from checker.study.reading import read_study
from nddl_lang.text.source import Source
from runtime.executive.distributions import DISTRIBUTIONS

SCHEMA: dict[str, Any] = json.loads(Path("checker/mission_schema.json").read_text(encoding="utf-8"))
FULL = """\
[mission]
name = "gps"
final_tick = 600
[[reactor]]
name = "navigator"
model = "navigator.nddl"
internal = ["nav"]
[[reactor]]
name = "detector"
code = "psim.nddl:Detector"
[[goal]]
timeline = "nav"
predicate = "Hold"
[[property]]
name = "p"
kind = "within"
timeline = "nav"
ticks = 3
[property.then]
timeline = "nav"
[[property]]
name = "q"
kind = "level"
resource = "battery"
margin = 3
[figures]
path = "nav"
[parameters.A]
range = [0, 1]
"""


def errors(text: str) -> list[str]:
    found = jsonschema.Draft202012Validator(SCHEMA).iter_errors(tomllib.loads(text))
    return [error.message for error in found]


def tables(node: dict[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], set[str]]]:
    """Each table of the schema that is closed, with its keys."""
    if node.get("additionalProperties") is False:
        yield path, set(node["properties"])
    for key, inner in node.get("properties", {}).items():
        yield from tables(inner, (*path, key))
    if isinstance(node.get("additionalProperties"), dict):
        yield from tables(node["additionalProperties"], (*path, "*"))
    for number, inner in enumerate(node.get("items", {}).get("oneOf", [node["items"]] if "items" in node else [])):
        yield from tables(inner, (*path, str(number)))


def test_the_schema_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("path", sorted(Path("models").rglob("m*.toml")), ids=str)
def test_our_missions_fit_the_schema(path: Path) -> None:
    assert errors(path.read_text(encoding="utf-8")) == []


def test_the_schema_has_the_keys_that_the_reader_asks_for(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: dict[tuple[str, ...], set[str]] = {}
    close = Table.close

    def note(table: Table) -> None:
        names = tuple("*" if table.path[0] == "parameters" and at else str(each) for at, each in enumerate(table.path))
        asked.setdefault(names, set()).update(table.asked)
        close(table)

    monkeypatch.setattr(Table, "close", note)
    mission, found = parse_mission(Source("m.toml", FULL), Path("models/gps"))
    assert mission is not None, [one.message for one in found]
    listed = dict(tables(SCHEMA))
    renamed = {("*" if names == ("parameters", "*") else names): keys for names, keys in asked.items()}
    assert renamed[()] == listed[()]
    assert asked["mission",] == listed["mission",]
    assert asked["reactor", "0"] == listed["reactor", "0"]
    assert asked["reactor", "1"] == listed["reactor", "1"]
    assert asked["goal", "0"] == listed["goal", "0"]
    assert asked["check",] == listed["check",]
    assert asked["property", "0"] | asked["property", "1"] == listed["property", "0"]
    assert asked["property", "0", "then"] == listed["property", "0", "then"]
    assert asked["figures",] == listed["figures",]
    assert asked["constraints",] == listed["constraints",]
    assert asked["parameters", "*"] | asked["parameters",] >= listed["parameters", "*"]


def test_the_schema_has_the_distributions() -> None:
    parameter = SCHEMA["properties"]["parameters"]["additionalProperties"]
    assert parameter["properties"]["distribution"]["enum"] == list(DISTRIBUTIONS)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("final_tick = 600", "final_tick = 0"),
        ('resource = "battery"', 'timeline = "nav"'),
        ('timeline = "nav"\nticks', 'resource = "nav"\nticks'),
        ("final_tick = 600", 'final_tick = "late"'),
        ("final_tick = 600", "final_tick = 99999999999999999999"),
        ('name = "gps"', 'name = ""'),
        ("final_tick = 600", "final_tick = 600\nfinal = 3"),
        ('model = "navigator.nddl"\n', ""),
        ("range = [0, 1]", "range = [0, 1, 2]"),
        ("range = [0, 1]", 'distribution = "gaussian"'),
    ],
)
def test_the_schema_refuses_what_the_reader_refuses(old: str, new: str) -> None:
    text = FULL.replace(old, new)
    assert errors(FULL) == []
    assert errors(text)
    assert parse_mission(Source("m.toml", text), Path("models/gps"))[0] is None


STUDY: dict[str, Any] = json.loads(Path("checker/study_schema.json").read_text(encoding="utf-8"))
STUDY_FILE = Path("models/auv/study.toml")


def test_the_schema_of_studies_has_the_keys_that_the_reader_asks_for(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: dict[tuple[str, ...], set[str]] = {}
    close = Table.close

    def note(table: Table) -> None:
        asked.setdefault(tuple(str(each) for each in table.path), set()).update(table.asked)
        close(table)

    monkeypatch.setattr(Table, "close", note)
    study, found = read_study(STUDY_FILE)
    assert study is not None, [one.message for one in found]
    jsonschema.Draft202012Validator.check_schema(STUDY)
    assert not list(jsonschema.Draft202012Validator(STUDY).iter_errors(tomllib.loads(STUDY_FILE.read_text())))
    listed = dict(tables(STUDY))
    assert asked[()] == listed[()]
    assert asked["study",] == listed["study",]
    assert asked["variant", "0"] == listed["variant", "0"]
    assert asked["variant", "0", "expected"] == listed["variant", "0", "expected"]
