"""A `close()` that stands above objects: one message there, in place of one at each object behind it."""

from collections.abc import Sequence

from nddl_lang.semantics.codes import CLASS_IS_CLOSED, CLOSED_TWICE, EARLY_CLOSE
from nddl_lang.syntax.removal import removal
from nddl_lang.text.diagnostic import Diagnostic, Fix, Note
from nddl_lang.text.source import Span

_MOST_NOTES = 3


def tell_early_close(found: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """`found`, where several complaints of one early `close()` are one: it is to be removed, or to be moved."""
    late: dict[Span, list[Diagnostic]] = {}
    for each in found:
        if each.code is CLASS_IS_CLOSED:
            late.setdefault(each.notes[0].span or each.span, []).append(each)
    told: dict[Diagnostic, Diagnostic | None] = {}
    for closed, objects in late.items():
        last = objects[-1]
        behind = found[found.index(last) + 1 :]
        again = [each for each in behind if each.code is CLOSED_TWICE and each.notes[0].span == closed]
        joined = [*objects, *again]
        if len(joined) > 1 and (again or last.fixes):
            told |= dict.fromkeys(joined)
            told[joined[0]] = _told_there(closed, objects, again)
    return tuple(kept for each in found if (kept := told.get(each, each)) is not None)


def _told_there(closed: Span, objects: Sequence[Diagnostic], again: Sequence[Diagnostic]) -> Diagnostic:
    text, last = closed.text, objects[-1]
    notes = [Note("made behind it", each.span) for each in objects[:_MOST_NOTES]]
    help_ = f"`{text}` stands behind the last object that is made"
    fixes = tuple(Fix(f"write `{text}` behind the last of them", each.edits, each.safe) for each in last.fixes)
    if again:
        notes.append(Note("closed here, too", again[0].span))
        help_ = f"{help_}: one stands there, remove this one"
        fixes = (Fix(f"remove this `{text}`", (removal(closed),), safe=False),)
    return EARLY_CLOSE.at(closed, notes=tuple(notes), help=help_, fixes=fixes, text=text)
