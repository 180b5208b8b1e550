"""Provenance of a token: the rule that asked for it, its parent, and so on up to the goal."""

from dataclasses import dataclass

from nddl_lang.text.source import Span
from runtime.plan.database import PlanDatabase
from runtime.plan.tags import NONE


@dataclass(frozen=True, slots=True)
class ProvenanceStep:
    """One token of a chain; `statement` made it, in a rule that is `rule` (None: in the script, or from outside)."""

    token: int
    predicate: str
    relation: str | None
    statement: Span | None
    rule: Span | None


def chain(database: PlanDatabase, t: int) -> list[ProvenanceStep]:
    """The token, its parent, its parent's parent, and so on."""
    rows = database.plan.rows
    links = []
    while t >= 0:
        creator = rows.creator[t]
        rule = NONE if creator < 0 else rows.scope_rule[creator]
        relation = rows.relation[t]
        link = ProvenanceStep(
            t,
            database.program.predicates[rows.predicate[t]].name,
            None if relation < 0 else database.relation_names[relation],
            span_of(database, rows.span[t]),
            None if rule < 0 else database.program.rules[rule].span,
        )
        links.append(link)
        t = rows.parent[t]
    return links


def span_of(database: PlanDatabase, number: int) -> Span | None:
    """The stretch of text that has a number; None where there is no text."""
    return database.code.spans[number] if 0 <= number < len(database.code.spans) else None
