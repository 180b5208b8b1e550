"""What is known of an argument in, its one value out, as messages and goals carry it."""

from compiler.program import DomainConstant


def single_value(domain: DomainConstant | None) -> float | int | bool | str | None:
    """The one value that a domain leaves; None where it leaves several, or nothing is known."""
    if domain is None:
        return None
    values = set(domain.interval if domain.interval is not None else domain.values or ())
    return values.pop() if len(values) == 1 else None
