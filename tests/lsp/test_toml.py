"""A solver's TOML and the settings of a project in the editor: what is offered at `|`, explained, and led to."""

import json
import tomllib
from pathlib import Path
from typing import Any

import pytest

from lsp.toml_kinds import TomlKind, root_schema
from nddl_lang.lint.configuration import read_configuration as read_settings
from nddl_lang.text.source import Source
from runtime.solver.configuration.read import read_configuration

MODEL = """\
class Rover extends Timeline {
  predicate Idle { }
  predicate Go { float speed; }
}
class Place { int depth; }
Rover rover = new Rover();
close();
"""
MISSION = (
    '[mission]\nname = "a"\nfinal_tick = 9\n[[reactor]]\nname = "a"\nmodel = "rover.nddl"\nsolver = "planner.toml"\n'
)
SOLVER = """\
name = "quick"
[[manager]]
component = "UnboundVariableManager"
default_priority = 2
[[manager.handler]]
component = "ValEnum"
class = "Rover"
predicate = "Go"
variable = "speed"
values = [1.0]
"""
SETTINGS = 'ignore = ["NDDL501"]\nfail-on = "warning"\n[severity]\nNDDL504 = "off"\n'


@pytest.fixture
def ask(wire: Any, tmp_path: Path) -> Any:
    """Ask about the place of `|` in a file of a project."""
    (tmp_path / "rover.nddl").write_text(MODEL)
    (tmp_path / "mission.toml").write_text(MISSION)
    (tmp_path / "lib").mkdir()
    wire.start()

    def asked(method: str, name: str, text: str) -> Any:
        before, _, after = text.partition("|")
        uri = (tmp_path / name).as_uri()
        wire.open(uri, before + after)
        position = {"line": before.count("\n"), "character": len(before.rpartition("\n")[2])}
        return wire.ask(f"textDocument/{method}", textDocument={"uri": uri}, position=position)["result"]

    return asked


@pytest.mark.parametrize(
    ("typed", "wanted", "others"),
    [
        ("[[manager]]\ncomponent = \"|", {"ThreatManager", "UnboundVariableManager"}, {"Min"}),
        ("[[manager]]\nd|", {"component", "default_priority", "order"}, {"priority", "mission"}),
        (SOLVER + "\n[[manager.handler]]\ncomponent = \"|", {"Min", "ValEnum"}, {"StandardThreatHandler"}),
        (SOLVER + "\n[[manager.filter]]\npolicy = \"|", {"PartiallyContained"}, {"Min"}),
        (SOLVER + "\n[[manager.filter]]\nclass = \"|", {"Rover"}, {"Place"}),
        (SOLVER + "\n[[manager.filter]]\npredicate = \"|", {"Rover.Go", "Rover.Idle"}, {"Place"}),
        (SOLVER.replace('predicate = "Go"', 'predicate = "|'), {"Go", "Idle"}, {"Rover.Go"}),
        (SOLVER.replace('variable = "speed"', 'variable = "|'), {"speed", "start"}, {"depth"}),
        (SOLVER.replace("values = [1.0]", "p|"), {"priority", "guards"}, {"policy"}),
        ("\n|" + SOLVER, {"[[manager]]", "[[filter]]"}, {"[mission]"}),
        (SOLVER + "[[|", {"manager", "filter"}, {"mission"}),
    ],
)  # fmt: skip
def test_a_solver_is_completed(typed: str, wanted: set[str], others: set[str], ask: Any) -> None:
    labels = {each["label"] for each in ask("completion", "planner.toml", typed)}
    assert wanted <= labels
    assert not labels & others


@pytest.mark.parametrize(
    ("at", "told"),
    [
        ('"Go"', "predicate Rover.Go"),
        ('"Rover"', "class Rover"),
        ('"speed"', "float speed"),
        ("values", "in the order in which they are tried"),
        ("default_priority", "99999"),
    ],
)
def test_a_solver_is_explained(at: str, told: str, ask: Any) -> None:
    text = SOLVER.replace(at, at[:2] + "|" + at[2:])
    assert told in ask("hover", "planner.toml", text)["contents"]["value"]


