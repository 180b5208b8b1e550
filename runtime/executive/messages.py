"""What reactors tell each other: observations, requests and recalls, as plain data."""

from dataclasses import dataclass

from compiler.program import DomainConstant

Arguments = tuple[tuple[str, DomainConstant], ...]  # parameter name and what is known of it, in declared order


@dataclass(frozen=True, slots=True)
class Observation:
    """The owner's word that from `tick` on `timeline` holds `predicate`; it holds until replaced (T-REX 1.6).

    `event` is its index in the trace; `owner`, `token` and `token_key` name the owner's token.
    """

    tick: int
    timeline: str
    predicate: str
    arguments: Arguments
    event: int
    owner: str = ""
    token: int = -1
    token_key: int = -1


@dataclass(frozen=True, slots=True)
class Request:
    """A token on another reactor's timeline that a user or a reactor asks the owner for (T-REX 1.8).

    Bounds are ticks; infinite ones are ±(2**52 - 1). `sender` is empty for a goal of the mission file.
    """

    number: int
    timeline: str
    predicate: str
    arguments: Arguments
    start: tuple[int, int]
    end: tuple[int, int]
    duration: tuple[int, int]
    sender: str
    event: int
    is_mandatory: bool = False


def number_text(value: float | int) -> str:
    """A number as traces print it: whole floats keep one decimal, others the shortest text that reads back."""
    return repr(value)


def domain_text(domain: DomainConstant) -> str:
    """A domain as traces print it: the value if there is one, `[lo hi]` or `{a, b}` otherwise."""
    if domain.interval is not None:
        lower, upper = domain.interval
        if lower == upper:
            return number_text(lower)
        return f"[{_bound(lower)} {_bound(upper)}]"
    values = [_value(value) for value in domain.values or ()]
    return values[0] if len(values) == 1 else "{" + ", ".join(values) + "}"


def token_text(predicate: str, arguments: Arguments) -> str:
    """A token as traces print it: `Run(distance=240.0)`."""
    inside = ", ".join(f"{name}={domain_text(domain)}" for name, domain in arguments)
    return f"{predicate}({inside})" if inside else predicate


def _bound(value: float | int) -> str:
    if value >= 2**51:
        return "+inf"
    if value <= -(2**51):
        return "-inf"
    return number_text(value)


def _value(value: float | int | bool | str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else number_text(value)
