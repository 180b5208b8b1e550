"""Conditions as text for a store, and read again: whoever explains a mission later need not fly for them."""

import json
from collections.abc import Mapping
from typing import Any

from checker.conditions.condition import Condition, Extreme, Feature, Literal, Share

# By the example of a bucket its condition; or the example of the bucket that is of the same fault.
Conditions = Mapping[int, "Condition | int | None"]


def write_condition(condition: Condition | int | None) -> str:
    """One line of JSON."""
    if condition is None or isinstance(condition, int):
        return json.dumps(condition)
    data = {
        "conjunctions": [[_literal(literal) for literal in one] for one in condition.conjunctions],
        "precision": [condition.precision.value, *condition.precision.interval],
        "recall": [condition.recall.value, *condition.recall.interval],
        "fresh": condition.fresh,
        "near": condition.near,
        "flights": condition.flights,
        "in_terms": [_literal(literal) for literal in condition.in_terms],
    }
    return json.dumps(data, separators=(",", ":"))


def read_condition(text: str) -> Condition | int | None:
    """What `write_condition` wrote."""
    data = json.loads(text)
    if data is None or isinstance(data, int):
        return data
    return Condition(
        tuple(tuple(_read(literal) for literal in one) for one in data["conjunctions"]),
        _share(data["precision"]),
        _share(data["recall"]),
        data["fresh"],
        data["near"],
        data["flights"],
        tuple(_read(literal) for literal in data["in_terms"]),
    )


def _literal(literal: Literal) -> list[Any]:
    feature = literal.feature
    return [feature.monomials, feature.extreme.value, literal.is_above, literal.edge, literal.holds_at_edge]


def _read(row: list[Any]) -> Literal:
    monomials, extreme, is_above, edge, holds_at_edge = row
    terms = tuple((factor, tuple((name, power) for name, power in powers)) for factor, powers in monomials)
    return Literal(Feature(terms, Extreme(extreme)), is_above, edge, holds_at_edge)


def _share(row: list[float]) -> Share:
    value, low, high = row
    return Share(value, (low, high))
