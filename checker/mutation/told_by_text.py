"""Sites in, the same out with edits that the text itself asks for, whatever a mission did.

Objects of a class that are counted have a number each; what is drawn is compared with numbers that it may be above and
below; the wait of a token that another one comes before counts from the end of that one; and of a share that one line
of a rule takes away another one hardly takes the part itself.
"""

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace

from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import NUMERIC, EditKind

_MADE = re.compile(r"(\w+)\s+\w+\s*=\s*new\s+\1\s*\(\s*(\w+)[^()]*\)\s*;")
_WHOLE, _NUMBER = re.compile(r"\d+"), re.compile(r"-?\d+(?:\.\d+)?")
_FEWEST = 3  # objects that say how they are counted
_RANGE = re.compile(r"(?:int|float)\s+\w+\s*=\s*\[\s*(-?[\d.]+)[\s,]+(-?[\d.]+)\s*\]\s*;")
_VALUE = re.compile(r"(?:int|float)\s+\w+\s*=\s*(-?\d+(?:\.\d+)?)\s*;")
_DRAWN = re.compile(r"\s*(\w+)\s*==\s*sampledParameter\s*\(\s*(\w+)\s*\)\s*;")
_ORDERED = re.compile(r"([A-Za-z_]\w*)\s*[<>]=?\s*([\w.]+)")
_BEFORE = re.compile(r"\s*(\w+)\s+(before|meets|after|met_by)\s+(\w+)\s*;")
_SINCE_OWN = re.compile(r"\s*(\w+)\.start\s*<=?\s*(start)\b[^;]*;")

_REST = re.compile(r"\(\s*1(?:\.0*)?\s*-\s*([A-Za-z_]\w*)\s*\)")

_Scope = tuple[str, tuple[int, int]]


def with_told(sites: Sequence[EditSite]) -> list[EditSite]:
    """All sites; those that something in the text speaks against have the edits that it asks for."""
    more: dict[EditSite, list[SmallEdit]] = defaultdict(list)
    for site, edit in (*_counted(sites), *_decided(sites), *_waiting(sites), *_left(sites)):
        more[site].append(edit)
    return [_with(site, more[site]) if site in more else site for site in sites]


def _with(site: EditSite, edits: Sequence[SmallEdit]) -> EditSite:
    known = {(edit.begin, edit.end, edit.new) for edit in site.edits}
    fresh = [edit for edit in edits if (edit.begin, edit.end, edit.new) not in known]
    wanted = site.wanted | {(edit.begin, edit.new) for edit in edits}
    return replace(site, edits=(*fresh, *site.edits), wanted=wanted)


def _counted(sites: Sequence[EditSite]) -> Iterator[tuple[EditSite, SmallEdit]]:
    """Of objects whose first numbers count them, where two have one number, the number that none has."""
    rows: dict[tuple[str, str], list[tuple[EditSite, int, str]]] = defaultdict(list)
    for site in sites:
        if not site.rule and (made := _MADE.fullmatch(site.text)) is not None:
            rows[site.file, made.group(1)].append((site, made.start(2), made.group(2)))
    for group in rows.values():
        if len(group) >= _FEWEST and all(_WHOLE.fullmatch(said) for *_, said in group):
            for row, missed in _renumbered([int(said) for *_, said in group]):
                site, at, old = group[row]
                yield site, site.edit(EditKind.CONSTANT, at, at + len(old), str(missed))


def _renumbered(numbers: list[int]) -> list[tuple[int, int]]:
    """Which of some numbers would be which other one, if they were counted then without a gap or a repetition.

    One of the two that are the same; where the numbers grow from one to the next, only the one that breaks that.
    """
    found = []
    for row in range(len(numbers)):
        others = numbers[:row] + numbers[row + 1 :]
        missed = set(range(min(others), max(others) + 2)) - set(others)
        for new in sorted(missed) if len(set(others)) == len(others) and numbers[row] in others else ():
            changed = [*numbers[:row], new, *numbers[row + 1 :]]
            if max(changed) - min(changed) == len(changed) - 1:
                found.append((row, new, changed == sorted(changed)))
    told = [one for one in found if one[2]] or found
    return [(row, new) for row, new, _ in told]


