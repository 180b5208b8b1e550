"""The state of a plan as values: domains, tokens and sequences, and the plain data that the conformance suite reads."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from typing import Any

from runtime.plan.store.domain_texts import DomainText

Interval = tuple[float, float]  # whole numbers, or infinities


@dataclass(frozen=True, slots=True)
class TokenExtent:
    """Variables of a token: its object, its times and its parameters."""

    object: DomainText
    start: Interval
    duration: Interval
    end: Interval
    parameters: Mapping[str, DomainText]

    @property
    def is_fixed(self) -> bool:
        """Whether start and end have one value each."""
        return self.start[0] == self.start[1] and self.end[0] == self.end[1]


@dataclass(frozen=True, slots=True)
class TokenState:
    """One token; it has no extent of its own where it is merged."""

    name: str
    predicate: str
    state: str
    extent: TokenExtent | None
    is_fact: bool
    parent: str | None
    relation: str | None
    merged_into: str | None

    def as_data(self) -> dict[str, Any]:
        """The token for programs, in the keys of the conformance suite."""
        data: dict[str, Any] = {"id": self.name, "predicate": self.predicate, "state": self.state}
        if (own := self.extent) is not None:
            data["object"] = str(own.object)
            data["start"] = [bound_data(bound) for bound in own.start]
            data["duration"] = [bound_data(bound) for bound in own.duration]
            data["end"] = [bound_data(bound) for bound in own.end]
            data["params"] = {name: str(domain) for name, domain in own.parameters.items()}
        data["fact"] = self.is_fact
        data["master"] = self.parent
        data["relation"] = self.relation
        data["merged_into"] = self.merged_into
        return data


@dataclass(frozen=True, slots=True)
class PlanState:
    """Consistency, domains of all variables, all tokens, and the sequence of tokens on each timeline."""

    is_consistent: bool
    variables: Mapping[str, DomainText]  # of the model, members of objects included
    token_variables: Mapping[str, DomainText]
    rule_variables: Mapping[str, DomainText]
    tokens: tuple[TokenState, ...]
    sequences: Mapping[str, list[str]]

    def as_data(self) -> dict[str, Any]:
        """The state for programs, in the keys of the conformance suite."""
        domains = {**self.variables, **self.token_variables, **self.rule_variables}
        return {
            "consistent": self.is_consistent,
            "domains": {name: str(domain) for name, domain in domains.items()},
            "tokens": [token.as_data() for token in self.tokens],
            "order": dict(self.sequences),
        }


def bound_text(bound: float) -> str:
    """A bound of a time."""
    return "+inf" if bound == inf else "-inf" if bound == -inf else str(bound)


def bound_data(bound: float) -> float | str:
    """A bound for programs: infinite ones are texts."""
    return bound_text(bound) if abs(bound) == inf else bound
