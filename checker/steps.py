"""The steps of a story: what each tells, and which of them say what was told already."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum

from checker.counterfactual.time_spent import LongPart
from checker.influence import InfluenceLine
from checker.requested import PlannerChoice
from checker.standing import Standing
from checker.waiting import Waiting
from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.outcome import Abort, ConflictElement, Deadlock, Draw, Event, LevelChange, SourcePlace
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.open_levels import LevelUser
from runtime.plan.readout.statements import Term


class StepKind(StrEnum):
    """What a step of a story tells."""

    DRAW = "draw"
    LINE = "line"  # of the model, on the way of the draw
    EVENT = "event"
    ASKED = "asked"  # a line of the model, by which an argument came to be asked for
    CHOSEN = "chosen"  # by a planner, as no line of the model says what an argument is
    CAUSE = "cause"  # an element of the conflict
    FAULT = "fault"  # the culprit
    BROKEN = "broken"  # the culprit of what broke a plan that was repaired
    TRIED = "tried"  # what the search tried in vain
    LEVEL = "level"  # a change of the level of a resource, or what may change it
    WAITING = "waiting"  # what an open goal waited for
    PART = "part"  # of a token that lasted too long
    ABORT = "abort"


@dataclass(frozen=True, slots=True)
class Step:
    """One link of the chain: when (None: always), what, and where that is written.

    `subject` is a draw with how it is drawn, the rule of a line, an event, an element of the conflict, a line that asks
    for one, what was tried or waited for, what changes a level, or the abort (None: the mission went to its end).
    `limits` are the lines that set what the faulty one compares with, or what another one reads, `under` the conditions
    under which the line of an element stands, `made` where the object is made that it speaks of. `alike` further
    elements say the same of other tokens. `is_tried`: the planner had ordered tokens so, and gave that up.
    """

    kind: StepKind
    tick: int | None
    subject: (
        tuple[Draw, ParameterConfiguration | None]
        | str
        | InfluenceLine
        | PlannerChoice
        | Event
        | ConflictElement
        | Deadlock
        | Waiting
        | LevelChange
        | LevelUser
        | LongPart
        | Abort
        | None
    )
    place: SourcePlace | None = None
    limits: tuple[SourcePlace, ...] = ()
    under: tuple[Standing, ...] = ()
    made: SourcePlace | None = None
    alike: int = 0
    is_tried: bool = False


def without_repeats(steps: Iterable[Step]) -> list[Step]:
    """The steps with those left out whose line the story has told already, the fault and other draws excepted.

    Of the elements of one line that is told which speaks of the most of it. What no line says of many tokens of one
    predicate, such as that each lasts a tick at least, is told of the first.
    """
    steps = list(steps)
    kept: list[Step] = []
    told: dict[object, int] = {}
    guilty = next((_line(step) for step in steps if step.kind is StepKind.FAULT), None)
    for step in steps:
        key = _line(step) if step.place is not None else _said_of_any(step)
        if step.kind is StepKind.FAULT or key is None:
            kept.append(step)
        elif key == guilty:
            continue
        elif key not in told or step.kind in (StepKind.DRAW, StepKind.LEVEL):
            told.setdefault(key, len(kept))
            kept.append(step)
        elif step.place is None:
            kept[told[key]] = replace(kept[told[key]], alike=kept[told[key]].alike + 1)
        elif _is_wider(step, kept[told[key]]):
            kept[told[key]] = step
    return kept


def _line(step: Step) -> tuple[str, int] | None:
    return None if step.place is None else (step.place.file, step.place.line)


def _is_wider(step: Step, told: Step) -> bool:
    """Whether an element speaks of more of the line than the one that was told."""
    if step.place is None or told.place is None or not told.kind is step.kind is StepKind.CAUSE:
        return False
    return len(told.place.text) < len(step.place.text)


def _said_of_any(step: Step) -> tuple[object, ...] | None:
    """What an element without a line says of one variable of a token, whichever token of its predicate that is."""
    element = step.subject
    if not isinstance(element, ConflictElement) or not isinstance(element.says, Term) or element.says.name != "bounds":
        return None
    about, *bounds = element.says.arguments
    if not isinstance(about, VariableName) or about.token is None:
        return None
    return element.kind, about.token.predicate, about.name, *bounds, element.says.values