@pytest.mark.parametrize(("at", "line"), [('"Go"', 2), ('"Rover"', 0), ('"speed"', 2)])
def test_a_solver_leads_into_the_model(at: str, line: int, ask: Any) -> None:
    found = ask("definition", "planner.toml", SOLVER.replace(at, at[:2] + "|" + at[2:]))
    assert found["uri"].endswith("rover.nddl")
    assert found["range"]["start"]["line"] == line


@pytest.mark.parametrize(
    ("typed", "wanted", "others"),
    [
        ("|", {"ignore", "fail-on", "[severity]", "[constraints]"}, {"[mission]", "[ignore]"}),
        ('ignore = ["|', {"NDDL501", "NDDL504"}, set()),
        ('fail-on = "|', {"error", "never"}, {"off"}),
        ("[severity]\n|", {"NDDL501"}, {"ignore"}),
        ('[severity]\nNDDL501 = "|', {"error", "off"}, {"never"}),
        ('include = ["|', {"lib"}, set()),
        ("[constraints]\n|", {"modules", "time_limit"}, {"ignore"}),
    ],
)
def test_settings_are_completed(typed: str, wanted: set[str], others: set[str], ask: Any) -> None:
    labels = {each["label"] for each in ask("completion", "nddlc.toml", typed)}
    assert wanted <= labels
    assert not labels & others


@pytest.mark.parametrize(
    ("at", "told"),
    [("NDDL501", "never"), ("NDDL504", "global"), ("fail-on", "least severity"), ("ignore", "not reported")],
)
def test_settings_are_explained(at: str, told: str, ask: Any) -> None:
    text = SETTINGS.replace(at, at[:3] + "|" + at[3:])
    assert told in ask("hover", "nddlc.toml", text)["contents"]["value"]


def keys(schema: Any, path: str = "") -> dict[str, set[str]]:
    """The keys of each table of a schema."""
    found = {path: set(schema.get("properties", {}))}
    for name, each in schema.get("properties", {}).items():
        inner = each.get("items", each)
        if "properties" in inner:
            found |= keys(inner, f"{path}.{name}".lstrip("."))
    return found


@pytest.mark.parametrize("table", ["manager", "manager.handler", "manager.filter", "filter"])
def test_the_schema_of_a_solver_has_the_keys_that_are_read(table: str) -> None:
    """What is read for any component: the reader lists it for one that it does not know."""
    known: set[str] = set()
    components = {"manager": "ResourceThreatManager", "filter": "HorizonFilter", "manager.filter": "HorizonFilter"}
    handlers = ["ResourceThreatHandler", "HSTSOpenConditionDecisionPoint"]
    for component in [components[table]] if table in components else handlers:
        manager = {"R": "ResourceThreatManager", "H": "OpenConditionManager"}.get(component[0], "")
        head = f'[[manager]]\ncomponent = "{manager}"\n' if table == "manager.handler" else ""
        head = '[[manager]]\ncomponent = "ThreatManager"\n' if table == "manager.filter" else head
        text = f'{head}[[{table}]]\ncomponent = "{component}"\nqqqqqqqqqqqq = 1\n'
        (told,) = read_configuration(Source("a.toml", text))[1]
        known |= set(str(told.help).partition(": ")[2].replace("`", "").split(", "))
    tables = {"manager": {"filter", "handler"}, "manager.handler": {"guards", "master_guards", "values"}}
    assert keys(root_schema(TomlKind.SOLVER))[table] == known | tables.get(table, set())


def test_the_schema_of_settings_has_the_keys_that_are_read(tmp_path: Path) -> None:
    samples = {
        "select": '["NDDL5"]', "ignore": "[]", "include": "[]", "dialect": '"nddlc"', "fail-on": '"hint"',
        "max-lexemes": "9", "constraints": "{ modules = [], time_limit = 1 }", "severity": '{ NDDL501 = "hint" }',
    }  # fmt: skip
    assert keys(root_schema(TomlKind.SETTINGS))[""] == set(samples)
    text = "".join(f"{key} = {value}\n" for key, value in samples.items())
    assert read_settings(tmp_path / "nddlc.toml", text)[1] == []
    assert json.loads(json.dumps(tomllib.loads(text)))
