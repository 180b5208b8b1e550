"""Records as JSON, in the form that docs/validate.md describes."""

from math import isinf
from typing import Any

from runtime.executive.record import (
    BodyRun,
    MissionRecord,
    OpenValues,
    ReactorRecord,
    TokenRecord,
    Value,
    ValueRange,
)


def value_data(value: Value) -> Any:
    """A value as JSON: itself, {"between": [lower, upper]} (null: no bound), {"one_of": [...]}; "inf" where endless."""
    if isinstance(value, ValueRange):
        return {"between": [None if isinf(end) else end for end in value]}
    if isinstance(value, OpenValues):
        return {"one_of": [value_data(each) for each in value.values]}
    return str(value) if isinstance(value, float) and isinf(value) else value


def record_data(record: MissionRecord) -> dict[str, Any]:
    """A mission's record as JSON."""
    return {"reactors": [_reactor_data(each) for each in record.reactors]}


def _reactor_data(record: ReactorRecord) -> dict[str, Any]:
    return {
        "reactor": record.reactor,
        "last_tick": record.last_tick,
        "globals": [value_data(each) for each in record.globals],
        "members": {each.name: [value_data(value) for value in each.members] for each in record.objects},
        "script_tokens": list(record.script_tokens),
        "tokens": [_token_data(each) for each in record.tokens],
    }


def _token_data(token: TokenRecord) -> dict[str, Any]:
    return {
        **token._asdict(),
        "object": value_data(token.object),
        "duration": value_data(token.duration),
        "start": value_data(token.start),
        "end": value_data(token.end),
        "arguments": [value_data(each) for each in token.arguments],
        "runs": [_run_data(run) for run in token.runs],
    }


def _run_data(run: BodyRun) -> dict[str, Any]:
    return {
        "rule": run.rule,
        "locals": [value_data(each) for each in run.locals],
        "children": list(run.children),
        "guards": [
            {
                "branch": guard.branch,
                "is_decided": guard.is_decided,
                "run": None if guard.run is None else _run_data(guard.run),
            }
            for guard in run.guards
        ],
    }
