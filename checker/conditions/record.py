"""Conditions as text for a store, and read again: whoever explains a mission later need not fly for them."""

import json
from collections.abc import Mapping
from typing import Any

from checker.conditions.condition import Condition, Extreme, Feature, Literal, Share, Unseen

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
        "unseen": [[*_feature(one.feature), one.below, one.above] for one in condition.unseen],
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
        tuple(Unseen(_feature_of(*feature), below, above) for *feature, below, above in data.get("unseen", ())),
        tuple(_read(literal) for literal in data["in_terms"]),
    )


def _literal(literal: Literal) -> list[Any]:
    return [*_feature(literal.feature), literal.is_above, literal.edge, literal.holds_at_edge]


def _read(row: list[Any]) -> Literal:
    *feature, is_above, edge, holds_at_edge = row
    return Literal(_feature_of(*feature), is_above, edge, holds_at_edge)


def _feature(feature: Feature) -> list[Any]:
    return [feature.monomials, feature.extreme.value]


def _feature_of(monomials: list[Any], extreme: str) -> Feature:
    terms = tuple((factor, tuple((name, power) for name, power in powers)) for factor, powers in monomials)
    return Feature(terms, Extreme(extreme))


def _share(row: list[float]) -> Share:
    value, low, high = row
    return Share(value, (low, high))
