"""A solver's configuration as text, what is read of it, and what is wrong with it."""

import re
from pathlib import Path
from textwrap import dedent

import pytest

from nddl_lang.text.source import Source
from runtime.plan.tags import ACTIVE
from runtime.solver.configuration.configuration import Configuration, FlawFilter, Match, default_configuration
from runtime.solver.configuration.limits import Limits, model_limits
from runtime.solver.configuration.read import read_configuration
from runtime.solver.configuration.read_toml import is_solver_text
from tests.solver.planning import loaded, solver_for

MANUAL = Path(__file__).resolve().parent.parent.parent / "docs" / "plan.md"

SAMPLE = """\
<Solver name="S">
  <FlawFilter component="HorizonFilter" policy="TotallyContained"/>
  <ThreatManager defaultPriority="3">
    <FlawHandler component="HSTSThreatDecisionPoint" order="late"/>
  </ThreatManager>
  <UnboundVariableManager>
    <FlawFilter class-match="T" var-match="x"/>
    <FlawHandler component="ValEnum" predicate="p" variable="e" priority="7" maxChoices="2">
      <Value val="red"/> <Value val="blue"/>
      <Guard name="x" value="3"/> <MasterGuard name="y" value="true"/>
    </FlawHandler>
  </UnboundVariableManager>
</Solver>
"""

SAME_AS_TOML = """\
name = "S"
[[filter]]
component = "HorizonFilter"
policy = "TotallyContained"
[[manager]]
component = "ThreatManager"
default_priority = 3
[[manager.handler]]
component = "HSTSThreatDecisionPoint"
order = "late"
[[manager]]
component = "UnboundVariableManager"
[[manager.filter]]
class = "T"
variable = "x"
[[manager.handler]]
component = "ValEnum"
predicate = "p"
variable = "e"
priority = 7
max_choices = 2
values = ["red", "blue"]
guards = { x = 3 }
master_guards = { y = true }
"""


def read_well(name: str, text: str) -> Configuration:
    configuration, complaints = read_configuration(Source(name, text))
    assert not complaints
    assert configuration is not None
    return configuration


def complaints_of(text: str, name: str = "s.xml") -> list[str]:
    """Complaints as `line: message`."""
    _, complaints = read_configuration(Source(name, dedent(text)))
    return [f"{each.span.line}: {each.message}" for each in complaints]


def test_xml_says_managers_filters_and_handlers_in_order() -> None:
    configuration = read_well("s.xml", SAMPLE)
    assert configuration.filters == (FlawFilter("HorizonFilter", Match(), "TotallyContained"),)
    threats, variables = configuration.managers
    assert (threats.handlers[0].priority, threats.handlers[0].order) == (3.0, ("late",))
    assert variables.filters == (FlawFilter("FlawFilter", Match(class_name="T", variable="x")),)
    (listed,) = variables.handlers
    assert (listed.values, listed.guards, listed.parent_guards) == (("red", "blue"), (("x", "3"),), (("y", "true"),))
    assert (listed.priority, listed.max_choices, listed.specificity) == (7.0, 2, 4)


def test_toml_says_the_same_as_xml() -> None:
    assert read_well("s.toml", SAME_AS_TOML) == read_well("s.xml", SAMPLE)


TREX = """<?xml version="1.0"?>
<!-- as T-REX's reactors have it -->
<Solver name="plan">
  <ThreatManager defaultPriority="10"><FlawHandler component="TrexThreatHandler"/></ThreatManager>
  <OpenConditionManager component="EarliestFirst" defaultPriority="{goals}">
    <FlawFilter component="notGoals"/> <FlawHandler component="TrexOpenConditionHandler"/>
  </OpenConditionManager>
  <OpenConditionManager defaultPriority="100">
    <FlawFilter component="goals"/> <FlawHandler component="TrexOpenConditionHandler"/>
  </OpenConditionManager>
</Solver>
"""


@pytest.mark.parametrize(("priority", "first"), [(40, "B.Goal"), (400, "B.Must")])
def test_filters_of_trex_leave_out_goals_that_may_be_rejected_or_all_others(
    tmp_path: Path, priority: int, first: str
) -> None:
    text = "class B extends Timeline { predicate Goal { } predicate Must { } }\nB b = new B();\n"
    text += "goal(B.Must must);\nrejectable(B.Goal one);\nclose();\n"
    how = read_well("s.xml", TREX.format(goals=priority))
    solver = solver_for(tmp_path, text, how=how)
    assert solver.solve(1, 2**60) != 0
    names = [predicate.name for predicate in solver.database.program.predicates]
    active = [names[solver.plan.rows.predicate[t]] for t in (0, 1) if solver.plan.rows.status[t] == ACTIVE]
    assert active == [first]


@pytest.mark.parametrize(("name", "text"), [("s.xml", TREX), ("s.cfg", TREX), ("s.toml", SAME_AS_TOML)])
def test_a_configuration_is_known_by_its_text(name: str, text: str) -> None:
    assert is_solver_text(name, text)
    assert not is_solver_text(name, '<Agent name="a"><EuropaReactor plan_cfg="Solver"/></Agent>')


