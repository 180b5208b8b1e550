"""A mission of the second agent as the texts that nddlc reads: models and a mission file."""

from pathlib import Path

from tests.executive.second.description import (
    FAR,
    Apart,
    Between,
    Bound,
    Child,
    Description,
    Drawn,
    Guarded,
    Item,
    Kind,
    Part,
    Store,
    Tie,
    Use,
)


def written(description: Description, folder: Path) -> Path:
    """Write it; the mission file."""
    for part in description.parts:
        (folder / f"{part.name}.nddl").write_text(model(description, part))
        if part.first or part.orders:
            (folder / f"{part.name}.toml").write_text(table(description, part))
    file = folder / "mission.toml"
    file.write_text(mission(description))
    return file


def model(description: Description, part: Part) -> str:
    """The model of a reactor."""
    used = {*part.internal, *part.external, *part.observed}
    text = ['#include "TREX.nddl"']
    for parameter in description.parameters:
        text.append(f"int {parameter.name} = [{min(parameter.values)} {max(parameter.values)}];")
    text += [_class(kind, part) for kind in description.kinds if kind.timeline in used]
    text += [_store(store) for store in part.stores]
    for rule in part.rules:
        body = "\n".join(line for item in rule.body for line in _item(item, "  "))
        text.append(f"{description.kind(rule.timeline).name}::{rule.predicate} {{\n{body}\n}}")
    for mode, timelines in (("Internal", part.internal), ("External", part.external), ("Observe", part.observed)):
        for timeline in timelines:
            name = description.kind(timeline).name
            text.append(f"{name} {timeline} = new {name}({mode});")
    text.append("close();")
    for place, first in enumerate(part.firsts):
        text.append(f"fact({first.timeline}.{first.predicate} first{place});\nfirst{place}.start == 0;")
        text += [f"eq(first{place}.{name}, {value});" for name, value in first.arguments]
    return "\n".join([*text, ""])


def table(description: Description, part: Part) -> str:
    """The solver's table of a reactor whose goals have priorities: tokens are ordered first, what else is open last.

    Where it has uses of stores ordered, that comes behind all else.
    """
    if part.orders:
        kinds = ("ThreatManager", "OpenConditionManager", "UnboundVariableManager", "ResourceThreatManager")
        return "".join(f'[[manager]]\ncomponent = "{kind}"\n' for kind in kinds)
    lines = ["[[manager]]", 'component = "ThreatManager"', "default_priority = 0"]
    lines += ["[[manager]]", 'component = "OpenConditionManager"', "default_priority = 50"]
    for place, predicate in enumerate(part.first, 1):
        kind = next(kind.name for kind in description.kinds if kind.timeline == part.internal[0])
        lines += ["[[manager.handler]]", 'component = "StandardOpenConditionHandler"']
        lines += [f'predicate = "{kind}.{predicate}"', f"priority = {place}"]
    lines += ["[[manager]]", 'component = "UnboundVariableManager"', "default_priority = 50"]
    return "\n".join([*lines, ""])


def _class(kind: Kind, part: Part) -> str:
    lines = [f"class {kind.name} extends AgentTimeline {{"]
    ranges = {one[:3]: one[3:] for one in part.ranges}
    for predicate, names in kind.predicates:
        if (kind.timeline, predicate) in part.lacks:
            continue
        inside = ""
        for name in names:
            bounds = ranges.get((kind.timeline, predicate, name))
            inside += f" int {name} = [{bounds[0]} {bounds[1]}];" if bounds else f" int {name};"
        lines.append(f"  predicate {predicate} {{{inside} }}")
    default = kind.predicates[0][0]
    return "\n".join([*lines, f'  {kind.name}(Mode m) {{ super(m, "{default}"); }}', "}"])


def _store(store: Store) -> str:
    limits = (store.first, store.least, store.most) if store.kind == "Reservoir" else (store.first, store.least)
    return f"{store.kind} {store.name} = new {store.kind}({', '.join(f'{one}.0' for one in limits)});"


