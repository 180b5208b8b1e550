"""What the property that a mission violated first is about: levels of a resource, or values that it forbids."""

from collections.abc import Sequence

from checker.oracle import given_up
from runtime.executive.configuration import PropertyConfiguration, PropertyKind
from runtime.executive.outcome import Outcome, PropertyFate


def first_violated(outcome: Outcome) -> PropertyFate | None:
    """The first property of the mission file that was violated, None where all were kept."""
    return next((one for one in outcome.properties if not one.is_kept), None)


def of_first_violated(outcome: Outcome, properties: Sequence[PropertyConfiguration]) -> list[PropertyConfiguration]:
    """What the mission file says of the first violated property, where the mission was judged by it."""
    broken = first_violated(outcome) if given_up(outcome) is None else None
    return _of(broken, properties)


def _of(broken: PropertyFate | None, properties: Sequence[PropertyConfiguration]) -> list[PropertyConfiguration]:
    return [each for each in properties if broken is not None and each.name == broken.name]


def promised_levels(outcome: Outcome, properties: Sequence[PropertyConfiguration]) -> list[str]:
    """The resource whose level the first violated property is about, if it is about one."""
    return [each.level.resource for each in of_first_violated(outcome, properties) if each.level is not None]


def forbids_values(outcome: Outcome, properties: Sequence[PropertyConfiguration]) -> bool:
    """Whether the first violated property forbids values, whenever they come."""
    forbidding = (PropertyKind.NEVER, PropertyKind.ALWAYS)
    return any(each.kind in forbidding for each in _of(first_violated(outcome), properties))
