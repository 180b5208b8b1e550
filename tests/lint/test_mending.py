"""Fixes are carried out until none is left, however many were refused on the way."""

from nddl_lang.lint.mending import mend
from nddl_lang.syntax.codes import INTEGER_RANGE
from nddl_lang.text.diagnostic import Code, Diagnostic, Edit, Fix, Severity
from nddl_lang.text.source import Anchor, Source, Span

_BAD = Code("NDDL901", Severity.WARNING, "lint", "line {n} is bad")


def _check(text: str) -> tuple[Diagnostic, ...]:
    """Each `x` is bad; mending one becomes an error, but for the last `x` of the text; `!` is that error."""
    anchor = Anchor(Source("text", text))
    found: list[Diagnostic] = [
        INTEGER_RANGE.at(Span(anchor, at, at + 1), text="!", bits=52) for at, sign in enumerate(text) if sign == "!"
    ]
    for at, sign in enumerate(text):
        if sign == "x":
            becomes = "." if "x" not in text[at + 1 :] else "!"
            fix = Fix(f"mend {at}", (Edit(Span(anchor, at, at + 1), becomes),))
            found.append(_BAD.at(Span(anchor, at, at + 1), n=at, fixes=(fix,)))
    return tuple(found)


def test_what_is_refused_does_not_use_up_the_rounds() -> None:
    mended = mend("x" * 300, _check)
    assert mended.text == "x" * 299 + "."
    assert mended.count == 1