def _decided(sites: Sequence[EditSite]) -> Iterator[tuple[EditSite, SmallEdit]]:
    """The numbers with which a comparison of what is drawn is not decided before: `day > 4.0` of a day up to 1.0."""
    ranges, values, declared = {}, {}, {}
    for site in sites:
        if (found := _RANGE.fullmatch(site.text)) is not None:
            ranges[site.named] = (float(found.group(1)), float(found.group(2)))
        elif (value := _VALUE.fullmatch(site.text)) is not None:
            values[site.named], declared[site.named] = value, site
    drawn: dict[_Scope, dict[str, str]] = defaultdict(dict)
    for site in sites:
        if (found := _DRAWN.fullmatch(site.text)) is not None and found.group(2) in ranges:
            drawn[site.file, site.scope][found.group(1)] = found.group(2)
    for site in sites:
        known = drawn.get((site.file, site.scope), {})
        for found in _ORDERED.finditer(site.text) if known else ():
            name, said = found.groups()
            if name not in known:
                continue
            low, high = ranges[known[name]]
            if _NUMBER.fullmatch(said):
                yield from _within(site, found.start(2), said, low, high)
            elif said in values and _uses(sites, said) == 1:
                value = values[said]
                yield from _within(declared[said], value.start(1), value.group(1), low, high)


def _within(site: EditSite, at: int, old: str, low: float, high: float) -> Iterator[tuple[EditSite, SmallEdit]]:
    """The edits that write a number between two, where it is not there."""
    if not low <= float(old) <= high:
        at += site.begin
        for edit in site.edits:
            if edit.kind in NUMERIC and edit.begin == at and low < float(edit.new) < high:
                yield site, edit


def _uses(sites: Sequence[EditSite], name: str) -> int:
    return sum(len(re.findall(rf"\b{name}\b", site.text)) for site in sites if site.named != name)


def _waiting(sites: Sequence[EditSite]) -> Iterator[tuple[EditSite, SmallEdit]]:
    """A wait that counts from the own start (`press.start <= start + WAIT`) of a token that another one is before.

    Of 31 such waits in right models two are of a token that comes behind another one, which may be left out.
    """
    before: dict[_Scope, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
    branched: dict[_Scope, int] = {}  # where the first condition of a rule stands: what holds in one branch may not
    for site in sites:
        if site.rule and not site.is_rule and not site.text.rstrip().endswith(";"):
            branched[site.file, site.scope] = min(site.begin, branched.get((site.file, site.scope), site.begin))
    always = [site for site in sites if site.begin < branched.get((site.file, site.scope), site.begin + 1)]
    for site in always:
        if (found := _BEFORE.fullmatch(site.text)) is not None:
            one, relation, other = found.groups()
            first, second = (one, other) if relation in ("before", "meets") else (other, one)
            before[site.file, site.scope][second].add(first)
    for site in always:
        if (found := _SINCE_OWN.fullmatch(site.text)) is None:
            continue
        firsts = before.get((site.file, site.scope), {}).get(found.group(1), set())
        for first in sorted(firsts) if len(firsts) == 1 else ():
            yield site, site.edit(EditKind.TOKEN, *found.span(2), f"{first}.end")


def _left(sites: Sequence[EditSite]) -> Iterator[tuple[EditSite, SmallEdit]]:
    """What a share leaves, where a line multiplies with the share itself: `pace * traffic` beside `(1.0 - traffic)`."""
    taken: dict[_Scope, set[str]] = defaultdict(set)
    for site in sites:
        taken[site.file, site.scope] |= set(_REST.findall(site.text)) if site.rule else set()
    for site in sites:
        for name in sorted(taken.get((site.file, site.scope), set()) - set(_REST.findall(site.text))):
            for found in re.finditer(rf"(?<=[*/])\s*\b({name})\b(?!\s*[*/.(])|\b({name})\b(?=\s*\*)", site.text):
                yield site, site.edit(EditKind.FORMULA, *found.span(1 if found.group(1) else 2), f"(1.0 - {name})")
