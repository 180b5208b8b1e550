"""Causes in, words out: one line for each cause, and plain data for programs."""

from collections.abc import Sequence
from typing import Any, assert_never

from checker.counterfactual.ranking import Causes, Claim, RankedLine
from checker.counterfactual.remarks import Remark
from checker.counterfactual.tried import TrialsEnd
from checker.mutation.edits import SmallEdit
from checker.mutation.kinds import EditKind
from checker.mutation.swaps import swapped_parts

_MOST_TEXT = 60
# What no flight speaks for.
_UNFLOWN = (Claim.LOOSE_END, Claim.UNEVEN, Claim.UNREAD, Claim.UNSET, Claim.RAISED, Claim.ASLEEP)


def claim_text(cause: RankedLine, remarks: Sequence[Remark] = ()) -> str:
    """What was found out about a line, and what lint says of it."""
    return "; ".join([_claimed(cause), *_remarked(cause, remarks)])


def _remarked(cause: RankedLine, remarks: Sequence[Remark]) -> list[str]:
    """What lint says of the line, or of a name that the change brings in."""
    said = dict.fromkeys(f"lint says of this line: {one.text}" for one in remarks if one.is_about(cause.place))
    brought = cause.change.new if cause.change is not None else ""
    return [*said, *dict.fromkeys(f"lint says: {one.text}" for one in remarks if one.names_one_of(brought))]


def _claimed(cause: RankedLine) -> str:
    change = _change_text(cause.change) if cause.change is not None else ""
    tried = f"{cause.helped} of {cause.missions} failed missions tried{_of_all(cause)}"
    match cause.claim:
        case Claim.MENDS:
            return f"{change}: {_passes(cause)}"
        case Claim.LOOSENS:
            return f"{change}, which takes a demand away: {_passes(cause)}"
        case Claim.CODED:
            return f"{change}: {_passes(cause)}, so what the Python of `{cause.variable}` says may be mistaken"
        case Claim.PARTLY:
            if cause.spoilt:
                return f"{change}: {_passes(cause)}, but missions that passed fail"
            return f"{change}: {tried} pass then, the others do not"
        case Claim.EVADES:
            less = "but it does less" if cause.missions == 1 else "but they do less"
            return f"{change}: {_passes(cause)}, {less}"
        case Claim.ASLEEP:
            return f"nothing calls `{cause.variable}` any more to end what it publishes here (no `now.wake` is left)"
        case Claim.RAISED:
            return f"`{cause.variable}` failed here; its Python was not changed"
        case Claim.LOOSE_END:
            return _missing(f"hardly one of this rule speaks of `{cause.variable}`")
        case Claim.UNEVEN:
            return _missing(f"one branch sets `{cause.variable}`, the other does not")
        case Claim.UNREAD:
            return _missing(f"nothing reads `{cause.variable}`")
        case Claim.UNSET:
            return _missing(f"nothing says what `{cause.variable}` is")
        case _:
            assert_never(cause.claim)


def _missing(sign: str) -> str:
    """What was not flown is told as a guess from its first word on."""
    return f"perhaps a line is missing: {sign} (no flight can tell)"


def cause_text(causes: Causes) -> str:
    """The likeliest cause in one line, with what was tried for it."""
    if causes.first is None and causes.ended is TrialsEnd.CANCELLED:
        return f"not known ({effort_text(causes)})"
    if causes.first is None:
        return nothing_text(effort_text(causes))
    if has_no_flown(causes):
        return f"{nothing_text(effort_text(causes))}; {claim_text(causes.first, causes.remarks)}"
    return f"{claim_text(causes.first, causes.remarks)} ({effort_text(causes)})"


def has_no_flown(causes: Causes) -> bool:
    """Whether no flight speaks for any of the causes."""
    return all(one.claim in _UNFLOWN for one in causes.ranked)


def nothing_text(effort: str) -> str:
    """That no flight has shown a cause, and how much was tried."""
    return f"none of the changes tried makes it pass ({effort})"


def _change_text(change: SmallEdit) -> str:
    """A change as what to do."""
    if not change.new.strip():
        return "leave it out"
    if change.kind is EditKind.LINE:
        return f"add `{change.new.strip()}` behind it"
    if change.kind is EditKind.SWAP:
        one, other = swapped_parts(change.old, change.new)
        return f"exchange `{_short(one)}` here and `{_short(other)}` in line {change.line + change.old.count(chr(10))}"
    return f"change `{_short(change.old)}` to `{_short(change.new)}`"


def effort_text(causes: Causes, mission: str = "the same mission") -> str:
    """How much was tried, and whether that is all."""
    lines = f"{causes.tried} line{'' if causes.tried == 1 else 's'}"
    text = f"{lines} tried in {causes.flights} flight{'' if causes.flights == 1 else 's'} of {mission}"
    if causes.aside:
        text += f", as to this property and not to {', '.join(f'`{name}`' for name in causes.aside)}"
    if causes.beside:
        text += f", whether {' and '.join(f'`{name}`' for name in causes.beside)} {_kept(causes.beside)} kept or not"
    match causes.ended:
        case TrialsEnd.COMPLETE:
            return text
        case TrialsEnd.FLIGHTS:
            return f"{text}, no more are made"
        case TrialsEnd.SECONDS:
            return f"{text}, then time was over"
        case TrialsEnd.CLOCK:
            return f"{text}, then the machine had no time for more"
        case TrialsEnd.CANCELLED:
            return f"{text}, then it was ended"
        case _:
            assert_never(causes.ended)


def cause_data(cause: RankedLine, remarks: Sequence[Remark]) -> dict[str, Any]:
    """A cause as JSON has it."""
    change = cause.change
    return {
        "file": cause.place.file,
        "line": cause.place.line,
        "column": cause.place.column,
        "text": cause.place.text,
        "rule": cause.rule,
        "claim": cause.claim.value,
        "change": _change_data(change),
        "variable": cause.variable,
        "helped": cause.helped,
        "missions": cause.missions,
        "failed": cause.among,
        "spoilt": cause.spoilt,
        "lint": _remarked(cause, remarks),
    }


def _change_data(change: SmallEdit | None) -> dict[str, str] | None:
    return None if change is None else {"kind": change.kind.value, "old": change.old, "new": change.new.strip()}


def causes_data(causes: Causes) -> dict[str, Any]:
    """All causes with what they cost, as JSON has them."""
    return {
        "ranked": [cause_data(cause, causes.remarks) for cause in causes.ranked],
        "tried": causes.tried,
        "flights": causes.flights,
        "ended": causes.ended.value,
    }


def _passes(cause: RankedLine) -> str:
    if cause.missions == 1:
        return f"the mission{' tried' * bool(_of_all(cause))}{_of_all(cause)} passes then"
    every = "both" if cause.missions == 2 else f"all {cause.missions}"
    return f"{every} failed missions tried{_of_all(cause)} pass then"


def _of_all(cause: RankedLine) -> str:
    """How many failed missions there are, where a change was not tried on all of them."""
    return f" (of {cause.among})" if cause.among > cause.missions else ""


def _kept(names: Sequence[str]) -> str:
    return "is" if len(names) == 1 else "are"


def _short(text: str) -> str:
    first = text.strip().partition("\n")[0]
    return first if len(first) <= _MOST_TEXT else f"{first[:_MOST_TEXT]}..."
