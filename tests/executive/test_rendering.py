"""Events become one line of text, and one of JSON, from their fields alone."""

import json

from compiler.program import DomainConstant
from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.outcome import Event, EventKind, Phase, Reason, ReasonKind
from runtime.executive.rendering import event_text, reason_text, trace_json, trace_line
from runtime.plan.readout.names import TokenName
from tests.executive.flying import fly, simulator

LAMP = """
int GLOW = [2 9];
class Lamp extends AgentTimeline { predicate Off { } predicate On { int n; } Lamp(Mode m) { super(m, "Off"); } }
Lamp::On { int glow; glow == sampledParameter(GLOW); duration == glow; }
Lamp lamp = new Lamp(Internal); close();
"""


def test_a_bound_next_to_zero_is_zero() -> None:
    n, m = DomainConstant("float", "float", (-5e-324, 4.0), None), DomainConstant("int", "int", (0, 3), None)
    event = Event(1, Phase.DISPATCH, EventKind.REQUEST, "a", "lamp", "On", (("n", n), ("m", m)), request=1)
    assert "On(n=[0.0 4.0], m=[0 3])" in event_text(event)


def test_a_trace_is_json_lines_with_typed_fields() -> None:
    goals = (
        GoalConfiguration("lamp", "On", start=(3, 5), parameters=(("n", (1, 4)),)),
        GoalConfiguration("lamp", "Of"),
    )
    parameters = (ParameterConfiguration("GLOW", 2, 9, "fixed", values=(4.0,), is_whole=True),)
    outcome = fly(simulator("sim", LAMP, "lamp"), until=9, goals=goals, parameters=parameters)
    events = [json.loads(trace_json(event)) for event in outcome.events]
    assert all(event["kind"] and event["phase"] and isinstance(event["tick"], int) for event in events)
    asked = next(event for event in events if event["kind"] == "request")
    assert (asked["timeline"], asked["predicate"], asked["arguments"]) == ("lamp", "On", {"n": [1, 4]})
    assert asked["start"] == [3, 5] and asked["end"] == ["-inf", "inf"]
    drawn = next(event for event in events if event["kind"] == "sample")
    assert (drawn["parameter"], drawn["raw"], drawn["value"]) == ("GLOW", 4.0, 4.0)
    lit = next(event for event in events if event["kind"] == "observation" and event["predicate"] == "On")
    assert lit["token"].startswith("Lamp.On#") and all(cause < events.index(lit) for cause in lit["causes"])
    refused = next(event for event in events if event["kind"] in ("reject", "refuse"))
    assert refused["reason"]["kind"] == "unknown predicate" and refused["request"] == -2
    assert events[-1]["kind"] == "end"


def test_a_domain_is_a_value_a_pair_or_a_list() -> None:
    domains = (
        DomainConstant("int", "int", (3, 3), None),
        DomainConstant("float", "float", (0.5, 4503599627370495), None),
        DomainConstant("bool", "bool", None, (False, True)),
        DomainConstant("symbol", "Colour", None, ("red",)),
    )
    arguments = tuple(zip("abcd", domains, strict=True))
    event = Event(7, Phase.OBSERVE, EventKind.OBSERVATION, "sim", "lamp", "On", arguments)
    assert event_text(event) == "On(a=3, b=[0.5 +inf], c={false, true}, d=red)"
    assert json.loads(trace_json(event))["arguments"] == {"a": 3, "b": [0.5, "inf"], "c": [False, True], "d": "red"}
    assert trace_line(event).split() == ["7", "sim", "observation", "lamp", *event_text(event).split()]


def test_every_reason_has_words_without_gaps() -> None:
    for kind in ReasonKind:
        reason = Reason(kind, TokenName("Lamp.On", 3), "On", "lamp", 7, 9, "it broke")
        text = reason_text(reason)
        assert text and "None" not in text and "{" not in text
