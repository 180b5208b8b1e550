"""A certificate in, its words and its plain data out: what is proved, for what, and what is not."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from checker.excerpts import Excerpts
from checker.explain import excerpt_lines, place_data
from checker.names import relative_name
from checker.oracle import judge_within
from checker.proofs.box import Box, Point
from checker.proofs.certify import Certainty, Certificate
from checker.proofs.constants import SafeConstant
from checker.proofs.demands import Demand
from checker.proofs.uncertain import PlanNetwork, VehicleDuration
from checker.rendering import failure_text
from checker.sampling.rendering import number
from nddl_lang.text.source import Span
from runtime.executive.outcome import SourcePlace


def certificate_lines(name: str, found: Certificate, box: Box, excerpts: Excerpts) -> list[str]:
    """The answer as `nddlc certify` prints it."""
    sides = ", ".join(_side(box, each) for each in box.sides) or "no sampled parameters"
    match found.certainty:
        case Certainty.CERTIFIED if found.unproved:
            lines = [f"{name}: certified but for its properties: no value in the box breaks the rules"]
            lines.append(f"  no part of the proof, judged in flights only: {', '.join(found.unproved)}")
        case Certainty.CERTIFIED:
            lines = [f"{name}: certified: no value in the box breaks it"]
        case Certainty.REFUTED:
            lines = [f"{name}: refuted: {_point(found.point)} fails when flown"]
        case _:
            lines = [f"{name}: unknown: {found.why}"]
    lines.append(f"  box: {sides}")
    if endless := box.endless():
        verb = "is" if len(endless) == 1 else "are"
        lines.append(f"  {' and '.join(endless)} {verb} drawn outside of the box too, of which nothing is proved")
    if found.certainty is Certainty.REFUTED and found.outcome is not None:
        judgement = judge_within(found.outcome, found.limits)
        lines.append(f"  {judgement.code} at tick {found.outcome.last_tick}: {_failure(found)}")
        for span in found.lines:
            lines += excerpt_lines(place_of(span, excerpts.root), excerpts, indent="  ")
        lines += _subset_lines(found)
    lines += _basis_lines(found)
    return lines


def _failure(found: Certificate) -> str:
    assert found.outcome is not None
    return failure_text(judge_within(found.outcome, found.limits), found.outcome.open_goals)


def _subset_lines(found: Certificate) -> list[str]:
    if found.base is None or not found.subset:
        return []
    names = ", ".join(found.subset)
    proved = "; no smaller set does, for these structures" if found.is_smallest else "; smaller sets are not ruled out"
    return [f"  it is enough to change {names} in the mission that passes with {_point(found.base)}{proved}"]


def _basis_lines(found: Certificate) -> list[str]:
    """What the answer rests on."""
    flown = f"{found.flights} mission{'s' if found.flights != 1 else ''} flown"
    if not found.structures:
        return [f"  {flown}"]
    many = f"{found.structures} structure{'s' if found.structures != 1 else ''}"
    lines = [f"  {flown}, {many} (tokens, order, relations, branches, and how long each request takes)"]
    if found.certainty is Certainty.CERTIFIED:
        lines += [
            f"  proved by z3: at every point of the box all {found.conditions} conditions of one of them hold",
            "  the reading is strong: with the times that the executive chooses, not with some that would do",
        ]
        if found.why:
            lines.append(f"  {found.why}")
    if found.repaired:
        lines.append(
            f"  in {found.repaired} of them a plan was repaired: what a repair forgets is not held against a mission"
            " (`max_repairs = 0` under [check] does that)"
        )
    if found.open:
        lines.append(f"  {found.open} demands are on what the missions left undecided; nothing is said of them")
    return lines


def constant_lines(
    safe: SafeConstant, places: tuple[Span, ...], again: Certificate | None, excerpts: Excerpts
) -> list[str]:
    """The safe value of a constant, offered only if it was certified again."""
    sign = ">=" if safe.is_least else "<="
    if again is None or again.certainty is not Certainty.CERTIFIED:
        why = again.why or again.certainty.value if again is not None else "its value is not written as a number"
        return [f"{safe.name} {sign} {safe.value} would do for these structures, but is not certified: {why}"]
    beyond = safe.value - 1 if safe.is_least else safe.value + 1
    lines = [
        f"{safe.name} {sign} {safe.value}: certified with {safe.value}; {beyond} is not enough for these structures"
    ]
    for span in places:
        lines += excerpt_lines(place_of(span, excerpts.root), excerpts, indent="  ")
    return lines


def certificate_data(found: Certificate, box: Box, excerpts: Excerpts) -> dict[str, Any]:
    """The same as data."""
    return {
        "answer": found.certainty.value,
        "why": found.why,
        "box": {name: [side.lower, side.upper] for name, side in box.sides.items()},
        "endless": box.endless(),
        "point": found.point,
        "code": judge_within(found.outcome, found.limits).code if found.outcome is not None else None,
        "lines": [place_data(place_of(span, excerpts.root), excerpts) for span in found.lines],
        "subset": list(found.subset),
        "subset_is_smallest": found.is_smallest,
        "base": found.base,
        "structures": found.structures,
        "conditions": found.conditions,
        "flights": found.flights,
        "open": found.open,
        "untold": dict(found.untold),
        "unproved": list(found.unproved),
        "repaired": found.repaired,
    }


def place_of(span: Span, root: Path) -> SourcePlace:
    """A span as outcomes name it."""
    line, column = span.source.locate(span.begin)
    return SourcePlace(relative_name(span.source.name, root), line, column, " ".join(span.text.split()))


def _side(box: Box, name: str) -> str:
    side = box.sides[name]
    if side.distribution in ("discrete", "fixed"):
        return f"{name} one of {', '.join(number(each) for each in side.values)}"
    return f"{name} {number(side.lower)} to {number(side.upper)}"


def _point(point: Point | None) -> str:
    return ", ".join(f"{name} = {number(value)}" for name, value in (point or {}).items()) or "the mission"


@dataclass(frozen=True, slots=True)
class Answer:
    """Whether a plan is controllable: the cycle that no strategy keeps, None if one does all.

    `is_shown`: nor does one keep it where all takes as long as flights have shown. `is_weak` is None if not known.
    """

    cycle: tuple[object, ...] | None
    is_shown: bool
    is_strong: bool
    is_weak: bool | None

    @property
    def is_reckoned(self) -> bool:
        """Whether only durations that no flight has shown are in the way."""
        return self.cycle is not None and not self.is_shown


def control_lines(name: str, plan: PlanNetwork, answer: Answer, excerpts: Excerpts) -> list[str]:
    """What is said of one reactor's plan."""
    cycle = answer.cycle
    if (cycle is None and plan.endless) or answer.is_reckoned:
        lines = [f"{name}, plan of {plan.reactor}: whether it is controllable is not known"]
    else:
        said = "dynamically controllable" if cycle is None else "not dynamically controllable"
        if cycle is None and plan.left_out:
            said += " as far as distances between times go"
        lines = [f"{name}, plan of {plan.reactor}: {said}; {_static(answer.is_strong, answer.is_weak)}"]
    open_ones = [each for each in plan.durations if each.lower < each.upper]
    if open_ones or plan.endless:
        lines.append(
            "  the vehicle decides:" if not answer.is_reckoned else "  others decide, at most as the lines tell:"
        )
    lines += [f"    {_taken(each)}{_shown(each) if answer.is_reckoned else ''}" for each in open_ones]
    lines += [f"    {each}: for how long is not known" for each in plan.endless]
    if exact := [_taken(each) for each in plan.durations if each.lower == each.upper]:
        lines.append(f"  the same for all values: {', '.join(exact)}")
    if plan.left_out:
        lines.append(f"  {plan.left_out} demands are no distances between times, and are left out")
    if cycle is not None:
        if answer.is_reckoned:
            lines.append("  some strategy does where all takes as long as in flights; none keeps all of these:")
        else:
            lines.append("  no strategy keeps all of these:")
        for each in _cycle(cycle):
            match each:
                case VehicleDuration():
                    lines.append(f"    {_taken(each)}")
                case Demand(span=Span() as span):
                    lines.append(f"    {each.token}" if each.token else "    the script")
                    lines += excerpt_lines(place_of(span, excerpts.root), excerpts, indent="      ")
                case Demand():
                    lines.append(f"    {_unwritten(each)}")
    return lines


