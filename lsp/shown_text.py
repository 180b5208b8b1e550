"""What is wrong with one text in, what the editor shows of it out; over an edit, what the edit leaves where it is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from lsprotocol.types import Diagnostic as Shown

from lsp.diagnostics import Conversion
from nddl_lang.syntax.incremental import common_ends
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source

_Place = tuple[int, int]


@dataclass(frozen=True, eq=False, slots=True)
class ShownText:
    """A text as it was shown: the diagnostics in it, where each stood, and what the editor showed of each.

    `fuller` is an earlier one that showed more: an error takes the findings back for a moment.
    """

    text: str
    found: Sequence[Diagnostic]
    places: tuple[_Place, ...]
    uri: str
    shown: tuple[Shown, ...]
    fuller: "ShownText | None"


def show(source: Source, found: Sequence[Diagnostic], conversion: Conversion, before: ShownText | None) -> ShownText:
    """What the editor shows of a text, after it showed what stood there `before`."""
    is_same = before is not None and before.text == source.text and before.found == found
    if before is not None and is_same and not any(map(_leads_elsewhere, found)):
        return before
    earlier = [] if before is None else [before] if before.fuller is None else [before.fuller, before]
    kept: dict[_Place, list[tuple[Diagnostic, Shown]]] = {}
    for each in earlier:
        _keep_unmoved(each, source.text, kept)
    places = tuple((each.span.begin, each.span.finish) for each in found)
    shown = tuple(
        next((old for known, old in kept.get(place, ()) if known == each), None) or conversion.shown(each)
        for each, place in zip(found, places, strict=True)
    )
    fuller = next((each for each in earlier if len(each.found) > len(found)), None)
    return ShownText(
        source.text, found, places, conversion.place(source)[0], shown, replace(fuller, fuller=None) if fuller else None
    )


def _keep_unmoved(before: ShownText, text: str, kept: dict[_Place, list[tuple[Diagnostic, Shown]]]) -> None:
    """Put into `kept`, by its place, what stands in the same lines and columns of `text`, if no note leads away."""
    if "\r" in text or "\r" in before.text:
        return  # an edit may part a CR from its LF
    prefix, suffix = common_ends(before.text, text)
    shift = len(text) - len(before.text)
    lines = before.text.count("\n", prefix, len(before.text) - suffix)
    below = text.find("\n", len(text) - suffix) + 1  # the first line that is as before, to its left end
    if not below or lines != text.count("\n", prefix, len(text) - suffix):
        below = len(text) + 1
    for each, (begin, finish), shown in zip(before.found, before.places, before.shown, strict=True):
        here = each.span.begin, each.span.finish
        is_above = finish <= prefix and here == (begin, finish)
        if (is_above or (here[0] >= below and here == (begin + shift, finish + shift))) and not _leads_away(each):
            kept.setdefault(here, []).append((each, shown))


def _leads_away(each: Diagnostic) -> bool:
    """Whether a note has a place of its own, which may have moved."""
    return any(note.span is not None for note in each.notes)


def _leads_elsewhere(each: Diagnostic) -> bool:
    """Whether a note stands in another text, which may have changed."""
    return any(note.span is not None and note.span.source is not each.span.source for note in each.notes)
