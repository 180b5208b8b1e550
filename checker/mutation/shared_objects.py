"""Sites in, the same out with one more edit for each number that another model gives an object of the same name.

Two models of a mission that make one timeline mean one length: where they differ, one of both is mistaken.
"""

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace

from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind

_MADE = re.compile(r"(\w+)\s+(\w+)\s*=\s*new\s+\1\s*\((.*)\)\s*;", re.DOTALL)
_NUMBER = re.compile(r"-?\d[\w.]*")


def with_shared(sites: Sequence[EditSite]) -> list[EditSite]:
    """All sites; those that make an object have the numbers of those that make one of its name in another file."""
    made: dict[tuple[str, str], list[EditSite]] = defaultdict(list)
    for site in sites:
        if (found := _MADE.fullmatch(site.text)) is not None:
            made[found.group(1), found.group(2)].append(site)
    more = {site: _of_others(site, group) for group in made.values() for site in group if len(group) > 1}
    return [_with(site, more[site]) if more.get(site) else site for site in sites]


def _with(site: EditSite, edits: list[SmallEdit]) -> EditSite:
    fresh = {(edit.begin, edit.new): edit for edit in edits}
    kept = [edit for edit in site.edits if (edit.begin, edit.new) not in fresh]
    return replace(site, edits=(*fresh.values(), *kept), wanted=site.wanted | fresh.keys())


def _of_others(site: EditSite, group: Sequence[EditSite]) -> list[SmallEdit]:
    own = list(_arguments(site.text))
    return [
        SmallEdit(EditKind.CONSTANT, site.file, site.begin + at, site.begin + at + len(old), old, new, site.first)
        for other in group
        if other.file != site.file
        for (at, old), (_, new) in zip(own, _arguments(other.text), strict=False)
        if _NUMBER.fullmatch(old) and _NUMBER.fullmatch(new) and float(old) != float(new)
    ]


def _arguments(text: str) -> Iterator[tuple[int, str]]:
    """What an object is made of, each with where it stands in a line."""
    found = _MADE.fullmatch(text)
    assert found is not None
    at = found.start(3)
    for part in found.group(3).split(","):
        yield at + len(part) - len(part.lstrip()), part.strip()
        at += len(part) + 1