def _item(item: Item, indent: str) -> list[str]:
    match item:
        case Bound(term, low, high):
            return [indent + line for line in _bounds(term, low, high)]
        case Drawn(term, parameter):
            name = f"drawn_{parameter.lower()}"
            return [
                f"{indent}int {name};",
                f"{indent}{name} == sampledParameter({parameter});",
                f"{indent}{term} == {name};",
            ]
        case Child(relation, timeline, predicate, label, ties):
            lines = [f"{relation}({timeline.capitalize()}.{predicate} {label});"]
            return [indent + line for line in [*lines, *(line for tie in ties for line in _tie(label, tie))]]
        case Apart(term, other, low, high):
            lines = _tie(term, Tie("", other, low, high)) if other else _bounds(term, low, high)
            return [indent + line for line in lines]
        case Use(store, amount, "all"):
            return [f"{indent}equals({store}.uses held);", f"{indent}held.quantity == {-amount}.0;"]
        case Use(store, amount, when):
            happens = "produce" if amount > 0 else "consume"
            lines = [f"any({store}.{happens} at_{when});", f"at_{when}.time == {when};"]
            return [indent + line for line in (*lines, f"at_{when}.quantity == {abs(amount)}.0;")]
        case Between(first, relation, second):
            return [f"{indent}{first} {relation} {second};"]
        case Guarded(parameter, value, body):
            test = f"{parameter} == {value}" if parameter else "start <= AGENT_CLOCK"
            return [
                f"{indent}if ({test}) {{",
                *(line for one in body for line in _item(one, indent + "  ")),
                indent + "}",
            ]


def _bounds(term: str, low: int, high: int) -> list[str]:
    if low == high:
        return [f"{term} == {low};" if term in ("start", "end", "duration") else f"eq({term}, {low});"]
    return [f"{term} >= {low};"] * (low > -FAR) + [f"{term} <= {high};"] * (high < FAR)


def _tie(label: str, tie: Tie) -> list[str]:
    term = f"{label}.{tie.term}" if tie.term else label
    if not tie.of_parent:
        if tie.low == tie.high and tie.term not in ("start", "end"):
            return [f"eq({term}, {tie.low});"]
        return _bounds(term, tie.low, tie.high)
    if tie.low == tie.high:
        return [f"{term} == {_plus(tie.of_parent, tie.low)};"]
    lines = [f"{_plus(tie.of_parent, tie.low)} <= {term};"] if tie.low > -FAR else []
    return lines + ([f"{term} <= {_plus(tie.of_parent, tie.high)};"] if tie.high < FAR else [])


def _plus(term: str, number: int) -> str:
    return f"{term} + {number}" if number > 0 else f"{term} - {-number}" if number < 0 else term


def mission(description: Description) -> str:
    """The mission file."""
    lines = ["[mission]", f'name = "{description.name}"', f"final_tick = {description.final}"]
    lines += ['on_failure = "kill_reactor"'] * description.kills
    for part in description.parts:
        lines += ["", "[[reactor]]", f'name = "{part.name}"', f'model = "{part.name}.nddl"']
        lines += [f"latency = {part.latency}", f"lookahead = {part.lookahead}", f"internal = {_texts(part.internal)}"]
        if part.external or part.observed:
            lines.append(f"external = {_texts((*part.external, *part.observed))}")
        if part.first or part.orders:
            lines.append(f'solver = "{part.name}.toml"')
        for key in ("early", "late"):
            if names := getattr(part, key):
                lines.append(f"{key} = {_texts(names)}")
    for wish in description.wishes:
        lines += ["", "[[goal]]", f'timeline = "{wish.timeline}"', f'predicate = "{wish.predicate}"']
        lines += [f"at = {wish.at}", f"mandatory = {str(wish.mandatory).lower()}", f"start = {list(wish.start)}"]
        if wish.duration:
            lines.append(f"duration = {list(wish.duration)}")
        if wish.recall is not None:
            lines.append(f"recall = {wish.recall}")
        if wish.arguments:
            lines += ["[goal.parameters]", *(f"{name} = {value}" for name, value in wish.arguments)]
    for parameter in description.parameters:
        lines += [
            "",
            f"[parameters.{parameter.name}]",
            'distribution = "discrete"',
            f"values = {list(parameter.values)}",
        ]
        lines += ['kind = "int"', f'mode = "{"intra" if parameter.update else "inter"}"']
        lines += [f"update = {parameter.update}"] * bool(parameter.update)
    return "\n".join([*lines, "", "[check]", "missions = 1", "seed = 1", ""])


def _texts(names: tuple[str, ...]) -> str:
    return "[" + ", ".join(f'"{name}"' for name in names) + "]"
