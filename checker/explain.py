"""A story in, text for people or plain data for programs out."""

from collections.abc import Sequence
from typing import Any

from checker.batch.result import MissionResult
from checker.conditions.rendering import condition_data, condition_lines
from checker.contrast import Contrast
from checker.contrast_rendering import contrast_lines
from checker.counterfactual.ranking import Causes, Claim
from checker.counterfactual.rendering import causes_data, claim_text, effort_text, has_no_flown, nothing_text
from checker.excerpts import Excerpts
from checker.findings import Fault
from checker.losses import Repairs
from checker.names import mission_name
from checker.oracle import CODE_NAMES
from checker.proofs.conflict import Confirmation
from checker.rendering import (
    beside,
    cause_number,
    confirmation_text,
    failure_text,
    kind_text,
    step_label,
    step_text,
)
from checker.sampling.rendering import number
from checker.steps import Step, StepKind
from checker.story import Story
from nddl_lang.text.printable import counted
from runtime.executive.configuration import CodeConfiguration
from runtime.executive.outcome import SourcePlace

MOST_CAUSES = 3
_MARKED = (StepKind.FAULT, StepKind.BROKEN, StepKind.ABORT)
_ARROW = "     │\n     ▼"


def page_text(
    story: Story,
    contrast: Contrast | None,
    run_id: str,
    excerpts: Excerpts,
    most: int = MOST_CAUSES,
    drawn: str = "",
) -> str:
    """The page that `nddlc explain` prints: the story with so many causes, its graph, what sets the mission apart."""
    apart = "\n".join(["", *contrast_lines(contrast)]) + "\n" if contrast is not None else ""
    return _story_text(story, run_id, excerpts, most) + drawn + apart


def _story_text(story: Story, run_id: str, excerpts: Excerpts, most: int) -> str:
    """The story, with so many causes."""
    code = story.judgement.code
    lines = [
        f"{mission_name(story.number)} of run {run_id} failed at tick {story.last_tick} of {story.final_tick} "
        f"({code}: {CODE_NAMES.get(code, 'unknown')})",
        f"  {failure_text(story.judgement, story.open_goals, story.refusal)}",
        "",
    ]
    if story.fault is not None and (story.fault.causes.tried or story.fault.causes.ranked):
        lines += [*_cause_lines(story, story.fault.causes, excerpts, most), "", "what happened:"]
    else:
        lines.append("no change was tried: which line is mistaken is not known; what happened:")
    causes = [cause.place for cause in story.fault.causes.ranked[:most]] if story.fault is not None else []
    for index, step in enumerate(story.steps, 1):
        lines += _step_lines(index, step, story, excerpts, causes)
        if index < len(story.steps):
            lines.append(_ARROW)
    found = [f"z3 {confirmation_text(story.confirmation)}"] if story.confirmation is not None else []
    found += _fault_lines(story.fault, story.number) if story.fault is not None else []
    lines += ["", *found] if found else []
    return "\n".join(lines) + "\n"


def _cause_lines(story: Story, causes: Causes, excerpts: Excerpts, most: int) -> list[str]:
    """The lines to look at, each with what its trial showed."""
    effort = effort_text(causes, "the same mission" if causes.flown in (0, story.number) else "one that fails alike")
    coded = [f"      {_python_text(one)}" for one in story.coded]
    if not causes.ranked:
        return [nothing_text(effort), *coded]
    if has_no_flown(causes):
        is_seen = causes.ranked[0].claim in (Claim.RAISED, Claim.ASLEEP)
        what = "the line that failed" if is_seen else "guesses, the likeliest first"
        lines = [f"{nothing_text(effort)}; {what}:"]
    else:
        lines = [f"causes, the likeliest first ({effort}):"]
    for place, cause in enumerate(causes.ranked[:most], 1):
        lines.append(f"{place:>4}  {claim_text(cause, causes.remarks)}")
        lines += excerpt_lines(cause.place, excerpts, marked=place == 1)
    if len(causes.ranked) > most:
        lines.append(f"      and {len(causes.ranked) - most} more (-v)")
    return [*lines, *coded]


def _python_text(coded: CodeConfiguration) -> str:
    """That no line of a reactor in Python was tried, through which the story goes."""
    return f"what happened goes through `{coded.name}`, which is Python ({coded.file}): none of its lines was changed"


def _step_lines(index: int, step: Step, story: Story, excerpts: Excerpts, causes: Sequence[SourcePlace]) -> list[str]:
    when = f"tick {step.tick}: " if step.tick is not None else ""
    lines = [f"{index:>4}  {when}{step_text(step, story)}{step_label(step, causes)}"]
    if step.place is not None:
        lines += excerpt_lines(step.place, excerpts, marked=step.kind in _MARKED)
        lines += [f"      {said}" for said in _remarks_on(step.place, story, causes)]
    for said, place, is_marked in beside(step):
        cause = cause_number(place, causes)
        mark = f" (cause {cause})" if cause else ""
        lines += [f"      {said}{mark}:", *excerpt_lines(place, excerpts, marked=is_marked)]
    return lines