def _taken(each: VehicleDuration) -> str:
    taken = f"{each.lower} to {each.upper}" if each.lower < each.upper else f"{each.lower}"
    return f"{each.token} ends {taken} after the end of {each.after}" if each.after else f"{each.token} takes {taken}"


def _shown(each: VehicleDuration) -> str:
    """How long it took in flights, where the lines tell more."""
    lower, upper = each.shown
    return "" if (lower, upper) == (each.lower, each.upper) else f" ({lower} to {upper} in flights)"


def _cycle(cycle: tuple[object, ...]) -> list[object]:
    """The reasons of a cycle, each line and each duration once."""
    found: dict[object, object] = {}
    for each in cycle:
        key = (each.token, each.span) if isinstance(each, Demand) and each.span is not None else each
        found.setdefault(key, each)
    return list(found.values())


def _unwritten(demand: Demand) -> str:
    if demand.token:
        return f"{demand.token} lasts at least 1, and is over when the mission ends"
    return "the order of tokens on a timeline, or what the mission file asks for"


def _static(is_strong: bool, is_weak: bool | None) -> str:
    if is_strong:
        return "strongly: yes, one schedule does for all durations"
    known = {True: "weakly: yes", False: "weakly: no", None: "weakly: not known"}[is_weak]
    return f"strongly: no, {known}"


def _known(holds: bool | None, plan: PlanNetwork) -> bool | None:
    """An answer that may not hold if requests are missing in the network."""
    return None if plan.endless and holds else holds


def control_data(plan: PlanNetwork, answer: Answer, excerpts: Excerpts) -> dict[str, Any]:
    """The same as data."""
    spans = [each.span for each in _cycle(answer.cycle or ()) if isinstance(each, Demand) and each.span is not None]
    return {
        "reactor": plan.reactor,
        "dynamic": None if answer.is_reckoned else _known(answer.cycle is None, plan),
        "strong": None if answer.is_reckoned else _known(answer.is_strong, plan),
        "weak": None if answer.is_reckoned else _known(answer.is_weak, plan),
        "durations": [
            {
                "token": each.token,
                "between": [each.lower, each.upper],
                "after": each.after,
                "in_flights": list(each.shown),
            }
            for each in plan.durations
        ],
        "not_known": list(plan.endless),
        "left_out": plan.left_out,
        "cycle": [place_data(place_of(span, excerpts.root), excerpts) for span in spans],
    }
