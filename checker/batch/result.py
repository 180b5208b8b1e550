"""What is kept of one mission of a batch, and how it is written as JSON and read again."""

import json
from dataclasses import asdict, dataclass, replace
from functools import cache
from typing import Any, get_args, get_origin, get_type_hints

from checker.oracle import Judgement, Verdict
from runtime.executive.outcome import Draw, Outcome


@dataclass(frozen=True, slots=True)
class MissionResult:
    """Mission `number` (from 1) of a batch. `outcome` is None where the tool failed; `detail` then says how.

    Events are kept for missions that failed, so that they can be explained at once; a mission that passed keeps what
    the statistics need, and is flown again from its seed when somebody asks for more (`has_trace` false).
    """

    number: int
    seed: int
    judgement: Judgement
    outcome: Outcome | None
    has_trace: bool
    detail: str = ""

    @property
    def verdict(self) -> Verdict:
        """The fate of the mission."""
        return self.judgement.verdict


def condense(outcome: Outcome) -> Outcome:
    """An outcome without its events, and of each parameter the least, the greatest and the last draw."""
    kept: list[Draw] = []
    for parameter in dict.fromkeys(draw.parameter for draw in outcome.draws):
        draws = [draw for draw in outcome.draws if draw.parameter == parameter]
        chosen = (min(draws, key=lambda one: one.value), max(draws, key=lambda one: one.value), draws[-1])
        kept += sorted(set(chosen), key=lambda one: one.tick)
    return replace(outcome, events=(), draws=tuple(kept))


def write_result(result: MissionResult) -> str:
    """One line of JSON, the same for equal results."""
    row = {
        "number": result.number,
        "seed": result.seed,
        "verdict": result.verdict.value,
        "code": result.judgement.code,
        "reason": result.judgement.reason,
        "has_trace": result.has_trace,
        "detail": result.detail,
        "outcome": None if result.outcome is None else asdict(result.outcome),
    }
    return json.dumps(row, ensure_ascii=False, separators=(",", ":"))


def read_result(text: str) -> MissionResult:
    """The result that `write_result` wrote."""
    row = json.loads(text)
    judgement = Judgement(Verdict(row["verdict"]), row["code"], row["reason"])
    outcome = None if row["outcome"] is None else _read(Outcome, row["outcome"])
    return MissionResult(row["number"], row["seed"], judgement, outcome, row["has_trace"], row["detail"])


def _read(kind: Any, value: Any) -> Any:
    """The value of type `kind` that `asdict` and JSON turned into `value`: dataclasses, tuples, options and atoms."""
    if hasattr(kind, "__dataclass_fields__"):
        hints = _hints(kind)
        return kind(**{name: _read(hints[name], item) for name, item in value.items()})
    inner = get_args(kind)
    if get_origin(kind) is tuple:
        return tuple(_read(inner[0], item) for item in value)
    if type(None) in inner and value is not None:
        return _read(next(one for one in inner if one is not type(None)), value)
    return value


@cache
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind)
