"""The state of a plan, read from its tables as values."""

from typing import Any

from compiler.program import PredicateCode
from nddl_lang.text.source import Span
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.state import Interval, PlanState, TokenExtent, TokenState
from runtime.plan.store.domain_texts import DomainText, domain_text, wide
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


def read(database: PlanDatabase) -> dict[str, Any]:
    """The state of a plan as plain data."""
    return read_state(database).as_data()


def read_state(database: PlanDatabase) -> PlanState:
    """The state of a plan."""
    tokens = live_tokens(database)
    names = token_names(database, tokens)
    variables: dict[str, DomainText] = {}
    of_tokens: dict[str, DomainText] = {}
    of_rules: dict[str, DomainText] = {}
    _read_globals(database, variables)
    for t in tokens:
        if database.plan.rows.status[t] != MERGED:
            _read_token_domains(database, t, names[t], of_tokens)
        _read_locals(database, t, names[t], of_rules)
    states = tuple(_token_state(database, t, names) for t in tokens)
    return PlanState(database.is_consistent, variables, of_tokens, of_rules, states, _sequences(database, names))


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


def _read_globals(database: PlanDatabase, domains: dict[str, DomainText]) -> None:
    """Global variables and members of objects."""
    plan = database.plan
    for index, (name, type_) in enumerate(database.program.globals):
        if plan.globals[index] >= 0:
            domains[name] = _text(database, plan.globals[index], type_.kind, type_.type_name)
    for o, name in enumerate(database.objects.names):
        for k, member in enumerate(database.program.classes[plan.object_class[o]].members):
            v = plan.object_var0[o] + k
            domains[f"{name}.{member.name}"] = _text(database, v, member.type.kind, member.type.type_name)


def _text(database: PlanDatabase, v: int, kind: str, type_name: str) -> DomainText:
    """The domain of a variable whose type is known."""
    shown = "symbol" if kind == "symbol" else type_name
    return domain_text(database.prototypes, database.plan.engine, v, database.objects.names, shown)


def _read_token_domains(database: PlanDatabase, t: int, name: str, domains: dict[str, DomainText]) -> None:
    """The variables of a token."""
    rows = database.plan.rows
    first = rows.var0[t]
    predicate = database.program.predicates[rows.predicate[t]]
    domains[f"{name}.state"] = _text(database, first + STATE, "symbol", "symbol")
    domains[f"{name}.object"] = _text(database, first + OBJECT, "object", predicate.class_name)
    domains[f"{name}.duration"] = _text(database, first + DURATION, "int", "int")
    if rows.flags[t] & FLAG_EVENT:
        domains[f"{name}.time"] = _text(database, first + START, "int", "int")
    else:
        domains[f"{name}.start"] = _text(database, first + START, "int", "int")
        domains[f"{name}.end"] = _text(database, first + END, "int", "int")
    for k, parameter in enumerate(predicate.parameters):
        v = first + FIRST_PARAMETER + k
        domains[f"{name}.{parameter.name}"] = _text(database, v, parameter.type.kind, parameter.type.type_name)


def _read_locals(database: PlanDatabase, t: int, name: str, domains: dict[str, DomainText]) -> None:
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
                    shown = database.code.local_types[plan.variable_name[v]]
                    domains[key] = domain_text(database.prototypes, plan.engine, v, database.objects.names, shown)
            h = rows.hold_next[h]
        s = rows.scope_next[s]


def _token_state(database: PlanDatabase, t: int, names: dict[int, str]) -> TokenState:
    """One token."""
    rows = database.plan.rows
    predicate = database.program.predicates[rows.predicate[t]]
    parent, merged, relation = rows.parent[t], rows.merged_into[t], rows.relation[t]
    return TokenState(
        names[t],
        predicate.name,
        STATE_NAMES[rows.status[t]],
        None if rows.status[t] == MERGED else _token_extent(database, t, predicate),
        bool(rows.flags[t] & FLAG_FACT),
        names.get(parent) if parent >= 0 else None,
        database.relation_names[relation] if relation >= 0 else None,
        names.get(merged) if merged >= 0 else None,
    )


def _token_extent(database: PlanDatabase, t: int, predicate: PredicateCode) -> TokenExtent:
    """The variables of a token."""
    first = database.plan.rows.var0[t]
    return TokenExtent(
        _text(database, first + OBJECT, "object", predicate.class_name),
        _interval(database, first + START),
        _interval(database, first + DURATION),
        _interval(database, first + END),
        {
            parameter.name: _text(database, first + FIRST_PARAMETER + k, parameter.type.kind, parameter.type.type_name)
            for k, parameter in enumerate(predicate.parameters)
        },
    )


def _interval(database: PlanDatabase, v: int) -> Interval:
    """The bounds of a time."""
    engine = database.plan.engine
    return wide(engine.lb[v]), wide(engine.ub[v])


def _sequences(database: PlanDatabase, names: dict[int, str]) -> dict[str, list[str]]:
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


def span_of(database: PlanDatabase, number: int) -> Span | None:
    """The stretch of text that has a number; None where there is no text."""
    return database.code.spans[number] if 0 <= number < len(database.code.spans) else None
