"""Reckon with the sets of values that a text fixes: intervals and sets, of one kind each."""

from bisect import bisect_left
from math import ceil, floor

from nddl_lang.semantics.schema import INFINITY, Domain, Interval, Kind, Values

_Item = float | int | bool | str

TOLERANCE = 1e-5  # floats closer than this are equal, as in EUROPA


def hull(domain: Domain) -> Interval | None:
    """The interval around a domain of numbers, None for other values."""
    if isinstance(domain, Interval):
        return domain
    numbers = [item for item in domain.items if isinstance(item, int | float)]
    if not numbers or len(numbers) != len(domain.items):
        return None
    return Interval(min(numbers), max(numbers))


def is_single(domain: Domain) -> bool:
    """Whether exactly one value is left."""
    if isinstance(domain, Interval):
        return domain.lower == domain.upper
    return len(set(domain.items)) == 1


def intersect(one: Domain, other: Domain, kind: Kind) -> Domain | None:
    """The values that both domains have, None where there are none; numbers are read as values of `kind`."""
    if isinstance(one, Interval) and isinstance(other, Interval):
        return _intersect_intervals(one, other, kind)
    if isinstance(one, Interval):
        one, other = other, one
    assert isinstance(one, Values)
    if isinstance(other, Values):
        kept = _common_items(one.items, other.items, TOLERANCE if kind is Kind.FLOAT else 0)
    else:
        kept = tuple(item for item in one.items if _contains(other, item, kind))
    return Values(kept) if kept else None


def _common_items(some: tuple[_Item, ...], others: tuple[_Item, ...], slack: float) -> tuple[_Item, ...]:
    known = set(others)
    numbers = sorted(item for item in others if not isinstance(item, str)) if slack else []

    def is_near(item: _Item) -> bool:
        if not numbers or isinstance(item, str):
            return False
        place = bisect_left(numbers, item - slack)
        return place < len(numbers) and numbers[place] <= item + slack

    return tuple(item for item in some if item in known or is_near(item))


def _contains(domain: Domain, value: float | int | bool | str, kind: Kind) -> bool:
    """Whether `domain` has `value`."""
    slack = TOLERANCE if kind is Kind.FLOAT else 0
    if isinstance(domain, Interval):
        if isinstance(value, str):
            return False
        return domain.lower - slack <= value <= domain.upper + slack
    if isinstance(value, str):
        return value in domain.items
    return any(not isinstance(item, str) and abs(item - value) <= slack for item in domain.items)


def is_within(inner: Domain, outer: Domain, kind: Kind) -> bool:
    """Whether `outer` has every value of `inner`."""
    if isinstance(inner, Values):
        return all(_contains(outer, item, kind) for item in inner.items)
    if isinstance(outer, Values):
        return False
    return _contains(outer, inner.lower, kind) and _contains(outer, inner.upper, kind)


def text(domain: Domain) -> str:
    """A domain as a model would write it."""
    if isinstance(domain, Interval):
        return _value_text(domain.lower) if domain.lower == domain.upper else set_text(domain)
    return _value_text(domain.items[0]) if len(domain.items) == 1 else set_text(domain)


def set_text(domain: Domain, kind: Kind | None = None) -> str:
    """A domain as a model would write it, with brackets or braces in any case."""
    if isinstance(domain, Interval):
        return f"[{_value_text(domain.lower)} {_value_text(domain.upper)}]"
    quote = '"' if kind is Kind.STRING else ""
    return "{" + ", ".join(f"{quote}{_value_text(item)}{quote}" for item in domain.items) + "}"


def _intersect_intervals(one: Interval, other: Interval, kind: Kind) -> Interval | None:
    lower, upper = max(one.lower, other.lower), min(one.upper, other.upper)
    if kind is Kind.INT:
        lower, upper = ceil(lower), floor(upper)
    if lower > upper:
        if kind is Kind.FLOAT and lower - upper <= TOLERANCE:
            return Interval(upper, lower)
        return None
    return Interval(lower, upper)


def _value_text(value: float | int | bool | str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if value >= INFINITY:
        return "+inf" if isinstance(value, int) else "+inff"
    if value <= -INFINITY:
        return "-inf" if isinstance(value, int) else "-inff"
    return repr(value)
