"""Read how parameters are drawn: the tables [parameters.NAME] and [joint.NAME] of a mission file in, parameters out."""

import math
from dataclasses import replace
from typing import cast

from checker.codes import ILL_DISTRIBUTION, TWICE
from checker.mission_table import LEAST, Table
from nddl_lang.text.diagnostic import Note
from nddl_lang.text.source import Span
from runtime.executive.configuration import Mode, ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS
from runtime.executive.expression import ExpressionError, parse_expression

_HELD = ("uniform", "truncated_normal")  # that draw nothing outside of the range
_WHOLE_ENDS = 'with `kind = "int"` the next whole numbers outside would be drawn too'
_ALL_CLIPPED = "every draw would be {:g}: write `value`"
_OWN_KEYS = ("values", "weights", "value", "mean", "sigma", "expression")  # of some distributions only


def read_parameters(tables: Table, joint: Table) -> tuple[tuple[ParameterConfiguration, ...], tuple[str, ...]]:
    """The parameters of both kinds of tables, and the names of those whose range the model has to give."""
    parameters: list[ParameterConfiguration] = []
    unranged: list[str] = []
    for name in tables.values:
        table = tables.table(name, f"[parameters.{name}]")
        parameter, has_range = _read_parameter(name, table)
        if not has_range:
            unranged.append(name)
        parameters.append(parameter)
    tables.close()
    for name in joint.values:
        parameters += _read_joint(name, joint.table(name, f"[joint.{name}]"), parameters)
    joint.close()
    return _with_rhythm(parameters, tables), tuple(unranged)


def _read_parameter(name: str, table: Table) -> tuple[ParameterConfiguration, bool]:
    """A parameter, and whether the file gives its range."""
    words = {"values": "discrete", "value": "fixed", "expression": "dependent", "mean": "normal", "sigma": "normal"}
    guess = next((word for key, word in words.items() if table.has(key)), "uniform")
    shape = table.choice("distribution", tuple(DISTRIBUTIONS), guess)
    distribution = DISTRIBUTIONS[shape]
    bounds = table.bounds("range", is_finite=True)
    values = table.numbers("values")
    weights = table.numbers("weights")
    value = table.number("value", 0.0, -math.inf, is_finite=True)
    mean = table.number("mean", 0.0, -math.inf, is_finite=True) if table.has("mean") else None
    deviation = table.number("sigma", 1.0, LEAST, is_finite=True) if table.has("sigma") else None
    expression = table.string("expression", "")
    is_whole = table.choice("kind", ("float", "int"), "float") == "int"
    mode = cast("Mode", table.choice("mode", ("inter", "intra"), "inter"))
    update = table.whole("update", 10, 1)
    clip = table.bounds("clip")
    table.asked += ["mean", "sigma"]
    table.close()
    _tell_ill_weights(table, weights, len(values), "of the values")
    for reason in _ill_distribution(table, shape, values, expression):
        table.text.diagnostics.append(ILL_DISTRIBUTION.at(table.text.key_span(table.path), reason=reason))
    if "value" in distribution.keys:
        values = (value,)
    if bounds is None and values and not distribution.has_range:
        bounds = (min(values), max(values))
    if bounds is None and shape == "normal" and mean is not None and deviation is not None:
        half = deviation * math.sqrt(3.0)  # the range that it would be matched to
        bounds = (mean - half, mean + half)
    if bounds and is_whole and shape in _HELD and not all(float(end).is_integer() for end in bounds):
        table.complain_of_value("range", list(bounds), "whole numbers at both ends", _WHOLE_ENDS)
    has_range = bounds is not None or shape == "dependent"
    lower, upper = bounds or (0.0, 0.0)
    if bounds and clip and shape != "normal" and not (lower <= clip[1] and clip[0] <= upper):
        end = clip[1] if clip[1] < lower else clip[0]
        table.complain_of_value(
            "clip", list(clip), f"such that it meets [{lower:g}, {upper:g}]", _ALL_CLIPPED.format(end)
        )
    found = ParameterConfiguration(
        name, float(lower), float(upper), shape, mode, update, clip, is_whole, values, weights, mean, deviation,
        expression if shape == "dependent" else "",
    )  # fmt: skip
    return found, has_range


def _ill_distribution(table: Table, name: str, values: tuple[float, ...], expression: str) -> list[str]:
    """What the keys of a distribution lack, or have in vain."""
    reasons: list[str] = []
    distribution = DISTRIBUTIONS[name]
    if (
        "values" in distribution.needs
        and table.values.get("values", []) == []
        and table.has("values") == table.means("values")
    ):
        reasons.append(f"a {name} distribution needs `values`, a list of numbers")
    for key in ("value", "expression"):
        if key in distribution.needs and not table.means(key):
            reasons.append(f"a {name} distribution needs `{key}`")
    are_apart = table.has("mean") != table.has("sigma") and table.means("mean") != table.means("sigma")
    if are_apart and name == "normal" and not table.has("range"):
        reasons.append("a normal distribution without a `range` needs both `mean` and `sigma`")
    for key in _OWN_KEYS:
        if table.has(key) and key not in distribution.keys:
            owners = " or ".join(other for other, row in DISTRIBUTIONS.items() if key in row.keys)
            reasons.append(f"`{key}` belongs to a {owners} distribution, not to a {name} one")
    is_inter = table.values["mode"] == "inter" if table.has("mode") else not table.means("mode")
    if table.has("update") and is_inter:
        reasons.append('`update` has no effect without `mode = "intra"`: there is one draw per mission')
    if name == "dependent":
        reasons += [f"`{key}` has no effect on a dependent parameter" for key in ("range", "mode") if table.has(key)]
        try:
            if not parse_expression(expression).names and expression:
                reasons.append("the expression reads no other parameter: write `value`")
        except ExpressionError as problem:
            reasons.append(f"`expression`: {problem}{f': write `{problem.meant}`' if problem.meant else ''}")
    return reasons


