"""Words and data for a condition: `A > 0.7 and B < 0.2`, and how well it holds on fresh missions."""

from typing import Any

from checker.conditions.condition import Condition, Conjunction, Extreme, Feature, Literal, Share, Unseen
from nddl_lang.text.printable import counted


def condition_text(condition: Condition) -> str:
    """The condition, such as `A > 0.7 and B < 0.2, or C <= 3`."""
    return ", or ".join(_conjunction_text(one) for one in condition.conjunctions)


def condition_claim(condition: Condition) -> str:
    """A condition with its measured quality, as the end of a sentence that begins with `fails`."""
    return f"{when_text(condition)} {condition_text(condition)} ({condition_evidence(condition)})"


def when_text(condition: Condition) -> str:
    """The word before a condition: whether it is the whole of it, and whether that is known."""
    if condition.is_partial:
        return "in part when"
    return f"as far as {counted(condition.fresh, 'mission')} tell when" if condition.is_thin else "when"


def condition_lines(condition: Condition, indent: str = "") -> list[str]:
    """A condition for people: the claim, and below it how well it holds and how it was found."""
    return [
        f"{indent}fails {when_text(condition)} {condition_text(condition)}",
        f"{indent}  {condition_evidence(condition)}",
    ]


def condition_evidence(condition: Condition) -> str:
    """How good it is, on which missions, and how it was found."""
    if condition.near is None:
        sample = f"{condition.fresh} missions of the run that were held back; none was flown for it"
    else:
        near = f", {condition.near} of them near an edge" if condition.near else ""
        sample = f"{condition.fresh} fresh missions{near}"
    quality = f"precision {_share(condition.precision)}, recall {_share(condition.recall)} on {sample}"
    found = f"; edges found by {condition.flights} flights of the example" if condition.flights else ""
    unseen = "".join(f"; {_unseen_text(one)}" for one in condition.unseen)
    return f"{'partial: ' if condition.is_partial else ''}{quality}{found}{unseen}"


def _unseen_text(unseen: Unseen) -> str:
    """Where an edge may lie, as nothing is known between two values."""
    ends = f"{_plain(unseen.below)} and {_plain(unseen.above)}"
    return f"of {_feature_text(unseen.feature)} nothing between {ends} was seen"


def _conjunction_text(conjunction: Conjunction) -> str:
    """Literals joined by `and`; two limits of one term become a band, or the one value between them."""
    parts: list[str] = []
    told: set[Feature] = set()
    for literal in conjunction:
        feature = literal.feature
        if feature in told:
            continue
        told.add(feature)
        own = [one for one in conjunction if one.feature == feature]
        below = [one for one in own if not one.is_above]
        above = [one for one in own if one.is_above]
        if len(below) == len(above) == 1 and feature.extreme is Extreme.ONLY:
            low, high = above[0], below[0]
            if low.edge == high.edge:
                parts.append(f"{_feature_text(feature)} = {_plain(low.edge)}")
                continue
            left, right = "<=" if low.holds_at_edge else "<", "<=" if high.holds_at_edge else "<"
            parts.append(f"{_plain(low.edge)} {left} {_feature_text(feature)} {right} {_plain(high.edge)}")
        else:
            parts += [literal_text(one) for one in own]
    return " and ".join(parts)


def literal_text(literal: Literal) -> str:
    """One limit, such as `A * B > 0.6`; of redrawn parameters `a draw of P > 3.8`, `P + Q > 3.8 at some draw`."""
    sign = (">" if literal.is_above else "<") + ("=" if literal.holds_at_edge else "")
    limit = f"{_feature_text(literal.feature)} {sign} {_plain(literal.edge)}"
    extreme = literal.feature.extreme
    if extreme is Extreme.ONLY:
        return limit
    is_any = literal.is_above is (extreme is Extreme.GREATEST)
    if len(literal.feature.parameters) == 1:
        return f"{'a' if is_any else 'every'} draw of {limit}"
    return f"{limit} at {'some draw' if is_any else 'every draw'}"


def _feature_text(feature: Feature) -> str:
    """A polynomial as a model would write it."""
    text = ""
    for index, (coefficient, powers) in enumerate(feature.monomials):
        above = [name for name, power in powers for _ in range(power)]
        below = [name for name, power in powers for _ in range(-power)]
        size = abs(coefficient)
        factors = [*([_plain(size)] if size != 1.0 or not above else []), *above]
        sign = ("-" if coefficient < 0 else "") if index == 0 else (" - " if coefficient < 0 else " + ")
        text += sign + " / ".join([" * ".join(factors), *below])
    return text


def condition_data(condition: Condition | None) -> dict[str, Any] | None:
    """A condition as reports in JSON have it."""
    if condition is None:
        return None
    return {
        "text": condition_text(condition),
        "partial": condition.is_partial,
        "any_of": [[_literal_data(literal) for literal in one] for one in condition.conjunctions],
        "precision": _share_data(condition.precision),
        "recall": _share_data(condition.recall),
        "measured_on": {"missions": condition.fresh, "near": condition.near, "fresh": condition.near is not None},
        "flights": condition.flights,
        "unseen": [_unseen_data(one) for one in condition.unseen],
        "in_terms": [literal_text(literal) for literal in condition.in_terms],
    }


def _unseen_data(unseen: Unseen) -> dict[str, Any]:
    return {
        "term": _feature_text(unseen.feature),
        "draw": unseen.feature.extreme.value,
        "below": unseen.below,
        "above": unseen.above,
    }


def _literal_data(literal: Literal) -> dict[str, Any]:
    feature = literal.feature
    return {
        "text": literal_text(literal),
        "term": _feature_text(feature),
        "parameters": list(feature.parameters),
        "draw": feature.extreme.value,
        "fails_above": literal.is_above,
        "edge": literal.edge,
        "fails_at_edge": literal.holds_at_edge,
    }


def _share_data(share: Share) -> dict[str, Any]:
    return {"value": round(share.value, 9), "interval": [round(end, 9) for end in share.interval]}


def _share(share: Share) -> str:
    low, high = share.interval
    return f"{_percent(share.value)} ({_percent(low)} to {_percent(high)})"


def _percent(share: float) -> str:
    return f"{100.0 * share:.3g} %"


def _plain(value: float) -> str:
    """A number as people write it: up to nine significant digits."""
    return f"{value:.9g}"