def _remarks_on(place: SourcePlace, story: Story, causes: Sequence[SourcePlace]) -> list[str]:
    """What lint says of a line of the story, where it was not told with a cause."""
    if story.fault is None or cause_number(place, causes):
        return []
    about = (one for one in story.fault.causes.remarks if one.is_about(place))
    return list(dict.fromkeys(f"lint says of this line: {one.text}" for one in about))


def excerpt_lines(
    place: SourcePlace, excerpts: Excerpts, *, marked: bool = False, indent: str = "      ", about: str = ""
) -> list[str]:
    """A place with its line of source; `marked` underlines what it is about, `about` says so."""
    text = excerpts.line(place).expandtabs(4)
    bar = " " * len(str(place.line))
    lines = [f"{indent}--> {excerpts.path(place)}{f' ({about})' if about else ''}", f"{indent} {place.line} | {text}"]
    if marked:
        first = place.text.strip().split("\n")[0].strip()
        start = max(text.find(first), 0)
        lines.append(f"{indent} {bar} | {' ' * start}{'^' * max(1, len(first))}")
    return lines


def _fault_lines(fault: Fault, told: int) -> list[str]:
    lines = condition_lines(fault.condition) if fault.condition is not None else []
    others = [str(mission) for mission in fault.bucket.missions if mission != told]
    if others:
        shown = ", ".join(others[:12]) + (", ..." if len(others) > 12 else "")
        lines.append(f"{len(others)} more missions fail alike: {shown}")
    return lines


def story_data(story: Story, run_id: str, excerpts: Excerpts) -> dict[str, Any]:
    """The story as `nddlc explain --format json` prints it."""
    fault = story.fault
    return {
        "run": run_id,
        "mission": story.number,
        "seed": story.seed,
        "verdict": story.judgement.verdict.value,
        "code": story.judgement.code,
        "reason": failure_text(story.judgement, story.open_goals, story.refusal),
        "last_tick": story.last_tick,
        "final_tick": story.final_tick,
        "causes": None if fault is None else causes_data(fault.causes),
        "steps": [_step_data(step, story, excerpts) for step in story.steps],
        "z3": confirmation_data(story.confirmation),
        "condition": None if fault is None else condition_data(fault.condition),
        "alike": [] if fault is None else list(fault.bucket.missions),
    }


def result_text(result: MissionResult, run_id: str) -> str:
    """What there is to say of a mission that did not fail."""
    outcome = result.outcome
    if outcome is None:
        reason = f"could not be flown: {failure_text(result.judgement)}"
        return f"{mission_name(result.number)} of run {run_id} (seed {result.seed}) {reason}\n{result.detail}\n"
    losses = result.losses
    ends = "nothing to explain" if not losses.repairs else f"after {counted(losses.repaired, 'repair')} of plans"
    lines = [f"{mission_name(result.number)} of run {run_id} passed: it reached tick {outcome.last_tick}; {ends}"]
    lines += [f"  repaired: {_repair_text(each)}" for each in losses.repairs]
    if losses.repairs:
        lines.append("  a repair may set aside what a rule says; `max_repairs = 0` under [check] makes it a failure")
    lines += [f"  {draw.parameter} = {number(draw.value)} from tick {draw.tick} on" for draw in outcome.draws]
    return "\n".join(lines) + "\n"


def _repair_text(repair: Repairs) -> str:
    """Repairs for one reason: the first of them, and the line that broke."""
    place = repair.place
    where = "" if place is None else f", by {place.file}:{place.line} `{place.text.strip()}`"
    first = f"at tick {repair.first}" if repair.count == 1 else f"{repair.count} times, first at tick {repair.first}"
    return f"{repair.reactor} {first}: {kind_text(repair.kind)}{where}"


def result_data(result: MissionResult, run_id: str) -> dict[str, Any]:
    """The same as data."""
    return {
        "run": run_id,
        "mission": result.number,
        "seed": result.seed,
        "verdict": result.verdict.value,
        "reason": failure_text(result.judgement, result.open_goals),
    }


def _step_data(step: Step, story: Story, excerpts: Excerpts) -> dict[str, Any]:
    return {
        "kind": step.kind.value,
        "tick": step.tick,
        "reason": step_text(step, story),
        "place": place_data(step.place, excerpts),
        "limits": [place_data(limit, excerpts) for limit in step.limits],
        "made": place_data(step.made, excerpts),
        "under": [{"place": place_data(one.place, excerpts), "else": one.is_else} for one in step.under],
    }


def place_data(place: SourcePlace | None, excerpts: Excerpts) -> dict[str, Any] | None:
    """A place; `file` is relative to the mission file, so that it reads the same in every checkout."""
    if place is None:
        return None
    return {"file": place.file, "line": place.line, "column": place.column, "text": excerpts.line(place).strip()}


def confirmation_data(found: Confirmation | None) -> dict[str, Any] | None:
    """z3's word: its finding and the causes in the core."""
    if found is None:
        return None
    return {
        "finding": found.finding.value,
        "core": list(found.core),
        "minimal": found.is_minimal,
        "from_text": found.written,
        "called": [
            {
                "constraint": one.name,
                "file": one.file,
                "line": one.line,
                "calls": one.calls,
                "refused": list(one.refused),
            }
            for one in found.called
        ],
        "untranslated": list(found.untranslated),
    }