def _tell_ill_weights(table: Table, weights: tuple[float, ...], count: int, of_what: str) -> bool:
    """Complain of weights that are none; whether there was a complaint."""
    reasons = []
    if weights and len(weights) != count:
        reasons.append(f"`weights` has {len(weights)} of {count}, one for each {of_what}")
    if weights and (min(weights) < 0.0 or sum(weights) <= 0.0):
        reasons.append("weights must not be negative, and one must be above 0")
    for reason in reasons:
        span = table.text.value_span((*table.path, "weights"))
        table.text.diagnostics.append(ILL_DISTRIBUTION.at(span, reason=reason))
    return bool(reasons)


def _read_joint(name: str, table: Table, known: list[ParameterConfiguration]) -> list[ParameterConfiguration]:
    """The columns of a joint table: discrete parameters of one stream, so that a row is drawn as a whole."""
    names = table.strings("parameters")
    rows = table.rows("rows", len(names))
    weights = table.numbers("weights")
    mode = cast("Mode", table.choice("mode", ("inter", "intra"), "inter"))
    update = table.whole("update", 10, 1)
    table.close()
    is_ill = bool(rows) and _tell_ill_weights(table, weights, len(rows), "row")
    reasons = []
    if table.values.get("parameters", []) == [] or table.values.get("rows", []) == []:
        reasons.append("a joint table needs `parameters`, a list of names, and `rows` with a value for each")
    for reason in reasons:
        table.text.diagnostics.append(ILL_DISTRIBUTION.at(table.text.key_span(table.path), reason=reason))
    taken = {one.name: _name_span(table, one, known) for one in known}
    for index, one in enumerate(names):
        span = table.text.value_span((*table.path, "parameters", index))
        if one in taken:
            notes = (Note("first here", taken[one]),)
            table.text.diagnostics.append(TWICE.at(span, what="the parameter", name=one, notes=notes))
        taken.setdefault(one, span)
    if is_ill or reasons or not rows:
        return []
    columns = zip(names, zip(*rows, strict=True), strict=True)
    return [
        ParameterConfiguration(
            one, min(column), max(column), "discrete", mode, update, values=column, weights=weights,
            stream=f"joint {name}",
        )
        for one, column in columns
    ]  # fmt: skip


def _name_span(table: Table, parameter: ParameterConfiguration, known: list[ParameterConfiguration]) -> Span:
    """Where a parameter that was read before has its name."""
    kind, _, joint = parameter.stream.partition(" ")
    if kind != "joint" or not joint:
        return table.text.key_span(("parameters", parameter.name))
    columns = [one.name for one in known if one.stream == parameter.stream]
    return table.text.value_span(("joint", joint, "parameters", columns.index(parameter.name)))


def _with_rhythm(parameters: list[ParameterConfiguration], tables: Table) -> tuple[ParameterConfiguration, ...]:
    """Dependent parameters change when those do that they read; they must not read each other in a cycle."""
    found = {one.name: one for one in parameters}
    read = {name: _read_by(one) for name, one in found.items() if one.expression}
    sources: dict[str, set[str]] = {}  # the parameters with a distribution that each reads, through others too
    for name in read:
        trail = {name: iter(read[name])}  # the way from `name` to where the walk stands, without recursion
        while trail:
            last = next(reversed(trail))
            following = next(trail[last], None)
            if following is None:
                del trail[last]
                sources[last] = set()
                for each in read[last]:
                    sources[last] |= sources.get(each, set()) if each in read else {each}
            elif following in trail:
                _tell_cycle(tables, [*trail][[*trail].index(following) :])
            elif following in read and following not in sources:
                trail[following] = iter(read[following])
    for name, leaves in sources.items():
        changing = [found[leaf].update for leaf in leaves if leaf in found and found[leaf].mode == "intra"]
        if changing:
            found[name] = replace(found[name], mode="intra", update=math.gcd(*changing))
    return tuple(found[one.name] for one in parameters)


def _read_by(parameter: ParameterConfiguration) -> tuple[str, ...]:
    """The names that an expression reads."""
    try:
        return tuple(sorted(parse_expression(parameter.expression).names))
    except ExpressionError:
        return ()  # told already


def _tell_cycle(tables: Table, names: list[str]) -> None:
    reason = f"parameters read each other in a cycle: {' → '.join((*names, names[0]))}"
    tables.text.diagnostics.append(ILL_DISTRIBUTION.at(tables.text.key_span((*tables.path, names[0])), reason=reason))
