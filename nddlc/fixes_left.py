"""Findings that are left after fixes in; lines that tell how many fixes were not carried out, and why, out."""

from collections import Counter
from collections.abc import Collection, Sequence
from pathlib import Path

from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.printable import counted


def fixes_left(found: Sequence[Diagnostic], mendable: Collection[Path], *, unsafe: bool) -> list[str]:
    """How many findings have fixes that were not carried out, and what carries them out; `mendable` are the files that
    were to be mended.
    """
    with_fixes = [each for each in found if each.fixes]
    elsewhere = Counter(each.span.source.name for each in with_fixes if Path(each.span.source.name) not in mendable)
    here = [each for each in with_fixes if Path(each.span.source.name) in mendable]
    chosen = [each for each in here if all(fix.is_choice for fix in each.fixes)]
    changing = [each for each in here if each not in chosen and not unsafe and not any(fix.safe for fix in each.fixes)]
    refused = len(here) - len(chosen) - len(changing)
    flag = "--unsafe-fixes" if unsafe else "--fix"
    lines = [
        f"{counted(number, 'fix', 'fixes')} left in `{name}`, which is not one of the files given: "
        f"`nddlc lint {flag} {name}`"
        for name, number in elsewhere.items()
    ]
    reasons = (
        (len(changing), "which may change the meaning: look at what is shown, or `--unsafe-fixes`"),
        (len(chosen), "to choose: there are several ways, or some of the text would be lost"),
        (refused, "to look at: carried out here it would lead to another error, or reach another file"),
    )
    lines += [f"{counted(number, 'fix', 'fixes')} left, {reason}" for number, reason in reasons if number]
    return lines