def test_the_example_in_the_manual_is_well_formed() -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", MANUAL.read_text(encoding="utf-8"), re.DOTALL)
    configuration = read_well("s.toml", text)
    assert [handler.values for handler in configuration.managers[1].handlers] == [("fast", "slow")]


def test_a_handler_without_priority_has_that_of_its_manager_or_the_worst() -> None:
    text = "<Solver><OpenConditionManager{}><FlawHandler/></OpenConditionManager></Solver>"
    assert read_well("s.xml", text.format("")).managers[0].handlers[0].priority == 99999
    assert read_well("s.xml", text.format(' defaultPriority="5"')).managers[0].handlers[0].priority == 5


def test_the_default_mends_order_tokens_and_variables_at_best_priority() -> None:
    managers = default_configuration().managers
    names = [manager.component for manager in managers]
    assert names == ["ThreatManager", "OpenConditionManager", "UnboundVariableManager"]
    assert all(handler.priority == 0 for manager in managers for handler in manager.handlers)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("<Solver>\n<ThreatManger/></Solver>", "2: no flaw manager is called `ThreatManger`"),
        (
            '<Solver><ThreatManager>\n<FlawHandler component="Foo"/></ThreatManager></Solver>',
            "2: no handler is called `Foo`",
        ),
        ('<Solver>\n\n<FlawFilter component="Foo"/></Solver>', "3: no filter is called `Foo`"),
        (
            '<Solver><ThreatManager><FlawHandler\n component="Min"/></ThreatManager></Solver>',
            "2: `Min` does not mend flaws of `ThreatManager`: left out",
        ),
        (
            '<Solver><FlawFilter perdicate="p"/></Solver>',
            "1: `perdicate` means nothing here and is left out",
        ),
        (
            '<Solver><OpenConditionManager><FlawHandler priority="-1"/></OpenConditionManager></Solver>',
            "1: `priority` must be a number from 0 to 99999",
        ),
        (
            '<Solver><FlawFilter component="HorizonFilter" policy="Half"/></Solver>',
            "1: `Half` is no `policy`; it may be `PartiallyContained`, `PossiblyContained`, `TotallyContained`",
        ),
        (
            '<Solver><ResourceThreatManager order="lower,upper"/></Solver>',
            "1: flaws cannot be ordered by `lower` and by `upper` at once",
        ),
        ("<Config/>", "1: expected `Solver`, found `Config`"),
        ("<Solver>\n<a></b></Solver>", "2: mismatched tag"),
        ("", "1: no element found"),
        ('<!DOCTYPE x [<!ENTITY e "f">]>\n<Solver name="&e;"/>', "1: a document type declaration is not read"),
    ],
)
def test_a_mistake_in_xml_is_told_with_its_line(text: str, complaint: str) -> None:
    assert complaints_of(text) == [complaint]


def test_a_mistake_in_toml_is_told_with_its_line() -> None:
    text = """\
    [[manager]]
    component = "ThreatManager"
    [[manager.handler]]
    component = "StandardThreatHandler"
    priorty = 3
    [[manager]]
    component = "Threats"
    """
    assert complaints_of(text, "s.toml") == [
        "5: `priorty` means nothing here and is left out",
        "7: no flaw manager is called `Threats`",
    ]
    assert complaints_of("a = \n", "s.toml") == ["1: invalid value"]


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ('filter = [{ component = "HorizonFilter" },\n  { perdicate = "p" }]', "2: `perdicate` means nothing here"),
        ('[manager]\ncomponent = "ThreatManager"\ndefault_priority = -1', "3: `default_priority` must be a number"),
        ('[[manager]]\ncomponent = "ThreatManager"\nhandler = 3', "3: `manager.handler` means nothing here"),
        ('[[manager]]\n"compon\\u0065nt" = "ThreatManager"\n"lab\\u0065ls" = 1', "3: `labels` means nothing here"),
        ("[[manager]]\na = \nb = 1", "2: invalid value"),
    ],
)
def test_a_mistake_is_told_at_its_table_or_key(text: str, complaint: str) -> None:
    (found,) = complaints_of(text, "s.toml")
    assert found.startswith(complaint)


def test_any_bytes_are_read_without_an_exception() -> None:
    for text in (
        "\x00",
        "<",
        "<Solver",
        "<Solver>\udc80",
        "[[",
        "a=1\r\n\x00",
        "<Solver><FlawFilter x='&#0;'/></Solver>",
    ):
        for name in ("s.xml", "s.toml"):
            read_configuration(Source(name, text))


def test_a_class_that_extends_planner_config_gives_the_limits(tmp_path: Path) -> None:
    text = """
    #include "PlannerConfig.nddl"
    class Season extends PlannerConfig { Season(int from, int to) { super(from, to, 7, 3); } }
    Season season = new Season(5, 50);
    close();
    """
    database = loaded(tmp_path, text).database
    assert database is not None
    assert model_limits(database) == Limits(5, 50, 7, 3)
