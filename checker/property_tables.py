"""Read the properties of a mission: the tables [[property]] of a mission file in, typed promises out."""

import math
from collections.abc import Mapping

from checker.codes import NO_OWNER, TWICE
from checker.mission_table import HELD, Table, is_held
from checker.respelt import respelt
from nddl_lang.text.nearest import nearest
from runtime.executive.configuration import (
    Bounds,
    LevelPattern,
    PropertyConfiguration,
    PropertyKind,
    TokenPattern,
    Value,
)
from runtime.executive.expression import ExpressionError, parse_expression

_NEEDS_THEN = (PropertyKind.WITHIN, PropertyKind.UNTIL)


def read_properties(tables: list[Table], owned: tuple[str, ...]) -> tuple[PropertyConfiguration, ...]:
    """The properties of a file; `owned` are the timelines that some reactor owns."""
    found: list[PropertyConfiguration] = []
    for table in tables:
        name = table.string("name")
        kind = PropertyKind(table.choice("kind", tuple(PropertyKind), PropertyKind.ALWAYS))
        table.complain_of_missing("kind")
        if name in [one.name for one in found]:
            span = table.text.value_span((*table.path, "name"))
            table.text.diagnostics.append(TWICE.at(span, what="the property", name=name))
        since, by = table.whole("from", 0, 0), table.whole("by", -1, 0) if table.has("by") else None
        if kind is PropertyKind.LEVEL:
            level = _read_level(table)
            table.asked += ["by"]
            table.close()
            found.append(PropertyConfiguration(name, kind, since=since, by=by, level=level))
            continue
        pattern = _read_pattern(table, owned)
        inner = table.table("then", "[property.then]", needed=kind in _NEEDS_THEN)
        then = _read_pattern(inner, owned) if inner.values else None
        inner.close()
        ticks = table.whole("ticks", 0, 0) if table.has("ticks") or kind is PropertyKind.WITHIN else 0
        if kind is PropertyKind.WITHIN:
            table.complain_of_missing("ticks")
        table.asked += ["by", "ticks"]
        is_known = table.values.get("kind") in tuple(PropertyKind)
        if is_known and kind not in _NEEDS_THEN and then is not None:
            table.complain_of_value("then", "a table", "left out: it belongs to within and until")
        table.close()
        found.append(PropertyConfiguration(name, kind, pattern, then, since, by, ticks))
    return tuple(found)


def _read_pattern(table: Table, owned: tuple[str, ...]) -> TokenPattern:
    timeline = table.string("timeline") if table.values else ""
    if timeline and timeline not in owned:
        close = nearest(timeline, owned)
        advice = f"did you mean `{close}`?" if close else "owned timelines: " + ", ".join(owned)
        span = table.text.value_span((*table.path, "timeline"))
        complaint = NO_OWNER.at(span, timeline=timeline, help=advice)
        table.text.unowned.append((timeline, respelt(complaint, timeline, owned)))
    given = table.table("parameters", "[property.parameters]")
    where = table.string("where", "")
    if where:
        try:
            parse_expression(where)
        except ExpressionError as problem:
            wanted = "arithmetic over the arguments of a token"
            table.complain_of_value("where", f"`{where}`: {problem}", wanted, meant=(where, problem.meant))
            where = ""
    parameters = tuple((key, _wanted(given, key, given.values)) for key in given.values)
    return TokenPattern(timeline, table.string("predicate", ""), parameters, where)


def _read_level(table: Table) -> LevelPattern:
    if not table.has("margin"):
        table.complain_of_missing("level")
    bounds = table.bounds("level") or (-math.inf, math.inf)
    return LevelPattern(table.string("resource"), table.string("reactor", ""), bounds, table.number("margin", 0.0, 0.0))


def _wanted(table: Table, key: str, values: Mapping[str, object]) -> Value | Bounds:
    value = values[key]
    if isinstance(value, list):
        return table.bounds(key) or 0
    if isinstance(value, int | float | str):
        if not isinstance(value, str | bool) and not is_held(value):
            table.complain_of_value(key, value, f"a number {HELD}")
        return value
    return table.string(key)  # complains
