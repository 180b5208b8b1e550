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
    return f"{one.reactor}: {where}{_claim(one)}{who}{_values_text(one)}"


def _values_text(one: Disagreement) -> str:
    """The values that were judged; constants and parts of expressions stand in the text of the model."""
    has_names = any(name for name, _ in one.values)
    shown = [(name, value) for name, value in one.values if name or not has_names]
    texts = [f"{name} = {value_text(value)}" if name else value_text(value) for name, value in shown]
    return f": {', '.join(texts)}" if texts else ""


def _claim(one: Disagreement) -> str:
    line = f"`{statement_of(one.span)}`" if one.span is not None else f"`{one.name}`"
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
        case "child":
            return f"{line}: {one.held}, but {one.found}"
        case "duration":
            return "the duration is not the time from start to end, or is too short"
        case "overlap":
            return f"overlap on `{one.name}`: {one.found}, where one token follows the other"
        case "level":
            return f"the {one.held} of `{one.name}` is {one.found}"
        case "gap" | "observation" | "goal":
            return f"{one.kind} on `{one.name}`: {one.held}, but {one.found}"
        case _:
            return f"{one.kind} `{one.name}`: {one.held}, but {one.found}"


def statement_of(span: Span) -> str:
    """The statement of a model that a stretch of it belongs to, on one line; of a block its head."""
    text, begin, finish = span.source.text, span.begin, span.finish
    line = text.rfind("\n", 0, begin) + 1
    begin = max(line, *[text.rfind(mark, line, begin) + 1 for mark in ";{}"])
    ends = [at for mark in ";{}\n" if (at := text.find(mark, finish)) >= 0]
    if not text[:finish].rstrip().endswith((";", "}")):
        finish = min(ends, default=len(text))
    return text[begin:finish].partition("\n")[0].partition("//")[0].rstrip("{; ").strip()


# What to do about a plan that somebody wrote.
_ADVICE: dict[str, str] = {
    "child": "a rule asks for tokens: add the one that is missing, or end the plan before it is due (`last_tick`)",
    "relation": "move one of the tokens until the relation holds, or leave a time open",
    "constraint": "change a value until the constraint holds, or leave it out: it is open then",
    "guard": "leave `runs` out, and the branches are found out",
    "domain": "the declaration in the model says which values there are",
    "duration": "leave `duration` out: it follows from `start` and `end`",
    "overlap": "on a timeline a token ends before the next one starts",
    "gap": "on a timeline that reactors share something holds at every tick",
    "level": "move or shrink what takes from the resource at that tick",
    "merge": "a merged token has the values of the one that stands for it",
}


def _disagreement_data(one: Disagreement) -> dict[str, Any]:
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
        "disagreements": [_disagreement_data(one) for one in report.disagreements],
        "judged": report.judged,
        "open": report.open,
        "skipped": [{"reason": reason, "count": count} for reason, count in report.skipped],
    }


def report_text(report: JudgeReport, *, advises: bool = False) -> str:
    """A judgement in lines: disagreements, then how much was judged; on request what to do about each kind."""
    found = report.disagreements
    lines = [disagreement_text(one) for one in found]
    if advises and found:
        lines += [f"help: {_ADVICE[kind]}" for kind in dict.fromkeys(one.kind for one in found) if kind in _ADVICE]
        named = next((name for one in found for name in one.tokens), None)
        if named is not None:
            key = named.rpartition("#")[2]
            lines.append(f"help: `{named}` is the token with the key {key}: its place in the list if it has no `key`")
    count = f"{len(found)} disagreement{'' if len(found) == 1 else 's'}"
    lines.append(f"{report.judged} judged, {report.open} left open, {count}")
    lines += [f"not judged: {count} x {reason}" for reason, count in report.skipped]
    return "\n".join(lines)
