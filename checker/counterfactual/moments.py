"""Sites in, out with edits that write a duration for a start or end; and whether times of one kind are compared.

`probe.start >= open.duration + SOAK_MIN;` holds a moment to a span: `open.end` is meant. Two moments are never added,
and none is multiplied; none is a product or a bare number. By `end == until` one may be said, or a span.
"""

import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from checker.counterfactual.word_odds import compared
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind

_SIDES = re.compile(r"([^<>=!&|?]+)(?:==|<=|>=|<|>)([^<>=!&|?]+);", re.DOTALL)
_TIME = re.compile(r"([-+]?)\s*(?<![\w.])(?:\w+\.)?(start|end|duration)\b")
_SCALED = re.compile(r"\b(?:start|end)\b\s*[*/]|[*/]\s*(?:\w+\.)?(?:start|end)\b")
_ROUNDED = re.compile(r"\b(?:ceil|floor|round)\s*\(")
_MOMENT, _END = re.compile(r"(?:\w+\.)?(?:start|end)"), re.compile(r"\b(?:start|end)\b")
_LIMITED = re.compile(r"\s*(?:\w+\.)?(start|end|duration)\s*(?:<=|>=|<|>)\s*(?:\d+|[A-Z][A-Z0-9_]*)\s*;")
# How often a time is held to a bare constant, before any line of the model is read: few know when anything comes.
_USUAL = {"duration": 4.0, "end": 1.5, "start": 1.0}
_WORD, _NUMBER = re.compile(r"[A-Za-z_]\w*"), re.compile(r"\s*\d[\d.]*\s*")
_POINT = re.compile(r"(?<![\w.])((?:\w+\.)?)(start|end|duration)\b")
_SPAN, _EVENT_TIME = "duration", "time"
_OTHERS = {"start": (_SPAN,), "end": (_SPAN,), _SPAN: ("end", "start")}


def with_durations(sites: Sequence[EditSite]) -> list[EditSite]:
    """All sites, with edits that write a duration for a moment: of limits, and where `==` sets a moment from no time.

    A mixed line has them also the other way round.
    """
    return [replace(site, edits=(*site.edits, *_exchanged(site))) if site.rule else site for site in sites]


def _exchanged(site: EditSite) -> Iterator[SmallEdit]:
    text = compared(site.text)
    is_limit, is_mixed = _SIDES.fullmatch(text) is not None and "==" not in text, _is_mixed(site.text)
    is_set = _set_from(text) is not None
    for found in _POINT.finditer(site.text) if is_limit or is_mixed or is_set else ():
        if found.group(2) == _SPAN and not is_mixed:
            continue  # what a duration is held to is hardly a moment
        for other in _OTHERS[found.group(2)]:
            edit = site.edit(EditKind.POINT, *found.span(), found.group(1) + other)
            if not _is_mixed(site.after(edit)):
                yield edit


class TimeLimits:
    """Which times of tokens the lines of models hold to a bare constant."""

    def __init__(self, sites: Sequence[EditSite]) -> None:
        self._counts = Counter(found.group(1) for site in sites if (found := _limited(site.text)) is not None)

    def odds(self, edit: SmallEdit, site: EditSite) -> float:
        """Logarithm of how much likelier the new time of a limit is meant than the old one; 0 in other lines."""
        before, after = _limited(site.text), _limited(site.after(edit))
        if before is None or after is None:
            return 0.0
        old, new = before.group(1), after.group(1)
        return math.log((_USUAL[new] + self._counts[new]) / (_USUAL[old] + self._counts[old] - 1))


def _limited(text: str) -> re.Match[str] | None:
    return _LIMITED.fullmatch(compared(text))


def puts_times_right(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a line compares times of one kind after an edit, and does not before."""
    return _is_mixed(site.text) and not _is_mixed(site.after(edit))


def mixes_times(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a line holds a moment to a span of time after an edit, and does not before."""
    return _is_mixed(site.after(edit)) and not _is_mixed(site.text)


def _set_from(text: str) -> str | None:
    """What a line says by `==` that a single moment is, where that has no time of a token; None in other lines."""
    sides = _SIDES.fullmatch(text) if "==" in text else None
    for one, other in (sides.groups(), sides.groups()[::-1]) if sides is not None else ():
        if _MOMENT.fullmatch(one.strip()) and not {*_OTHERS, _EVENT_TIME} & set(_WORD.findall(other)):
            return other
    return None


def _is_mixed(text: str) -> bool:
    sides = _SIDES.fullmatch(compared(text))
    if sides is None:
        return False
    said = _set_from(compared(text))
    if said is not None and (_NUMBER.fullmatch(said) or any(mark in said for mark in "*/")):
        return True
    if any(_SCALED.search(side) for side in sides.groups()):
        return True
    if "==" in text and _ROUNDED.search(text) and any(_MOMENT.fullmatch(side.strip()) for side in sides.groups()):
        return len(_END.findall(text)) == 1  # what is rounded is a span
    if any(mark in side for side in sides.groups() for mark in "(*/"):
        return False  # what comes of a product or call may be either
    moments = [_moments(side) for side in sides.groups()]
    return any(each not in (None, 0, 1) for each in moments) or set(moments) == {0, 1}


def _moments(side: str) -> int | None:
    """How many moments are left of a sum: 1 is a moment, 0 a span; None where it has no time of a token."""
    times = _TIME.findall(side)
    return sum(-1 if sign == "-" else 1 for sign, word in times if word != _SPAN) if times else None
