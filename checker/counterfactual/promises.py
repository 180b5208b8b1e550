"""What the property that a mission violated first is about: levels of a resource, or values that it forbids."""

from collections.abc import Sequence

from checker.oracle import given_up
from runtime.executive.configuration import PropertyConfiguration, PropertyKind
from runtime.executive.outcome import Outcome


def promised_levels(outcome: Outcome, properties: Sequence[PropertyConfiguration]) -> list[str]:
    """The resource whose level the first violated property is about, if it is about one."""
    broken = next((one.name for one in outcome.properties if not one.is_kept), "")
    is_judged = given_up(outcome) is None
    return [each.level.resource for each in properties if is_judged and each.name == broken and each.level is not None]


def forbids_values(outcome: Outcome, properties: Sequence[PropertyConfiguration]) -> bool:
    """Whether the first violated property forbids values, whenever they come."""
    broken = next((one.name for one in outcome.properties if not one.is_kept), "")
    return any(each.name == broken and each.kind in (PropertyKind.NEVER, PropertyKind.ALWAYS) for each in properties)
