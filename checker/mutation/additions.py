"""Sites in, the same out with one more kind of edit: a number that nothing reads, as a term or factor of a line.

Who declares a constant, or sets a local variable, means it to be read: where no line does, an expression may lack it.
So may a limit that holds two moments to each other without any slack, where other limits of the file have one.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Container, Iterator, Sequence
from dataclasses import replace

from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind
from checker.mutation.labels import Label
from compiler.program import TOKEN_TIMES

_WORD = re.compile(r"[A-Za-z_]\w*")
_NUMBER = re.compile(r"(int|float)\s+(\w+)\s*(?:=.*)?;", re.DOTALL)
_SET = re.compile(r"\s*(\w+)\s*==")
_COMPARED = re.compile(r"([^<>=!&|?]+?)(?:==|<=|>=|<|>)([^<>=!&|?]+);", re.DOTALL)
_ROUNDED = re.compile(r"\b(?:ceil|floor|round)\s*\(")
_BARE = re.compile(r"\s*\w+\.start\s*(?:<=|<)\s*(?:\w+\.)?(?:start|end)\s*;")
_SLACK = re.compile(r"\s*[\w.]+\s*(?:<=|<)\s*[\w.]+\s*\+\s*([A-Za-z_]\w*)\s*;")
_SAMPLING = "sampledParameter"
_LASTS = re.compile(r"\s*duration\s*==")
_POINTS = ("start", "end")
_MOST_IDLE = 4  # names that nothing reads: where there are more, that says little


def with_additions(sites: Sequence[EditSite], labels: Container[Label] = ()) -> list[EditSite]:
    """All sites; those of rules have edits that write what nothing reads into an expression, but for `labels`."""
    words = {site: [word for word in _WORD.findall(site.text) if word != site.named] for site in sites}
    used = Counter(word for found in words.values() for word in found)
    constants = [site for site in sites if site.is_number and not used[site.named]]
    scopes: dict[tuple[str, tuple[int, int]], list[EditSite]] = defaultdict(list)
    for site in sites:
        if site.rule and not site.is_rule:
            scopes[site.file, site.scope].append(site)
    heads = {(site.file, site.scope): site for site in sites if site.is_rule}
    files = {file for file, _ in scopes}
    slacks: dict[str, Counter[str]] = defaultdict(Counter)
    for site in sites:
        if (limit := _SLACK.fullmatch(site.text)) is not None:
            slacks[site.file][limit.group(1)] += 1
    found: dict[EditSite, list[SmallEdit]] = defaultdict(list)
    for (file, scope), lines in scopes.items():
        near = [one for one in constants if one.file == file or one.file not in files]
        idle = [(one.named, "float" if one.text.startswith("float") else "int", False) for one in near[:_MOST_IDLE]]
        idle += [(name, kind, True) for name, kind in _unread_locals(lines, words)]
        inputs = _unread_inputs(heads.get((file, scope)), lines, words)
        idle += [(name, kind, True) for name, kind in inputs if (_predicate(lines), name) not in labels]
        for site in lines if idle else ():
            for name, kind, is_local in idle:
                found[site] += _grown(site, name, kind == "float", is_local)
        for site in lines:
            if _BARE.fullmatch(site.text):
                usual = [name for name, _ in slacks[file].most_common(_MOST_IDLE)]
                found[site] += [one for name in usual for one in _grown(site, name, False, False) if "+" in one.new]
    return [replace(site, edits=(*site.edits, *found[site])) if found.get(site) else site for site in sites]


def _unread_locals(lines: Sequence[EditSite], words: dict[EditSite, list[str]]) -> Iterator[tuple[str, str]]:
    """The numbers that lines of a rule declare and set, and none reads, each with its type."""
    for site in lines:
        if (declared := _NUMBER.fullmatch(site.text)) is None:
            continue
        kind, name = declared.groups()
        others = [one for one in lines if one is not site and name in words[one]]
        is_set = "=" in site.text or bool(others)
        if is_set and all((left := _SET.match(one.text)) and left.group(1) == name for one in others):
            yield name, kind


def _unread_inputs(
    head: EditSite | None, lines: Sequence[EditSite], words: dict[EditSite, list[str]]
) -> Iterator[tuple[str, str]]:
    """The numbers that a token brings along and its rule does not speak of, where that simulates how long it lasts."""
    if head is None or not any(_LASTS.match(site.text) for site in lines):
        return
    said = {word for site in lines for word in words[site]}
    yield from ((name, kind) for name, kind in head.inputs if name not in said)


def _predicate(lines: Sequence[EditSite]) -> str:
    """The predicate of a rule, without its class."""
    return lines[0].rule.rpartition(".")[2]


def _grown(site: EditSite, name: str, is_real: bool, is_local: bool) -> Iterator[SmallEdit]:
    """A demand with a number more: beside its right side, or beside one of the terms there."""
    compared = _COMPARED.fullmatch(site.text)
    if compared is None or _SAMPLING in site.text or name in _WORD.findall(site.text):
        return
    whole = _stripped(site.text, *compared.span(2))
    is_time = compared.group(1).strip().rpartition(".")[2] in TOKEN_TIMES
    sums = [(whole, sign) for sign in "+-"] if not (is_real and is_time) else []
    terms = [one for one in _terms(site.text, *whole) if not set(_POINTS) & set(_WORD.findall(site.text[slice(*one)]))]
    inner = [_within(site.text, one.end()) for one in _ROUNDED.finditer(site.text, *whole)]
    products = [(one, sign) for one in (*inner, *(() if is_real and is_time else terms)) for sign in "*/"]
    for (first, last), sign in (*products, *sums) if is_local else (*sums, *products):
        old = site.text[first:last]
        is_sum = sign in "*/" and len(list(_terms(old, 0, len(old)))) > 1
        new = f"({old}) {sign} {name}" if is_sum else f"{old} {sign} {name}"
        yield site.edit(EditKind.MISSING, first, last, new)


def _terms(text: str, first: int, last: int) -> Iterator[tuple[int, int]]:
    """Where the terms of a sum stand."""
    depth, begun = 0, first
    for at in range(first, last):
        depth += (text[at] == "(") - (text[at] == ")")
        if depth == 0 and text[at] in "+-" and text[begun:at].strip() and text[begun:at].rstrip()[-1] not in "*/":
            yield _stripped(text, begun, at)
            begun = at + 1
    yield _stripped(text, begun, last)


def _within(text: str, first: int) -> tuple[int, int]:
    """What stands in parentheses that begin before `first`."""
    depth, last = 1, first
    while depth and last < len(text):
        depth += (text[last] == "(") - (text[last] == ")")
        last += 1
    return _stripped(text, first, last - 1)


def _stripped(text: str, first: int, last: int) -> tuple[int, int]:
    """A stretch of a text without the blanks around it."""
    part = text[first:last]
    return first + len(part) - len(part.lstrip()), last - len(part) + len(part.rstrip())
