"""Domains as text in the notation of the conformance suite: `[1, 3] int`, `{red, green} Color`, `{a} T open`."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from sys import float_info

from runtime.constraints.domains.base_domain import is_growing
from runtime.constraints.domains.tags import (
    HALF_INF,
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    KIND_OBJECT,
    KIND_STRING,
)
from runtime.constraints.engine import Engine
from runtime.plan.store.prototypes import STATES, Prototypes

_NAMES = {KIND_BOOL: "bool", KIND_INT: "int", KIND_FLOAT: "float", KIND_STRING: "string"}


@dataclass(frozen=True, slots=True)
class DomainText:
    """A domain in the notation of the conformance suite, in its parts."""

    values: str
    type_name: str
    is_several: bool
    is_open: bool = False

    def __str__(self) -> str:
        return f"{self.values} {self.type_name} open" if self.is_open else f"{self.values} {self.type_name}"

    @property
    def brief(self) -> str:
        """The values without their type, a single one without braces."""
        return self.values if self.is_several else self.values[1:-1]


def domain_text(
    prototypes: Prototypes, engine: Engine, v: int, names: Sequence[str], type_name: str | None
) -> DomainText:
    """The derived domain of a variable."""
    kind = engine.kind[v]
    name = _NAMES.get(kind, type_name)
    if is_growing(engine, v):
        values = engine.values_of(v)
        return DomainText(set_text(prototypes, kind, values, names), str(name), len(values) > 1, is_open=True)
    lower, upper = wide(engine.lower(v)), wide(engine.upper(v))
    between = f"[{_number_text(lower, kind)}, {_number_text(upper, kind)}]"
    if kind in (KIND_INT, KIND_FLOAT):
        if lower == upper or (kind == KIND_FLOAT and engine.is_singleton(v)):
            return DomainText(f"{{{_number_text(lower, kind)}}}", str(name), is_several=False)
        if lower > upper:
            return DomainText("{}", str(name), is_several=False)
        if engine.word[v] < 0:
            return DomainText(between, str(name), is_several=True)
    values = list(engine.values_of(v))
    if kind == KIND_INT and len(values) > 1 and values[-1] - values[0] + 1 == len(values):
        return DomainText(between, str(name), is_several=True)
    if name is None:
        name = _symbol_type(prototypes, values)
    return DomainText(set_text(prototypes, kind, values, names), name, len(values) > 1)


def wide(x: float) -> float:
    """A bound, infinite where the engine counts it as infinite."""
    return inf if x >= HALF_INF else -inf if x <= -HALF_INF else x


def _symbol_type(prototypes: Prototypes, values: Sequence[float]) -> str:
    """The enum of some symbols."""
    enum = prototypes.symbol_enum[int(values[0])] if values else STATES
    return "symbol" if enum == STATES else enum


def set_text(prototypes: Prototypes, kind: int, values: Sequence[float], names: Sequence[str]) -> str:
    """The values of a set; those with names are sorted by name."""
    if kind in (KIND_INT, KIND_FLOAT):
        texts = [_number_text(x, kind) for x in values]
    elif kind == KIND_BOOL:
        texts = ["true" if x else "false" for x in values]
    elif kind == KIND_STRING:
        texts = sorted(json.dumps(prototypes.texts.text(int(x)), ensure_ascii=False) for x in values)
    elif kind == KIND_OBJECT:
        texts = sorted(names[int(x)] for x in values)
    else:
        texts = sorted(prototypes.symbols.text(int(x)) for x in values)
    return f"{{{', '.join(texts)}}}"


def _number_text(x: float, kind: int) -> str:
    """A number; floats have a decimal point."""
    if x == inf:
        return "+inf"
    if x == -inf:
        return "-inf"
    if kind == KIND_INT:
        return str(int(x))
    # Products are rounded outwards: beside zero that is the least number there is, of either sign.
    return "0.0" if abs(x) < float_info.min else repr(float(x))


def base_text(prototypes: Prototypes, engine: Engine, v: int, names: Sequence[str]) -> str:
    """The base domain of a variable, for a message."""
    kind = engine.kind[v]
    values = engine.base_values(v)
    if values is not None:
        text = set_text(prototypes, kind, values, names)
        return text[1:-1] if len(values) == 1 else text
    lower, upper = engine.base_lower(v), engine.base_upper(v)
    if kind not in (KIND_INT, KIND_FLOAT):
        return set_text(prototypes, kind, list(range(int(lower), int(upper) + 1)), names)
    if lower == upper:
        return set_text(prototypes, kind, [lower], names)[1:-1]
    return f"[{_number_text(lower, kind)}, {_number_text(upper, kind)}]"
