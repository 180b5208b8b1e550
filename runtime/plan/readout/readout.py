"""Tell the state of a plan as plain data, in the form that the conformance suite reads."""

from typing import Any

from runtime.constraints.domains.tags import HALF_INF
from runtime.plan.database import PlanDatabase
from runtime.plan.store.domain_texts import domain_text
from runtime.plan.tags import (
    DURATION,
    END,
    FIRST_PARAMETER,
    FLAG_EVENT,
    FLAG_FACT,
    FREED,
    HOLDS_VARIABLES,
    LIST_ORDER,
    LISTS,
    MERGED,
    OBJECT,
    ROLE_LOCAL,
    START,
    STATE,
    STATE_NAMES,
)

Bound = int | str


def read(database: PlanDatabase) -> dict[str, Any]:
    """Consistency, domains of all variables, all tokens, and the sequence of tokens on each timeline."""
    tokens = live_tokens(database)
    names = token_names(database, tokens)
    domains: dict[str, str] = {}
    read_globals(database, domains)
    for t in tokens:
        if database.plan.rows.status[t] != MERGED:
            read_token_domains(database, t, names[t], domains)
        read_locals(database, t, names[t], domains)
    return {
        "consistent": database.is_consistent,
        "domains": domains,
        "tokens": [token_facts(database, t, names) for t in tokens],
        "order": orders(database, names),
    }


def live_tokens(database: PlanDatabase) -> list[int]:
    """All tokens in the order of their making."""
    rows = database.plan.rows
    return sorted((t for t in range(rows.token_count) if rows.status[t] != FREED), key=lambda t: rows.key[t])


def token_names(database: PlanDatabase, tokens: list[int]) -> dict[int, str]:
    """The names that the script gives; others are numbered by predicate."""
    rows = database.plan.rows
    names: dict[int, str] = {}
    counts: dict[int, int] = {}
    for t in tokens:
        given = database.token_label(t)
        if given is None:
            predicate = rows.predicate[t]
            counts[predicate] = counts.get(predicate, 0) + 1
            given = f"{database.program.predicates[predicate].name}#{counts[predicate]}"
        names[t] = given
    return names


def read_globals(database: PlanDatabase, domains: dict[str, str]) -> None:
    """Global variables and members of objects."""
    plan = database.plan
    for index, (name, type_) in enumerate(database.program.globals):
        if plan.globals[index] >= 0:
            domains[name] = text(database, plan.globals[index], type_.kind, type_.type_name)
    for o, name in enumerate(database.objects.names):
        for k, member in enumerate(database.program.classes[plan.object_class[o]].members):
            v = plan.object_var0[o] + k
            domains[f"{name}.{member.name}"] = text(database, v, member.type.kind, member.type.type_name)


def text(database: PlanDatabase, v: int, kind: str, type_name: str) -> str:
    """The domain of a variable whose type is known."""
    shown = "symbol" if kind == "symbol" else type_name
    return domain_text(database.prototypes, database.plan.engine, v, database.objects.names, shown)


def read_token_domains(database: PlanDatabase, t: int, name: str, domains: dict[str, str]) -> None:
    """The variables of a token."""
    rows = database.plan.rows
    first = rows.var0[t]
    predicate = database.program.predicates[rows.predicate[t]]
    domains[f"{name}.state"] = text(database, first + STATE, "symbol", "symbol")
    domains[f"{name}.object"] = text(database, first + OBJECT, "object", predicate.class_name)
    domains[f"{name}.duration"] = text(database, first + DURATION, "int", "int")
    if rows.flags[t] & FLAG_EVENT:
        domains[f"{name}.time"] = text(database, first + START, "int", "int")
    else:
        domains[f"{name}.start"] = text(database, first + START, "int", "int")
        domains[f"{name}.end"] = text(database, first + END, "int", "int")
    for k, parameter in enumerate(predicate.parameters):
        v = first + FIRST_PARAMETER + k
        domains[f"{name}.{parameter.name}"] = text(database, v, parameter.type.kind, parameter.type.type_name)


def read_locals(database: PlanDatabase, t: int, name: str, domains: dict[str, str]) -> None:
    """The named variables of the rules that ran for a token; of several with one name, the latest."""
    plan, rows = database.plan, database.plan.rows
    s = rows.scopes[t]
    while s >= 0:
        h = rows.scope_holds[s]
        while h >= 0:
            v = rows.hold_id[h]
            if rows.hold_kind[h] == HOLDS_VARIABLES and plan.variable_role[v] == ROLE_LOCAL:
                key = f"{name}::{database.names.text(plan.variable_name[v])}"
                if key not in domains:
                    shown = database.local_type(v)
                    domains[key] = domain_text(database.prototypes, plan.engine, v, database.objects.names, shown)
            h = rows.hold_next[h]
        s = rows.scope_next[s]


def token_facts(database: PlanDatabase, t: int, names: dict[int, str]) -> dict[str, Any]:
    """One token."""
    rows = database.plan.rows
    predicate = database.program.predicates[rows.predicate[t]]
    master, merged = rows.master[t], rows.merged_into[t]
    relation = rows.relation[t]
    facts: dict[str, Any] = {"id": names[t], "predicate": predicate.name, "state": STATE_NAMES[rows.status[t]]}
    if rows.status[t] != MERGED:
        first = rows.var0[t]
        facts["object"] = text(database, first + OBJECT, "object", predicate.class_name)
        facts["start"] = bounds(database, first + START)
        facts["duration"] = bounds(database, first + DURATION)
        facts["end"] = bounds(database, first + END)
        facts["params"] = {
            parameter.name: text(database, first + FIRST_PARAMETER + k, parameter.type.kind, parameter.type.type_name)
            for k, parameter in enumerate(predicate.parameters)
        }
    facts["fact"] = bool(rows.flags[t] & FLAG_FACT)
    facts["master"] = names.get(master) if master >= 0 else None
    facts["relation"] = database.relation_names[relation] if relation >= 0 else None
    facts["merged_into"] = names.get(merged) if merged >= 0 else None
    return facts


def bounds(database: PlanDatabase, v: int) -> list[Bound]:
    """The bounds of a time."""
    engine = database.plan.engine
    return [bound(engine.lb[v]), bound(engine.ub[v])]


def bound(moment: int) -> Bound:
    """A moment, or that there is none."""
    return moment if abs(moment) < HALF_INF else "+inf" if moment > 0 else "-inf"


def orders(database: PlanDatabase, names: dict[int, str]) -> dict[str, list[str]]:
    """The sequence on each timeline that has one."""
    plan, rows = database.plan, database.plan.rows
    found: dict[str, list[str]] = {}
    for o, name in enumerate(database.objects.names):
        t = rows.head_first[plan.object_head[o]]
        sequence = []
        while t >= 0:
            sequence.append(names[t])
            t = rows.link_after[LISTS * t + LIST_ORDER]
        if sequence:
            found[name] = sequence
    return found
