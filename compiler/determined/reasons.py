"""Why a reactor is not determined: the kinds of choice that are in the way, each with the line that leaves it."""

from dataclasses import dataclass
from enum import Enum

from nddl_lang.text.source import Span


class FreeChoice(Enum):
    """What a model leaves open. The text says what, `{name}` in it names the subject."""

    LOOKAHEAD = "`{name}` looks further ahead than one tick, so it plans"
    NO_TIMELINE = "`{name}` is on no timeline that the reactor owns or uses"
    SEVERAL_OBJECTS = "`{name}` may be on several timelines"
    OPEN_TIMES = "`{name}` leaves open when its token starts"
    MERGED = "`{name}` asks for what it begins with itself, and both may be one token"
    ASKED_OF_OTHERS = "`{name}` is asked of another reactor"
    RESOURCE = "`{name}` is no predicate of a timeline"
    CLOCK = "`{name}` reads the clock"
    OPEN_VALUE = "nothing says the value of `{name}`"
    UNKNOWN_VALUE = "`{name}` has no value when the mission starts"
    FUNCTION = "`{name}` has no register code"
    STATEMENT = "`{name}` is a statement without register code"
    END = "`{name}` reads an end that is not yet known"
    CYCLE = "the timelines {name} wait for each other"
    LATER_FACT = "`{name}` is given for later than the first tick"
    GOAL = "`{name}` is a goal of the model's script"
    EARLY = "what is planned on `{name}` starts as soon as it may, by the setting `early`"
    LIMITED = "the planner's steps of `{name}` are limited"


_ADVICE = {
    FreeChoice.LOOKAHEAD: "a planner looks ahead on purpose; a simulator has `lookahead = 1`",
    FreeChoice.NO_TIMELINE: "name its timeline under `internal` or `external` of the reactor",
    FreeChoice.SEVERAL_OBJECTS: "write the timeline before the predicate: `arm.Rest`; `object.Rest` for the rule's own",
    FreeChoice.OPEN_TIMES: "say when it starts: `starts`, `equals` (now), `meets` (next), `met_by` (before), or "
    "`contained_by` (what holds already)",
    FreeChoice.MERGED: "let one of the two rules ask for the other's token, and not both for each other",
    FreeChoice.ASKED_OF_OTHERS: "let a planner ask for it; a simulator may read what holds there with `contained_by`",
    FreeChoice.RESOURCE: "leave resources to the planner",
    FreeChoice.CLOCK: "read the `start` of the token: the rule runs at that tick",
    FreeChoice.OPEN_VALUE: "say what it is with `==`, from parameters, constants and draws",
    FreeChoice.UNKNOWN_VALUE: "give it a value where it is declared",
    FreeChoice.FUNCTION: "there is code for `+ - * /`, `min`, `max`, `abs`, `ceil`, `floor`, `sqrt`, and comparisons",
    FreeChoice.STATEMENT: "a rule of a simulator has relations, comparisons, draws and conditions",
    FreeChoice.END: "say how long it lasts, from what is known as it starts, and compute with that: "
    "`duration == lasting;`, `start + lasting`",
    FreeChoice.CYCLE: "let one of them read the others, and not be read by them in the same tick",
    FreeChoice.LATER_FACT: "let a rule begin it with `meets`, or ask for it in the mission file",
    FreeChoice.GOAL: "ask for it in the mission file, as `[[goal]]`",
    FreeChoice.EARLY: "leave `early` out of the settings of the reactor",
    FreeChoice.LIMITED: "leave out the limit of its steps",
}


@dataclass(frozen=True, slots=True)
class ChoiceReason:
    """One choice: its kind, the subject in the modeler's words, and where the model leaves it (None: the setting)."""

    choice: FreeChoice
    name: str
    span: Span | None

    @property
    def text(self) -> str:
        """The reason in words."""
        return self.choice.value.format(name=self.name)

    @property
    def advice(self) -> str:
        """What to write for a reactor that is to be determined."""
        return _ADVICE[self.choice]


class UndeterminedError(Exception):
    """Ends the analysis of one block; raised and caught inside the analysis only."""

    def __init__(self, choice: FreeChoice, name: str, span: Span | None) -> None:
        super().__init__(choice.name)
        self.reason = ChoiceReason(choice, name, span)
