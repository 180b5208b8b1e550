"""Say a disagreement in words: where the model says it, what the executive held, what the judge found."""

from pathlib import PurePath
from typing import Any

from checker.judge.document import value_data
from checker.judge.report import Disagreement, JudgeReport
from nddl_lang.text.source import Span
from runtime.executive.record import OpenValues, Value, ValueRange


class DisagreementError(Exception):
    """The executive holds true what the judge does not: a fault of nddlc, never of the model."""

    def __init__(self, report: JudgeReport) -> None:
        self.report = report
        more = len(report.errors) - 1
        others = f"; and {more} more" if more else ""
        super().__init__(disagreement_text(report.errors[0]) + others)


def value_text(value: Value) -> str:
    """A value as reports print it: `[lo hi]` and `{a, b}` for what was never fixed."""
    if isinstance(value, ValueRange):
        return f"[{_bound(value.lower)} {_bound(value.upper)}]"
    if isinstance(value, OpenValues):
        return "{" + ", ".join(value_text(each) for each in value.values) + "}"
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else repr(value)


def _bound(number: float) -> str:
    if number in (float("inf"), float("-inf")):
        return "+inf" if number > 0 else "-inf"
    return repr(int(number)) if number == int(number) else repr(number)


def place_text(span: Span) -> str:
    """File and line of a stretch of a model."""
    return f"{PurePath(span.source.name).name}:{span.line}"


def disagreement_text(one: Disagreement) -> str:
    """One disagreement in one line."""
    where = f"{place_text(one.span)}: " if one.span is not None else ""
    who = f" ({', '.join(one.tokens)})" if one.tokens else ""
    values = ", ".join(f"{name} = {value_text(value)}" if name else value_text(value) for name, value in one.values)
    return f"{one.reactor}: {where}{_claim(one)}{who}{f': {values}' if values else ''}"


def _claim(one: Disagreement) -> str:
    line = f"`{first_line(one.span.text)}`" if one.span is not None else f"`{one.name}`"
    match one.kind:
        case "constraint" | "relation":
            left_open = "fixes a value that was left open"
            return f"{line} {left_open if one.held == 'left open' else 'does not hold'}"
        case "guard":
            return f"{line} asks for `{one.found}`, but `{one.held}` ran"
        case "domain":
            return f"`{one.name}` is {one.found}"
        case "draw":
            return f"{line}: `{one.name}` is not what is drawn for the tick at which the token begins"
        case "overlap" | "gap" | "observation" | "level" | "goal":
            return f"{one.kind} on `{one.name}`: {one.held}, but {one.found}"
        case _:
            return f"{one.kind} `{one.name}`: {one.held}, but {one.found}"


def disagreement_data(one: Disagreement) -> dict[str, Any]:
    """One disagreement as JSON."""
    data: dict[str, Any] = {
        "kind": one.kind,
        "reactor": one.reactor,
        "name": one.name,
        "tokens": list(one.tokens),
        "values": [{"name": name, "value": value_data(value)} for name, value in one.values],
        "held": one.held,
        "found": one.found,
    }
    if one.span is not None:
        data["place"] = {"file": PurePath(one.span.source.name).name, "line": one.span.line}
    return data


def report_data(report: JudgeReport) -> dict[str, Any]:
    """A judgement as JSON."""
    return {
        "holds": report.holds,
        "disagreements": [disagreement_data(one) for one in report.disagreements],
        "judged": report.judged,
        "open": report.open,
        "skipped": [{"reason": reason, "count": count} for reason, count in report.skipped],
    }


def first_line(text: str) -> str:
    """The first line of a piece of a model, without its block."""
    return text.partition("\n")[0].rstrip("{ ").strip()


def report_text(report: JudgeReport) -> str:
    """A judgement in lines: disagreements, then how much was judged."""
    lines = [disagreement_text(one) for one in report.disagreements]
    lines.append(f"{report.judged} judged, {report.open} left open, {len(report.disagreements)} disagreements")
    lines += [f"not judged: {count} x {reason}" for reason, count in report.skipped]
    return "\n".join(lines)
