"""Read variations of missions from text: each a few lines that say who flies, and what must come of it.

    ## its_name
    the rule that it shows, and the section of the reference of T-REX that has it
    | until 30, kill                             the final tick; `kill`: a reactor that fails is killed
    | plan 1/60 task > arm ~src                  latency/look-ahead, own timelines > those used, ~ those only observed
      Task::Do { equals(Arm.Act a); }            its model; classes, timelines and `close()` are written by themselves
    | resources                                  solvers order what uses resources
    | priority Job.Halt Job.Make                 solvers decide these first, in this order
                                                 `, then order`: and order tokens last
    | goal task.Do(n=1) start 5..9 mandatory     also end, duration, at, recall
    = PASS @30                                   verdict, code, last tick
    = task: 0 Idle, 5..6 Do(1), 10 Idle ?        all that is observed there; `?`: may be missing
    = request arm.Act @4..5                      events, in this order; those of `= any` in whatever order
    = kill by plan(F8)                           with its code
    = 1 x request arm.Act                        how many there are
    = draws 10 wave.v copy.v                     values of one parameter: the same in each period of so many ticks

`| like NAME` takes over what another one has: its models, and what is not said anew.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from runtime.executive.configuration import Bounds, GoalConfiguration, OnFailure, ParameterConfiguration
from runtime.solver.configuration.configuration import (
    Configuration,
    FlawHandler,
    FlawManager,
    Match,
    default_configuration,
)
from runtime.solver.tags import WORST_PRIORITY
from tests.executive.flying import Flyer, planner

CLASSES = {
    "Src": ("A", {"A": "", "B": "", "C": ""}),
    "Mood": ("Low", {"Low": "", "High": ""}),
    "Lamp": ("Off", {"Off": "", "On": ""}),
    "Arm": ("Rest", {"Rest": "", "Act": "int n;"}),
    "Task": ("Idle", {"Idle": "", "Do": "int n;"}),
    "Job": ("Free", {"Free": "", "Make": "int n;", "Halt": ""}),
    "State": ("Normal", {"Normal": "", "Go": "", "Halt": ""}),
    "Count": ("At", {"At": "int k;"}),
    "Copy": ("Of", {"Of": "int k;"}),
    "Wave": ("Step", {"Step": "float v;"}),
}
RESOURCES = replace(
    default_configuration(),
    managers=(
        FlawManager("ResourceThreatManager", (), (FlawHandler("ResourceThreatHandler", priority=0.0),)),
        *default_configuration().managers,
    ),
)
ABOVE = ("  class ", "  enum ")  # lines of a model that come before its timelines
MODES = {"": "Internal", ">": "External", "~": "Observe", "-": "Private", "!": "Ignore"}
EVENT = re.compile(r"(\w+)(?: by (\w+))?(?: (\w+)(?:\.(\w+))?)?(?:\((.*?)\))?(?: @(\S+))?$")
Data = dict[str, Any]


@dataclass(slots=True)
class Variation:
    """A mission, and what must come of it, as an `expected.json` of `cases/` has it."""

    name: str
    why: str = ""
    until: int = 40
    on_failure: OnFailure = "abort_agent"
    flyers: dict[str, Flyer] = field(default_factory=dict)
    solver: Configuration = field(default_factory=default_configuration)  # of all reactors
    models: dict[str, str] = field(default_factory=dict)  # as they stand in the file
    goals: list[GoalConfiguration] = field(default_factory=list)
    parameters: list[ParameterConfiguration] = field(default_factory=list)
    verdict: tuple[str, tuple[str, ...]] = ("PASS", ("",))
    last_tick: Any = None
    observations: dict[str, list[Any]] = field(default_factory=dict)
    events: list[Data] = field(default_factory=list)
    unordered: list[Data] = field(default_factory=list)
    counts: list[Data] = field(default_factory=list)
    draws: tuple[int, list[list[str]]] = (1, [])  # a period, and the timelines and arguments that show a parameter


def read_variations(file: Path) -> list[Variation]:
    """All that a file has."""
    found: dict[str, Variation] = {}
    for text in file.read_text().split("\n## ")[1:]:
        one = read(text.split("\n"), found)
        assert one.name not in found, one.name
        found[one.name] = one
    return list(found.values())


def read(lines: list[str], others: dict[str, Variation]) -> Variation:
    """One of them."""
    one = Variation(lines[0].strip())
    reactors: list[tuple[str, list[str]]] = []
    goals: list[GoalConfiguration] = []
    for line in lines[1:]:
        said = line[2:].split(";;")[0].strip()
        if line.startswith("| like "):
            other = others[said.split()[1]]
            one = replace(other, name=one.name, observations={}, last_tick=None)
            one.flyers, one.models = dict(other.flyers), dict(other.models)
            one.why, one.events, one.unordered, one.counts, one.draws = "", [], [], [], (1, [])
        elif line.startswith("| until "):
            ticks, *rest = said.replace(",", " ").split()[1:]
            one.until, one.on_failure = int(ticks), "kill_reactor" if "kill" in rest else "abort_agent"
        elif line.startswith("| resources"):
            one.solver = RESOURCES
        elif line.startswith("| priority "):
            first, _, last = said.partition(", then ")
            one.solver = prioritised(first.split()[1:], last == "order")
        elif line.startswith("| goal "):
            goals.append(goal_of(said[5:]))
        elif line.startswith("| draw "):
            one.parameters = [*one.parameters, parameter_of(said.split()[1:])]
        elif line.startswith("| "):
            reactors.append((said, []))
        elif line.startswith("  "):
            reactors[-1][1].append(line)
        elif line.startswith("= "):
            expect(one, said)
        else:
            one.why = f"{one.why} {line}".strip()
    for said, model in reactors:
        name = said.split()[0]
        one.models[name] = "\n".join(model) or one.models.get(name, "")
        one.flyers[name] = flyer_of(said, one.models[name])
    one.goals = goals or one.goals
    return one


def flyer_of(said: str, model: str) -> Flyer:
    """A reactor, and its model without what is written by itself."""
    name, pace, *rest = said.split()
    latency, lookahead = map(int, pace.split("/"))
    lines, words, mode, options = [], iter(rest), "", Data()
    for word in words:
        if word in ("early", "late"):
            options[word] = tuple(next(words).split(","))
        elif word in ("steps", "depth"):
            options[f"max_{word}"] = int(next(words))
        elif word == ">":
            mode = word
        else:
            lines.append((word.lstrip("~-!"), word[0] if word[0] in "~-!" else mode))
    depth = options.pop("max_depth", None)
    internal, external = (
        " ".join(line for line, mode in lines if (mode in ("", "-")) is own and mode != "!") for own in (True, False)
    )
    found = planner(name, written(model, lines), internal, external, latency, lookahead, **options)
    return Flyer(replace(found.configuration, max_depth=depth), found.text)


def written(model: str, lines: list[tuple[str, str]]) -> str:
    """A model with the classes and timelines that it speaks of."""
    text = []
    kinds = [(line, line.rstrip("0123456789").capitalize(), mode) for line, mode in lines]
    for kind in dict.fromkeys(kind for _, kind, _ in kinds):
        if f"class {kind} " not in model:
            default, predicates = CLASSES[kind]
            body = " ".join(f"predicate {name} {{ {args} }}" for name, args in predicates.items())
            text.append(f'class {kind} extends AgentTimeline {{ {body} {kind}(Mode m) {{ super(m, "{default}"); }} }}')
    rules, _, script = model.partition("close();")
    text += [line for line in rules.split("\n") if line.startswith(ABOVE)]
    text += [f"{kind} {line} = new {kind}({MODES[mode]});" for line, kind, mode in kinds]
    text += [line for line in rules.split("\n") if not line.startswith(ABOVE)]
    return "\n".join([*text, "close();", script])


def prioritised(predicates: list[str], orders_last: bool) -> Configuration:
    """A table that has tokens of some predicates decided before all else, in this order; tokens are ordered before or
    behind all that."""
    given = {
        "OpenConditionManager": tuple(
            FlawHandler("StandardOpenConditionHandler", Match(predicate=predicate), priority=number)
            for number, predicate in enumerate(predicates, 1)
        )
    }
    if orders_last:
        given["ThreatManager"] = (FlawHandler("StandardThreatHandler", priority=WORST_PRIORITY),)
    found = default_configuration()
    managers = tuple(replace(each, handlers=given.get(each.component, each.handlers)) for each in found.managers)
    return replace(found, managers=managers)


def bounds_of(said: str) -> Bounds:
    """`5` or `5..9`."""
    low, _, high = said.partition("..")
    return (float(low), float(high or low))


def value_of(said: str) -> Any:
    """An argument: a number, a truth value, a name."""
    said = said.strip()
    if said in ("true", "false"):
        return said == "true"
    return said if said[0].isalpha() else float(said) if "." in said else int(said)


def goal_of(said: str) -> GoalConfiguration:
    """A goal, as in `task.Do(n=1) start 5..9 mandatory`."""
    what, rest = re.match(r"(\w+\.\w+(?:\([^)]*\))?)\s*(.*)", said).groups()  # type: ignore[union-attr]
    timeline, predicate, arguments = re.match(r"(\w+)\.(\w+)(?:\((.*)\))?", what).groups()  # type: ignore[union-attr]
    parameters = tuple(
        (name.strip(), bounds_of(value) if ".." in value else value_of(value))
        for name, value in (each.split("=") for each in (arguments or "").split(",") if each)
    )
    more, words = Data(), iter(rest.split())
    for word in words:
        if word == "mandatory":
            more[word] = True
        else:
            more[word] = int(next(words)) if word in ("at", "recall") else bounds_of(next(words))
    return GoalConfiguration(timeline, predicate, parameters=parameters, **more)


def parameter_of(words: list[str]) -> ParameterConfiguration:
    """A parameter that has some values in turn of chance, as in `SEA 1.0 2.0 every 10`."""
    values = [float(word) for word in words[1 : words.index("every") if "every" in words else None]]
    found = ParameterConfiguration(words[0], min(values), max(values), "discrete", values=tuple(values))
    return replace(found, mode="intra", update=int(words[-1])) if "every" in words else found


def expect(one: Variation, said: str) -> None:
    """Add what must come of a variation."""
    if said.startswith(("PASS", "FAIL")):
        verdict, *rest = said.split()
        codes = tuple(word for word in rest if not word.startswith("@"))
        one.verdict = (verdict, codes or ("",))
        one.last_tick = next((ticks_of(word[1:]) for word in rest if word.startswith("@")), one.until)
    elif re.match(r"\w+:", said):
        timeline, _, tokens = said.partition(":")
        one.observations[timeline] = list(tokens_of(tokens))
    elif re.match(r"\d+ x ", said):
        count, _, pattern = said.partition(" x ")
        one.counts.append(pattern_of(pattern) | {"n": int(count)})
    elif said.startswith("draws "):
        period, *shown = said.split()[1:]
        one.draws = (int(period), [each.split(".") for each in shown])
    elif said.startswith("any "):
        one.unordered.append(pattern_of(said[4:]))
    else:
        one.events.append(pattern_of(said))


def tokens_of(said: str) -> Iterator[list[Any]]:
    """`0 Idle, 5..6 Do(1), 9 Idle ?`: ticks, predicates, values of arguments, whether it may be missing."""
    for tick, predicate, values, may in re.findall(r"([\d.]+) (\w+)(?:\(([^)]*)\))?( \?)?", said):
        token = [ticks_of(tick), predicate, [value_of(each) for each in values.split(",") if each]]
        yield [*token, True] if may else token


def ticks_of(said: str) -> Any:
    """`5` or `5..9`."""
    low, _, high = said.partition("..")
    return [int(low), int(high)] if high else int(low)


def pattern_of(said: str) -> Data:
    """`request by plan arm.Act(n=1) @4..5`."""
    match = EVENT.match(said)
    assert match, said
    kind, reactor, timeline, predicate, arguments, tick = match.groups()
    found: Data = {"kind": kind, "reactor": reactor, "timeline": timeline, "predicate": predicate}
    if arguments and "=" not in arguments:
        found["code"] = arguments
    elif arguments:
        pairs = [each.split("=") for each in arguments.split(",")]
        found["arguments"] = {name: value_of(value) for name, value in pairs}
    found["tick"] = None if tick is None else ticks_of(tick)
    return {key: value for key, value in found.items() if value is not None}
